"""Pushes: the same impulse in every engine, and a pushed run repeats itself bit for bit."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import replace

import numpy as np
import pytest

import apnc
from apnc.cli.walk import experiment_of
from apnc.loop.push import LASTS, Push, parse_pushes, pushes_text, velocity_changes
from apnc.loop.record import Record
from apnc.report.wording import facts, heading
from apnc_core.types import Array
from apnc_plant.conditions import Conditions
from apnc_plant.options import PlantOptions

PUSHED = (Push(0.5, 0.3, -0.4), Push(0.53, 0.0, 0.2))
ENGINES = ("compiled", "exudyn", "mujoco")


def walk(engine: str, pushes: tuple[Push, ...] = PUSHED, duration: float = 1.0) -> Record:
    return apnc.simulate(apnc.Experiment(duration=duration, engine=engine, pushes=pushes))


def same(a: Record, b: Record) -> bool:
    return all(np.array_equal(values, b.signals[name]) for name, values in a.signals.items())


def test_the_impulse_comes_in_equal_parts_and_pushes_add_up() -> None:
    changes = velocity_changes(PUSHED, 2.0, 0.02, 1000)
    ticks = round(LASTS / 0.02)
    assert list(changes) == list(range(25, 27 + ticks))
    assert changes[25] == pytest.approx((0.3 / 2.0 / ticks, -0.4 / 2.0 / ticks))
    total = np.sum(list(changes.values()), axis=0) * 2.0
    assert total == pytest.approx([0.3, -0.2])


def test_a_push_after_the_end_is_none_and_one_at_the_end_is_cut() -> None:
    assert velocity_changes([Push(1.0, 1.0, 0.0)], 1.0, 0.02, 50) == {}
    assert list(velocity_changes([Push(0.97, 1.0, 0.0)], 1.0, 0.02, 50)) == [49]


@pytest.mark.parametrize("engine", ENGINES)
def test_a_robot_in_the_air_takes_up_the_whole_impulse(engine: str) -> None:
    """In free fall the velocity of the centre of mass changes by impulse over mass."""
    from apnc.loop.engines import plant_in  # noqa: PLC0415  # MuJoCo may be missing

    experiment = apnc.Experiment(engine=engine)
    plant = plant_in(engine)(
        experiment.description, options=PlantOptions(step=experiment.step),
        conditions=Conditions(held_at=0.5),
    )  # fmt: skip
    plant.set_conditions(Conditions())
    still = np.zeros(plant.n_legs)
    for _ in range(3):
        plant.advance(still, still, 1 / 60)
    before = plant.sample()
    plant.shift_velocity(0.25, -0.1)
    plant.advance(still, still, 1e-3)
    after = plant.sample()
    assert (after["foot_force"] == 0.0).all()
    change = after["velocity"] - before["velocity"]
    assert change[:2] == pytest.approx([0.25, -0.1], abs=2e-3)
    # no body moves against another
    assert after["joint_speed"] == pytest.approx(before["joint_speed"], abs=0.05)


def test_the_engines_are_pushed_alike_and_the_robot_steps_aside() -> None:
    free, *pushed = (walk("compiled", ()), *(walk(engine) for engine in ENGINES))
    aside = [record.signals["position"] for record in pushed]
    assert aside[1] == pytest.approx(aside[0], abs=1e-6)
    assert aside[2] == pytest.approx(aside[0], abs=1e-6)
    moved = aside[0] - free.signals["position"]
    assert (moved[:31] == 0.0).all()
    assert moved[37, 1] < -1e-3  # before the second push ends


class Still:
    """A plant that cannot be pushed."""

    legs, mass, fell = ("RF", "RH", "LF", "LH"), 1.0, False


def test_a_plant_that_cannot_be_pushed_is_named() -> None:
    experiment = apnc.Experiment(duration=1.0, pushes=PUSHED)
    with pytest.raises(ValueError, match="a Still can be neither watched nor pushed"):
        apnc.simulate(experiment, plant=Still())  # type: ignore[arg-type]


def test_in_c_with_others_beside_it_the_bits_are_those_of_the_loop_in_python() -> None:
    seen: list[float] = []

    def watch(t: float, sample: Mapping[str, Array], controller: object) -> Iterable[object]:
        seen.append(t)
        return ()

    experiment = apnc.Experiment(duration=1.0, engine="compiled", pushes=PUSHED)
    in_python = apnc.simulate(experiment, watch=watch)
    assert len(seen) == 60
    assert same(apnc.simulate(experiment), in_python)
    others = [replace(experiment, pushes=()), experiment, replace(experiment, pushes=PUSHED[:1])]
    together = apnc.simulate_many(others, records=True)
    assert together[1] is not None and same(together[1], in_python)
    assert together[0] is not None and not same(together[0], in_python)


@pytest.mark.parametrize("engine", ENGINES)
def test_a_run_that_was_pushed_by_hand_says_so_and_repeats_itself(engine: str) -> None:
    times: list[float] = []

    def watch(
        t: float, sample: Mapping[str, Array], controller: object
    ) -> Iterable[tuple[float, float]]:
        times.append(float(sample["position"][0]))
        return {20: [(0.2, 0.3), (0.0, 0.1)], 23: [(-0.1, 0.0)]}.get(len(times) - 1, [])

    record = apnc.simulate(apnc.Experiment(duration=1.0, engine=engine), watch=watch)
    assert times == record.signals["position"][:, 0].tolist()
    pushes = record.experiment.pushes
    assert [(p.x, p.y) for p in pushes] == [(0.2, 0.3), (0.0, 0.1), (-0.1, 0.0)]
    assert [p.at for p in pushes] == [n * (1 / 60) for n in (20, 20, 23)]
    words = record.experiment.command().split()
    again = experiment_of(
        {"duration": 1.0, "engine": engine, "push": words[words.index("--push") + 1]}
    )
    assert again == record.experiment
    assert same(apnc.simulate(again), record)
    assert dict(facts(record))["Pushes"] == (
        "0.2 N s forward, 0.3 N s left at 0.3333 s; 0 N s forward, 0.1 N s left at 0.3333 s; "
        "0.1 N s back, 0 N s left at 0.3833 s"
    )
    assert heading(record.experiment).endswith("pushed 3 times")


def test_pushes_go_through_text_and_json() -> None:
    pushes = (Push(1 / 3, 0.1, -2.0), Push(7.0, 0.0, 1e-9))
    assert parse_pushes(pushes_text(pushes)) == pushes
    experiment = apnc.Experiment(pushes=pushes)
    data = json.loads(json.dumps(experiment.to_dict()))
    assert apnc.Experiment.from_dict(data) == experiment
    assert apnc.Experiment().key() != experiment.key()
    assert "Pushes" not in dict(facts(walk("compiled", (), 0.1)))


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("3", "push = '3' is not seconds:x:y"),
        ("3:1", "is not seconds:x:y"),
        ("3:1:x", "is not seconds:x:y"),
        ("-1:0:0", "at is -1.0; allowed: a finite number, 0 or more [s]"),
        ("1:inf:0", "x is inf; allowed: a finite number [N.s]"),
    ],
)
def test_what_is_no_push_is_refused_in_a_line(text: str, words: str) -> None:
    with pytest.raises(ValueError, match=r".") as refused:
        parse_pushes(text)
    assert words in str(refused.value) and "\n" not in str(refused.value)


def test_the_command_line_takes_pushes() -> None:
    assert experiment_of({"push": "1:0.5:0,2:0:-1"}).pushes == (
        Push(1.0, 0.5, 0.0),
        Push(2.0, 0.0, -1.0),
    )

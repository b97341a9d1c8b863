"""Walks from other phases: where they begin, and where they are said to end."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from apnc import Experiment, metrics, simulate
from apnc.loop.fmu_controller import FmuError
from apnc.loop.simulate import plant_of
from apnc_core.controller import Controller
from apnc_core.interface import Inputs, Parameters
from research.basin import runner
from research.basin.ends import counts, counts_table, places, times
from research.basin.starts import (
    RANDOM,
    Walk,
    found_in,
    outputs_at,
    phases_of,
    starts_of,
    walks_from,
)
from research.modes.gaits import CANDIDATES, mirrored

TICK = 1.0 / 60.0


def walk(seconds: float, **fields: object) -> Experiment:
    return Experiment(duration=seconds, engine="compiled", **fields)  # type: ignore[arg-type]


def test_a_start_has_the_phases_of_its_gait() -> None:
    for gait in CANDIDATES[4]:
        phases = phases_of(gait, 4, 7)
        relative = metrics.wrap(phases[1:] - phases[0] - CANDIDATES[4][gait])
        assert np.abs(relative).max() < 1e-12
    assert phases_of("trot", 4, 7)[0] != phases_of("trot", 4, 8)[0]
    one, two = phases_of(RANDOM, 6, 7), phases_of(RANDOM, 6, 8)
    assert len(one) == 6 and np.ptp(one) > 0.1 and not np.allclose(one, two)
    assert starts_of(4)[:3] == (RANDOM, "trot", "pace")


def test_the_oscillators_begin_at_the_phases() -> None:
    phases = np.array([0.3, -2.0, 1.0, 2.5])
    seen = metrics.cpg_phase(*outputs_at(walk(1.0, mi=0.15), phases))
    assert np.abs(metrics.wrap(seen - phases)).max() < 0.3  # the angle grows unevenly


def walk_in_numpy(experiment: Experiment, o1: np.ndarray, o2: np.ndarray) -> Walk:
    """The same walk under the readable controller, whose state can be written."""
    p = Parameters(**experiment.parameters())  # type: ignore[arg-type]
    controller, plant = Controller(p, len(o1)), plant_of(experiment)
    controller.circuits.o1, controller.circuits.o2 = o1, o2
    trace = plant.trace()
    seen = []
    for _ in range(experiment.ticks):
        out = controller.tick(Inputs(grf=plant.grf(), MI=experiment.mi))  # type: ignore[arg-type]
        trace.take()
        seen.append((out.o1, out.o2))
        plant.advance(out.theta_hip, out.theta_knee, experiment.Ts)
    first, second = (np.array(each) for each in zip(*seen, strict=True))
    return Walk(first, second, trace.signals()["foot_force"][..., 2], plant.fell)


@pytest.mark.parametrize("controller", ["apc", "apnc"])
def test_the_oscillators_of_the_fmu_begin_apart(controller: str) -> None:
    experiments = [walk(3.0, mi=0.15, seed=seed, controller=controller) for seed in range(10)]
    starts = [outputs_at(e, phases_of(RANDOM, 4, e.seed)) for e in experiments]
    found = dict(walks_from(experiments, starts))
    assert sorted(found) == list(range(10))
    for index in (0, 9):  # one of the first, and one that took the lane of another
        own = walk_in_numpy(experiments[index], *starts[index])
        assert np.abs(own.o1 - found[index].o1).max() < 1e-9
        assert np.abs(own.force - found[index].force).max() < 1e-6
    after = simulate(walk(0.1)).signals["o1"][0]  # of the same FMU, all legs alike again
    assert after == pytest.approx(0.01)


def test_outputs_that_are_not_in_the_saved_state_are_named(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("research.basin.apart._HEADER", 10**6)
    with pytest.raises(FmuError, match="does not hold the outputs of the oscillators"):
        list(walks_from([walk(1.0, mi=0.15)], [(np.zeros(4), np.zeros(4))]))


def made(phases: np.ndarray, seconds: float = 10.0, fell: bool = False) -> Walk:
    """Oscillators on a circle; the phases, shape (T, n), may change."""
    time = np.arange(round(seconds / TICK)) * TICK
    angle = 2.0 * np.pi * 1.5 * time[:, np.newaxis] + phases
    force = np.full(angle.shape, 6.0)
    return Walk(np.cos(angle), -np.sin(angle), force, fell)


def test_a_walk_ends_in_the_gait_of_its_last_second() -> None:
    ticks = np.arange(600)[:, np.newaxis]
    trot = np.array([0.0, np.pi, np.pi, 0.0])
    turned = np.where(ticks < 240, 0.0, trot)  # after 4 s
    found = found_in(made(turned), 24.5, TICK)
    assert found["gait"] == "trot" and found["after_s"] == pytest.approx(4.0, abs=0.8)
    assert found_in(made(np.zeros(4)), 24.5, TICK)["gait"] == "pronk"
    odd = found_in(made(np.array([0.0, 2.0, 1.0, 5.0])), 24.5, TICK)
    assert odd == {"gait": "other", "after_s": None, "fell": False}
    assert found_in(made(trot, fell=True), 24.5, TICK)["gait"] == "fell"
    six = np.concatenate([[0.0], mirrored(CANDIDATES[6]["tetrapod"])])
    assert not np.allclose(metrics.wrap(six[1:] - CANDIDATES[6]["tetrapod"]), 0.0)
    mirror = found_in(made(six), 24.5, TICK)
    assert mirror["gait"] == "tetrapod" and mirror["after_s"] is not None


def test_walks_are_kept_and_continued(tmp_path: Path) -> None:
    few = runner.grid_of("lilibot", [0.15], 1, 0, 1.0)
    runner.run(few, tmp_path, workers=1)
    kept = (tmp_path / runner.RESULTS_FILE).read_bytes()
    with pytest.raises(ValueError, match="holds walks already; --resume continues them"):
        runner.run(few, tmp_path)
    more = runner.grid_of("lilibot", [0.15], 2, 0, 1.0)
    results = runner.run(more, tmp_path, workers=2, resume=True)
    assert (tmp_path / runner.RESULTS_FILE).read_bytes().startswith(kept)
    assert [(r["seed"], r["controller"]) for r in results] == [
        (0, "apnc"), (0, "apc"), (1, "apnc"), (1, "apc"),
    ]  # fmt: skip
    with (tmp_path / runner.TABLE_FILE).open() as file:
        assert len(list(csv.DictReader(file))) == 4


def test_every_start_of_a_robot_is_another_walk() -> None:
    grid = runner.grid_of("hexapod", [0.1, 0.2], 3, 2)
    assert len({trial.id for trial in grid}) == len(grid)
    assert len(grid) == 2 * 2 * (3 + 2 * len(CANDIDATES[6]))


def test_the_table_counts_ends_and_the_picture_shows_the_commonest() -> None:
    cell = {"mi": 0.15, "start": RANDOM, "controller": "apc"}
    ends = [("trot", 2.0), ("trot", 4.0), ("trot", ""), ("pace", 1.0)]
    other = [cell | {"start": "pace", "gait": "other", "after_s": ""}]
    rows = counts([*(cell | {"gait": gait, "after_s": after} for gait, after in ends), *other])
    assert counts_table(rows).splitlines()[2] == (
        "| 0.15 | random (4) | APC alone | trot 3, pace 1 | 19.4 ... 99.4 % | 3.0 (2.2 ... 3.8) |"
    )
    assert places(rows) == {"from random: trot 3/4": 0.0, "from pace: other 1/1": -1.0}
    (trace,) = times(rows)  # no time without a gait
    assert (trace["x"], trace["y"]) == ([3.0], [0.0])
    assert trace["error_x"]["array"] == pytest.approx([0.8])
    both = times([*rows, *(row | {"controller": "apnc"} for row in rows)])
    assert both[0]["y"][0] > both[1]["y"][0]

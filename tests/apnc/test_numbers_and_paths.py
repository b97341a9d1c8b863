"""What is a number or a path is taken as one, wherever it comes in, and can be saved."""

from __future__ import annotations

import json
import re
from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from apnc import (
    Conditions,
    Experiment,
    Gait,
    Kerb,
    Obstacles,
    Plane,
    Waves,
    load_robot,
    read_gait,
    run_study,
    write_gait,
)
from apnc.loop.as_dict import to_dict
from apnc.loop.fmu_controller import FmuController
from apnc.studies.runner import grid_of
from apnc_core.in_python import in_python
from apnc_core.settings import checked
from apnc_plant.options import PlantOptions
from apnc_plant.robot import ROBOTS
from build_fmu.build import build_key
from build_fmu.options import BuildOptions

LILIBOT = load_robot("lilibot")
QUARTER = np.float32(0.25)  # exact in single precision, too

SAME: list[tuple[Callable[[Any], Any], Any, Any]] = [
    (lambda x: Experiment(mi=x), QUARTER, 0.25),
    (lambda x: Experiment(mi=x), np.array(0.25), 0.25),
    (lambda x: Experiment(mi=x), Fraction(1, 4), 0.25),
    (lambda x: Experiment(mi=x), np.array([[0.0, 0.25], [5.0, 0.5]]), ((0.0, 0.25), (5.0, 0.5))),
    (lambda x: Experiment(turn=((0, x),)), QUARTER, 0.25),
    (lambda x: Experiment(reset=x), np.True_, True),
    (lambda x: Experiment(seed=x), np.uint64(3), 3),
    (lambda x: Experiment(duration=x), np.float32(2), 2.0),
    (lambda x: Experiment(rate=x), np.int32(50), 50.0),
    (lambda x: Experiment(step=x), np.float64(0.001), 0.001),
    (lambda x: Experiment(controller=x), np.str_("apc"), "apc"),
    (lambda x: Experiment(robot=x), ROBOTS / "hexapod.toml", str(ROBOTS / "hexapod.toml")),
    (lambda x: Experiment(settings={"xi": x}), QUARTER, 0.25),
    (lambda x: Experiment(settings={"N": x}), np.int16(40), 40),
    (lambda x: Experiment(settings={"phi_frozen": x}), np.False_, False),
    (lambda x: Experiment(settings={"phi_stored": x}), np.array([1.0, 2.0, 3.0]), (1, 2, 3)),
    (lambda x: Experiment(ground=Obstacles(seed=x)), np.int64(3), 3),
    (lambda x: Experiment(ground=Obstacles(roughness=x)), QUARTER, 0.25),
    (lambda x: Experiment(ground=Obstacles(diameters=x)), np.array([0.05, 0.1]), (0.05, 0.1)),
    (lambda x: Experiment(ground=Kerb(at=x)), QUARTER, 0.25),
    (lambda x: Experiment(ground=Waves(wavelength=x)), QUARTER, 0.25),
    (lambda x: Experiment(ground=Plane(slope=x)), QUARTER, 0.25),
    (lambda x: Experiment(conditions=Conditions(payload=x)), QUARTER, 0.25),
    (lambda x: Experiment(conditions=Conditions(stuck={"RF": x})), QUARTER, 0.25),
    (lambda x: Experiment(conditions=Conditions(held_at=x)), QUARTER, 0.25),
    (lambda x: Experiment(robot=replace(LILIBOT, controller={"xi": x})), QUARTER, 0.25),
    (
        lambda x: Experiment(robot=replace(LILIBOT, servo=replace(LILIBOT.servo, damping=x))),
        QUARTER,
        0.25,
    ),
    (
        lambda x: Experiment(
            robot=replace(
                LILIBOT,
                trunk=replace(LILIBOT.trunk, com=x),
            )
        ),
        np.array([0.25, 0.0, 0.0], dtype=np.float32),
        (0.25, 0.0, 0.0),
    ),
]


@pytest.mark.parametrize(("make", "given", "own"), SAME, ids=range(len(SAME)))
def test_an_experiment_is_the_same_and_can_be_saved(
    make: Callable[[Any], Experiment], given: Any, own: Any
) -> None:
    found, usual = make(given), make(own)
    assert found == usual and hash(found) == hash(usual)
    assert found.key() == usual.key() and found.command() == usual.command()
    assert json.dumps(found.to_dict()) == json.dumps(usual.to_dict())
    assert Experiment.from_dict(json.loads(json.dumps(found.to_dict()))) == found


def test_an_fmu_may_be_a_path(fmu4: Path) -> None:
    assert Experiment(fmu=fmu4) == Experiment(fmu=str(fmu4))  # type: ignore[arg-type]


def test_a_float_of_single_precision_is_the_number_that_it_is() -> None:
    assert Experiment(mi=np.float32(0.1)).mi == float(np.float32(0.1)) != 0.1


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"mi": "0.1"}, "mi: '0.1' is not a number"),
        ({"seed": True}, "seed is True; allowed: a whole number from 0 to 2^64 - 1"),
        ({"seed": np.float64(3)}, "seed is 3.0; allowed: a whole number"),
        ({"rate": "fast"}, "rate is 'fast'; allowed: a finite number"),
        ({"duration": None}, "duration is None; allowed: a finite number"),
        ({"step": "0.001"}, "step is '0.001'; allowed: a finite number"),
        ({"robot": 5}, "robot: 5 is not a name, a file or a description"),
        ({"fmu": 5}, "fmu is 5; allowed: the path of a file"),
        ({"settings": None}, "settings is None; allowed: a table"),
        ({"settings": {"N": np.float32(40)}}, "N = 40.0; allowed: a whole number"),
        ({"settings": {"xi": np.array([0.1, 0.2])}}, "xi = [0.1, 0.2]; allowed: a number"),
    ],
)
def test_what_is_neither_is_refused_for_what_it_is(change: dict[str, Any], words: str) -> None:
    with pytest.raises(ValueError, match=re.escape(words)):
        Experiment(**change)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: Obstacles(roughness="rough"), "roughness is 'rough'; allowed: a finite number"),
        (lambda: Obstacles(seed=1.5), "seed is 1.5; allowed: a whole number"),
        (lambda: Plane(slope=None), "slope is None; allowed: a finite number"),
        (lambda: Conditions(payload="heavy"), "payload is 'heavy'; allowed: a finite number"),
        (lambda: Conditions(stuck={"RF": None}), "stuck.RF is None; allowed: a finite number"),
        (lambda: PlantOptions(clearance="low"), "clearance is 'low'; allowed: a finite number"),
        (
            lambda: Gait(("RF", "RH"), ("x",)),
            "phi[1] is 'x'; allowed: a finite number from -7 to 7 [rad]",
        ),
        (lambda: Gait(("RF", 3), (1.0,)), "legs[2] is 3; allowed: a text"),
        (lambda: Gait("RF", (1.0,)), "legs is 'RF'; allowed: a list of texts"),
        (lambda: grid_of("mi", 2.5), "trials = 2.5 is not a whole number"),
        (lambda: grid_of("mi", 1, chosen={"mi": 0.1}), "mi = 0.1 is not a list of values"),
        (lambda: grid_of("mi", 1, chosen={"mi": [None]}), "mi = None: not a number"),
    ],
)
def test_nor_anywhere_else(make: Callable[[], Any], words: str) -> None:
    with pytest.raises(ValueError, match=re.escape(words)):
        make()


def test_a_gait_takes_lists_and_arrays(tmp_path: Path) -> None:
    gait = Gait(("RF", "RH", "LF", "LH"), (3.25, 3.0, 0.5))
    given = Gait(["RF", "RH", "LF", "LH"], np.array([3.25, 3.0, 0.5], np.float32))  # type: ignore[arg-type]
    assert given == gait and given.settings(gait.legs) == gait.settings(gait.legs)
    write_gait(given, tmp_path / "gait.json")
    assert read_gait(tmp_path / "gait.json") == gait


def test_a_study_takes_arrays_and_paths(tmp_path: Path) -> None:
    results = run_study(
        "mi",
        trials=np.int64(1),  # type: ignore[arg-type]
        controllers=np.array(["apnc"]),  # type: ignore[arg-type]
        chosen={"mi": np.array([0.1, 0.2])},  # type: ignore[dict-item]
        duration=np.float32(0.5),  # type: ignore[arg-type]
        robot=ROBOTS / "hexapod.toml",  # type: ignore[arg-type]
        output=tmp_path,
    )
    usual = grid_of("mi", 1, ["apnc"], {"mi": [0.1, 0.2]}, 0.5, str(ROBOTS / "hexapod.toml"))
    assert [result["key"] for result in results] == [trial.id.key for trial in usual]
    stored = [json.loads(line) for line in (tmp_path / "trials.jsonl").read_text().splitlines()]
    assert {result["robot"] for result in stored} == {str(ROBOTS / "hexapod.toml")}
    assert {result["error"] for result in stored} == {""}


def test_a_build_is_the_same() -> None:
    own = BuildOptions(legs=4, fmi=2, gait=(1.0, 2.0, 0.5), settings={"xi": 0.25})
    given = BuildOptions(
        legs=np.int64(4),  # type: ignore[arg-type]
        fmi=np.int8(2),  # type: ignore[arg-type]
        gait=np.array([1.0, 2.0, 0.5]),  # type: ignore[arg-type]
        settings={"xi": QUARTER},
    )
    assert given == own and build_key(given) == build_key(own)


def test_a_controller_takes_arrays(fmu4: Path) -> None:
    with FmuController(fmu4, {"phi_stored": np.array([1.0, 2.0, 0.5]), "N": np.int64(40)}) as fmu:  # type: ignore[dict-item]
        found = fmu.parameters()
    assert (found["phi_stored"], found["N"]) == ((1.0, 2.0, 0.5), 40)


def test_robots_by_their_path() -> None:
    assert load_robot(ROBOTS / "lilibot.toml") == LILIBOT


def test_what_is_no_number_stays_what_it_is() -> None:
    kept = (checked("method", "apc"), {"a": 1}, "text", None, object)
    assert in_python(kept) == kept and all(
        a is b for a, b in zip(in_python(kept), kept, strict=True)
    )
    assert to_dict(in_python([np.int8(1), (np.float16(0.5), Path("x"))])) == [1, [0.5, "x"]]

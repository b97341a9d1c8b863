"""How far the claim goes: the cases, what counts as walking, and where it ends."""

from __future__ import annotations

import math
from typing import Any

import pytest
from made_up_results import made_up

from apnc.studies.results import SPEED, STRICT, Result
from apnc.studies.runner import grid_of
from apnc_plant.conditions import Conditions
from apnc_plant.ground import Kerb, Obstacles, Plane, Waves
from apnc_plant.robot import load_robot
from apnc_plant.robot.size import mean_leg_length, times_longer
from research import limits
from research.limits.cases import AS_IT_IS, CASES, LIMITS
from research.registry import STUDIES

WALKS_WELL = {STRICT: 2.0, SPEED: 0.1, "forward_speed_m_per_s": 0.09, "distance_m": 3.0}


def test_values_go_from_easy_to_hard_and_every_case_is_another_experiment() -> None:
    for limit in LIMITS.values():
        assert sorted(limit.values) in (list(limit.values), list(limit.values[::-1]))
    trials = grid_of("limits", 1, studies=STUDIES)
    assert len({trial.id for trial in trials}) == len(trials) == 3 * len(CASES)
    assert not any("," in name for name in CASES)


def test_a_case_changes_what_it_says_in_units_of_the_robot() -> None:
    robot, leg = load_robot("hexapod"), mean_leg_length(load_robot("hexapod"))
    own = limits.experiment("apnc", 3, AS_IT_IS, "hexapod")

    def of(case: str) -> Any:
        return limits.experiment("apnc", 3, case, "hexapod")

    assert own.ground == Plane() and own.conditions == "C1" and own.rate == 60.0
    assert of("slope down 10 deg").ground == Plane(slope=-math.radians(10.0))
    assert of("obstacles 0.8 R").ground == Obstacles(
        roughness=0.8, seed=3, scale=times_longer(robot)
    )
    assert of("kerb 10 % of the leg").ground == Kerb(at=0.5, height=0.1 * leg)
    assert of("waves 10 % of the leg").ground == Waves(amplitude=0.1 * leg, wavelength=3.0 * leg)
    assert of("payload 50 % of the mass").conditions == Conditions(payload=0.5 * robot.mass)
    assert of("update rate 20 Hz").rate == 20.0
    assert of("noise of the sensors 0.4 half weights").conditions == Conditions(grf_noise=0.4)
    late = of("more delay of the sensors 20 ms").description.sensor
    assert late.delay == pytest.approx(robot.sensor.delay + 0.02)


@pytest.mark.parametrize(
    "lost",
    [{STRICT: None}, {"fell": True}, {SPEED: 0.004}, {"forward_speed_m_per_s": 0.04},
     {"distance_m": None}],
)  # fmt: skip
def test_a_gait_that_does_not_carry_the_robot_ahead_does_not_work(lost: Result) -> None:
    good = {"case": AS_IT_IS, "fell": False} | WALKS_WELL
    assert limits.works(good) and not limits.works(good | lost)


def test_a_kerb_must_be_met() -> None:
    good = {"case": "kerb 10 % of the leg", "fell": False} | WALKS_WELL
    assert limits.works(good) and not limits.works(good | {"distance_m": 0.6})


def test_the_table_ends_at_the_first_value_that_does_not_work() -> None:
    def figures(cell: Result) -> Result:
        value, first = CASES[cell["case"]].value, cell["seed"] == 0
        good = value <= 4.0 or value == 8.0
        good &= cell["controller"] == "apnc" or value == 0.0
        return WALKS_WELL | {STRICT: 1.0 if good and not (value == 8.0 and first) else None}

    cases = (AS_IT_IS, *(f"slope up {value} deg" for value in (2, 4, 6, 8)), "slope down 2 deg")
    results = made_up({"case": cases}, figures, ("apnc", "tegotae_best"), 5, study="limits")
    rows = limits.counts(results)
    lines = limits.counts_table(rows).splitlines()
    assert lines[2:] == [
        "| slope up | deg | 4 (5/5), not 6 (0/5) | nothing (5/5), not 2 (0/5) |",
        "| slope down | deg | at least 2 (5/5) | nothing (5/5), not 2 (0/5) |",
    ]
    never = [row | {"works": 0} for row in rows]
    assert "no: nothing (0/5)" in limits.counts_table(never)
    assert "at least 8 (5/5)" in limits.counts_table(rows, "upright")
    last = [row | {"value": 32.0} if row["value"] == 8.0 else row for row in rows]
    assert "all, to 32 (5/5)" in limits.counts_table(last, "upright")

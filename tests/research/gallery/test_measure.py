"""The gallery's walks: on fresh seeds, over the MI range of the robot, and judged as walks."""

from __future__ import annotations

from dataclasses import replace

import pytest

from apnc.loop.experiment import Experiment
from apnc.many import simulate_many
from apnc_plant.robot import RobotDescription, load_robot
from research.gallery import measure
from research.gallery.measure import CONTROLLERS, experiments, measured, mi_values, walks


@pytest.fixture(scope="module")
def robot() -> RobotDescription:
    return replace(load_robot("lilibot"), rate=50.0, mi_range=(0.08, 0.32))


def test_every_seed_walks_at_every_mi_with_each_controller_on_both_bodies(
    robot: RobotDescription,
) -> None:
    plan = list(experiments(robot, 2))
    cells = {(body, label, e.mi, e.seed) for body, label, e in plan}
    assert len(plan) == len(cells) == 2 * 2 * 5 * 2
    assert mi_values(robot) == pytest.approx([0.08, 0.1131, 0.16, 0.2263, 0.32])
    for body, label, experiment in plan:
        assert experiment.controller == CONTROLLERS[label]
        assert (experiment.rate, experiment.ticks) == (50.0, 1800)
        assert experiment.seed >= 2**32
        own = experiment.description
        assert (own == robot) is (body == "own")
        # the controller is told the weight of the file, whatever the body weighs
        assert experiment.parameters()["robot_weight"] == robot.weight
        assert own.controller == robot.controller
    bodies = {e.description.mass for body, _, e in plan if body == "varied"}
    assert len(bodies) == 2  # one per seed


def test_walks_are_measured_in_their_order(
    robot: RobotDescription, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(measure, "WALK_S", 3.0)
    counts: list[int] = []
    found = walks("dog", robot, 1, 2, lambda done, total: counts.append(done))
    plan = list(experiments(robot, 1))
    assert [(w.body, w.controller, w.mi) for w in found] == [
        (body, label, e.mi) for body, label, e in plan
    ]
    assert counts == list(range(1, len(plan) + 1))
    assert {w.robot for w in found} == {"dog"}


def one(experiment: Experiment) -> measure.Walk:
    (record,) = simulate_many([experiment], records=True)
    assert record is not None
    return measured("lilibot", "own", "ANC", record)


def test_a_trot_counts_and_a_stand_does_not() -> None:
    walk = one(Experiment(mi=0.16, duration=20.0, seed=measure.FIRST_SEED))
    assert walk.strict and walk.convergence_time_s is not None
    assert 0.08 < walk.speed_m_per_s < 0.2  # docs/formation/walks.md: 0.13 m/s
    assert 0.02 < walk.lift_share < 0.15
    assert walk.slip_share is not None and walk.slip_share < 0.5
    stand = one(Experiment(mi=0.0, duration=5.0))
    assert not stand.strict and abs(stand.speed_m_per_s) < 0.005
    assert stand.lift_share == 0.0 and stand.slip_share is None


def test_a_trot_on_the_spot_does_not_count() -> None:
    ice = replace(load_robot("lilibot"), contact=replace(load_robot("lilibot").contact, friction=0))
    gait = {"stored": True, "phi_stored": (3.1416, 3.1416, 0.0)}
    walk = one(Experiment(robot=ice, mi=0.16, duration=10.0, settings=gait))
    assert walk.convergence_time_s is not None and not walk.strict


def test_a_fall_counts_for_nothing() -> None:
    robot = load_robot("lilibot")
    weak = replace(robot, servo=replace(robot.servo, stall_torque=0.2))
    walk = one(Experiment(robot=weak, duration=5.0))
    assert walk.end == "fell" and not walk.strict
    assert (walk.speed_m_per_s, walk.lift_share, walk.slip_share) == (0.0, 0.0, None)

"""Every condition does what it says, and can be switched while the robot walks."""

import math
import pickle
from dataclasses import replace

import numpy as np
import pytest
from plants import AnyPlant, Kind, in_both

from apnc_plant.conditions import CONDITIONS, Conditions, named_conditions, paper_conditions
from apnc_plant.numbers import SUSPENSION, suspension
from apnc_plant.options import PlantOptions
from apnc_plant.robot import PAYLOAD_SIZE, Body, MassProperties, RobotDescription, load_robot

TICK = 1 / 60
ROBOT = load_robot("lilibot")
QUIET = replace(ROBOT, sensor=replace(ROBOT.sensor, noise=0.0))
HALF = ROBOT.weight / 2.0


def wait(plant: AnyPlant, seconds: float, hip: float = 0.0, knee: float = 0.0) -> None:
    for _ in range(round(seconds / TICK)):
        plant.advance(np.full(4, hip), np.full(4, knee), TICK)


@in_both
def test_payload_weighs_on_the_feet(kind: Kind) -> None:
    plant = kind(ROBOT, conditions=named_conditions("C4", ROBOT))
    wait(plant, 2.0)
    assert plant.mass == pytest.approx(3.75)
    load = plant.sample()["foot_force"][:, 2].sum()
    assert load == pytest.approx(3.75 * 9.81, rel=1e-3)


def test_payload_sits_on_the_trunk() -> None:
    trunk = ROBOT.trunk
    loaded = trunk.loaded(0.001, 1.25)
    height = trunk.center[2] + trunk.size[2] / 2.0 + PAYLOAD_SIZE[2] / 2.0
    assert loaded.mass == pytest.approx(trunk.mass + 1.25)
    own = np.add(trunk.com, [0.0, 0.001, 0.0])
    expected = (trunk.mass * own + 1.25 * np.array([0.0, 0.0, height])) / loaded.mass
    np.testing.assert_allclose(loaded.com, expected)
    plain = trunk.loaded(0.001, 0.0)
    np.testing.assert_allclose(plain.com, own)
    np.testing.assert_allclose(plain.inertia, trunk.inertia_tensor())


def test_two_halves_of_a_box_are_the_box() -> None:
    half = Body(1.0, (0.1, 0.2, 0.3), (0.0, 0.0, 0.0)).inertia_tensor()
    left = MassProperties(1.0, np.array([0.05, 0.0, 0.0]), half)
    right = MassProperties(1.0, np.array([0.15, 0.0, 0.0]), half)
    whole = left.joined(right)
    np.testing.assert_allclose(whole.com, [0.1, 0.0, 0.0])
    expected = Body(2.0, (0.2, 0.2, 0.3), (0.0, 0.0, 0.0)).inertia_tensor()
    np.testing.assert_allclose(whole.inertia, expected)


@in_both
def test_payload_cannot_change_on_the_way(kind: Kind) -> None:
    plant = kind(ROBOT)
    with pytest.raises(ValueError, match=r"payload is 1\.25 kg"):
        plant.set_conditions(Conditions(payload=1.25))


@in_both
def test_added_noise_has_its_size(kind: Kind) -> None:
    plant = kind(QUIET)
    wait(plant, 2.0)
    plant.set_conditions(Conditions(grf_noise=0.05))
    readings = []
    for _ in range(600):
        wait(plant, TICK)
        readings.append(plant.grf())
    # 2400 samples, 4 standard errors of a standard deviation: 6 %.
    deviations = np.array(readings) - plant.sample()["foot_force"][:, 2]
    assert deviations.std() == pytest.approx(0.05 * HALF, rel=0.06)
    assert named_conditions("C2", ROBOT).grf_noise > 5 * ROBOT.sensor.noise


@in_both
def test_a_damaged_leg_does_not_follow(kind: Kind) -> None:
    plant = kind(ROBOT, options=PlantOptions(gravity=0.0, clearance=0.5))
    plant.set_conditions(named_conditions("C3", ROBOT))
    wait(plant, 1.0, hip=0.2, knee=0.3)
    angles = plant.sample()["joint_angle"]
    np.testing.assert_allclose(angles[0], 0.0, atol=0.01)
    np.testing.assert_allclose(angles[1:, 1], 0.2, atol=0.01)
    np.testing.assert_allclose(angles[1:, 2], 0.3, atol=0.01)
    plant.set_conditions(Conditions())
    wait(plant, 1.0, hip=0.2, knee=0.3)
    np.testing.assert_allclose(plant.sample()["joint_angle"][0], [0.0, 0.2, 0.3], atol=0.01)


@in_both
def test_stuck_sensors_deliver_their_value_and_the_others_the_load(kind: Kind) -> None:
    plant = kind(QUIET)
    wait(plant, 2.0)
    plant.set_conditions(named_conditions("S2", ROBOT))
    wait(plant, TICK)
    reading, load = plant.grf(), plant.sample()["foot_force"][:, 2]
    np.testing.assert_allclose(reading[[0, 2]], 0.9 * HALF)
    np.testing.assert_allclose(reading[[1, 3]], load[[1, 3]], rtol=1e-3)
    plant.set_conditions(Conditions())
    wait(plant, TICK)
    np.testing.assert_allclose(plant.grf(), load, rtol=1e-3)


@in_both
def test_removed_feedback_reads_zero(kind: Kind) -> None:
    plant = kind(ROBOT, conditions=named_conditions("S3", ROBOT))
    wait(plant, 1.0)
    np.testing.assert_array_equal(plant.grf(), 0.0)
    plant.set_conditions(Conditions(dropout=("LH",)))
    wait(plant, TICK)
    assert plant.grf()[3] == 0.0
    assert (plant.grf()[:3] > 1.0).all()


@in_both
def test_a_held_robot_hangs_until_it_is_let_go(kind: Kind) -> None:
    plant = kind(QUIET, conditions=named_conditions("S1", ROBOT))
    start = plant.sample()["position"]
    height = start[2] - kind(QUIET).sample()["position"][2]
    assert height == pytest.approx(0.03)
    for tick in range(102):
        swing = 0.1 * math.sin(0.15 * tick)
        plant.advance(np.full(4, swing), np.full(4, swing), TICK)
        np.testing.assert_array_equal(plant.sample()["foot_force"], 0.0)
    # The springs of the suspension give by weight over stiffness, 5 mm, and no more.
    np.testing.assert_allclose(plant.sample()["position"], start, atol=0.006)
    np.testing.assert_allclose(plant.sample()["rpy"], 0.0, atol=0.05)
    plant.set_conditions(Conditions())
    wait(plant, 1.5)
    assert plant.sample()["foot_force"][:, 2].sum() == pytest.approx(ROBOT.weight, rel=1e-3)


@in_both
def test_a_robot_can_be_lifted_while_it_stands(kind: Kind) -> None:
    plant = kind(QUIET)
    wait(plant, 1.0)
    plant.set_conditions(Conditions(held_at=0.03))
    wait(plant, 1.0)
    np.testing.assert_array_equal(plant.sample()["foot_force"], 0.0)
    np.testing.assert_allclose(plant.sample()["rpy"], 0.0, atol=0.01)


def test_conditions_of_the_paper_fit_the_robot() -> None:
    assert set(CONDITIONS) == {"C1", "C2", "C3", "C4", "S1", "S2", "S3"}
    assert named_conditions("C1", ROBOT) == Conditions()
    assert set(paper_conditions(ROBOT)) == set(CONDITIONS)
    with pytest.raises(ValueError, match=r"^'C5' is not one of C1, .*, S2, S3$"):
        named_conditions("C5", ROBOT)


@pytest.mark.parametrize("name", CONDITIONS)
def test_conditions_go_to_other_processes(name: str) -> None:
    assert pickle.loads(pickle.dumps(CONDITIONS[name])) == CONDITIONS[name]


@in_both
def test_no_feedback_means_every_leg_of_any_robot(kind: Kind) -> None:
    legs = ("RF", "RM", "RH", "LF", "LM", "LH")
    assert named_conditions("S3", ROBOT).silent(legs) == legs
    assert Conditions(dropout=("LM",)).silent(legs) == ("LM",)
    assert Conditions().silent(legs) == ()
    plant = kind(load_robot("hexapod"), conditions=named_conditions("S3", ROBOT))
    for _ in range(30):
        plant.advance(np.zeros(6), np.zeros(6), TICK)
    np.testing.assert_array_equal(plant.grf(), 0.0)


def test_the_paper_s_conditions_of_lilibot_are_these_to_the_last_bit() -> None:
    assert paper_conditions(ROBOT) == {
        "C1": Conditions(),
        "C2": Conditions(grf_noise=0.2),
        "C3": Conditions(damaged=("RF",)),
        "C4": Conditions(payload=1.25),
        "S1": Conditions(held_at=0.03),
        "S2": Conditions(stuck={"RF": 0.9, "LF": 0.9}),
        "S3": Conditions(dropout=("*",)),
    }
    assert suspension(ROBOT) == SUSPENSION


def grown(length: float, mass: float) -> RobotDescription:
    """Lilibot with longer legs and heavier parts, legs named as on other robots."""
    names = {"RF": "FR", "RH": "RR", "LF": "FL", "LH": "RL"}

    def heavy(body: Body) -> Body:
        return replace(body, mass=mass * body.mass)

    legs = tuple(
        replace(
            leg,
            name=names[leg.name],
            femur_length=length * leg.femur_length,
            tibia_length=length * leg.tibia_length,
            hip=heavy(leg.hip),
            femur=heavy(leg.femur),
            tibia=heavy(leg.tibia),
        )
        for leg in ROBOT.legs
    )
    trunk = replace(ROBOT.trunk, mass=mass * ROBOT.trunk.mass)
    return replace(ROBOT, trunk=trunk, legs=legs)


def test_the_paper_s_conditions_grow_with_the_robot_and_go_by_place() -> None:
    robot = grown(4.0, 10.0)
    assert named_conditions("C4", robot).payload == pytest.approx(12.5)
    assert named_conditions("S1", robot).held_at == pytest.approx(0.12)
    assert named_conditions("C3", robot).damaged == ("FR",)
    assert named_conditions("S2", robot).stuck == {"FR": 0.9, "FL": 0.9}
    # the same multiple of its weight holds it at the same share of its leg, in the same time
    stiffness, damping, turning, turning_damping = suspension(robot)
    assert stiffness == pytest.approx(5000.0 * 10.0 / 4.0)
    assert turning == pytest.approx(50.0 * 10.0 * 4.0)
    assert damping / stiffness == pytest.approx(2.0 * 200.0 / 5000.0)
    assert turning_damping / turning == pytest.approx(2.0 * 2.0 / 50.0)


def test_a_robot_without_a_leg_at_a_place_has_not_the_conditions_of_it() -> None:
    alone = replace(ROBOT, legs=ROBOT.legs[2:3])
    assert set(paper_conditions(alone)) == {"C1", "C2", "C4", "S1", "S3"}
    with pytest.raises(ValueError, match=r"^leg 'right front' is not one of LF; nor left front"):
        named_conditions("C3", alone)


@pytest.mark.parametrize(
    "conditions",
    [Conditions(damaged=("XX",)), Conditions(stuck={"XX": 0.0}), Conditions(dropout=("XX", "*"))],
)
def test_a_leg_that_the_robot_lacks_is_named(conditions: Conditions) -> None:
    with pytest.raises(
        ValueError, match=r"^leg 'XX' is not one of RF, RH, LF, LH; nor right front"
    ):
        conditions.of_legs(("RF", "RH", "LF", "LH"))


def test_zero_is_allowed_everywhere() -> None:
    Conditions(payload=0.0, grf_noise=0.0, stuck={"RF": 0.0}, held_at=0.0)


@in_both
def test_legs_go_by_name(kind: Kind) -> None:
    with pytest.raises(ValueError, match="leg 'RM' is not one of RF, RH, LF, LH"):
        kind(ROBOT, conditions=Conditions(damaged=("RM",)))


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"payload": -1.0}, r"^payload is -1.0; allowed: a finite number, 0 or more \[kg\]$"),
        ({"grf_noise": math.inf}, "grf_noise is inf"),
        ({"grf_noise": -0.1}, "grf_noise is -0.1"),
        ({"held_at": math.nan}, "held_at is nan"),
        ({"stuck": {"RF": math.nan}}, r"stuck\.RF is nan"),
        ({"held_at": -0.1}, "held_at is -0.1"),
    ],
)
def test_values_out_of_range_are_refused(values: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Conditions(**values)  # type: ignore[arg-type]

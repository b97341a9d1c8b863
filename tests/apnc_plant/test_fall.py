"""When a robot counts as fallen: tilt against the ground, corners of the trunk in it."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from plain_robot import plain_robot
from plants import Kind, in_both, trot
from scipy.spatial.transform import Rotation

from apnc_plant.compiled import PlantInC
from apnc_plant.forces import RobotForces
from apnc_plant.ground import Ground, GroundInC, Kerb, Plane
from apnc_plant.library import library
from apnc_plant.numbers import robot_numbers
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription
from apnc_plant.signals import PlantError
from exudyn_models.plant import ExudynPlant

TICK = 1 / 60
ROBOT = plain_robot()
ZERO = np.zeros(4)


def fallen(
    roll: float, pitch: float, yaw: float, ground: Ground | None = None, height: float = 1.0
) -> bool:
    """Whether a robot in the air over the ground, in any attitude, counts as fallen; asked of the
    plant in C, and of the forces for other engines."""
    _, lib = library()
    ground = ground or Plane()
    q = np.zeros(18)
    q[:3] = height * ground.rotation()[:, 2]
    q[3:6] = yaw, pitch, roll
    plant = PlantInC(ROBOT, GroundInC(ground, ROBOT.contact.foot_radius), "legs")
    plant.place(robot_numbers(ROBOT), 0, q, 0.0, TICK)
    found = bool(lib.plant_state_of(plant.at, 0) == lib.PLANT_FELL)
    assert RobotForces(ROBOT, ground, q[6:]).fallen(q) is found
    return found


@pytest.mark.parametrize("yaw", [0.0, 1.0, -2.5])
@pytest.mark.parametrize(
    ("roll", "pitch", "fell"),
    [
        (0.0, 0.0, False),
        (59.0, 0.0, False),
        (61.0, 0.0, True),
        (0.0, -59.0, False),
        (0.0, -61.0, True),
        (0.0, 90.0, True),
        (180.0, 0.0, True),
        # Euler angles of an upright robot: the same attitude written in another way
        (180.0, 180.0, False),
        # both at 50 degrees: the axis leans by acos(cos(50)^2) = 65.6 degrees
        (50.0, 50.0, True),
        (40.0, 40.0, False),
    ],
)
def test_the_trunk_may_lean_by_sixty_degrees(
    roll: float, pitch: float, yaw: float, fell: bool
) -> None:
    assert fallen(math.radians(roll), math.radians(pitch), yaw) is fell


def test_lean_counts_from_the_normal_of_the_ground() -> None:
    slope = Plane(slope=math.radians(50.0))
    assert not fallen(0.0, -slope.slope, 0.0, slope)
    assert not fallen(0.0, math.radians(-50.0 + 55.0), 0.0, slope)
    assert fallen(0.0, math.radians(-50.0 + 65.0), 0.0, slope)


def test_on_a_steep_slope_a_trunk_that_points_straight_up_has_fallen() -> None:
    wall = Plane(slope=math.radians(70.0))
    assert not fallen(0.0, math.radians(-79.0), 0.0, wall)
    assert fallen(0.0, math.radians(-81.0), 0.0, wall)


def test_a_corner_in_the_ground_is_a_fall() -> None:
    corners = ROBOT.trunk.corners()
    for roll, pitch, yaw in ((0.0, 0.0, 0.0), (0.3, -0.2, 1.0)):
        depth = -(corners @ Rotation.from_euler("ZYX", (yaw, pitch, roll)).as_matrix().T)[
            :, 2
        ].min()
        assert not fallen(roll, pitch, yaw, height=depth + 1e-6)
        assert fallen(roll, pitch, yaw, height=depth - 1e-6)


def test_corners_touch_the_ground_where_it_is_high() -> None:
    # Trunk from x = -0.13 to 0.13, its bottom 10 mm below the hips.
    for at, fell in ((0.12, True), (0.14, False)):
        assert fallen(0.0, 0.0, 0.0, Kerb(at=at, height=0.1), height=0.1) is fell


def scaled(robot: RobotDescription, size: float) -> RobotDescription:
    """The robot with all lengths times ``size`` and all masses times its cube."""

    def vector(v: tuple[float, float, float]) -> tuple[float, float, float]:
        return (v[0] * size, v[1] * size, v[2] * size)

    def body(b: Any) -> Any:
        return replace(b, mass=b.mass * size**3, size=vector(b.size), com=vector(b.com))

    legs = tuple(
        replace(
            leg,
            mount=vector(leg.mount),
            hip_offset=vector(leg.hip_offset),
            femur_length=leg.femur_length * size,
            tibia_length=leg.tibia_length * size,
            hip=body(leg.hip),
            femur=body(leg.femur),
            tibia=body(leg.tibia),
        )
        for leg in robot.legs
    )
    trunk = replace(body(robot.trunk), center=vector(robot.trunk.center))
    contact = replace(robot.contact, foot_radius=robot.contact.foot_radius * size)
    return replace(robot, legs=legs, trunk=trunk, contact=contact)


@in_both
def test_a_robot_of_half_the_size_stands(kind: Kind) -> None:
    plant = kind(scaled(ROBOT, 0.5))
    for _ in range(60):
        plant.advance(ZERO, ZERO, TICK)
    assert plant.sample()["position"][2] < 0.08
    assert not plant.fell


@in_both
def test_a_walk_down_a_slope_is_no_fall(kind: Kind) -> None:
    plant = kind(ROBOT, ground=Plane(slope=math.radians(-8.0)))
    for tick in range(300):
        trot(plant, tick)
        assert not plant.fell
    x, _, z = plant.sample()["position"]
    assert x > 0.3
    assert z - 0.147 < -0.04


@in_both
@pytest.mark.parametrize("slope", [math.radians(70.0), math.radians(-70.0)])
def test_a_robot_that_tips_over_falls_before_the_angles_break_down(
    kind: Kind, slope: float
) -> None:
    # Rubber that hardly slides on a wall: the robot turns over its lower feet, at high speed.
    grip = replace(ROBOT, contact=replace(ROBOT.contact, friction=5.0))
    plant = kind(grip, ground=Plane(slope=slope))
    try:
        for _ in range(120):
            plant.advance(ZERO, ZERO, TICK)
            if plant.fell:
                break
    except PlantError as error:
        pytest.fail(f"{error} at pitch {plant.sample()['rpy'][1]:.2f}")
    assert plant.fell


def test_a_robot_that_turns_over_its_back_is_seen_in_time() -> None:
    # Pushed in the air without gravity: it pitches freely, at 6 rad/s.
    plant = ExudynPlant(ROBOT, options=PlantOptions(clearance=2.0, gravity=0.0))
    plant._engine.mbs.systemData.SetODE2Coordinates_t(np.eye(18)[4] * 6.0)
    seen = []
    for _ in range(20):
        plant.advance(ZERO, ZERO, TICK)
        seen.append((abs(plant._q[4]), plant.fell))
        if plant.fell:
            break
    angle, fell = seen[-1]
    assert fell
    assert math.radians(60.0) < angle < math.radians(85.0)
    assert all(angle <= math.radians(60.0) for angle, _ in seen[:-1])

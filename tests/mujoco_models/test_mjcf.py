"""The robot as MJCF, as MuJoCo loads it, against the robot file and our own kinematics."""

from __future__ import annotations

from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from full_robot import full_robot
from made_up_robots import every_chain
from odd_robot import odd_robot
from scipy.spatial.transform import Rotation

from apnc_plant.kinematics import Kinematics
from apnc_plant.library import library
from apnc_plant.numbers import servo_numbers
from apnc_plant.robot import RobotDescription, Servo, load_robot
from apnc_plant.robot.links import links_of
from apnc_plant.signals import JOINTS

mujoco: Any = pytest.importorskip("mujoco")

from mujoco_models.tree import export_mjcf  # noqa: E402

ROBOTS = [load_robot("lilibot"), load_robot("hexapod"), odd_robot(), full_robot(), every_chain()]
LILIBOT = ROBOTS[0]


@pytest.fixture(params=ROBOTS, ids=lambda robot: robot.name)
def robot(request: pytest.FixtureRequest) -> RobotDescription:
    return request.param


def servos_of(robot: RobotDescription) -> list[Servo]:
    """The servos of all joints, in the order of the model."""
    return [
        robot.servo_of(leg, JOINTS[link.angle])
        for leg in robot.legs
        for link in links_of(leg)
        if not link.locked
    ]


def loaded(robot: RobotDescription, **options: str) -> Any:
    return mujoco.MjModel.from_xml_string(export_mjcf(robot, **options))


def test_bodies_have_our_masses_centres_and_inertias(robot: RobotDescription) -> None:
    model = loaded(robot)
    expected = {"trunk": robot.trunk.loaded(0.0, 0.0)} | {
        f"{leg.name}_{link.name}": link.body for leg in robot.legs for link in links_of(leg)
    }
    assert model.nbody == 1 + len(expected)  # and the world
    for name, body in expected.items():
        at, turn = model.body(name).id, np.zeros(9)
        mujoco.mju_quat2Mat(turn, model.body_iquat[at])
        turn = turn.reshape(3, 3)
        inertia = turn @ np.diag(model.body_inertia[at]) @ turn.T
        assert model.body_mass[at] == pytest.approx(body.mass, abs=1e-12)
        np.testing.assert_allclose(model.body_ipos[at], body.com, atol=1e-12)
        np.testing.assert_allclose(inertia, body.inertia, atol=1e-12)
    assert model.body_mass.sum() == pytest.approx(robot.mass, abs=1e-9)
    np.testing.assert_array_equal(model.dof_armature[:6], 0.0)
    servos = servos_of(robot)
    for found, key in (
        (model.dof_armature, "reflected_inertia"),
        (model.dof_damping, "joint_damping"),
        (model.dof_frictionloss, "dry_friction"),
    ):
        np.testing.assert_array_equal(found[6:], [getattr(servo, key) for servo in servos])


def test_feet_are_where_ours_are_at_any_pose(robot: RobotDescription) -> None:
    model = loaded(robot)
    data, random = mujoco.MjData(model), np.random.default_rng(0)
    for _ in range(5):
        place, rpy = random.uniform(-1, 1, 3), random.uniform(-1, 1, 3)
        angles = random.uniform(-1.5, 1.5, (len(robot.legs), 3))
        rows = Rotation.from_euler("ZYX", rpy[::-1]).as_matrix()
        data.qpos[:3] = place
        mujoco.mju_mat2Quat(data.qpos[3:7], rows.ravel())
        links = [link for leg in robot.legs for link in links_of(leg)]
        for k, link in enumerate(links):
            angles[k // 3, link.angle] *= not link.locked
        data.qpos[7:] = [
            angles[k // 3, link.angle] for k, link in enumerate(links) if not link.locked
        ]
        mujoco.mj_kinematics(model, data)
        feet = place + Kinematics(robot).feet(angles) @ rows.T
        for leg, foot in zip(robot.legs, feet, strict=True):
            np.testing.assert_allclose(data.geom(f"{leg.name}_foot").xpos, foot, atol=1e-9)
            np.testing.assert_allclose(data.site(f"{leg.name}_foot").xpos, foot, atol=1e-9)
            assert model.geom(f"{leg.name}_foot").size[0] == robot.foot_radius_of(leg)


@pytest.mark.parametrize("robot", [LILIBOT, full_robot()], ids=lambda robot: robot.name)
@pytest.mark.parametrize("servo", ["position", "dcmotor"])
def test_a_servo_gives_our_torque(servo: str, robot: RobotDescription) -> None:
    if servo == "dcmotor" and not hasattr(mujoco.mjtGain, "mjGAIN_DCMOTOR"):
        pytest.skip("this MuJoCo has no dcmotor")
    model = loaded(robot, servo=servo)
    data, random, seen = mujoco.MjData(model), np.random.default_rng(0), set()
    ffi, lib = library()
    for _ in range(50):
        data.qpos[7:], data.qvel[6:] = random.uniform(-0.3, 0.3, (2, 12))
        data.qvel[6:] *= 20.0
        data.ctrl[:] = random.uniform(-0.3, 0.3, 12)
        mujoco.mj_forward(model, data)
        for k, ours in enumerate(servos_of(robot)):
            numbers = ffi.new("plant_servo *", servo_numbers(ours))
            error, speed = data.ctrl[k] - data.qpos[7 + k], data.qvel[6 + k]
            free = ours.stiffness * error - ours.damping * speed
            expected = lib.plant_servo_torque(numbers, error, speed)
            if servo == "position":  # knows the stall torque, not the line
                expected = np.clip(free, -ours.stall_torque, ours.stall_torque)
            assert data.actuator_force[k] == pytest.approx(expected, abs=1e-9)
            seen.add("free" if expected == pytest.approx(free) else "limited")
    assert seen == {"free", "limited"}


def test_it_stands_on_its_feet_and_its_sensors_show_its_weight(robot: RobotDescription) -> None:
    model = loaded(robot)
    data = mujoco.MjData(model)
    for _ in range(4000):
        mujoco.mj_step(model, data)
    loads = [data.sensor(f"{leg.name}_grf").data[0] for leg in robot.legs]
    assert sum(loads) == pytest.approx(robot.weight, rel=1e-3)
    for leg, load in zip(robot.legs, loads, strict=True):
        depth = robot.foot_radius_of(leg) - data.geom(f"{leg.name}_foot").xpos[2]
        sunk = max(0.0, depth)  # not every leg of the odd robot reaches the ground
        assert sunk == pytest.approx(load / robot.contact.stiffness, rel=0.01, abs=1e-7)


def stood(text: str, robot: RobotDescription) -> tuple[Any, Any, np.ndarray]:
    """Model and data after two seconds from ``stand``, and the loads on the feet [N]."""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("stand").id)
    while data.time < 2.0:
        mujoco.mj_step(model, data)
    loads = [data.sensor(f"{leg.name}_grf").data[0] for leg in robot.legs]
    return model, data, np.array(loads)


def test_stand_is_the_reference_pose_with_a_foot_on_the_ground(robot: RobotDescription) -> None:
    model = loaded(robot)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("stand").id)
    np.testing.assert_array_equal(data.qpos[7:], 0.0)
    np.testing.assert_array_equal(data.ctrl, 0.0)
    mujoco.mj_kinematics(model, data)
    lowest = min(
        data.geom(f"{leg.name}_foot").xpos[2] - robot.foot_radius_of(leg) for leg in robot.legs
    )
    assert lowest == pytest.approx(0.0, abs=1e-9)


def test_it_stands_on_what_is_in_the_scene_as_on_the_ground(robot: RobotDescription) -> None:
    root, height = ElementTree.fromstring(export_mjcf(robot)), 0.02
    slab = {"type": "box", "size": f"1 1 {height / 2.0}", "pos": f"0 0 {height / 2.0}"}
    ElementTree.SubElement(root.find("worldbody"), "geom", slab, name="slab")
    key = root.find("keyframe/key")
    place = key.get("qpos").split()
    key.set("qpos", " ".join([*place[:2], str(float(place[2]) + height), *place[3:]]))
    model, data, loads = stood(ElementTree.tostring(root, encoding="unicode"), robot)
    assert loads.sum() == pytest.approx(robot.weight, rel=1e-3)
    assert all(model.geom("slab").id in contact.geom for contact in data.contact)
    for leg, load in zip(robot.legs, loads, strict=True):
        depth = robot.foot_radius_of(leg) + height - data.geom(f"{leg.name}_foot").xpos[2]
        sunk = max(0.0, depth)
        assert sunk == pytest.approx(load / robot.contact.stiffness, rel=0.01, abs=1e-7)


def test_no_part_of_it_touches_another(robot: RobotDescription) -> None:
    model = loaded(robot)
    data, random = mujoco.MjData(model), np.random.default_rng(0)
    for _ in range(50):
        data.qpos[:3] = 0.0, 0.0, 2.0
        data.qpos[7:] = random.uniform(-np.pi, np.pi, model.nu)
        mujoco.mj_forward(model, data)
        assert data.ncon == 0


def test_limits_are_those_of_servos_and_stops_or_a_full_turn(robot: RobotDescription) -> None:
    model = loaded(robot)
    stalls = [(-servo.stall_torque, servo.stall_torque) for servo in servos_of(robot)]
    stops = np.array(
        [leg.stops[link.angle] for leg in robot.legs for link in links_of(leg) if not link.locked]
    )
    stops = np.where(np.isfinite(stops), stops, [-np.pi, np.pi])
    np.testing.assert_array_equal(model.jnt_limited[1:], 1)
    np.testing.assert_array_equal(model.jnt_range[1:], stops)
    np.testing.assert_array_equal(model.jnt_actfrcrange[1:], stalls)


def test_an_unknown_servo_is_named() -> None:
    with pytest.raises(ValueError, match="servo 'cow' is not one of position, dcmotor"):
        export_mjcf(LILIBOT, servo="cow")

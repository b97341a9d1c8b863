"""The robot as URDF, read by yourdfpy and by MuJoCo: the same masses, the same feet."""

from __future__ import annotations

import io
import math
from dataclasses import replace
from xml.etree import ElementTree

import numpy as np
import pytest
from full_robot import full_robot
from made_up_robots import every_chain
from odd_robot import odd_robot

from apnc_plant.kinematics import Kinematics
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.robot.links import links_of
from apnc_plant.robot.urdf import robot_urdf
from apnc_plant.signals import JOINTS

ROBOTS = [load_robot("lilibot"), load_robot("hexapod"), odd_robot(), full_robot(), every_chain()]


@pytest.fixture(params=ROBOTS, ids=lambda robot: robot.name)
def robot(request: pytest.FixtureRequest) -> RobotDescription:
    return request.param


def test_links_have_our_masses_centres_and_inertias(robot: RobotDescription) -> None:
    yourdfpy = pytest.importorskip("yourdfpy")
    model = yourdfpy.URDF.load(io.BytesIO(robot_urdf(robot).encode()))
    expected = {"trunk": robot.trunk.loaded(0.0, 0.0)} | {
        f"{leg.name}_{link.name}": link.body for leg in robot.legs for link in links_of(leg)
    }
    found = {name: link.inertial for name, link in model.link_map.items()}
    heavy = {name: inertial for name, inertial in found.items() if inertial.mass}
    assert set(heavy) == set(expected)
    assert set(found) - set(heavy) == {f"{leg.name}_foot" for leg in robot.legs}
    for name, found in heavy.items():
        assert found.mass == pytest.approx(expected[name].mass, abs=1e-12)
        np.testing.assert_allclose(found.origin[:3, 3], expected[name].com, atol=1e-12)
        np.testing.assert_allclose(found.inertia, expected[name].inertia, atol=1e-15)
    assert sum(each.mass for each in heavy.values()) == pytest.approx(robot.mass, abs=1e-12)


def test_feet_are_where_ours_are_at_any_joint_angles(robot: RobotDescription) -> None:
    yourdfpy = pytest.importorskip("yourdfpy")
    model = yourdfpy.URDF.load(io.BytesIO(robot_urdf(robot).encode()))
    random = np.random.default_rng(0)
    for angles in random.uniform(-1.5, 1.5, (5, len(robot.legs), 3)):
        joints = {
            f"{leg.name}_{link.joint}": (k, link)
            for k, leg in enumerate(robot.legs)
            for link in links_of(leg)
        }
        for k, link in joints.values():
            angles[k, link.angle] *= not link.locked
        model.update_cfg(
            {name: angles[k, link.angle] for name, (k, link) in joints.items() if not link.locked}
        )
        for leg, ours in zip(robot.legs, Kinematics(robot).feet(angles), strict=True):
            foot = model.get_transform(f"{leg.name}_foot", "trunk")[:3, 3]
            np.testing.assert_allclose(foot, ours, atol=1e-9)


def test_a_servo_is_the_limits_of_its_joint(robot: RobotDescription) -> None:
    yourdfpy = pytest.importorskip("yourdfpy")
    model = yourdfpy.URDF.load(io.BytesIO(robot_urdf(robot).encode()))
    moving = [joint for joint in model.joint_map.values() if joint.type != "fixed"]
    assert len(moving) == sum(len(leg.chain) for leg in robot.legs)
    for leg in robot.legs:
        for link in links_of(leg):
            joint = model.joint_map[f"{leg.name}_{link.joint}"]
            if link.locked:
                assert joint.type == "fixed"
                continue
            stops, servo = leg.stops[link.angle], robot.servo_of(leg, JOINTS[link.angle])
            assert joint.type == "revolute"
            found = (joint.limit.lower, joint.limit.upper)
            full = (-math.pi, math.pi)
            assert found == tuple(np.where(np.isfinite(stops), stops, full))
            assert joint.limit.effort == servo.stall_torque
            assert joint.limit.velocity == servo.no_load_speed
            own = joint.dynamics
            assert float(own.damping if own else 0.0) == servo.joint_damping
            assert float(own.friction if own else 0.0) == servo.dry_friction


def test_mujoco_reads_it_too(robot: RobotDescription) -> None:
    mujoco = pytest.importorskip("mujoco")
    spec = mujoco.MjSpec.from_string(robot_urdf(robot))
    spec.compiler.fusestatic = False
    model = spec.compile()
    assert model.body_mass.sum() == pytest.approx(robot.mass, abs=1e-9)
    assert model.njnt == sum(len(leg.chain) for leg in robot.legs)


def test_what_touches_are_boxes_of_trunk_and_upper_links_and_balls(
    robot: RobotDescription,
) -> None:
    links = ElementTree.fromstring(robot_urdf(robot)).findall("link")
    touching = {
        link.get("name"): [shape.find("geometry")[0].attrib for shape in link.findall("collision")]
        for link in links
    }
    expected: dict[str, list[dict[str, str]]] = {
        "trunk": [{"size": " ".join(map(str, robot.trunk.edges))}]
    }
    for leg in robot.legs:
        ball = {"radius": str(robot.foot_radius_of(leg))}
        for name, link in (("hip", leg.hip), ("femur", leg.femur)):
            expected[f"{leg.name}_{name}_link"] = [{"size": " ".join(map(str, link.size))}]
        expected |= {f"{leg.name}_tibia_link": [ball], f"{leg.name}_foot": []}
    assert touching == expected


def test_a_base_without_mass_carries_the_trunk(robot: RobotDescription) -> None:
    plain, based = (
        ElementTree.fromstring(robot_urdf(robot, root=root)) for root in ("trunk", "base")
    )
    base, joint = based.find("link[@name='base']"), based.find("joint[@name='floating_base']")
    assert len(base) == 0
    assert joint.get("type") == "fixed"
    assert (joint.find("parent").get("link"), joint.find("child").get("link")) == ("base", "trunk")
    based.remove(base)
    based.remove(joint)
    assert [ElementTree.tostring(part).split() for part in based] == [
        ElementTree.tostring(part).split() for part in plain
    ]


def test_an_unknown_root_is_named() -> None:
    with pytest.raises(ValueError, match="root 'cow' is not one of trunk, base"):
        robot_urdf(ROBOTS[0], root="cow")


def test_names_are_plain_and_differ() -> None:
    names = ("a b", "a,b", "../c", "1")
    legs = (replace(leg, name=name) for leg, name in zip(ROBOTS[0].legs, names, strict=True))
    text = robot_urdf(replace(ROBOTS[0], name="sub/../../x", legs=tuple(legs)))
    robot = ElementTree.fromstring(text)
    assert robot.get("name") == "sub_______x"
    hips = [name for joint in robot.iter("joint") if (name := joint.get("name")).endswith("_hip")]
    assert hips == ["a_b_hip", "a_b__hip", "___c_hip", "_1_hip"]
    links = [link.get("name") for link in robot.iter("link")]
    assert len(set(links)) == len(links) == 17

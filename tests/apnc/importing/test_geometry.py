"""An imported robot moves as the file's own does in MuJoCo, in poses drawn at random."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest

pytest.importorskip("mujoco")

import mujoco
from dog_urdf import FEMUR, FOOT_AHEAD, HIP_OUT, KNEE_OUT, MOUNT, NAMES, RADIUS, SHANK, Dog

from apnc.importing import ImportedRobot, import_robot
from apnc.importing.mjcf import read_mjcf
from apnc.importing.model import rotation
from apnc.importing.xml_file import read_xml
from apnc_core.interface import Parameters

MJCF = """
<mujoco model="mutt">
  <compiler angle="degree" eulerseq="zyx"/>
  <default>
    <joint damping="0.5" armature="0.03"/>
    <geom density="5000"/>
    <default class="hip"><joint axis="0 1 0" range="-100 150"/></default>
    <default class="knee">
      <joint axis="0 -1 0" range="20 150" ref="40"/><geom type="mesh" mesh="lost"/>
    </default>
  </default>
  <asset><mesh name="lost" file="nowhere/lost.stl"/><material name="fur"/></asset>
  <worldbody>
    <light pos="0 0 3"/><geom type="plane" size="1 1 1"/>
    <body name="torso" pos="0 0 1">
      <freejoint/>
      <inertial pos="0.01 0 0" mass="9" fullinertia="0.06 0.12 0.14 0.001 0.002 0.003"/>
      <geom type="box" size="0.3 0.1 0.05" material="fur"/>
      <site name="imu"/>
      {legs}
    </body>
  </worldbody>
  <actuator>{motors}</actuator>
  <keyframe><key name="home" qpos="0 0 1 1 0 0 0 {home}"/></keyframe>
</mujoco>
"""

LEG = """
<body name="{n}_hip" pos="{x} {y} 0">
  <inertial pos="0 0 0" mass="0.7" diaginertia="0.001 0.001 0.001"/>
  <joint name="{n}_a" axis="{s} 0 0" range="-40 40" pos="-0.02 0 0"/>
  <body name="{n}_thigh" pos="0 {out} 0" euler="0 10 0">
    <inertial pos="0 0 -0.1" mass="0.8" diaginertia="0.004 0.004 0.001"/>
    <joint name="{n}_h" class="hip"/>
    <body name="{n}_shin" pos="0 0 -0.25">
      <inertial pos="0 0 -0.1" mass="0.2" diaginertia="0.002 0.002 0.0001"/>
      <joint name="{n}_k" class="knee"/>
      <geom class="knee"/>
      <geom name="{n}_paw" type="capsule" fromto="0 0 -0.1 0.01 0 -0.24" size="0.02"/>
    </body>
  </body>
</body>
"""


def mjcf() -> str:
    legs, motors, home = [], [], []
    for n, x, y in (("A", 0.25, 0.1), ("B", 0.25, -0.1), ("C", -0.25, 0.1), ("D", -0.25, -0.1)):
        s = np.sign(y)
        legs.append(LEG.format(n=n, x=x, y=y, out=0.06 * s, s=s))
        home += ["0", "0.7", "1.2"]
        for joint in "ahk":
            motors.append(f'<motor joint="{n}_{joint}" ctrlrange="-25 25" ctrllimited="true"/>')
    text = MJCF.replace("{legs}", "".join(legs)).replace("{motors}", "".join(motors))
    return text.replace("{home}", " ".join(home))


def feet(found: ImportedRobot, angles: dict[tuple[str, str], float]) -> dict[str, np.ndarray]:
    """Feet in the frame of the trunk, of the robot file, at angles from its reference pose [m]."""
    at = {}
    x, y = np.eye(3)[:2]
    for leg in found.robot.legs:
        q = [angles[leg.name, joint] for joint in ("abduction", "hip", "knee")]
        femur = leg.femur_angle - q[1]
        shank = femur - leg.tibia_angle - (-q[2] if leg.knee == ">" else q[2])
        point = rotation(y, femur) @ [0.0, 0.0, -leg.femur_length]
        point = point + rotation(y, shank) @ [0.0, 0.0, -leg.tibia_length]
        at[leg.name] = leg.mount + rotation(x, q[0]) @ (leg.outward(leg.hip_offset) + point)
    return at


def foot_link(names: list[str]) -> str:
    """The link of the foot of the dog, from the names of a leg's joints."""
    return names[0].replace("haa", "foot")


def paw(names: list[str], model: Any, data: Any) -> Any:
    """The end of the mutt's capsule that is farther from the knee."""
    capsule = data.geom(names[0].replace("_a", "_paw"))
    half = model.geom(capsule.id).size[1]
    axis = np.asarray(capsule.xmat).reshape(3, 3)[:, 2]
    ends = [capsule.xpos + half * axis, capsule.xpos - half * axis]
    knee = data.joint(names[2]).xanchor
    return max(ends, key=lambda end: float(np.linalg.norm(end - knee)))


def without_meshes(text: str) -> Any:
    spec = mujoco.MjSpec.from_string(text)
    for geom in [geom for body in spec.bodies for geom in body.geoms if geom.meshname]:
        spec.delete(geom)
    for mesh in list(spec.meshes):
        spec.delete(mesh)
    return spec


def compare(found: ImportedRobot, spec: Any, trunk: str, foot: Any) -> None:
    """Compare feet with those of MuJoCo in poses drawn at random.

    Args:
        foot: from the names of a leg's joints and the data of MuJoCo to the foot in the world.
    """
    model = spec.compile()
    data = mujoco.MjData(model)
    random = np.random.default_rng(1)
    for _ in range(5):
        angles = {(j.leg, j.joint): random.uniform(-0.5, 0.5) for j in found.robot.joint_map}
        for j in found.robot.joint_map:
            at = model.joint(j.name).qposadr[0]
            data.qpos[at] = j.offset + j.sign * angles[j.leg, j.joint] + model.qpos0[at]
        mujoco.mj_kinematics(model, data)
        body = data.body(trunk)
        for leg, point in feet(found, angles).items():
            names = [j.name for j in found.robot.joint_map if j.leg == leg]
            turn = np.asarray(body.xmat).reshape(3, 3)
            there = turn.T @ (foot(names, model, data) - body.xpos)
            np.testing.assert_allclose(point, there, atol=1e-9)


IN_FRONT = (-2.6, -0.4)
KNEES = {
    "dog": {},
    "X": {"hl": IN_FRONT, "hr": IN_FRONT},
    "X turned": {"fl": IN_FRONT, "fr": IN_FRONT},
    "bird": dict.fromkeys(NAMES, IN_FRONT),
}
"""Ranges of the knees that lie in front of the line from hip to foot [rad]."""


@pytest.mark.parametrize("pose", KNEES)
def test_a_urdf_with_mirrored_axes_and_turned_frames_moves_as_in_mujoco(
    pose: str, tmp_path: Path
) -> None:
    dog, path = Dog(knee=KNEES[pose]), tmp_path / "dog.urdf"
    path.write_text(dog.text())
    found = import_robot(path)
    in_front = {own.names[0][:2] for own, leg in zip(found.legs, found.robot.legs, strict=True)
                if leg.knee == ">"}  # fmt: skip
    assert in_front == set(KNEES[pose])
    spec = mujoco.MjSpec.from_string(dog.text())
    spec.compiler.fusestatic = False
    spec.compiler.boundmass = spec.compiler.boundinertia = 1e-9

    # the base of the dog is a frame on which the trunk is fixed
    compare(found, spec, "base", lambda names, model, data: data.body(foot_link(names)).xpos)


def test_a_hip_axis_that_is_level_only_in_another_pose_is_counted_from_there(
    tmp_path: Path,
) -> None:
    dog = Dog(axes=("1 0 0", "0 0.8 0.6"), arm=False)
    path = tmp_path / "dog.urdf"
    path.write_text(dog.text())
    found = import_robot(path)
    for j in found.robot.joint_map:
        if j.joint == "abduction":
            assert abs(j.offset) == pytest.approx(np.arctan2(0.6, 0.8))
    spec = mujoco.MjSpec.from_string(dog.text())
    spec.compiler.fusestatic = False
    spec.compiler.boundmass = spec.compiler.boundinertia = 1e-9
    compare(found, spec, "base", lambda names, model, data: data.body(foot_link(names)).xpos)


def test_the_numbers_of_the_dog_are_those_it_was_made_of(tmp_path: Path) -> None:
    path = tmp_path / "dog.urdf"
    path.write_text(Dog().text())
    found = import_robot(path)
    robot = found.robot
    assert [leg.name for leg in robot.legs] == ["RF", "RH", "LF", "LH"]
    assert [leg.names[0] for leg in found.legs] == ["fr_hip", "hr_hip", "fl_hip", "hl_hip"]
    for leg in robot.legs:
        x, y, z = MOUNT
        ahead = 1.0 if leg.name.endswith("F") else -1.0
        mount = [0.01 + ahead * x, leg.side * y, 0.02 + z]
        np.testing.assert_allclose(leg.mount, mount, atol=1e-12)
        np.testing.assert_allclose(leg.hip_offset, [0.0, HIP_OUT + KNEE_OUT, 0.0], atol=1e-12)
        assert leg.femur_length == pytest.approx(FEMUR)
        assert leg.tibia_length == pytest.approx(np.hypot(FOOT_AHEAD, SHANK))
    assert robot.contact.foot_radius == RADIUS
    assert robot.servo.stall_torque == 30.0
    assert robot.servo.no_load_speed == 20.0


def test_arm_rotors_and_fixed_parts_keep_mass_and_centre_of_mass(tmp_path: Path) -> None:
    path = tmp_path / "dog.urdf"
    path.write_text(Dog().text())
    found = import_robot(path)
    model = mujoco.MjModel.from_xml_string(
        Dog().text().replace("</robot>", '<mujoco><compiler boundmass="1e-9" boundinertia="1e-9" '
                             'fusestatic="false"/></mujoco></robot>')
    )  # fmt: skip
    data = mujoco.MjData(model)
    data.joint("arm_pitch").qpos[0] = 0.3  # 0 is not in its range
    for j in found.robot.joint_map:
        data.joint(j.name).qpos[0] = j.offset
    mujoco.mj_fwdPosition(model, data)
    assert found.robot.mass == pytest.approx(model.body_mass.sum(), abs=1e-6)
    np.testing.assert_allclose(center_of_mass(found), data.subtree_com[0], atol=1e-7)
    behind_legs = re.compile("|".join(f"{name}_" for name in NAMES))
    carried = [k for k in range(1, model.nbody) if not behind_legs.match(model.body(k).name)]
    com = model.body_mass[carried] @ data.xipos[carried] / model.body_mass[carried].sum()
    inertia = np.zeros((3, 3))
    for k in carried:
        turn, d = data.ximat[k].reshape(3, 3), data.xipos[k] - com
        inertia += turn @ np.diag(model.body_inertia[k]) @ turn.T
        inertia += model.body_mass[k] * (d @ d * np.eye(3) - np.outer(d, d))
    own = np.diag(found.robot.trunk.inertia_tensor())
    np.testing.assert_allclose(own, np.diag(inertia), rtol=1e-6)
    told = " ".join(found.dropped)
    assert "arm_yaw is held" in told
    assert "1 kg" in told


def center_of_mass(found: ImportedRobot) -> np.ndarray:
    robot, y = found.robot, np.array([0.0, 1.0, 0.0])
    total = robot.trunk.mass * np.array(robot.trunk.com)
    for leg in robot.legs:
        hip = np.add(leg.mount, leg.outward(leg.hip_offset))
        back = rotation(y, leg.femur_angle)
        knee = hip + back @ [0.0, 0.0, -leg.femur_length]
        shank = rotation(y, leg.femur_angle - leg.tibia_angle)
        total = total + leg.hip.mass * np.add(leg.mount, leg.outward(leg.hip.com))
        total = total + leg.femur.mass * (hip + back @ leg.outward(leg.femur.com))
        total = total + leg.tibia.mass * (knee + shank @ leg.outward(leg.tibia.com))
    return np.asarray(total / robot.mass)


@pytest.mark.parametrize("pose", KNEES)
def test_the_stance_is_that_of_the_rule(pose: str, tmp_path: Path) -> None:
    path = tmp_path / "dog.urdf"
    path.write_text(Dog(knee=KNEES[pose]).text())
    found = import_robot(path)
    assert found.stance.ratio == pytest.approx(1.05)
    half = MOUNT[0]
    standing = feet(found, {(j.leg, j.joint): 0.0 for j in found.robot.joint_map})
    points = np.array(list(standing.values()))
    hips = np.mean([np.add(leg.mount, leg.hip_offset)[2] for leg in found.robot.legs])
    assert hips - points[:, 2] == pytest.approx(1.05 * half)
    assert center_of_mass(found)[0] - points[:, 0].mean() == pytest.approx(0.25 * half)


def test_a_stance_that_a_range_forbids_is_replaced_by_the_nearest_and_told(tmp_path: Path) -> None:
    low, high = 0.4, 1.7
    path = tmp_path / "dog.urdf"
    path.write_text(Dog(knee=dict.fromkeys(NAMES, (low, high))).text())
    found = import_robot(path)
    swing = Parameters().a2
    for leg, own in zip(found.robot.legs, found.legs, strict=True):
        # the line from knee to foot is not the z axis of the calf
        aside = np.arctan2(FOOT_AHEAD, SHANK)
        assert own.turns["tibia"].upper == pytest.approx(high + aside)
        assert leg.tibia_angle + swing <= high + aside
        assert leg.tibia_angle + swing > high + aside - 0.05
    assert found.stance.ratio > 1.05
    assert any(line.startswith("the height of the rule, 1.05") for line in found.dropped)


def test_a_mjcf_without_its_meshes_moves_as_in_mujoco(tmp_path: Path) -> None:
    path = tmp_path / "mutt.xml"
    path.write_text(mjcf())
    found = import_robot(path)
    compare(found, without_meshes(mjcf()), "torso", paw)


def test_two_joints_in_one_body_turn_about_their_own_points(tmp_path: Path) -> None:
    text = mjcf().replace(' euler="0 10 0"', "")
    text = re.sub(r'<joint name="._a".*?/>', "", text)
    for name, side in (("A", 1), ("B", -1), ("C", 1), ("D", -1)):
        hip = f'<joint name="{name}_h" class="hip"/>'
        both = (
            f'<joint name="{name}_a" axis="{side} 0 0" range="-40 40" pos="-0.02 0.03 0.01"/>'
            f'<joint name="{name}_h" class="hip" pos="0.01 0 0.02"/>'
        )
        assert hip in text
        text = text.replace(hip, both)
    path = tmp_path / "mutt.xml"
    path.write_text(text)
    found = import_robot(path)
    compare(found, without_meshes(text), "torso", paw)
    assert [leg.hip.mass for leg in found.robot.legs] == [0.0] * 4


def test_the_mass_of_a_mjcf_is_that_of_its_inertials(tmp_path: Path) -> None:
    path = tmp_path / "mutt.xml"
    path.write_text(mjcf())
    robot = import_robot(path).robot
    assert robot.mass == pytest.approx(9.0 + 4 * 1.7)
    full = [[0.06, 0.001, 0.002], [0.001, 0.12, 0.003], [0.002, 0.003, 0.14]]
    np.testing.assert_allclose(robot.trunk.inertia_tensor(), full, rtol=1e-12)
    trunk = read_mjcf(read_xml(path), path).parts[0].body
    np.testing.assert_array_equal(trunk.inertia, full)
    assert robot.servo.stall_torque == 25.0
    assert robot.servo.reflected_inertia == pytest.approx(0.03)


def test_a_named_pose_is_the_reference_pose(tmp_path: Path) -> None:
    path = tmp_path / "mutt.xml"
    path.write_text(mjcf())
    found = import_robot(path, "home")
    offsets = {j.name: j.offset for j in found.robot.joint_map}
    # a joint counts from its ref in the file
    home = {"a": 0.0, "h": 0.7, "k": 1.2 - np.deg2rad(40.0)}
    for name, offset in offsets.items():
        assert offset == pytest.approx(home[name[-1]]), name
    assert found.robot.controller["b1"] == 0.0


def test_names_in_the_file_do_not_matter(tmp_path: Path) -> None:
    path = tmp_path / "dog.urdf"
    path.write_text(Dog().text())
    other = tmp_path / "other.urdf"
    other.write_text(Dog(names=("w", "x", "y", "z")).text())
    own = import_robot(path).toml.replace("dog.urdf", "other.urdf")
    for a, b in zip(NAMES, "wxyz", strict=True):
        own = own.replace(f"{a}_", f"{b}_")
    assert import_robot(other).toml == own

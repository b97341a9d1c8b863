"""From a model file to a robot file, and what was found, estimated and dropped on the way."""

from __future__ import annotations

import tempfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import numpy as np

from apnc.importing.forward import faced
from apnc.importing.joint_map import joint_maps
from apnc.importing.legs import LegGeometry
from apnc.importing.limbs import Limbs
from apnc.importing.mjcf import read_mjcf
from apnc.importing.model import Model, ModelFileError
from apnc.importing.robot_file import Found, robot_text
from apnc.importing.scaling import Estimate, Size, gain, guess
from apnc.importing.stance import Stance, Swing, stance_by_rule, stance_of_pose
from apnc.importing.urdf import read_urdf
from apnc.importing.xml_file import read_xml
from apnc_core.interface import Parameters
from apnc_core.types import Array
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.robot.quantities import LONGEST

ZERO: Final = "zero"
"""Pose of every file: all joints at 0."""


@dataclass(frozen=True)
class ImportedRobot:
    """A robot that was read from a model file.

    Args:
        toml: its robot file.
        robot: the same as a robot.
        legs: what was found of its legs, in the order of ``robot.legs``.
        forward: the direction of the file that points forward, one of ``FORWARD`` of
            :mod:`apnc.importing.forward`.
        facing: how that is known, in words.
        stance: how it stands, which is its reference pose.
        estimates: numbers that are not the file's.
        dropped: what of the file is not in the robot, in words.
    """

    toml: str
    robot: RobotDescription
    legs: tuple[LegGeometry, ...]
    forward: str
    facing: str
    stance: Stance
    estimates: tuple[Estimate, ...]
    dropped: tuple[str, ...]


def import_robot(
    path: str | Path, pose: str | None = None, forward: str | None = None
) -> ImportedRobot:
    """Read a robot from URDF or MJCF.

    Args:
        path: the model file; its z axis points up.
        pose: name of a pose of the file, or ``zero``, about which the robot is to walk; the rule
            of :func:`apnc.importing.stance.stance_by_rule` if omitted.
        forward: direction of the file that points forward: ``x``, ``-x``, ``y`` or ``-y``; told
            from the legs, see :func:`apnc.importing.forward.faced`, if omitted.

    Raises:
        ModelFileError: the file cannot be read, or the robot file cannot say what it holds.
        ValueError: MJCF, and MuJoCo is not installed.
    """
    path = Path(path)
    try:
        model = _read(path)
        return _imported(model, path.name, pose, forward)
    except ModelFileError as error:
        raise ModelFileError(f"{path.name}: {error}") from None


def _read(path: Path) -> Model:
    root = read_xml(path)
    if root.tag == "robot":
        return read_urdf(root, path)
    if root.tag == "mujoco":
        return read_mjcf(root, path)
    raise ModelFileError(f"its root is <{root.tag}>; allowed: <robot> (URDF) or <mujoco> (MJCF)")


def _imported(model: Model, source: str, pose: str | None, forward: str | None) -> ImportedRobot:
    angles = {}
    if pose is not None:
        poses: dict[str, Mapping[str, float]] = {ZERO: {}, **model.poses}
        if pose not in poses:
            raise ModelFileError(f"pose is {pose!r}; allowed: {', '.join(poses)}")
        angles = dict(poses[pose])
    for part in model.parts:
        if part.body.mass < 0.0:
            raise ModelFileError(
                f"{part.name}: its mass is {part.body.mass:g} kg; allowed: 0 or more"
            )
    facing = faced(model, angles, forward)
    limbs, legs = facing.limbs, _ordered(facing.legs)
    longest = max(max(leg.femur, leg.tibia) for leg in legs)
    if longest > LONGEST:
        raise ModelFileError(
            f"a femur or tibia is {longest:.3g} m long; allowed: up to {LONGEST:g} m, and lengths "
            "of the file are in m, not in mm"
        )
    names = _names(legs)
    default = Parameters()
    swing = Swing(gain("a1"), gain("a2"))
    trunk = limbs.trunk.body
    if trunk.mass <= 0.0:
        raise ModelFileError(f"{model.parts[0].name}: it has no mass; allowed: above 0 [kg]")
    stance = (
        stance_by_rule(trunk, legs, swing)
        if pose is None
        else stance_of_pose(trunk, legs, swing, angles)
    )
    mass = trunk.mass + sum(body.mass for leg in legs for body in leg.bodies)
    length = float(np.mean([leg.femur + leg.tibia for leg in legs]))
    guessed = guess(legs, Size(mass, length, len(legs)), 1.0 / default.Ts)
    joints = joint_maps(names, legs, stance)
    found = Found(
        model.name, trunk, _outline(limbs), names, legs, facing.forward, stance, joints, guessed
    )
    text = robot_text(found, source)
    robot = _loaded(text.toml)
    return ImportedRobot(
        text.toml,
        robot,
        legs,
        facing.forward,
        facing.why,
        stance,
        guessed.estimates,
        (
            *model.dropped, *limbs.folded, *stance.dropped, *guessed.dropped, *text.dropped,
        ),
    )  # fmt: skip


def _ordered(legs: Iterable[LegGeometry]) -> tuple[LegGeometry, ...]:
    """The legs in the order of a robot: right from front to hind, then left."""
    return tuple(sorted(legs, key=lambda leg: (not leg.right, -leg.mount[0])))


def _names(legs: Sequence[LegGeometry]) -> tuple[str, ...]:
    """Names by place: RF, RH, LF, LH; RM and LM between them, or R2, R3 and so on."""
    names = []
    for side, right in (("R", True), ("L", False)):
        count = sum(leg.right is right for leg in legs)
        middle = ["M"] if count == 3 else [str(k) for k in range(2, count)]
        names += [side + place for place in ("F", *middle, "H")[:count]]
        if count < 2:
            raise ModelFileError(
                f"{count} of {len(legs)} legs are on the side {side}; allowed: two or more"
            )
    return tuple(names)


def _outline(limbs: Limbs) -> Array | None:
    """Box around the simple shapes of the trunk: middle and edges [m], shape (2, 3)."""
    for touching in (True, False):
        corners = []
        for shape in limbs.trunk.shapes:
            if shape.touches is touching:
                reach = np.abs(shape.frame.turn) @ shape.half
                corners += [shape.frame.position - reach, shape.frame.position + reach]
        if corners:
            low, high = np.min(corners, axis=0), np.max(corners, axis=0)
            return np.array([(low + high) / 2.0, high - low])
    return None


def _loaded(toml: str) -> RobotDescription:
    """The robot of a robot file, as any other is read."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "robot.toml")
        path.write_text(toml, encoding="utf-8")
        return load_robot(path)

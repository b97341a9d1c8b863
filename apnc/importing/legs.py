"""Legs as geometry: where their joints lie, which way they turn, and how far."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np

from apnc.importing.feet import Foot
from apnc.importing.model import Frame, Joint, rotation
from apnc_core.types import Array
from apnc_plant.robot import MassProperties
from apnc_plant.robot.model import CHAINS
from apnc_plant.signals import JOINTS


@dataclass(frozen=True)
class Pose:
    """Geometric angles of a leg [rad].

    Args:
        abduction: foot to the left of vertical, from where the hip axis is level.
        pointing: a leg with a coxa forward of straight outward.
        femur: back of vertical; outward of vertical with a coxa.
        tibia: forward of the line of the femur; inward of it with a coxa.
    """

    abduction: float = 0.0
    pointing: float = 0.0
    femur: float = 0.0
    tibia: float = 0.0


@dataclass(frozen=True)
class Turn:
    """A joint of a leg as the robot file counts it: angle in the file = zero + sign angle.

    Args:
        joint: the joint of the file.
        sign: +1 or -1.
        zero: angle of the joint in the file where the geometric angle is 0 [rad].
        lower, upper: range of the geometric angle [rad].

    The geometric angles are those of :class:`Pose`.
    """

    joint: Joint
    sign: float
    zero: float
    lower: float
    upper: float

    def in_file(self, angle: float) -> float:
        """Angle of the joint in the file [rad], from the geometric one."""
        return self.zero + self.sign * angle

    def geometric(self, in_file: float) -> float:
        """The geometric angle [rad], from that in the file."""
        return self.sign * (in_file - self.zero)


@dataclass(frozen=True)
class LegGeometry:
    """A leg whose joints are one of ``CHAINS``.

    In its straight pose, all geometric angles are 0: femur and tibia hang down, and all frames are
    parallel to that of the trunk.

    Args:
        chain: its joints from the trunk outward.
        names: of its segments in the file, from the trunk outward.
        mount: first joint in the frame of the trunk [m], shape (3,).
        hip_offset: from there to the second joint in the plane of the leg, in the straight pose
            [m], shape (3,).
        femur, tibia: lengths [m].
        turns: its joints by the angle of :class:`Pose` that they are, from the trunk outward.
        fixed: angles of joints that it lacks.
        bodies: mass properties of hip, femur and tibia, in frames at their joints whose -z points
            along the link.
        foot: its foot.
    """

    chain: tuple[str, ...]
    names: tuple[str, ...]
    mount: Array
    hip_offset: Array
    femur: float
    tibia: float
    turns: Mapping[str, Turn]
    bodies: tuple[MassProperties, MassProperties, MassProperties]
    foot: Foot
    fixed: Pose = field(default_factory=Pose)

    @property
    def right(self) -> bool:
        """True for a leg on the right."""
        return bool(self.mount[1] < 0.0)

    @property
    def side(self) -> float:
        """-1 for a leg on the right, else 1."""
        return -1.0 if self.right else 1.0

    @property
    def has_coxa(self) -> bool:
        """Whether the first joint turns about z."""
        return self.chain[0] == "coxa"

    @property
    def pitches_first(self) -> bool:
        """Whether the hip comes before the abduction."""
        return self.chain == CHAINS[1]

    @property
    def hip_joint(self) -> Array:
        """The hip axis in the plane of the leg, in the straight pose [m], shape (3,)."""
        if self.pitches_first:
            return np.asarray(self.mount + self.hip_offset * np.array([0.0, 1.0, 0.0]))
        return np.asarray(self.mount + self.hip_offset)

    def counted(self, tibia: float) -> dict[str, tuple[str, float]]:
        """For each joint of a record its angle of :class:`Pose`, and the sign with which it counts.

        A positive hip angle swings the foot forward, that is a femur less back of vertical or a
        coxa. A positive knee angle flexes the knee wherever it lies, or lifts a femur behind a
        coxa. The remaining joint moves the foot to the left.

        Args:
            tibia: angle of the tibia in the reference pose [rad].
        """
        angles = (("abduction", 1.0), ("femur", -1.0), ("tibia", -1.0 if tibia < 0.0 else 1.0))
        if self.has_coxa:
            angles = (("tibia", -self.side), ("pointing", 1.0), ("femur", 1.0))
        return {
            joint: angle
            for joint, angle in zip(JOINTS, angles, strict=True)
            if angle[0] in self.turns
        }

    def pose(self, in_file: Mapping[str, float]) -> Pose:
        """The geometric angles, from those of the file by joint; 0 if left out [rad]."""
        angles = {
            name: turn.geometric(in_file.get(turn.joint.name, 0.0))
            for name, turn in self.turns.items()
        }
        return replace(self.fixed, **angles)

    def frames(self, pose: Pose) -> tuple[Frame, Frame, Frame, Frame]:
        """Hip, femur, tibia and foot in the frame of the trunk."""
        x, y, z = np.eye(3)
        down = np.array([0.0, 0.0, -1.0])
        across = self.side * x if self.has_coxa else y
        aside, back = rotation(x, pose.abduction), rotation(across, pose.femur)
        if self.has_coxa:
            aside = rotation(z, -self.side * pose.pointing)
        first, second = (back, aside) if self.pitches_first else (aside, back)
        hip = Frame(self.mount, first)
        femur = hip @ Frame(self.hip_offset, second)
        tibia = femur @ Frame(self.femur * down, rotation(across, -pose.tibia))
        return hip, femur, tibia, tibia @ Frame(self.tibia * down)

    def foot_at(self, pose: Pose) -> Array:
        """The foot in the frame of the trunk [m], shape (3,)."""
        return self.frames(pose)[3].position

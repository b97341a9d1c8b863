"""A robot as a file of URDF or MJCF tells it: one tree of rigid parts, whatever the format."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np

from apnc_core.types import Array
from apnc_plant.robot import MassProperties


class ModelFileError(ValueError):
    """A model file cannot be read, or holds what a robot file cannot express."""


@dataclass(frozen=True)
class Frame:
    """Placement of a frame in another one.

    Args:
        position: of its origin [m], shape (3,).
        turn: its axes as columns, shape (3, 3).
    """

    position: Array = field(default_factory=lambda: np.zeros(3))
    turn: Array = field(default_factory=lambda: np.eye(3))

    def __matmul__(self, inner: Frame) -> Frame:
        """Placement of a frame that is placed in this one."""
        return Frame(self.at(inner.position), self.turn @ inner.turn)

    def at(self, point: Array) -> Array:
        """A point of this frame in the outer one [m], shape (3,)."""
        return np.asarray(self.position + self.turn @ point)

    def inverse(self) -> Frame:
        """Placement of the outer frame in this one."""
        return Frame(-self.turn.T @ self.position, self.turn.T)


def rotation(axis: Array, angle: float) -> Array:
    """Rotation about a unit vector (Rodrigues), shape (3, 3).

    Args:
        axis: the unit vector, shape (3,).
        angle: right-handed [rad].
    """
    x, y, z = axis
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.asarray(
        np.eye(3) + math.sin(angle) * cross + (1.0 - math.cos(angle)) * (cross @ cross)
    )


@dataclass(frozen=True)
class Motor:
    """What a file says about the drive of a joint; None where it says nothing.

    Args:
        effort: largest torque [N m].
        velocity: largest speed [rad/s].
        stiffness: torque per position error [N m/rad].
        damping: torque per joint speed of the drive [N m s/rad].
        passive: the same of the joint itself [N m s/rad].
        friction: dry friction [N m].
        armature: reflected inertia of the rotor [kg m^2].
    """

    effort: float | None = None
    velocity: float | None = None
    stiffness: float | None = None
    damping: float | None = None
    passive: float | None = None
    friction: float | None = None
    armature: float | None = None


@dataclass(frozen=True)
class Joint:
    """A joint between a part and its parent, at the origin of the part.

    Args:
        name: its name in the file.
        kind: ``hinge``; or the word of the file for any other kind that moves.
        axis: unit vector in the frame of the part, shape (3,).
        lower, upper: range of the angle [rad]; infinite if there is none.
        motor: its drive.
        follows: name of a joint or part that it is tied to; empty if it is free.
    """

    name: str
    kind: str
    axis: Array
    lower: float = -math.inf
    upper: float = math.inf
    motor: Motor = Motor()
    follows: str = ""


@dataclass(frozen=True)
class Shape:
    """A simple body that a part consists of or touches with.

    Args:
        name: its name in the file, or that of its part.
        kind: ``sphere``, ``box``, ``cylinder`` or ``capsule``; the last two lie along their z.
        frame: in the frame of the part.
        half: half of its edges along x, y and z [m], shape (3,).
        touches: False for a shape that is only seen.
    """

    name: str
    kind: str
    frame: Frame
    half: Array
    touches: bool = True


@dataclass(frozen=True)
class Part:
    """A rigid part of the tree.

    Args:
        name: its name in the file.
        parent: index of the part that carries it; -1 for the base.
        frame: its placement in the parent's frame, with its joint at 0.
        body: its mass properties; a part without mass is a mere frame.
        joint: how it moves against its parent; None if it is fixed.
        shapes: what it consists of.
    """

    name: str
    parent: int
    frame: Frame
    body: MassProperties
    joint: Joint | None = None
    shapes: tuple[Shape, ...] = ()


@dataclass(frozen=True)
class Model:
    """What a model file holds.

    Args:
        name: of the robot.
        parts: its parts, a parent before its children; the first is the floating base.
        poses: angles by joint of each named pose [rad]; joints that a pose leaves out are at 0.
        dropped: what was not read, in words.
    """

    name: str
    parts: tuple[Part, ...]
    poses: Mapping[str, Mapping[str, float]] = field(default_factory=dict)
    dropped: tuple[str, ...] = ()


NO_BODY = MassProperties(0.0, np.zeros(3), np.zeros((3, 3)))


def moved(body: MassProperties, frame: Frame) -> MassProperties:
    """Mass properties, given in a frame, in the outer one."""
    turn = frame.turn
    return MassProperties(body.mass, frame.at(body.com), turn @ body.inertia @ turn.T)


def together(first: MassProperties, second: MassProperties) -> MassProperties:
    """Mass properties of two bodies in one frame, rigidly connected; either may have no mass."""
    if second.mass == 0.0:
        return MassProperties(first.mass, first.com, first.inertia + second.inertia)
    if first.mass == 0.0:
        return MassProperties(second.mass, second.com, first.inertia + second.inertia)
    return first.joined(second)

"""Legs as geometry: where their joints lie, which way they turn, and how far."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from apnc.importing.limbs import Segment
from apnc.importing.model import Frame, Joint, ModelFileError, Shape, moved, rotation
from apnc_core.types import Array
from apnc_plant.robot import MassProperties

TOLERANCE: Final = 0.01
"""Largest deviation of an axis from the one it is taken for [rad]."""

_FOOT: Final = re.compile(r"foot|toe|sole|contact|(?<![a-z])(?:ee|tip|end)(?![a-z])", re.IGNORECASE)
"""Names of frames that mark a foot."""

_AXES: Final = ("x", "y", "z")


@dataclass(frozen=True)
class Foot:
    """A foot in the frame of the last segment.

    Args:
        name: of the shape or frame in the file.
        center: of the ball [m], shape (3,).
        radius: of the ball [m]; None if the file has only a frame.
    """

    name: str
    center: Array
    radius: float | None


@dataclass(frozen=True)
class Turn:
    """A joint of a leg as the robot file counts it: angle in the file = zero + sign angle.

    Args:
        joint: the joint of the file.
        sign: +1 or -1.
        zero: angle of the joint in the file where the geometric angle is 0 [rad].
        lower, upper: range of the geometric angle [rad].

    The geometric angles are: the abduction from where the hip axis points to the left; the femur
    back of vertical; the tibia forward of the line of the femur.
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
    """A leg with an abduction joint about x and hip and knee joints about y.

    Args:
        names: of its segments in the file, from the trunk outward.
        mount: abduction joint in the frame of the trunk [m], shape (3,).
        hip_offset: from there to the plane of the leg on the hip axis, in axes of the trunk
            [m], shape (3,).
        femur, tibia: lengths [m].
        abduction, hip, knee: its joints.
        bodies: mass properties of hip, femur and tibia, in frames at their joints whose -z points
            along the link.
        foot: its foot.
    """

    names: tuple[str, ...]
    mount: Array
    hip_offset: Array
    femur: float
    tibia: float
    abduction: Turn
    hip: Turn
    knee: Turn
    bodies: tuple[MassProperties, MassProperties, MassProperties]
    foot: Foot

    @property
    def right(self) -> bool:
        """True for a leg on the right."""
        return bool(self.mount[1] < 0.0)

    @property
    def turns(self) -> tuple[Turn, Turn, Turn]:
        """Its joints from the trunk outward."""
        return self.abduction, self.hip, self.knee

    @property
    def hip_joint(self) -> Array:
        """The hip axis in the plane of the leg, in the frame of the trunk [m], shape (3,)."""
        return np.asarray(self.mount + self.hip_offset)


def leg_geometry(leg: tuple[Segment, ...]) -> LegGeometry:
    """The geometry of a leg.

    The abduction joint is put where the hip axis is level, which is the reference of the robot
    file. An offset of knee or foot along the hip axis does not matter to the motion, so it is
    counted at the hip.

    Args:
        leg: its segments from the trunk outward.

    Raises:
        ModelFileError: the robot file has no such leg; the message says why.
    """
    name = leg[0].name
    joints = _hinges(leg)
    _check_axes(leg, joints)
    first, second, third = joints
    along = _axis(leg, 1, {})
    side = math.copysign(1.0, float(_axis(leg, 0, {})[0]))
    tilt = math.atan2(float(along[2]), float(along[1]))
    level = _nearest(-side * tilt, math.pi, first)
    if level is None:
        raise ModelFileError(
            f"leg {name}: joint {first.name} would stand at {-side * tilt:.3g} rad, where the hip "
            f"axis is level; allowed: in its range, {_range(first)}"
        )
    at = {0: level}
    hip_axis, knee_axis = _axis(leg, 1, at), _axis(leg, 2, at)
    skew = math.acos(min(1.0, abs(float(hip_axis @ knee_axis))))
    if skew > TOLERANCE:
        raise ModelFileError(
            f"leg {name}: the axes of {second.name} and {third.name} are {skew:.3g} rad apart; "
            "allowed: parallel, hip and knee"
        )
    frames = [_placed(leg, k, at) for k in range(3)]
    foot = _foot(leg)
    mount, hip, knee = (frame.position for frame in frames)
    ball = frames[2].at(foot.center)
    femur, tibia = knee - hip, ball - knee
    lengths = [math.hypot(vector[0], vector[2]) for vector in (femur, tibia)]
    for length, what in zip(lengths, ("hip to knee", "knee to foot"), strict=True):
        if length < 1e-3:
            raise ModelFileError(f"leg {name}: {what} are {length:.3g} m; allowed: 0.001 or more")
    femur_back, tibia_back = (math.atan2(-vector[0], -vector[2]) for vector in (femur, tibia))
    plane = ball[1]
    hip_sign, knee_sign = (math.copysign(1.0, float(axis[1])) for axis in (hip_axis, knee_axis))
    turns = (
        _turn(first, side, level, 0.0),
        _unwound(_turn(second, hip_sign, 0.0, femur_back), -math.pi / 2, math.pi / 2),
        _unwound(_turn(third, -knee_sign, 0.0, femur_back - tibia_back), -math.pi, math.pi),
    )
    y = np.array([0.0, 1.0, 0.0])
    origins = (mount, np.array([hip[0], plane, hip[2]]), np.array([knee[0], plane, knee[2]]))
    pitches = (0.0, femur_back, tibia_back)
    bodies = [
        moved(segment.body, Frame(origin, rotation(y, pitch)).inverse() @ frame)
        for segment, frame, origin, pitch in zip(leg, frames, origins, pitches, strict=True)
    ]
    return LegGeometry(
        names=tuple(segment.name for segment in leg),
        mount=mount,
        hip_offset=origins[1] - mount,
        femur=lengths[0],
        tibia=lengths[1],
        abduction=turns[0],
        hip=turns[1],
        knee=turns[2],
        bodies=(bodies[0], bodies[1], bodies[2]),
        foot=foot,
    )


def _hinges(leg: tuple[Segment, ...]) -> tuple[Joint, Joint, Joint]:
    """The joints of a leg, which are three hinges."""
    name = leg[0].name
    joints = [segment.joint for segment in leg if segment.joint is not None]
    for joint in joints:
        if joint.kind != "hinge":
            raise ModelFileError(f"leg {name}: joint {joint.name} is {joint.kind}; allowed: hinge")
        if joint.follows:
            raise ModelFileError(
                f"leg {name}: joint {joint.name} is tied to {joint.follows}; allowed: free joints"
            )
    if len(joints) != 3:
        named = ", ".join(joint.name for joint in joints)
        raise ModelFileError(
            f"leg {name} has {len(joints)} joints: {named}; allowed: three, abduction, hip and knee"
        )
    return joints[0], joints[1], joints[2]


def _check_axes(leg: tuple[Segment, ...], joints: tuple[Joint, Joint, Joint]) -> None:
    """Refuse a leg unless its first joint turns about x and its second at right angles to it."""
    name = leg[0].name
    first, second = (_axis(leg, k, {}) for k in range(2))
    if abs(first[0]) < math.cos(TOLERANCE):
        k = int(np.argmax(np.abs(first)))
        straight = abs(first[k]) >= math.cos(TOLERANCE)
        words = f"about {_AXES[k]}" if straight else f"about the oblique axis {_vector(first)}"
        kinds = {1: ", a pitch before the abduction", 2: ", a vertical coxa"}
        raise ModelFileError(
            f"leg {name}: its first joint {joints[0].name} turns {words} of the trunk"
            f"{kinds.get(k, '') if straight else ''}; allowed: an abduction about x, then hip and "
            "knee about y (x forward, z up)"
        )
    if abs(second[0]) > math.sin(TOLERANCE):
        raise ModelFileError(
            f"leg {name}: its second joint {joints[1].name} turns about {_vector(second)} of the "
            "trunk; allowed: a hip axis across x"
        )


def _vector(values: Array) -> str:
    return "(" + ", ".join(f"{value + 0.0:.3g}" for value in values) + ")"


def _placed(leg: tuple[Segment, ...], index: int, angles: Mapping[int, float]) -> Frame:
    """Placement of a segment in the frame of the trunk, joints that are not named at 0."""
    frame = Frame()
    for k, segment in enumerate(leg[: index + 1]):
        assert segment.joint is not None
        turn = rotation(segment.joint.axis, angles.get(k, 0.0))
        frame = frame @ segment.frame @ Frame(turn=turn)
    return frame


def _axis(leg: tuple[Segment, ...], index: int, angles: Mapping[int, float]) -> Array:
    """Axis of a joint in the frame of the trunk, shape (3,)."""
    joint = leg[index].joint
    assert joint is not None
    return np.asarray(_placed(leg, index, angles).turn @ joint.axis)


def _turn(joint: Joint, sign: float, at: float, angle: float) -> Turn:
    """A joint whose geometric angle is known at one angle of the file [rad]."""
    zero = at - sign * angle
    ends = sorted(sign * (limit - zero) for limit in (joint.lower, joint.upper))
    return Turn(joint, sign, zero, ends[0], ends[1])


def _nearest(angle: float, period: float, joint: Joint) -> float | None:
    """The smallest of angles one period apart that lies in the range of a joint [rad]."""
    angles = [angle + k * period for k in range(-3, 4)]
    inside = [each for each in angles if joint.lower - 1e-9 <= each <= joint.upper + 1e-9]
    return min(inside, key=abs, default=None)


def _range(joint: Joint) -> str:
    return f"{joint.lower:.3g} to {joint.upper:.3g} rad"


def _unwound(turn: Turn, low: float, high: float) -> Turn:
    """The joint counted in those turns in which most of its range lies from low to high [rad]."""

    def shared(turn: Turn) -> float:
        return min(turn.upper, high) - max(turn.lower, low)

    choices = [turn]
    for whole in (2.0 * math.pi, -2.0 * math.pi):
        zero, ends = turn.zero - turn.sign * whole, (turn.lower + whole, turn.upper + whole)
        choices.append(Turn(turn.joint, turn.sign, zero, *ends))
    return max(choices, key=shared)


def _foot(leg: tuple[Segment, ...]) -> Foot:
    """The foot of a leg: a ball, else the end of a capsule, else a frame with such a name.

    What touches goes before what is only seen, and what is farther from the knee before the rest.
    """
    last = leg[-1]
    marks = [(name, frame.position) for name, frame in last.frames.items() if _FOOT.search(name)]
    far = max((float(np.linalg.norm(point)) for _, point in marks), default=0.0)
    for touching in (True, False):
        balls = [
            Foot(shape.name, center, radius)
            for shape in last.shapes
            if shape.touches is touching
            for center, radius in _ends(shape)
        ]
        best = max(balls, key=lambda ball: float(np.linalg.norm(ball.center)), default=None)
        if best is not None:
            reach = float(np.linalg.norm(best.center)) + 2.0 * (best.radius or 0.0)
            if reach >= far:
                return best
    if marks:
        name, point = max(marks, key=lambda mark: float(np.linalg.norm(mark[1])))
        return Foot(name, point, None)
    frames = [(name, frame.position) for name, frame in last.frames.items()]
    name, point = max(frames, key=lambda mark: float(np.linalg.norm(mark[1])))
    if np.linalg.norm(point) > 1e-3:
        return Foot(name, point, None)
    raise ModelFileError(
        f"leg {leg[0].name}: {last.name} ends without a foot; allowed: a sphere or capsule, or a "
        "frame that is fixed to it"
    )


def _ends(shape: Shape) -> list[tuple[Array, float]]:
    """Balls at the ends of a shape, with their radii [m]."""
    center, half = shape.frame.position, shape.half
    if shape.kind == "sphere":
        return [(center, float(half[0]))]
    if shape.kind == "capsule":
        reach = shape.frame.turn @ np.array([0.0, 0.0, half[2] - half[0]])
        return [(center - reach, float(half[0])), (center + reach, float(half[0]))]
    return []

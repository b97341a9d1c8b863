"""Which of the known chains a leg of a model file is, and its geometry."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Final

import numpy as np

from apnc.importing.feet import foot_of
from apnc.importing.legs import LegGeometry, Pose, Turn
from apnc.importing.limbs import Segment
from apnc.importing.model import NO_BODY, Frame, Joint, ModelFileError, moved, rotation
from apnc_core.types import Array
from apnc_plant.robot.model import CHAINS

TOLERANCE: Final = 0.01
"""Largest deviation of an axis from the one it is taken for [rad]."""

SHORTEST: Final = 1e-3
"""Shortest femur or tibia [m]."""

BESIDE: Final = 1e-3
"""How far a leg may lie beside its abduction where the hip comes first, in lengths of the femur."""

_AXES: Final = ("x", "y", "z")
_X, _Y, _Z = np.eye(3)


@dataclass(frozen=True)
class _Straight:
    """A leg as it is measured: its first joints are straight, those that bend it are at 0.

    Args:
        chain: one of ``CHAINS``.
        at: angles of the joints that are straight, by their number [rad].
        turns: the same joints, by their angle of :class:`Pose`.
        across: the axis about which femur and tibia turn, shape (3,).
        base: what the frames are counted in.
        fixed: angles of joints that the leg lacks.
    """

    chain: tuple[str, ...]
    at: dict[int, float]
    turns: dict[str, Turn]
    across: Array
    base: Frame = field(default_factory=Frame)
    fixed: Pose = field(default_factory=Pose)


def leg_geometry(leg: tuple[Segment, ...]) -> LegGeometry:
    """The geometry of a leg.

    An offset of knee or foot along the hip axis does not matter to the motion, so it is counted at
    the hip. The rigid link behind a coxa and a femur without a tibia is halved into the two.

    Args:
        leg: its segments from the trunk outward.

    Raises:
        ModelFileError: the robot file has no such leg; the message says why.
    """
    name = leg[0].name
    straight = _straight(leg, _hinges(leg))
    chain, across, base = straight.chain, straight.across, straight.base
    inner = base.inverse()
    frames = [inner @ _placed(leg, k, straight.at) for k in range(len(leg))]
    foot = foot_of(leg)
    ball = frames[-1].at(foot.center)
    bends = range(len(leg) - 2, len(leg))  # femur and tibia
    if chain == CHAINS[1]:
        bends = range(2, 3)
    elif chain == CHAINS[4]:
        bends = range(1, 2)
    axes = [inner.turn @ _axis(leg, k, straight.at) for k in bends]
    _check_parallel(leg, bends, axes)
    signs = [math.copysign(1.0, float(axis @ across)) for axis in axes]
    knee = (frames[1].position + ball) / 2.0 if chain == CHAINS[4] else frames[-1].position
    hip = frames[0 if chain == CHAINS[2] else 1].position
    if chain == CHAINS[1]:
        _check_plane(leg, hip, knee, ball)
        hip = np.array([knee[0], hip[1], hip[2]])  # along the axis of the abduction
    mount = frames[0].position
    hip, knee = (point + across * ((ball - point) @ across) for point in (hip, knee))
    if chain == CHAINS[2]:
        mount = hip
    lengths = [float(np.linalg.norm(vector)) for vector in (knee - hip, ball - knee)]
    for length, what in zip(lengths, ("hip to knee", "knee to foot"), strict=True):
        if length < SHORTEST:
            raise ModelFileError(
                f"leg {name}: {what} are {length:.3g} m; allowed: {SHORTEST} or more"
            )
    back = np.cross(_Z, across)
    femur, tibia = (
        math.atan2(float(vector @ back), float(-vector[2])) for vector in (knee - hip, ball - knee)
    )
    turns = dict(straight.turns)
    if chain != CHAINS[1]:
        low, high = (0.0, math.pi) if chain[0] == "coxa" else (-math.pi / 2, math.pi / 2)
        turns["femur"] = _unwound(_turn(_joint(leg, bends[0]), signs[0], 0.0, femur), low, high)
    if chain != CHAINS[4]:
        turn = _turn(_joint(leg, bends[-1]), -signs[-1], 0.0, femur - tibia)
        turns["tibia"] = _unwound(turn, -math.pi, math.pi)
    origins, pitches = (mount, hip, knee), (0.0, femur, tibia)
    lacking = 0 if chain == CHAINS[2] else 2 if chain == CHAINS[4] else None
    links = [link for link in range(3) if link != lacking]
    bodies = [NO_BODY, NO_BODY, NO_BODY]
    for link, segment, frame in zip(links, leg, frames, strict=True):
        own = Frame(origins[link], rotation(across, pitches[link]))
        bodies[link] = moved(segment.body, own.inverse() @ frame)
    return LegGeometry(
        chain=chain,
        names=tuple(segment.name for segment in leg),
        mount=base.at(mount),
        hip_offset=hip - mount,
        femur=lengths[0],
        tibia=lengths[1],
        turns=turns,
        bodies=(bodies[0], bodies[1], bodies[2]),
        foot=foot,
        fixed=straight.fixed,
    )


def _straight(leg: tuple[Segment, ...], joints: tuple[Joint, ...]) -> _Straight:
    """The chain of a leg, from the axis of its first joint, and how it is straight."""
    first = _axis(leg, 0, {})
    if abs(first[2]) >= math.cos(TOLERANCE):
        return _coxa(leg, joints)
    if abs(first[0]) >= math.cos(TOLERANCE) and len(leg) == 3:
        return _abduction(leg, joints)
    if abs(first[0]) <= math.sin(TOLERANCE) and len(leg) == 2:
        tilt = _level(first)
        base = Frame(turn=rotation(_X, tilt))
        return _Straight(CHAINS[2], {}, {}, _Y, base, Pose(abduction=tilt))
    if abs(first[1]) >= math.cos(TOLERANCE) and len(leg) == 3:
        return _pitch_first(leg, joints)
    k = int(np.argmax(np.abs(first)))
    plain = abs(first[k]) >= math.cos(TOLERANCE)
    words = f"about {_AXES[k]}" if plain else f"about the oblique axis {_vector(first)}"
    allowed = "an abduction about x, a hip about y or a coxa about z"
    if len(leg) == 2:
        allowed = "a hip across x or a coxa about z, for legs of two joints"
    raise ModelFileError(
        f"leg {leg[0].name}: its first joint {joints[0].name} turns {words} of the trunk; "
        f"allowed: {allowed} (x forward, z up)"
    )


def _abduction(leg: tuple[Segment, ...], joints: tuple[Joint, ...]) -> _Straight:
    """Abduction, hip and knee: straight where the hip axis is level."""
    along = _axis(leg, 1, {})
    if abs(along[0]) > math.sin(TOLERANCE):
        _refuse_second(leg, joints, along, "a hip axis across x")
    sign = math.copysign(1.0, float(_axis(leg, 0, {})[0]))
    at = _nearest(-sign * _level(along), joints[0])
    return _Straight(CHAINS[0], {0: at}, {"abduction": _turn(joints[0], sign, at, 0.0)}, _Y)


def _pitch_first(leg: tuple[Segment, ...], joints: tuple[Joint, ...]) -> _Straight:
    """Hip, abduction and knee: straight where the abduction axis is level and the knee below."""
    axis = _axis(leg, 1, {})
    if abs(axis[1]) > math.sin(TOLERANCE):
        _refuse_second(leg, joints, axis, "an abduction at right angles to the hip")
    sign = math.copysign(1.0, float(_axis(leg, 0, {})[1]))
    at = {0: sign * math.atan2(axis[2], axis[0])}
    inner = math.copysign(1.0, float(_axis(leg, 1, at)[0]))
    third = _axis(leg, 2, at)
    if abs(third[0]) > math.sin(TOLERANCE):
        raise ModelFileError(
            f"leg {leg[0].name}: its third joint {joints[2].name} turns about {_vector(third)} "
            "where the abduction axis is level; allowed: at right angles to the abduction"
        )
    at[1] = _nearest(-inner * _level(third), joints[1])
    if _placed(leg, 2, at).position[2] > _placed(leg, 1, at).position[2]:
        at[0] += math.pi if at[0] <= 0.0 else -math.pi
        inner = -inner
    turns = {
        "femur": _unwound(_turn(joints[0], sign, at[0], 0.0), -math.pi / 2, math.pi / 2),
        "abduction": _turn(joints[1], inner, at[1], 0.0),
    }
    return _Straight(CHAINS[1], at, turns, _Y)


def _coxa(leg: tuple[Segment, ...], joints: tuple[Joint, ...]) -> _Straight:
    """Coxa, femur and perhaps tibia: straight where it points straight outward."""
    across = _axis(leg, 1, {})
    if abs(across[2]) > math.sin(TOLERANCE):
        _refuse_second(leg, joints, across, "a level femur axis")
    side = -1.0 if _placed(leg, 0, {}).position[1] < 0.0 else 1.0
    radial = np.array([-across[1], across[0], 0.0]) / math.hypot(across[0], across[1])
    outward = side * radial[1]
    if abs(outward) < TOLERANCE:  # it points forward or back: to its foot
        end = _placed(leg, len(leg) - 1, {}).at(foot_of(leg).center)
        outward = float(radial @ (end - _placed(leg, 0, {}).position))
    radial = radial if outward > 0.0 else -radial
    sign = -side * math.copysign(1.0, float(_axis(leg, 0, {})[2]))
    turn = _turn(joints[0], sign, 0.0, math.atan2(radial[0], side * radial[1]))
    chain = CHAINS[3] if len(leg) == 3 else CHAINS[4]
    at = {0: turn.zero}
    return _Straight(chain, at, {"pointing": turn}, side * _X)


def _hinges(leg: tuple[Segment, ...]) -> tuple[Joint, ...]:
    """The joints of a leg, which are two or three hinges."""
    name = leg[0].name
    joints = tuple(segment.joint for segment in leg if segment.joint is not None)
    for joint in joints:
        if joint.kind != "hinge":
            raise ModelFileError(f"leg {name}: joint {joint.name} is {joint.kind}; allowed: hinge")
        if joint.follows:
            raise ModelFileError(
                f"leg {name}: joint {joint.name} is tied to {joint.follows}; allowed: free joints"
            )
    if len(joints) not in {len(chain) for chain in CHAINS}:
        named = ", ".join(joint.name for joint in joints)
        raise ModelFileError(f"leg {name} has {len(joints)} joints: {named}; allowed: two or three")
    return joints


def _refuse_second(
    leg: tuple[Segment, ...], joints: tuple[Joint, ...], axis: Array, allowed: str
) -> None:
    raise ModelFileError(
        f"leg {leg[0].name}: its second joint {joints[1].name} turns about {_vector(axis)} of the "
        f"trunk; allowed: {allowed}"
    )


def _check_parallel(leg: tuple[Segment, ...], bends: range, axes: list[Array]) -> None:
    """Refuse a leg unless femur and tibia turn about the same direction."""
    if len(axes) < 2:
        return
    skew = math.acos(min(1.0, abs(float(axes[0] @ axes[1]))))
    if skew > TOLERANCE:
        names = " and ".join(_joint(leg, k).name for k in bends)
        raise ModelFileError(
            f"leg {leg[0].name}: the axes of {names} are {skew:.3g} rad apart; allowed: parallel"
        )


def _check_plane(leg: tuple[Segment, ...], hip: Array, knee: Array, ball: Array) -> None:
    """Refuse a leg whose plane lies beside its abduction, where the hip comes before it."""
    beside = abs(float(ball[1] - hip[1]))
    if beside > BESIDE * abs(float(knee[2] - hip[2])):
        raise ModelFileError(
            f"leg {leg[0].name}: its foot lies {beside:.3g} m beside the abduction, which comes "
            "after the hip; allowed: 0"
        )


def _joint(leg: tuple[Segment, ...], index: int) -> Joint:
    joint = leg[index].joint
    assert joint is not None
    return joint


def _level(axis: Array) -> float:
    """Turn about x that makes an axis across x level, from the nearer end of y [rad]."""
    y, z = (float(each) for each in axis[1:])
    return math.atan2(z, y) if y > 0.0 else math.atan2(-z, -y)


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
    return np.asarray(_placed(leg, index, angles).turn @ _joint(leg, index).axis)


def _turn(joint: Joint, sign: float, at: float, angle: float) -> Turn:
    """A joint whose geometric angle is known at one angle of the file [rad]."""
    zero = at - sign * angle
    ends = sorted(sign * (limit - zero) for limit in (joint.lower, joint.upper))
    return Turn(joint, sign, zero, ends[0], ends[1])


def _nearest(angle: float, joint: Joint) -> float:
    """The smallest of angles half a turn apart, in the range of a joint if one is [rad]."""
    angles = [angle + k * math.pi for k in range(-3, 4)]
    inside = [each for each in angles if joint.lower - 1e-9 <= each <= joint.upper + 1e-9]
    return min(inside or angles, key=abs)


def _unwound(turn: Turn, low: float, high: float) -> Turn:
    """The joint counted in those turns in which most of its range lies from low to high [rad]."""

    def shared(turn: Turn) -> float:
        return min(turn.upper, high) - max(turn.lower, low)

    choices = [turn]
    for whole in (2.0 * math.pi, -2.0 * math.pi):
        zero, ends = turn.zero - turn.sign * whole, (turn.lower + whole, turn.upper + whole)
        choices.append(Turn(turn.joint, turn.sign, zero, *ends))
    return max(choices, key=shared)

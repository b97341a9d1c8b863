"""How an imported robot stands as it walks: a rule, or a pose of its file."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from apnc.importing.legs import LegGeometry, Pose
from apnc.importing.model import ModelFileError, moved, together
from apnc_core.types import Array
from apnc_plant.robot import MassProperties

LEG_PER_SPACING: Final = 1.05
"""Height of the hips over the feet, in halves of the distance of neighbouring hips."""

FEET_BEHIND: Final = 0.25
"""How far the middle of the feet lies behind the centre of mass, in the same halves."""

STRAIGHTEST: Final = 0.2
"""Smallest angle between femur and tibia in a walk [rad]: a straight leg cannot give way."""

_RATIOS: Final = tuple(sorted(np.arange(0.3, 2.5, 0.01), key=lambda r: abs(r - LEG_PER_SPACING)))

LIFTED: Final = math.radians(110.0)
"""Femur of a leg with a coxa by the rule, outward of vertical [rad]."""

LEANING: Final = math.radians(5.0)
"""Its tibia, outward of vertical [rad]."""

UNEVEN: Final = 0.02
"""Largest difference in height of the feet of a pose with coxae, in lengths of a leg."""

LOWEST: Final = 0.2
"""Smallest height of the femur axes over such feet, in lengths of a leg."""

_HELD: Final = 1e-9
"""By how much a joint that the gait does not move may lie beyond its range [rad]: files round."""


@dataclass(frozen=True)
class Swing:
    """How far the gait moves the joints to both sides of the stance.

    Args:
        hip, knee: amplitudes [rad].
    """

    hip: float
    knee: float


@dataclass(frozen=True)
class Stance:
    """Angles of all legs about which the robot walks.

    Args:
        poses: angles of each leg.
        ratio: height of the hips over the feet, in halves of the distance of neighbouring hips.
        behind: how far the middle of the feet lies behind the centre of mass, in the same halves.
        dropped: what of a named pose is not kept, in words.
    """

    poses: tuple[Pose, ...]
    ratio: float
    behind: float
    dropped: tuple[str, ...] = ()


def stance_by_rule(trunk: MassProperties, legs: Sequence[LegGeometry], swing: Swing) -> Stance:
    """The stance in which most quadrupeds trot, or that of legs with a coxa.

    The hips are ``LEG_PER_SPACING`` above the feet and the middle of the feet is ``FEET_BEHIND``
    behind the centre of mass, both in halves of the mean distance of neighbouring hips of a side.
    If a joint would leave its range, the nearest height at which none does is taken. A knee lies
    behind the line from hip to foot, or in front of it where its range is all there. For legs with
    a coxa see :func:`_stance_with_coxae`.

    Args:
        trunk: mass properties of the trunk in its frame.
        legs: the legs.
        swing: how far the gait moves the joints.

    Raises:
        ModelFileError: no height keeps all joints in their ranges; the message names the joint
            that is farthest out of it at the height of the rule; or only some legs have a coxa.
    """
    coxae = sum(leg.has_coxa for leg in legs)
    if coxae == len(legs):
        return _stance_with_coxae(trunk, legs, swing)
    if coxae:
        raise ModelFileError(
            f"{coxae} of {len(legs)} legs have a coxa; allowed: all or none, or a pose by name"
        )
    for leg in legs:
        _check_level(leg)
    bends = [_bends(leg, swing) for leg in legs]
    half = _half_spacing(legs)
    kept = []
    for ratio in _RATIOS:
        angles = _angles(trunk, legs, bends, half, ratio)
        out = [_outside(leg, pose, swing) for leg, pose in zip(legs, angles, strict=True)]
        worst = max(out)
        if worst[0] <= 0.0:
            told = (
                f"the height of the rule, {LEG_PER_SPACING}, at which a joint would leave its "
                f"range; {ratio:.3g} is the nearest at which none does",
            )
            on_rule = abs(ratio - LEG_PER_SPACING) < 1e-9
            return Stance(tuple(angles), float(ratio), FEET_BEHIND, () if on_rule else told)
        kept.append(worst)
    raise ModelFileError(min(kept)[1])


def stance_of_pose(
    trunk: MassProperties,
    legs: Sequence[LegGeometry],
    swing: Swing,
    pose: Mapping[str, float],
) -> Stance:
    """A pose of the file as stance.

    Args:
        trunk, legs, swing: as of :func:`stance_by_rule`.
        pose: angles by joint [rad]; 0 if left out.

    Raises:
        ModelFileError: the gait would leave the range of a joint.
    """
    poses = [_principal(leg.pose(pose)) for leg in legs]
    for leg, own in zip(legs, poses, strict=True):
        worst = _outside(leg, own, swing)
        if worst[0] > 0.0:
            raise ModelFileError(worst[1])
    return _measured(trunk, legs, poses)


def _measured(
    trunk: MassProperties,
    legs: Sequence[LegGeometry],
    poses: Sequence[Pose],
    dropped: tuple[str, ...] = (),
) -> Stance:
    """The stance of a pose."""
    half = _half_spacing(legs)
    com = _center_of_mass(trunk, legs, poses)
    middle = np.mean([leg.foot_at(own) for leg, own in zip(legs, poses, strict=True)], axis=0)
    hips = np.mean([leg.hip_joint[2] for leg in legs])
    ratio, behind = float(hips - middle[2]) / half, float(com[0] - middle[0]) / half
    return Stance(tuple(poses), ratio, behind, dropped)


def _stance_with_coxae(trunk: MassProperties, legs: Sequence[LegGeometry], swing: Swing) -> Stance:
    """The stance of legs with a coxa: all joints at 0 if the robot can stand so, else by a rule.

    It can stand so if its feet lie outward of and below the femur axes, differ in height by
    ``UNEVEN`` at most, and no joint leaves its range. The rule leaves the coxae as they are, lifts
    the femurs by ``LIFTED`` and lets the tibias lean by ``LEANING``, both as near as the ranges
    allow, and levels the feet by the femurs.
    """
    zero = [_principal(_in_range(leg, leg.pose({}), swing)) for leg in legs]
    feet = [leg.foot_at(own) for leg, own in zip(legs, zero, strict=True)]
    size = float(np.mean([leg.femur + leg.tibia for leg in legs]))
    heights = [float(foot[2]) for foot in feet]
    stands = max(heights) - min(heights) <= UNEVEN * size and all(
        leg.hip_joint[2] - height >= LOWEST * size
        and 0.0 < own.femur < math.pi
        and _outside(leg, own, swing)[0] <= 0.0
        for leg, own, height in zip(legs, zero, heights, strict=True)
    )
    if stands:
        return _measured(trunk, legs, zero)
    kept = []
    for lifted, leaning in _LIFTS:
        first = [_lifted(leg, own, lifted, leaning) for leg, own in zip(legs, zero, strict=True)]
        ground = float(np.mean([leg.foot_at(own)[2] for leg, own in zip(legs, first, strict=True)]))
        poses = [_levelled(leg, own, ground, leaning) for leg, own in zip(legs, first, strict=True)]
        worst = max(_outside(leg, own, swing) for leg, own in zip(legs, poses, strict=True))
        if worst[0] <= 0.0:
            told = "all joints at 0: the feet are not level and below the coxae within the ranges"
            return _measured(trunk, legs, poses, (told,))
        kept.append(worst)
    raise ModelFileError(min(kept)[1])


_LIFTS: Final = tuple(
    sorted(
        (
            (math.radians(lifted), math.radians(leaning))
            for lifted in range(40, 156, 5)
            for leaning in range(-45, 46, 5)
        ),
        key=lambda pair: (abs(pair[0] - LIFTED) + abs(pair[1] - LEANING), pair),
    )
)
"""Femurs and tibias outward of vertical [rad], from those of the rule outward."""


def _in_range(leg: LegGeometry, pose: Pose, swing: Swing) -> Pose:
    """The pose with every joint, and the coxa with its swing, as near as its range allows."""
    found = {}
    for name, turn in leg.turns.items():
        room = swing.hip if name == "pointing" else 0.0
        low, high = turn.lower + room, turn.upper - room
        found[name] = min(max(getattr(pose, name), low), max(low, high))
    return replace(pose, **found)


def _lifted(leg: LegGeometry, pose: Pose, lifted: float, leaning: float) -> Pose:
    """The pose with a femur and a tibia so far outward of vertical [rad].

    A rigid leg is turned so that the line to its foot leans as far as that of a usual one.
    """
    if "tibia" in leg.turns:
        return replace(pose, femur=lifted, tibia=lifted - leaning)
    return replace(pose, femur=(lifted + leaning) / 2.0)


def _levelled(leg: LegGeometry, pose: Pose, ground: float, leaning: float) -> Pose:
    """The pose with its foot at a height in the frame of the trunk [m]; nan if it cannot."""
    down = float(leg.hip_joint[2]) - ground
    if "tibia" not in leg.turns:
        cosine = down / (leg.femur + leg.tibia)
        return replace(pose, femur=math.acos(cosine) if abs(cosine) <= 1.0 else math.nan)
    cosine = (down - leg.tibia * math.cos(leaning)) / leg.femur
    femur = math.acos(cosine) if abs(cosine) <= 1.0 else math.nan
    return replace(pose, femur=femur, tibia=femur - leaning)


def _check_level(leg: LegGeometry) -> None:
    """Refuse a leg that cannot stand with its hip axis level."""
    turn = leg.turns.get("abduction")
    if turn is not None and not turn.lower - _HELD <= 0.0 <= turn.upper + _HELD:
        low, high = turn.joint.lower, turn.joint.upper
        raise ModelFileError(
            f"leg {leg.names[0]}: joint {turn.joint.name} would stand at {turn.zero:.3g} rad, "
            f"where the hip axis is level; allowed: in its range, {low:.3g} to {high:.3g} rad, "
            "or a pose by name"
        )


def _principal(pose: Pose) -> Pose:
    """The pose with its angles in (-pi, pi] [rad]; one that is there already is left as it is."""

    def angle(value: float) -> float:
        if -math.pi < value <= math.pi:
            return value
        return math.pi - (math.pi - value) % (2.0 * math.pi)

    return Pose(*map(angle, (pose.abduction, pose.pointing, pose.femur, pose.tibia)))


def _half_spacing(legs: Sequence[LegGeometry]) -> float:
    """Half of the mean distance of neighbouring hips of a side [m].

    Raises:
        ModelFileError: all hips of a side are at the same place along x.
    """
    distances = []
    for right in (True, False):
        x = sorted(leg.hip_joint[0] for leg in legs if leg.right is right)
        distances += list(np.diff(x))
    spacing = float(np.mean(distances)) if distances else 0.0
    if spacing < 1e-3:
        raise ModelFileError(
            f"hips of a side are {spacing:.3g} m apart along x; allowed: 0.001 or more "
            "(x forward, y to the left, z up)"
        )
    return spacing / 2.0


def _bends(leg: LegGeometry, swing: Swing) -> float:
    """1 for a knee that lies behind the line from hip to foot, -1 for one in front of it."""
    room, knee = STRAIGHTEST + 2.0 * swing.knee, leg.turns["tibia"]
    behind, in_front = knee.upper >= room, knee.lower <= -room
    return -1.0 if in_front and not behind else 1.0


def _angles(
    trunk: MassProperties,
    legs: Sequence[LegGeometry],
    bends: Sequence[float],
    half: float,
    ratio: float,
) -> list[Pose]:
    """Pose of each leg; nan where a leg does not reach."""
    hips = np.array([leg.hip_joint for leg in legs])
    heights = ratio * half + hips[:, 2] - hips[:, 2].mean()
    forward, poses = 0.0, [Pose() for _ in legs]
    for _ in range(30):  # the legs move the centre of mass a little
        poses = [
            _reach(leg, forward, float(height), bent)
            for leg, height, bent in zip(legs, heights, bends, strict=True)
        ]
        com = _center_of_mass(trunk, legs, poses)
        before, forward = forward, float(com[0] - FEET_BEHIND * half - hips[:, 0].mean())
        if not math.isfinite(forward) or abs(forward - before) < 1e-12:
            break
    return poses


def _reach(leg: LegGeometry, forward: float, down: float, bends: float) -> Pose:
    """The pose with the foot so far in front of and below the hip [m]."""
    down /= math.cos(leg.fixed.abduction)
    a, lead, b, distance = leg.femur, 0.0, leg.tibia, math.hypot(forward, down)
    if leg.pitches_first:  # from the hip axis to the knee, and how far back that lies
        x, _, z = leg.hip_offset
        a, lead = math.hypot(x, leg.femur - z), math.atan2(-x, leg.femur - z)
    cosine = (distance**2 - a**2 - b**2) / (2.0 * a * b)
    if not abs(cosine) <= 1.0:
        return replace(leg.fixed, femur=math.nan, tibia=math.nan)
    knee = math.acos(cosine)
    back = math.atan2(-forward, down)
    lean = math.atan2(b * math.sin(knee), a + b * math.cos(knee))
    return replace(leg.fixed, femur=back + bends * lean - lead, tibia=bends * knee - lead)


def _outside(leg: LegGeometry, pose: Pose, swing: Swing) -> tuple[float, str]:
    """How far the gait leaves the range of a joint at most [rad], not above 0 if nowhere."""
    name = leg.names[0]
    if math.isnan(pose.femur):
        return math.inf, f"leg {name} is too short or too long for any stance"
    worst = (-math.inf, "")
    turns, sizes = dict(leg.turns), {"femur": swing.hip, "tibia": swing.knee}
    if leg.has_coxa:
        sizes = {"pointing": swing.hip, "femur": swing.knee}
    elif pose.tibia < 0.0:
        turns["tibia"] = replace(turns["tibia"], upper=min(turns["tibia"].upper, -STRAIGHTEST))
    else:
        turns["tibia"] = replace(turns["tibia"], lower=max(turns["tibia"].lower, STRAIGHTEST))
    for angle_name, turn in turns.items():
        angle, size = getattr(pose, angle_name), sizes.get(angle_name, 0.0)
        out = max(turn.lower - (angle - size), angle + size - turn.upper)
        out -= _HELD if size == 0.0 else 0.0
        moves = sorted(map(turn.in_file, (angle - size, angle + size)))
        ends = sorted(map(turn.in_file, (turn.lower, turn.upper)))
        words = (
            f"leg {name}: the gait would move {turn.joint.name} from {moves[0]:.3g} to "
            f"{moves[1]:.3g} rad; allowed: {ends[0]:.3g} to {ends[1]:.3g} rad, its range"
        )
        worst = max(worst, (out, words))
    return worst


def _center_of_mass(
    trunk: MassProperties, legs: Sequence[LegGeometry], poses: Sequence[Pose]
) -> Array:
    """Centre of mass of the robot in the frame of its trunk [m], shape (3,)."""
    whole = trunk
    for leg, pose in zip(legs, poses, strict=True):
        for body, frame in zip(leg.bodies, leg.frames(pose)[:3], strict=True):
            whole = together(whole, moved(body, frame))
    return whole.com

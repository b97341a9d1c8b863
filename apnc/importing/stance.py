"""How an imported robot stands as it walks: a rule, or a pose of its file."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from apnc.importing.legs import LegGeometry
from apnc.importing.model import Frame, ModelFileError, moved, rotation, together
from apnc_core.types import Array
from apnc_plant.robot import MassProperties

LEG_PER_SPACING: Final = 1.05
"""Height of the hips over the feet, in halves of the distance of neighbouring hips."""

FEET_BEHIND: Final = 0.25
"""How far the middle of the feet lies behind the centre of mass, in the same halves."""

STRAIGHTEST: Final = 0.2
"""Smallest angle between femur and tibia in a walk [rad]: a straight leg cannot give way."""

_RATIOS: Final = tuple(sorted(np.arange(0.3, 2.5, 0.01), key=lambda r: abs(r - LEG_PER_SPACING)))
_LEVEL: Final = 0.01


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
        femur: back of vertical, of each leg [rad].
        tibia: forward of the line of the femur, of each leg [rad]; negative where the knee lies in
            front of the line from hip to foot.
        ratio: height of the hips over the feet, in halves of the distance of neighbouring hips.
        behind: how far the middle of the feet lies behind the centre of mass, in the same halves.
        dropped: what of a named pose is not kept, in words.
    """

    femur: tuple[float, ...]
    tibia: tuple[float, ...]
    ratio: float
    behind: float
    dropped: tuple[str, ...] = ()


def stance_by_rule(trunk: MassProperties, legs: Sequence[LegGeometry], swing: Swing) -> Stance:
    """The stance in which most quadrupeds trot.

    The hips are ``LEG_PER_SPACING`` above the feet and the middle of the feet is ``FEET_BEHIND``
    behind the centre of mass, both in halves of the mean distance of neighbouring hips of a side.
    If a joint would leave its range, the nearest height at which none does is taken. A knee lies
    behind the line from hip to foot, or in front of it where its range is all there.

    Args:
        trunk: mass properties of the trunk in its frame.
        legs: the legs.
        swing: how far the gait moves the joints.

    Raises:
        ModelFileError: no height keeps all joints in their ranges; the message names the joint
            that is farthest out of it at the height of the rule.
    """
    bends = [_bends(leg, swing) for leg in legs]
    half = _half_spacing(legs)
    kept = []
    for ratio in _RATIOS:
        angles = _angles(trunk, legs, bends, half, ratio)
        out = [_outside(leg, *pair, swing) for leg, pair in zip(legs, angles, strict=True)]
        worst = max(out)
        if worst[0] <= 0.0:
            femur, tibia = (tuple(float(pair[k]) for pair in angles) for k in range(2))
            told = (
                f"the height of the rule, {LEG_PER_SPACING}, at which a joint would leave its "
                f"range; {ratio:.3g} is the nearest at which none does",
            )
            on_rule = abs(ratio - LEG_PER_SPACING) < 1e-9
            return Stance(femur, tibia, float(ratio), FEET_BEHIND, () if on_rule else told)
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
    angles, dropped = [], []
    for leg in legs:
        aside, femur, tibia = (turn.geometric(pose.get(turn.joint.name, 0.0)) for turn in leg.turns)
        femur, tibia = (_principal(angle) for angle in (femur, tibia))
        if abs(aside) > _LEVEL:
            dropped.append(
                f"{leg.abduction.joint.name} stands at {leg.abduction.zero:.3g} rad, where the hip "
                f"axis is level, not at {leg.abduction.in_file(aside):.3g} as in the pose"
            )
        worst = _outside(leg, femur, tibia, swing)
        if worst[0] > 0.0:
            raise ModelFileError(worst[1])
        angles.append((femur, tibia))
    half = _half_spacing(legs)
    com = _center_of_mass(trunk, legs, angles)
    feet = [_foot_at(leg, *pair) for leg, pair in zip(legs, angles, strict=True)]
    middle = np.mean(feet, axis=0)
    hips = np.mean([leg.hip_joint[2] for leg in legs])
    return Stance(
        tuple(pair[0] for pair in angles),
        tuple(pair[1] for pair in angles),
        float(hips - middle[2]) / half,
        float(com[0] - middle[0]) / half,
        tuple(dropped),
    )


def _principal(angle: float) -> float:
    """The angle in (-pi, pi] [rad]; one that is there already is left as it is."""
    if -math.pi < angle <= math.pi:
        return angle
    return math.pi - (math.pi - angle) % (2.0 * math.pi)


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
    room = STRAIGHTEST + 2.0 * swing.knee
    behind, in_front = leg.knee.upper >= room, leg.knee.lower <= -room
    return -1.0 if in_front and not behind else 1.0


def _angles(
    trunk: MassProperties,
    legs: Sequence[LegGeometry],
    bends: Sequence[float],
    half: float,
    ratio: float,
) -> list[tuple[float, float]]:
    """Angles of femur and tibia of each leg [rad]; nan where a leg does not reach."""
    hips = np.array([leg.hip_joint for leg in legs])
    heights = ratio * half + hips[:, 2] - hips[:, 2].mean()
    forward, angles = 0.0, [(0.0, 0.0)] * len(legs)
    for _ in range(30):  # the legs move the centre of mass a little
        angles = [
            _reach(leg, forward, height, bent)
            for leg, height, bent in zip(legs, heights, bends, strict=True)
        ]
        com = _center_of_mass(trunk, legs, angles)
        before, forward = forward, float(com[0] - FEET_BEHIND * half - hips[:, 0].mean())
        if not math.isfinite(forward) or abs(forward - before) < 1e-12:
            break
    return angles


def _reach(leg: LegGeometry, forward: float, down: float, bends: float) -> tuple[float, float]:
    """Angles of femur and tibia with the foot so far in front of and below the hip [m]."""
    a, b, distance = leg.femur, leg.tibia, math.hypot(forward, down)
    cosine = (distance**2 - a**2 - b**2) / (2.0 * a * b)
    if not abs(cosine) <= 1.0:
        return math.nan, math.nan
    knee = math.acos(cosine)
    back = math.atan2(-forward, down)
    lean = math.atan2(b * math.sin(knee), a + b * math.cos(knee))
    return back + bends * lean, bends * knee


def _outside(leg: LegGeometry, femur: float, tibia: float, swing: Swing) -> tuple[float, str]:
    """How far the gait leaves the range of a joint at most [rad], not above 0 if nowhere."""
    name = leg.names[0]
    if math.isnan(femur):
        return math.inf, f"leg {name} is too short or too long for any stance"
    worst = (-math.inf, "")
    if tibia < 0.0:
        least = replace(leg.knee, upper=min(leg.knee.upper, -STRAIGHTEST))
    else:
        least = replace(leg.knee, lower=max(leg.knee.lower, STRAIGHTEST))
    for turn, angle, size in ((leg.hip, femur, swing.hip), (least, tibia, swing.knee)):
        out = max(turn.lower - (angle - size), angle + size - turn.upper)
        moves = sorted(map(turn.in_file, (angle - size, angle + size)))
        ends = sorted(map(turn.in_file, (turn.lower, turn.upper)))
        words = (
            f"leg {name}: the gait would move {turn.joint.name} from {moves[0]:.3g} to "
            f"{moves[1]:.3g} rad; allowed: {ends[0]:.3g} to {ends[1]:.3g} rad, its range"
        )
        worst = max(worst, (out, words))
    return worst


def _foot_at(leg: LegGeometry, femur: float, tibia: float) -> Array:
    """The foot in the frame of the trunk [m], shape (3,)."""
    back = femur - tibia
    x = -leg.femur * math.sin(femur) - leg.tibia * math.sin(back)
    z = -leg.femur * math.cos(femur) - leg.tibia * math.cos(back)
    return np.asarray(leg.hip_joint + np.array([x, 0.0, z]))


def _center_of_mass(
    trunk: MassProperties, legs: Sequence[LegGeometry], angles: Sequence[tuple[float, float]]
) -> Array:
    """Centre of mass of the robot in the frame of its trunk [m], shape (3,)."""
    whole, y = trunk, np.array([0.0, 1.0, 0.0])
    for leg, (femur, tibia) in zip(legs, angles, strict=True):
        knee = leg.hip_joint - leg.femur * np.array([math.sin(femur), 0.0, math.cos(femur)])
        frames = (
            Frame(leg.mount),
            Frame(leg.hip_joint, rotation(y, femur)),
            Frame(knee, rotation(y, femur - tibia)),
        )
        for body, frame in zip(leg.bodies, frames, strict=True):
            whole = together(whole, moved(body, frame))
    return whole.com

"""How a robot stands as it walks, in shares of its leg length, and the angles that make it so."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from apnc_plant.robot import Leg, RobotDescription
from apnc_plant.robot.model import JointsInFile
from apnc_plant.robot.size import mean_leg_length

_FROM_STOPS = 0.03
"""Least distance of a reference angle from the stops of its joint [rad]."""

_FOLDED = 0.02
"""Least distance of hip and foot from that of a straight or a folded leg, in leg lengths."""


@dataclass(frozen=True)
class StanceChange:
    """A change of the pose about which a robot walks, in leg lengths (femur and tibia).

    Args:
        up: how much higher the hips stand over the feet.
        back: how much farther back all feet stand.
        apart: how much farther forward the front feet and back the hind feet stand; those of a leg
            in between in proportion.
        fore_up: how much higher the front hips stand over their feet than the hind hips do.
    """

    up: float = 0.0
    back: float = 0.0
    apart: float = 0.0
    fore_up: float = 0.0


def stood(
    robot: RobotDescription,
    b: tuple[float, float],
    stance: StanceChange,
    *,
    keep: bool = False,
) -> tuple[RobotDescription, tuple[float, float]]:
    """The robot in another stance.

    What all legs have in common of the change goes into the offsets of the motor neurons
    (Eq. 8, 9), so that the reference pose of a robot whose legs are alike stays as it is. The rest
    goes into the reference angles of each leg; all of it does if the offsets are to be kept.

    Args:
        robot: the robot.
        b: offsets b1 of the hip and b2 of the knee that hold in its present stance [rad].
        stance: the change.
        keep: whether the offsets stay as they are.

    Returns:
        The robot, and its offsets b1 and b2 [rad].
    """
    if stance == StanceChange():
        return robot, b
    L = mean_leg_length(robot)
    ends = _ends(robot.legs)
    wanted = []
    for leg, end in zip(robot.legs, ends, strict=True):
        forward, down = _foot(leg, *b)
        forward += L * (end * stance.apart - stance.back)
        down += L * (stance.up + 0.5 * end * stance.fore_up)
        wanted.append(_turned(leg, forward, down))
    moved = [_offsets(leg, *pose) for leg, pose in zip(robot.legs, wanted, strict=True)]
    b1, b2 = b if keep else (float(x) for x in np.mean(moved, axis=0))
    legs = tuple(
        _referred(leg, hip - b1, knee - b2)
        for leg, (hip, knee) in zip(robot.legs, moved, strict=True)
    )
    return replace(robot, legs=legs), (b1, b2)


def _referred(leg: Leg, hip: float, knee: float) -> Leg:
    """The leg with a reference pose that is off by angles of hip and knee [rad], between stops.

    The joints of its model file count from the reference pose, so that their offsets change, too.
    """
    if abs(hip) < 1e-12 and abs(knee) < 1e-12:
        return leg
    femur = _inside(leg.femur_angle - hip, leg.femur_range)
    tibia = _inside(leg.tibia_angle + _bends(leg) * knee, leg.tibia_range)
    turned = {"hip": leg.femur_angle - femur, "knee": _bends(leg) * (tibia - leg.tibia_angle)}
    return replace(
        leg, femur_angle=femur, tibia_angle=tibia, joints=counted_from(leg.joints, turned)
    )


def counted_from(joints: JointsInFile, turned: Mapping[str, float]) -> JointsInFile:
    """Joints of a model file, whose angles count from a reference pose that has turned.

    Args:
        joints: of a leg.
        turned: by how much each joint has, by name [rad].
    """
    found = {
        name: replace(own, offset=own.offset + own.sign * angle)
        for name, angle in turned.items()
        if (own := getattr(joints, name)) is not None
    }
    return replace(joints, **found)


def _inside(angle: float, stops: tuple[float, float] | None) -> float:
    """The nearest angle between the stops of a joint [rad]."""
    if stops is None:
        return angle
    low, high = stops
    margin = min(_FROM_STOPS, 0.25 * (high - low))
    return min(max(angle, low + margin), high - margin)


def _ends(legs: Sequence[Leg]) -> list[float]:
    """Where each leg is along its robot: 1 for the front, -1 for the hind."""
    x = np.array([leg.mount[0] for leg in legs])
    low, high = x.min(), x.max()
    middle, half = (high + low) / 2.0, (high - low) / 2.0
    return [float((at - middle) / half) if half > 0.0 else 0.0 for at in x]


def _bends(leg: Leg) -> float:
    """1 for a knee behind the line from hip to foot, -1 for one in front of it."""
    return -1.0 if leg.knee == ">" else 1.0


def _foot(leg: Leg, b1: float, b2: float) -> tuple[float, float]:
    """How far the foot is in front of and below the hip, in the plane of the leg [m]."""
    femur = leg.femur_angle - b1
    tibia = femur - (leg.tibia_angle + _bends(leg) * b2)
    x = -leg.femur_length * math.sin(femur) - leg.tibia_length * math.sin(tibia)
    return x, leg.femur_length * math.cos(femur) + leg.tibia_length * math.cos(tibia)


def _turned(leg: Leg, forward: float, down: float) -> tuple[float, float]:
    """Angles of femur and tibia with the foot there, or as near as the leg reaches [rad]."""
    a, b = leg.femur_length, leg.tibia_length
    margin = _FOLDED * (a + b)
    distance = min(max(math.hypot(forward, down), abs(a - b) + margin), a + b - margin)
    knee = math.acos((distance**2 - a**2 - b**2) / (2.0 * a * b))
    back = math.atan2(-forward, down)
    bends = _bends(leg)
    femur = back + bends * math.atan2(b * math.sin(knee), a + b * math.cos(knee))
    return femur, bends * knee


def _offsets(leg: Leg, femur: float, tibia: float) -> tuple[float, float]:
    """Offsets of hip and knee that turn a leg from its reference pose to these angles [rad]."""
    return leg.femur_angle - femur, _bends(leg) * (tibia - leg.tibia_angle)

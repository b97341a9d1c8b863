"""Numbers of a robot that were set by hand after its model file was read."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any, Final

from apnc.tune.stance import counted_from
from apnc.tune.tuned_file import tuned_text
from apnc_plant.robot import Leg, RobotDescription, load_robot

HEAD: Final = "Set by hand: stance, servo and controller, see research/gallery/robots.toml."


@dataclass(frozen=True)
class ByHand:
    """What is set by hand.

    Args:
        stance: reference angles of legs with a coxa by the place in their name (``F``, ``M``,
            ``H``): how far the coxa points forward, femur outward of vertical, tibia inward of the
            femur [deg].
        servo: keys of ``[servo]``.
        controller: keys of ``[controller]``.
        mi_range: lowest and highest MI.
        mi: MI that it walks at.
    """

    stance: Mapping[str, tuple[float, float, float]] = field(default_factory=dict)
    servo: Mapping[str, Any] = field(default_factory=dict)
    controller: Mapping[str, float] = field(default_factory=dict)
    mi_range: tuple[float, float] | None = None
    mi: float | None = None


def text_by_hand(file: Path, given: ByHand) -> str:
    """Text of a robot file with numbers that were set by hand.

    Args:
        file: as it was read from the model file.
        given: the numbers.
    """
    return tuned_text(file, by_hand(load_robot(file), given), [HEAD])


def by_hand(robot: RobotDescription, given: ByHand) -> RobotDescription:
    """The robot with numbers that were set by hand."""
    return replace(
        robot,
        legs=tuple(
            _stood(leg, given.stance[leg.name[1]]) if leg.name[1] in given.stance else leg
            for leg in robot.legs
        ),
        servo=replace(robot.servo, **given.servo),
        controller={**robot.controller, **given.controller},
        mi_range=given.mi_range or robot.mi_range,
        mi=given.mi or robot.mi,
    )


def _stood(leg: Leg, degrees: tuple[float, float, float]) -> Leg:
    """The leg in another reference pose; the joints of its model file count from it."""
    pointing, femur, tibia = map(math.radians, degrees)
    turned = {
        "abduction": leg.side * (leg.tibia_angle - tibia),
        "hip": pointing - leg.pointing,
        "knee": femur - leg.femur_angle,
    }
    return replace(
        leg, pointing=pointing, femur_angle=femur, tibia_angle=tibia,
        joints=counted_from(leg.joints, turned),
    )  # fmt: skip

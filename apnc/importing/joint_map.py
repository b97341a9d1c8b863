"""The joints of a model file as maps from the angles that controller and record count."""

from __future__ import annotations

from collections.abc import Sequence

from apnc.importing.legs import LegGeometry
from apnc.importing.stance import Stance
from apnc_plant.robot import JointMap
from apnc_plant.signals import JOINTS


def joint_maps(
    names: Sequence[str], legs: Sequence[LegGeometry], stance: Stance
) -> tuple[JointMap, ...]:
    """The joints of all legs.

    Args:
        names: of the legs.
        legs: the legs.
        stance: its angles are those of the reference pose.

    A positive hip angle swings the femur forward, that is less back of vertical. A positive knee
    angle flexes the knee, wherever it lies.
    """
    found = []
    for name, leg, femur, tibia in zip(names, legs, stance.femur, stance.tibia, strict=True):
        counted = ((0.0, 1.0), (femur, -1.0), (tibia, -1.0 if tibia < 0.0 else 1.0))
        for joint, turn, (angle, sign) in zip(JOINTS, leg.turns, counted, strict=True):
            offset, signed = turn.in_file(angle), round(sign * turn.sign)
            found.append(JointMap(name, joint, turn.joint.name, signed, offset))
    return tuple(found)

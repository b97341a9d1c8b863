"""The joints of a model file as maps from the angles that controller and record count."""

from __future__ import annotations

from collections.abc import Sequence

from apnc.importing.legs import LegGeometry
from apnc.importing.stance import Stance
from apnc_plant.robot import JointMap


def joint_maps(
    names: Sequence[str], legs: Sequence[LegGeometry], stance: Stance
) -> tuple[JointMap, ...]:
    """The joints of all legs.

    Args:
        names: of the legs.
        legs: the legs.
        stance: its angles are those of the reference pose.
    """
    found = []
    for name, leg, pose in zip(names, legs, stance.poses, strict=True):
        for joint, (angle, sign) in leg.counted(pose.tibia).items():
            turn = leg.turns[angle]
            offset, signed = turn.in_file(getattr(pose, angle)), round(sign * turn.sign)
            found.append(JointMap(name, joint, turn.joint.name, signed, offset))
    return tuple(found)

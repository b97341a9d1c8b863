"""How the joints of a model file follow from the angles that controller and record count."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from apnc.importing.legs import LegGeometry
from apnc.importing.stance import Stance
from apnc_plant.signals import JOINTS


@dataclass(frozen=True)
class JointMap:
    """A joint here and in the file: angle in the file = offset + sign angle here.

    Args:
        leg: name of the leg here.
        joint: ``abduction``, ``hip`` or ``knee``.
        name: of the joint in the file.
        sign: +1 or -1.
        offset: angle in the file in the reference pose [rad].
    """

    leg: str
    joint: str
    name: str
    sign: float
    offset: float

    def words(self) -> str:
        """The equation, with q for the angle here."""
        offset = f"{self.offset:.4g}" if abs(self.offset) > 5e-5 else ""
        sign = "-" if self.sign < 0.0 else "+" if offset else ""
        return f"{self.name} = " + (f"{offset} {sign} q" if offset else f"{sign}q")


def joint_maps(
    names: Sequence[str], legs: Sequence[LegGeometry], stance: Stance
) -> tuple[JointMap, ...]:
    """The joints of all legs.

    Args:
        names: of the legs.
        legs: the legs.
        stance: its angles are those of the reference pose.

    A positive hip angle swings the femur forward, that is less back of vertical.
    """
    found = []
    for name, leg, femur, tibia in zip(names, legs, stance.femur, stance.tibia, strict=True):
        counted = ((0.0, 1.0), (femur, -1.0), (tibia, 1.0))
        for joint, turn, (angle, sign) in zip(JOINTS, leg.turns, counted, strict=True):
            offset, signed = turn.in_file(angle), sign * turn.sign
            found.append(JointMap(name, joint, turn.joint.name, signed, offset))
    return tuple(found)

"""How the joints of a robot's own model file follow from the angles that are counted here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeVar

from apnc_core.types import Array

Angle = TypeVar("Angle", float, Array)


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
    sign: int
    offset: float

    def in_file(self, angle: Angle) -> Angle:
        """The angle in the file, of one that controller and record count [rad]."""
        return self.offset + self.sign * angle

    def here(self, angle: Angle) -> Angle:
        """The angle that controller and record count, of one in the file [rad]."""
        return self.sign * (angle - self.offset)

    def words(self) -> str:
        """The equation, with q for the angle here [rad]."""
        offset = f"{self.offset:.4g}" if abs(self.offset) > 5e-5 else ""
        sign = "-" if self.sign < 0 else "+" if offset else ""
        return f"{self.name} = " + (f"{offset} {sign} q" if offset else f"{sign}q")

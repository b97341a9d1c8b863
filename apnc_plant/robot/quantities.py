"""Kinds of values in a robot file, with the range and unit that a message names."""

from __future__ import annotations

import math
from typing import Annotated, Any, Final

from pydantic import ValidationInfo, ValidatorFunctionWrapHandler, WrapValidator

from apnc_plant.files import Number, limits


class RobotDescriptionError(ValueError):
    """A robot file is missing, or a value in it or in a robot is not allowed."""


def _angle(value: Any, check: ValidatorFunctionWrapHandler, info: ValidationInfo) -> float:
    """An angle in rad; it is checked in degrees, which is what a file holds."""
    in_file = bool(info.context)
    if in_file or isinstance(value, bool) or not isinstance(value, int | float):
        return math.radians(check(value))
    check(math.degrees(value))
    return float(value)


LONGEST: Final = 10.0
"""Largest length in a robot [m]: above that of any legged robot, below most lengths in mm."""

Length = Annotated[Number, limits("m", ge=-LONGEST, le=LONGEST)]
Edge = Annotated[Number, limits("m", gt=0.0, le=LONGEST)]
Angle = Annotated[Number, limits("deg", ge=-180.0, le=180.0), WrapValidator(_angle)]
Turns = Annotated[Number, limits("deg", ge=-360.0, le=360.0), WrapValidator(_angle)]
Range = tuple[Turns, Turns]
_ODD = r"\p{Cc}\p{Zl}\p{Zp}\p{Noncharacter_Code_Point}"  # not in a line of every file format
_NAME = rf"^[^{_ODD}]*[^\s{_ODD}][^{_ODD}]*$"
Name = Annotated[str, limits(allowed="a name without control characters", pattern=_NAME)]

Vector3 = tuple[Length, Length, Length]
Edges = tuple[Edge, Edge, Edge]

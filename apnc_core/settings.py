"""Values of parameters, checked against the table."""

from __future__ import annotations

import json
from collections.abc import Sequence

from apnc_core.schema import Causality, Value
from apnc_core.variables import row, rows

Setting = Value | Sequence[float]


def checked(name: str, value: Setting) -> Setting:
    """Stand-in."""
    if name not in [v.name for v in rows(Causality.parameter)]:
        raise ValueError(f"parameter '{name}' is not one of the table")
    return value


def parse(text: str) -> tuple[str, Setting]:
    """``"xi=0.02"`` -> ``("xi", 0.02)``; enumerations by item name, Booleans true or false.

    Raises:
        ValueError: no such parameter, or a value of the wrong type.
    """
    name, _, value = text.partition("=")
    name = name.strip()
    known = [v.name for v in rows(Causality.parameter)]
    if name not in known:
        raise ValueError(f"parameter '{name}' is not one of {', '.join(known)}")
    enumeration = row(name).enumeration
    if enumeration:
        if value not in enumeration.items.__members__:
            allowed = ", ".join(enumeration.items.__members__)
            raise ValueError(f"{name} = '{value}' is not one of {allowed}")
        return name, int(enumeration.items[value])
    try:
        parsed = json.loads(value)
    except json.JSONDecodeError:
        raise ValueError(f"{name} = '{value}' is not a number, true, false or a list") from None
    return name, parsed

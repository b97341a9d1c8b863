"""Values of parameters, checked against the table of variables."""

from __future__ import annotations

import json
import math
from collections.abc import Sequence
from typing import Final

from apnc_core.in_python import in_python
from apnc_core.schema import Causality, Shape, Type, Value, Variable
from apnc_core.variables import variables_of

Setting = Value | tuple[float, ...]
"""Checked value of a parameter; a tuple if the parameter has several entries."""

SettingLike = Value | str | Sequence[float]
"""Value of a parameter as it is given: the item of an enumeration may be given by its name."""

_PARAMETERS: Final = {v.name: v for v in variables_of(Causality.parameter)}


def parameter(name: str) -> Variable:
    """The parameter of that name.

    Raises:
        ValueError: no such parameter.
    """
    if name not in _PARAMETERS:
        raise ValueError(f"parameter '{name}' is not one of {', '.join(_PARAMETERS)}")
    return _PARAMETERS[name]


def checked(name: str, value: object) -> Setting:
    """The value of a parameter in the type of that parameter.

    Args:
        name: of the parameter, as in the table.
        value: a number; true or false for a Boolean; name or number of an item for an enumeration;
            a sequence of numbers for a parameter with one entry per phase relation.

    Raises:
        ValueError: unknown name, wrong type or out of range; a Real takes a whole number, an
            Integer no other, and a Boolean no number.
    """
    return checked_in(parameter(name), value)


def checked_in(variable: Variable, value: object) -> Setting:
    """As ``checked``, for a variable of any table."""
    value = in_python(value)
    if variable.shape is not Shape.scalar:
        if isinstance(value, str) or not isinstance(value, Sequence):
            raise _error(variable.name, value, "a list of numbers")
        return tuple(_number(variable, item, value) for item in value)
    if variable.enumeration is not None:
        return _item(variable, value)
    if variable.type is Type.boolean:
        if not isinstance(value, bool):
            raise _error(variable.name, value, "true or false")
        return value
    return _number(variable, value, value)


def parse(text: str) -> tuple[str, Setting]:
    """``"xi=0.02"`` -> ``("xi", 0.02)``.

    Args:
        text: name, equals sign and value; the value as in JSON, an enumeration by item name.

    Raises:
        ValueError: no such parameter, or a value it cannot have.
    """
    name, _, value = text.partition("=")
    name, value = name.strip(), value.strip()
    try:
        return name, checked(name, json.loads(value))
    except json.JSONDecodeError:
        return name, checked(name, value)


def _item(variable: Variable, value: object) -> int:
    assert variable.enumeration is not None
    items = variable.enumeration.items
    if isinstance(value, str) and value in items.__members__:
        return items[value]
    if isinstance(value, int) and not isinstance(value, bool) and value in list(items):
        return items(value)
    raise ValueError(f"{variable.name} = {value!r} is not one of {', '.join(items.__members__)}")


def _number(variable: Variable, value: object, shown: object) -> float:
    whole = variable.type is Type.integer
    assert variable.min is not None and variable.max is not None
    if (
        isinstance(value, int if whole else int | float)
        and not isinstance(value, bool)
        and math.isfinite(value)
        and variable.min <= value <= variable.max
    ):
        return value if whole else float(value)
    unit = f" [{variable.unit}]" if variable.unit not in (None, "1") else ""
    kind = "a whole number" if whole else "a number"
    raise _error(variable.name, shown, f"{kind} from {variable.min:g} to {variable.max:g}{unit}")


def _error(name: str, value: object, allowed: str) -> ValueError:
    return ValueError(f"{name} = {value!r}; allowed: {allowed}")

"""Dataclasses as plain data for JSON."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any, Final

_ALREADY: Final = frozenset((float, str, int, bool, type(None)))


def to_dict(value: Any) -> Any:
    """Data that JSON knows: enumerations by name, objects as tables."""
    if type(value) in _ALREADY:  # most are
        return value
    if is_dataclass(value):
        return {f.name: to_dict(getattr(value, f.name)) for f in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): to_dict(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [to_dict(entry) for entry in value]
    return value.name if isinstance(value, Enum) else value

"""Dataclasses as plain data for JSON, and back."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields, is_dataclass
from enum import Enum
from typing import Any, Final, get_args, get_type_hints

_ALREADY: Final = frozenset((float, str, int, bool, type(None)))


def plain(value: Any) -> Any:
    """Data that JSON knows: enumerations by name, objects as tables."""
    if type(value) in _ALREADY:  # most are
        return value
    if is_dataclass(value):
        return {f.name: plain(getattr(value, f.name)) for f in fields(value)}
    if isinstance(value, Mapping):
        return {str(key): plain(entry) for key, entry in value.items()}
    if isinstance(value, list | tuple):
        return [plain(entry) for entry in value]
    return value.name if isinstance(value, Enum) else value


def made(kind: Any, value: Any) -> Any:
    """The object of a type that :func:`plain` turned into ``value``.

    Raises:
        TypeError: a table that lacks a field, or has one too many.
        ValueError: as the object itself.
    """
    if is_dataclass(kind) and isinstance(value, Mapping):
        hints = get_type_hints(kind)
        values = {name: made(hints.get(name), entry) for name, entry in value.items()}
        return kind(**values)  # type: ignore[operator]  # a class
    if isinstance(value, list):
        kinds = get_args(kind)
        return tuple(made(kinds[0] if kinds else None, entry) for entry in value)
    return value

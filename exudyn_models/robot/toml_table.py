"""A TOML table that hands out checked values and says in one line what is wrong with one."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any

from exudyn_models.robot.model import Vector3


class RobotDescriptionError(ValueError):
    """A robot file is missing, or a value in it is not allowed."""


class Table:
    """One table of a robot file; it knows which of its keys were never asked for."""

    def __init__(self, file: str, path: str, data: Mapping[str, Any]) -> None:
        """Wrap ``data``, found under ``path`` in ``file``; both only name things in errors."""
        self._file, self._path, self._data = file, path, data
        self._used: set[str] = set()

    def error(self, key: str, value: object, allowed: str) -> RobotDescriptionError:
        """The error of a value that is not allowed."""
        return RobotDescriptionError(
            f"robot file {self._file}: {self._path}{key} is {value!r}; allowed: {allowed}"
        )

    def close(self) -> None:
        """Refuse keys nobody reads: a misspelt optional-looking value must not pass silently."""
        for key in self._data.keys() - self._used:
            raise self.error(key, self._data[key], f"only {', '.join(sorted(self._used))}")

    def _get(self, key: str, kind: type | tuple[type, ...], allowed: str) -> Any:
        self._used.add(key)
        value = self._data.get(key)
        if not isinstance(value, kind) or isinstance(value, bool):
            raise self.error(key, "missing" if value is None else value, allowed)
        return value

    def text(self, key: str) -> str:
        """A text that is not empty."""
        value: str = self._get(key, str, "a name")
        if not value:
            raise self.error(key, value, "a name")
        return value

    def choice(self, key: str, allowed: tuple[str, ...]) -> str:
        """One of some words."""
        value = self.text(key)
        if value not in allowed:
            raise self.error(key, value, " or ".join(allowed))
        return value

    def number(self, key: str, low: float = -math.inf, high: float = math.inf) -> float:
        """A finite number from ``low`` to ``high``."""
        allowed = f"a finite number from {low:g} to {high:g}"
        value = float(self._get(key, (int, float), allowed))
        if not (math.isfinite(value) and low <= value <= high):
            raise self.error(key, value, allowed)
        return value

    def nonnegative(self, key: str) -> float:
        """A number that is not negative."""
        return self.number(key, low=0.0)

    def positive(self, key: str) -> float:
        """A number above 0."""
        value = self.nonnegative(key)
        if value == 0.0:
            raise self.error(key, value, "a number above 0")
        return value

    def vector(self, key: str) -> Vector3:
        """Three finite numbers."""
        allowed = "three finite numbers"
        value = self._get(key, list, allowed)
        if len(value) != 3 or not all(_is_finite_number(item) for item in value):
            raise self.error(key, value, allowed)
        return (float(value[0]), float(value[1]), float(value[2]))

    def size(self, key: str) -> Vector3:
        """Three numbers above 0."""
        value = self.vector(key)
        if min(value) <= 0.0:
            raise self.error(key, value, "three numbers above 0")
        return value

    def table(self, key: str) -> Table:
        """A table inside this one."""
        value = self._get(key, dict, "a table")
        return Table(self._file, f"{self._path}{key}.", value)

    def tables(self, key: str) -> list[Table]:
        """A list of tables, at least one."""
        value = self._get(key, list, "a list of tables")
        if not value or not all(isinstance(item, dict) for item in value):
            raise self.error(key, value, "a list of tables, at least one")
        return [
            Table(self._file, f"{self._path}{key}[{i}].", item)
            for i, item in enumerate(value, start=1)
        ]


def _is_finite_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)

"""Fields of a robot that say their unit and what is allowed, and check it."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Any, Final, get_type_hints
from unicodedata import category

from apnc_core.in_python import in_python


class RobotDescriptionError(ValueError):
    """A robot file is missing, or a value in it or in a robot is not allowed."""


class NotAllowedError(RobotDescriptionError):
    """A field holds a value that is not allowed; None stands for one that is missing."""

    def __init__(self, name: str, value: object, allowed: str) -> None:
        shown = "missing" if value is None else repr(value)
        super().__init__(f"{name} is {shown}; allowed: {allowed}")
        self.name, self.value, self.allowed = name, value, allowed

    def under(self, path: str) -> NotAllowedError:
        """The same error of a field that lies under ``path``."""
        return NotAllowedError(path + self.name, self.value, self.allowed)


@dataclass(frozen=True)
class Rule:
    """What a field may hold, in the unit of a robot file.

    Args:
        unit: of the numbers; what a file has in ``deg`` is in rad in the object.
        low, high: range of the numbers, ends included.
        positive: 0 is excluded, and what is below.
        count: how many numbers.
        words: for a field that is a text: the texts allowed; empty: any that is not blank and has
            no control characters.
    """

    unit: str = ""
    low: float = -math.inf
    high: float = math.inf
    positive: bool = False
    count: int = 1
    words: tuple[str, ...] | None = None

    @property
    def allowed(self) -> str:
        """What is allowed, in words."""
        if self.words is not None:
            return " or ".join(self.words) or "a name without control characters"
        many = "a finite number" if self.count == 1 else "three finite numbers"
        bounds = f" from {self.low:g} to {self.high:g}" if self.low > -math.inf else ""
        unit = f" [{self.unit}]" if self.unit else ""
        return many + (" above 0" if self.positive else bounds) + unit

    def fits(self, value: object) -> bool:
        """Whether a value is allowed."""
        if self.words is not None:
            return isinstance(value, str) and (value in self.words or self._fits_name(value))
        if self.count == 1:
            return self._fits_number(value)
        return (
            isinstance(value, list | tuple)
            and len(value) == self.count
            and all(self._fits_number(item) for item in value)
        )

    def _fits_name(self, value: str) -> bool:
        """Whether any text is allowed, and this one can stand in a line of any file."""
        lines = {"Cc", "Cs", "Zl", "Zp"}  # controls, surrogates, ends of lines and paragraphs
        odd = any(category(c) in lines or ord(c) & 0xFFFE == 0xFFFE for c in value)
        return self.words == () and value.strip() != "" and not odd

    def _fits_number(self, value: object) -> bool:
        if isinstance(value, bool) or not isinstance(value, int | float):
            return False
        if not math.isfinite(value) or (self.positive and value <= 0.0):
            return False
        return self.low <= value <= self.high


FLAT: Final = "flat"
"""Annotates a field that holds a part whose keys lie, in a file, beside those of the whole."""


def _rules(part: Any) -> dict[str, Rule]:
    return {
        name: note
        for name, hint in get_type_hints(part, include_extras=True).items()
        for note in getattr(hint, "__metadata__", ())
        if isinstance(note, Rule)
    }


rules: Final[Callable[[Any], dict[str, Rule]]] = cache(_rules)
"""Rules of the fields of a part that have one, by name."""


class Checked:
    """A dataclass whose fields are checked against their rules when it is made.

    A field has a rule if it is annotated with one: ``mass: Annotated[float, Rule("kg")]``.
    """

    def __post_init__(self) -> None:
        """Check the fields.

        Raises:
            NotAllowedError: a value that is not allowed.
        """
        for name, rule in rules(type(self)).items():
            value = in_python(getattr(self, name))
            if isinstance(value, list):
                value = tuple(value)
            object.__setattr__(self, name, value)
            if rule.unit == "deg" and isinstance(value, float):
                value = math.degrees(value)
            if not rule.fits(value):
                raise NotAllowedError(name, value, rule.allowed)

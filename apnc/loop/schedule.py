"""Schedules: one value for all the time, or steps ``((start [s], value), ...)``."""

from __future__ import annotations

import itertools
import math
from bisect import bisect_right
from collections.abc import Callable
from typing import Any, TypeAlias, TypeVar

T = TypeVar("T")
Steps: TypeAlias = tuple[tuple[float, T], ...]
Schedule: TypeAlias = T | Steps[T]
"""A value that holds all the time, or steps: each value holds from its start to the next."""


def steps_of(value: Schedule[Any]) -> Steps[Any]:
    """The steps of a schedule. A single value is one step from 0 on."""
    if isinstance(value, tuple | list):
        return tuple((float(start), entry) for start, entry in value)
    return ((0.0, value),)


def checked_schedule(value: Any, check: Callable[[Any], T]) -> Schedule[T]:
    """The schedule with every value replaced by what ``check`` returns for it.

    Raises:
        ValueError: steps that are no pairs, no step, a first one that is not at 0, or times that do
            not grow; or as ``check``.
    """
    if not isinstance(value, tuple | list):
        return check(value)
    try:
        steps = steps_of(value)
    except (TypeError, ValueError):
        raise ValueError(f"{value} is not ((start, value), ...)") from None
    times = [start for start, _ in steps]
    grows = all(a < b for a, b in itertools.pairwise(times))
    if not times or times[0] != 0.0 or not grows or not math.isfinite(times[-1]):
        raise ValueError(f"steps start at {times} s; allowed: 0, then growing times")
    return tuple((start, check(entry)) for start, entry in steps)


class ScheduleLookup:
    """Looks up the value of a schedule tick by tick."""

    def __init__(self, value: Schedule[Any]) -> None:
        steps = steps_of(value)
        self._starts = [start for start, _ in steps]
        self._values = [entry for _, entry in steps]

    def at(self, t: float) -> Any:
        """Value at time ``t`` [s], at least 0."""
        return self._values[bisect_right(self._starts, t) - 1]


def first_tick(start: float, Ts: float) -> int:
    """The first tick n with n Ts >= start, computed as the loop in Python does.

    Args:
        start: a time [s].
        Ts: time of a tick [s].
    """
    n = max(0, int(start / Ts) - 1)
    while n * Ts < start:
        n += 1
    return n


def parse_schedule(name: str, text: str, convert: Callable[[str], T]) -> Schedule[T]:
    """``"0.1"`` -> 0.1; ``"0:0.15,25:0.4"`` -> ((0, 0.15), (25, 0.4)).

    Raises:
        ValueError: a time or value that ``convert`` does not take; it names ``name``.
    """
    pairs = [part.partition(":") for part in text.split(",")]
    try:
        if ":" not in text:
            return convert(text)
        return tuple((float(start), convert(entry.strip())) for start, _, entry in pairs)
    except (KeyError, ValueError):
        raise ValueError(
            f"{name} = '{text}' is not a value, or 0:value,seconds:value,..."
        ) from None


def _text(value: Any) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    return str(value).removesuffix(".0") if isinstance(value, float) else str(value)


def schedule_text(value: Schedule[Any], text: Callable[[Any], str] = _text) -> str:
    """The text that :func:`parse_schedule` reads, without rounding. ``text`` writes one value."""
    if not isinstance(value, tuple | list):
        return text(value)
    return ",".join(f"{_text(start)}:{text(entry)}" for start, entry in steps_of(value))

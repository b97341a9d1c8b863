"""Quantities over time."""

from __future__ import annotations

import re
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from apnc.loop.schedule import (
    ScheduleLookup,
    checked_schedule,
    parse_schedule,
    schedule_text,
    steps_of,
)


def test_a_step_holds_from_its_start_until_the_next() -> None:
    values = ScheduleLookup(((0, "a"), (1.5, "b"), (4, "c")))
    assert [values.at(t) for t in (0.0, 1.4999, 1.5, 3.9, 4.0, 1e9)] == list("aabbcc")
    assert ScheduleLookup(0.7).at(123.0) == 0.7


@pytest.mark.parametrize(
    ("text", "value"),
    [("0.1", 0.1), ("0:0.15,25:0.4", ((0.0, 0.15), (25.0, 0.4))), ("0: 0.1", ((0.0, 0.1),))],
)
def test_text_is_read(text: str, value: Any) -> None:
    assert parse_schedule("mi", text, float) == value


@pytest.mark.parametrize("text", ["", "fast", "0:", "0:0.1,", "0:0.1,0.4", "x:0.1", "0.1,0.2"])
def test_other_text_is_refused(text: str) -> None:
    with pytest.raises(ValueError, match=re.escape(f"mi = '{text}' is not a value, or 0:value")):
        parse_schedule("mi", text, float)


TIMES = st.lists(st.floats(0, 1e9), unique=True, min_size=1, max_size=4).map(sorted)
VALUES = st.floats(allow_nan=False, allow_infinity=False)


@given(TIMES, VALUES)
def test_written_and_read_again_nothing_is_rounded(times: list[float], value: float) -> None:
    steps = tuple((t, value) for t in times)
    assert parse_schedule("mi", schedule_text(steps), float) == steps
    assert parse_schedule("mi", schedule_text(value), float) == value


def test_flags_are_written_in_small_letters() -> None:
    assert schedule_text(((0, True), (2, False))) == "0:true,2:false"


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ((), "steps start at []"),
        (((1.0, 0.1),), "steps start at [1.0]"),
        (((0.0, 0.1), (0.0, 0.2)), "start at [0.0, 0.0]"),
        (((0.0, 0.1), (5.0, 0.2), (4.0, 0.1)), "start at [0.0, 5.0, 4.0]"),
        (((0.0, 0.1), (float("inf"), 0.2)), "start at [0.0, inf]"),
        (((0.0, 0.1), (float("nan"), 0.2)), "start at [0.0, nan]"),
        ((0.1, 0.2), "(0.1, 0.2) is not ((start, value), ...)"),
        (((0.0, "no"),), "no is refused"),
    ],
)
def test_times_begin_at_0_and_grow_and_each_value_is_checked(value: Any, words: str) -> None:
    def check(entry: Any) -> Any:
        if entry == "no":
            raise ValueError("no is refused")
        return entry

    with pytest.raises(ValueError, match=re.escape(words)):
        checked_schedule(value, check)


def test_each_value_gets_its_type() -> None:
    assert checked_schedule([[0, "0.5"], [1, "2"]], float) == ((0.0, 0.5), (1.0, 2.0))
    assert checked_schedule("0.5", float) == 0.5


def test_a_single_value_is_one_step() -> None:
    assert steps_of(3) == ((0.0, 3),)

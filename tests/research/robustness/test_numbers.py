"""One number at a time: what each change does, and where the limits are."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

import pytest
from made_up_results import made_up

from apnc.studies.results import STRICT
from apnc_plant.robot import ROBOTS, load_robot
from apnc_plant.step import own_step
from research.robustness import numbers
from research.robustness.known import KNOWN

LILIBOT = load_robot("lilibot")


def leaves(value: Any, name: str = "") -> dict[str, Any]:
    """Every number of nested data, by its place; all legs are one place."""
    if isinstance(value, dict):
        pairs = list(value.items())
    elif isinstance(value, (list, tuple)):
        legs = bool(value) and isinstance(value[0], dict)
        pairs = [("each" if legs else str(at), part) for at, part in enumerate(value)]
    else:
        return {name: value}
    return {k: v for key, part in pairs for k, v in leaves(part, f"{name}/{key}").items()}


@pytest.mark.parametrize("name", KNOWN)
def test_a_change_is_of_one_number_and_of_the_size_that_is_said(name: str) -> None:
    known = KNOWN[name]
    assert known.change(LILIBOT, known.nothing) == LILIBOT
    assert "," not in name  # names are listed with commas on the command line
    by = 7.0 if known.unit else 1.5
    before, after = leaves(asdict(LILIBOT)), leaves(asdict(known.change(LILIBOT, by)))
    changed = {key for key in before if before[key] != after[key]}
    vectors = {key.rsplit("/", 1)[0] if key[-1].isdigit() else key for key in changed}
    assert len(vectors) == (3 if name == "edges of the links" else 1)
    scale = {"mm": 1e-3, "ms": 1e-3, "deg": 0.017453292519943295, "": 0.0}[known.unit]
    for key in changed:
        new = before[key] + scale * by if known.unit else by * before[key]
        assert after[key] == pytest.approx(new), key


@pytest.mark.parametrize("robot", sorted(path.stem for path in ROBOTS.glob("*.toml")))
def test_every_shipped_robot_can_be_off_as_far_as_it_is_tried(robot: str) -> None:
    for name in KNOWN:
        for level in (-numbers.LEVELS, numbers.LEVELS):
            assert 1e-5 < own_step(numbers.body(robot, name, level)) <= 1.0 / 960.0, name


def test_the_real_number_lies_around_that_of_the_robot() -> None:
    for name, known in KNOWN.items():
        assert known.low <= known.nothing <= known.high and known.low < known.high, name


@pytest.fixture
def rows() -> list[dict[str, Any]]:
    """APNC is good at levels -2 to 3 and 5; APC at MI 0.08 only, there at levels 0 and 1."""

    def figures(cell: dict[str, Any]) -> dict[str, Any]:
        level, lost = cell["level"], cell["seed"] == 0
        good = -2 <= level <= 3 or level == 5
        if cell["controller"] == "apc":
            good = level in (0, 1) and cell["walk"] == "MI 0.08"
        return {STRICT: 1.0 if good and not (lost and level == 3) else None}

    axes = {"number": ("friction",), "level": range(-10, 11), "walk": numbers.WALKED}
    controllers = ("apnc", "apc")
    return numbers.counts(made_up(axes, figures, controllers, 5, study="robustness.numbers"))


def test_limits_end_at_the_first_level_that_loses_the_gait(rows: list[dict[str, Any]]) -> None:
    assert numbers.limits(rows, "friction", "apnc") == (-2, 2)  # 4 of 5 are not enough
    assert numbers.walks_judged(rows, "apc") == ["MI 0.08"]
    assert numbers.limits(rows, "friction", "apc") == (0, 1)
    line = numbers.counts_table(rows).splitlines()[2]
    assert line == (
        "| friction | factor | 0.75 ... 1.25 | rubber on a dry floor, 0.6 to 1.0 "
        "| 0.66 ... 1.52 | 1 ... 1.23 |"
    )


def test_the_robot_as_it_is_walks_once_for_all_numbers(rows: list[dict[str, Any]]) -> None:
    others = [row | {"number": "noise of the sensors"} for row in rows if row["level"] != 0]
    own = [row for row in rows if row["level"] == 0]
    assert numbers.limits([*others, *own], "noise of the sensors", "apnc") == (-2, 2)


def test_a_number_that_was_not_walked_at_all_levels_is_left_out() -> None:
    axes = {"number": ("friction",), "level": range(-9, 11), "walk": ("MI 0.08",)}
    results = made_up(axes, lambda cell: {STRICT: 1.0}, ("apnc",), 1, study="robustness.numbers")
    rows = numbers.counts(results)
    assert [row["level"] for row in rows] == [0]
    assert len(numbers.counts_table(rows).splitlines()) == 2


def test_a_bar_reaches_from_limit_to_limit(rows: list[dict[str, Any]]) -> None:
    apc, bar, *_ = numbers.bars(rows, shifts=False)
    assert (apc["name"], bar["name"]) == ("APC alone", "APNC")  # the first is drawn lowest
    assert bar["y"] == ["friction"]
    assert bar["base"][0] == pytest.approx(8.0**-0.2)
    assert bar["base"][0] + bar["x"][0] == pytest.approx(8.0**0.2)
    assert numbers.bars(rows, shifts=True)[0]["y"] == []

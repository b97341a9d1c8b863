"""Data that people write: what is refused is named in one line."""

from __future__ import annotations

import pickle
import re
from dataclasses import field, replace
from pathlib import Path
from typing import Annotated, Any, Literal

import numpy as np
import pytest
from pydantic import AfterValidator, BaseModel, ConfigDict

from apnc_plant.files import Number, checked, checked_file, limits

Length = Annotated[Number, limits("m", gt=0)]


class PartError(ValueError):
    pass


def _even(value: int) -> int:
    if value % 2:
        raise ValueError(f"{value} is odd")
    return value


@checked(PartError)
class Part:
    mass: Annotated[Number, limits("kg", ge=0, le=9)]
    size: tuple[Length, Length]
    kind: Literal["box", "ball"] = "box"
    teeth: Annotated[int, limits(ge=0), AfterValidator(_even)] = 0
    name: Annotated[str, limits(allowed="a name in lower case", pattern="^[a-z]+$")] = "part"


class Whole(BaseModel):
    model_config = ConfigDict(extra="forbid")

    parts: Annotated[tuple[Part, ...], limits(min_length=1)]
    prices: dict[str, Annotated[Number, limits("EUR")]] = field(default_factory=dict)


PART = '{"mass": 1, "size": [1, 2]}'


@pytest.mark.parametrize(
    ("text", "line"),
    [
        ('{"parts": []}', "parts is []; allowed: a list of tables, at least 1"),
        ("{}", "parts is missing; allowed: a list of tables, at least 1"),
        ('{"parts": [3]}', "parts[1] is 3; allowed: a table"),
        (
            f'{{"parts": [{PART}, {{"mass": 10, "size": [1, 2]}}]}}',
            "parts[2].mass is 10; allowed: a finite number from 0 to 9 [kg]",
        ),
        (
            '{"parts": [{"mass": "1", "size": [1, 2]}]}',
            "parts[1].mass is '1'; allowed: a finite number from 0 to 9 [kg]",
        ),
        (
            '{"parts": [{"mass": true, "size": [1, 2]}]}',
            "parts[1].mass is True; allowed: a finite number from 0 to 9 [kg]",
        ),
        (
            '{"parts": [{"mass": NaN, "size": [1, 2]}]}',
            "parts[1].mass is nan; allowed: a finite number from 0 to 9 [kg]",
        ),
        (
            '{"parts": [{"mass": 1, "size": [1]}]}',
            "parts[1].size is [1]; allowed: 2 finite numbers above 0 [m]",
        ),
        (
            '{"parts": [{"mass": 1, "size": [1, 0]}]}',
            "parts[1].size[2] is 0; allowed: a finite number above 0 [m]",
        ),
        (
            '{"parts": [{"mas": 1, "size": [1, 2]}]}',
            "parts[1].mas is 1; allowed: only kind, mass, name, size, teeth; did you mean mass?",
        ),
        (f'{{"part": [{PART}]}}', "did you mean parts?"),
        (
            f'{{"parts": [{PART}], "prices": {{"nut": "dear"}}}}',
            "prices.nut is 'dear'; allowed: a finite number [EUR]",
        ),
        (f'{{"parts": [{PART[:-1]}, "kind": "rod"}}]}}', "kind is 'rod'; allowed: box or ball"),
        (f'{{"parts": [{PART[:-1]}, "teeth": 3}}]}}', "parts[1].teeth: 3 is odd"),
        (f'{{"parts": [{PART[:-1]}, "name": "A"}}]}}', "is 'A'; allowed: a name in lower case"),
        ("[1]", "not a table of NAME: VALUE"),
        ("{", "not readable as JSON (Expecting property name"),
        ("[" * 100_000, "not readable as JSON"),
    ],
)
def test_checked_file_says_what_is_wrong_in_one_line(tmp_path: Path, text: str, line: str) -> None:
    path = tmp_path / "whole.json"
    path.write_text(text, encoding="utf-8")
    with pytest.raises(ValueError, match=re.escape(line)) as caught:
        checked_file(Whole, path)
    assert str(caught.value).startswith(f"{path}: ") and "\n" not in str(caught.value)


def test_checked_file_reads_toml_and_json_alike(tmp_path: Path) -> None:
    (tmp_path / "whole.json").write_text(f'{{"parts": [{PART}]}}', encoding="utf-8")
    (tmp_path / "whole.toml").write_text("[[parts]]\nmass = 1\nsize = [1, 2]", encoding="utf-8")
    read = [checked_file(Whole, tmp_path / name) for name in ("whole.json", "whole.toml")]
    assert read[0] == read[1] == Whole(parts=(Part(1.0, (1.0, 2.0)),))


def test_checked_file_names_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match=r"no\.toml: cannot be read: No such file"):
        checked_file(Whole, tmp_path / "no.toml")


def test_checked_takes_numpy_and_stays_immutable() -> None:
    values: Any = (np.float32(0.5), np.array([1, 2]))
    part = Part(*values)
    assert part == Part(0.5, (1.0, 2.0)) and type(part.mass) is float
    assert hash(part) == hash(pickle.loads(pickle.dumps(part)))
    with pytest.raises(AttributeError, match="mass"):
        part.mass = 2.0  # type: ignore[misc]


def test_checked_raises_its_own_error_with_one_line() -> None:
    with pytest.raises(PartError, match=r"^mass is -1.0; allowed: a finite number from 0 to 9 \["):
        replace(Part(0.5, (1.0, 2.0)), mass=-1.0)


def test_a_long_value_is_cut() -> None:
    values: Any = {"mass": "1" * 1000}
    with pytest.raises(PartError) as caught:
        Part(size=(1.0, 2.0), **values)
    assert len(str(caught.value)) < 300


def test_values_given_by_position_are_named_by_their_field() -> None:
    assert Part(1.0, (1.0, 2.0)) == Part(mass=1.0, size=(1.0, 2.0))
    with pytest.raises(PartError, match=r"^size\[2\] is 0\.0; allowed"):
        Part(1.0, (1.0, 0.0))
    for args, values in (((1.0,), {"mass": 1.0}), ((1.0, (1.0, 2.0), "box", 0, "a", 5), {})):
        with pytest.raises(
            TypeError, match="Part takes each of mass, size, kind, teeth, name once"
        ):
            Part(*args, **values)  # type: ignore[arg-type]

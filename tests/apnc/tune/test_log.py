"""The log of a search: one search, whole rows, and nothing written before there is a cost."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest

from apnc.tune.log import Log, read_rows

NAMES = ("a1", "a2")
POINTS = [np.array([0.1, 0.2]), np.array([1 / 3, 0.7])]
SEARCH: dict[str, Any] = {"robot": "f00", "seed": 1}


def begun(path: Path, *, resume: bool = False, **other: Any) -> Log:
    log = Log(path)
    log.begin(NAMES, SEARCH | other, resume=resume)
    return log


def full(path: Path) -> Path:
    log = begun(path)
    log.write_check(0, 5.5)
    log.write(0, POINTS, [2.0, 1 / 7])
    log.write_check(1, 1.25)
    return path


def test_a_log_is_read_back_to_the_last_bit(tmp_path: Path) -> None:
    log = begun(full(tmp_path / "l.csv"), resume=True)
    assert log.costs(0, POINTS) == [2.0, 1 / 7]
    assert log.costs(1, POINTS) is None
    assert (log.check(0), log.check(1), log.check(2)) == (5.5, 1.25, None)
    assert read_rows(tmp_path / "l.csv")[2] == (0, "1", 1 / 7, [1 / 3, 0.7])


def test_a_search_without_a_cost_leaves_no_file(tmp_path: Path) -> None:
    begun(tmp_path / "l.csv")
    assert not (tmp_path / "l.csv").exists()


@pytest.mark.parametrize("cut", range(1, 60, 7))
def test_what_a_kill_cut_short_is_walked_and_written_again(cut: int, tmp_path: Path) -> None:
    whole = full(tmp_path / "whole.csv").read_text()
    path = tmp_path / "l.csv"
    path.write_text(whole[:-cut])
    log = begun(path, resume=True)
    if log.costs(0, POINTS) is None:
        log.write(0, POINTS, [2.0, 1 / 7])
    log.write_check(1, 1.25)
    again = begun(path, resume=True)
    assert again.costs(0, POINTS) == [2.0, 1 / 7]
    assert again.check(1) == 1.25


def test_a_log_of_another_search_is_refused_and_says_what_differs(tmp_path: Path) -> None:
    path = full(tmp_path / "l.csv")
    before = path.read_bytes()
    with pytest.raises(ValueError, match=r"l\.csv is of another search: seed was 1 and is 2$"):
        begun(path, resume=True, seed=2)
    with pytest.raises(ValueError, match=r"paper was null and is true"):
        begun(path, resume=True, paper=True)
    with pytest.raises(ValueError, match=r"earlier search; allowed: --resume"):
        begun(path)
    other = [np.array([0.1, 0.2]), np.array([0.4, 0.7])]
    with pytest.raises(ValueError, match="has other candidates in generation 0"):
        begun(path, resume=True).costs(0, other)
    assert path.read_bytes() == before


@pytest.mark.parametrize(
    ("content", "why"),
    [
        (b"", "no log of a search"),
        (b"\xff\xfe\x00", "no log of a search"),
        (b"time,x\n1,2\n", "line 1 does not say of which"),
        (b'# {"robot": "f00", "seed": 1}\ntime,x\n1,2\n', "line 2 has no columns"),
        (
            b'# {"robot": "f00", "seed": 1}\ngeneration,candidate,cost,a1,a2\n0,0,x,0.1,0.2\n',
            "line 3",
        ),
        (
            b'# {"robot": "f00", "seed": 1}\ngeneration,candidate,cost,a1,a2\n0,0,1.0,0.1\n',
            "line 3",
        ),
    ],
)
def test_another_file_is_no_log_and_stays_as_it_is(
    content: bytes, why: str, tmp_path: Path
) -> None:
    path = tmp_path / "l.csv"
    path.write_bytes(content)
    with pytest.raises(ValueError, match=why):
        begun(path, resume=True)
    assert path.read_bytes() == content

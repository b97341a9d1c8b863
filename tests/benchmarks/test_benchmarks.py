"""The benchmarks run from a checkout and say what they have measured."""

from __future__ import annotations

import json
import subprocess
import sys
from pathlib import Path

import pytest

from benchmarks import fits, rows

ROOT = Path(__file__).resolve().parents[2]
QUICK = (
    "controller", "closed_loop", "batch", "plant", "mujoco_rollout", "legs", "memory",
    "walk_command", "study", "tune",
)  # fmt: skip
"""All but ``install``, which fetches packages."""


@pytest.mark.thorough
def test_every_benchmark_measures_something(tmp_path: Path) -> None:
    written = tmp_path / "found.json"
    command = [sys.executable, "-m", "benchmarks", "--quick", "--json", str(written), "--only"]
    done = subprocess.run([*command, *QUICK], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    found = json.loads(written.read_text())
    assert found["machine"]["commit"]
    assert list(found["tables"]) == list(QUICK)
    for name, table in found["tables"].items():
        assert table["rows"], name
        for row in table["rows"]:
            values = row["values"] + row["others"]
            assert values and all(value > 0.0 for value in values), (name, row)
            assert f"| {row['what']} | {row['unit']} | {len(row['values'])} | " in done.stdout


def test_a_ratio_is_of_the_same_round() -> None:
    row = rows.Row("C", "s", (1.0, 2.0, 4.0), "other", (10.0, 40.0, 50.0), least=15.0)
    assert row.ratio == 12.5
    assert row.ratio_of_least == 10.0
    assert row.met == "no, 20 % off"


def test_an_aim_of_a_value_is_met_by_the_median() -> None:
    row = rows.Row
    assert row("C", "s", (1.0, 2.0, 9.0), most=2.0).met == "yes"
    assert row("C", "s", (1.0, 3.0, 3.0), most=2.0).met == "no, 50 % off"
    assert row("C", "s", (1.0,)).met == ""


def test_what_drifts_hits_all_alike() -> None:
    clock = iter(range(100))
    found = rows.in_turn({name: lambda: next(clock) for name in "AB"}, rounds=4)
    assert found == {"A": (2, 5, 6, 9), "B": (3, 4, 7, 8)}
    assert sum(found["A"]) == sum(found["B"])


def test_steps_at_an_error_between_two() -> None:
    between = fits.between
    # error and cost both go with a power of the step
    found = between({8: 0.16, 16: 0.04, 32: 0.01}, 0.02)
    assert (found.coarse, found.fine) == (16, 32)
    assert found.steps == pytest.approx(16 * 2**0.5)
    assert found.cost(3.0, 12.0) == pytest.approx(6.0)
    assert between({8: 0.16, 16: 0.04}, 0.2).steps == 8
    with pytest.raises(ValueError, match="beyond"):
        between({8: 0.16, 16: 0.04}, 0.02)


def test_distance_from_a_line() -> None:
    line = fits.line
    begin, slope, off = line((4, 8, 16), (7.0, 11.0, 19.0))
    assert (begin, slope, off) == (
        pytest.approx(3.0),
        pytest.approx(1.0),
        pytest.approx(0, abs=1e-9),
    )
    assert line((4, 8, 16), (7.0, 11.0, 30.0))[2] > 10.0

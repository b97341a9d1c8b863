"""A search: the same file whoever walks it, and however often it is interrupted."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from apnc.tune import Allowed, Stopped, Tuned, tune
from apnc.tune.design import MI_AIMED, Start, variables_for
from apnc.tune.log import read_rows
from apnc.tune.search import Best, Count, _Strategy
from apnc.tune.tuned_file import path_of
from apnc_plant.robot import load_robot

FEW: dict[str, Any] = {"candidates": 8, "seeds": 1}
"""Two small generations, and one seed of the validation."""


@pytest.fixture(autouse=True)
def small(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("apnc.tune.search.CANDIDATES", 4)
    monkeypatch.setattr("apnc.tune.search.CHECK_EVERY", 1)


def searched(log: Path | None = None, **other: Any) -> Tuned:
    return tune("lilibot", log=log, **{**FEW, **other})


def what(found: Tuned) -> tuple[str, str]:
    """File and validation, in which the time of a run without a gait is nan, which is no equal."""
    return found.text, repr(found.validation)


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> tuple[Tuned, bytes]:
    """What one thread finds without an interruption, and its log."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr("apnc.tune.search.CANDIDATES", 4)
        patch.setattr("apnc.tune.search.CHECK_EVERY", 1)
        patch.setattr("apnc.tune.runs.RANGE_SEEDS", 1)  # this fixture is made before conftest's
        log = tmp_path_factory.mktemp("alone") / "tuned.csv"
        return searched(log), log.read_bytes()


@pytest.mark.thorough
def test_two_processes_find_the_same_as_one(alone: tuple[Tuned, bytes], tmp_path: Path) -> None:
    log = tmp_path / "tuned.csv"
    found = searched(log, workers=2)  # processes
    assert what(found) == what(alone[0])
    assert log.read_bytes() == alone[1]
    searched(other := tmp_path / "other.csv", seed=2, candidates=4)
    points, others = ([row[3] for row in read_rows(path) if row[0] == 0] for path in (log, other))
    assert points != others


@pytest.mark.thorough
def test_workers_of_dask_find_the_same(alone: tuple[Tuned, bytes], tmp_path: Path) -> None:
    distributed = pytest.importorskip("distributed", reason="the extra cluster is not installed")
    log = tmp_path / "tuned.csv"
    with distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, dashboard_address=None, host="127.0.0.1"
    ) as cluster:
        found = searched(log, scheduler=cluster.scheduler_address)
    assert what(found) == what(alone[0])
    assert log.read_bytes() == alone[1]


def stopped_after(candidates: int) -> tuple[dict[str, Any], list[int]]:
    """Arguments that stop a search in the generation after some candidates."""
    seen = [-1]

    def progress(best: Best, count: Count, share: float) -> None:
        seen.append(count.candidates)

    return {"progress": progress, "stop": lambda: seen[-1] >= candidates}, seen


@pytest.mark.parametrize("candidates", [pytest.param(0, marks=pytest.mark.thorough), 4])
def test_an_interrupted_search_keeps_the_best_and_goes_on_to_the_same_end(
    candidates: int, alone: tuple[Tuned, bytes], tmp_path: Path
) -> None:
    log = tmp_path / "tuned.csv"
    asked, seen = stopped_after(candidates)
    kept = searched(log, **asked)
    assert seen == [-1, *range(0, candidates + 1, 4)]
    assert kept.validation is None
    assert kept.count.checked == candidates
    assert f"--candidates {candidates} --seed 1" in kept.command
    whole = searched(candidates=candidates).robot  # but for the range, which was not walked
    assert replace(kept.robot, mi=None, mi_range=None) == replace(whole, mi=None, mi_range=None)
    found = searched(log, resume=True)
    assert what(found) == what(alone[0])
    assert log.read_bytes() == alone[1]
    assert found.count.resumed == candidates


def test_a_search_that_is_cut_off_inside_a_line_of_its_log_goes_on(
    alone: tuple[Tuned, bytes], tmp_path: Path
) -> None:
    log = tmp_path / "tuned.csv"
    log.write_bytes(alone[1][: alone[1].index(b"\n1,1,") + 30])
    assert searched(log, resume=True).text == alone[0].text


def test_stopped_before_the_first_check_nothing_is_written(tmp_path: Path) -> None:
    log = tmp_path / "tuned.csv"
    with pytest.raises(Stopped):
        searched(log, stop=lambda: True)
    assert not log.exists()


def test_however_short_the_time_something_is_found() -> None:
    found = tune("lilibot", minutes=1e-6, seeds=1)
    assert found.count.candidates == 0
    assert found.validation is not None
    assert found.robot.mi_range is not None


def test_a_number_of_candidates_between_two_generations_is_checked_at_the_end(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("apnc.tune.search.CHECK_EVERY", 99)
    assert searched(candidates=5).count.checked == 8


def test_torque_limits_and_what_is_not_allowed_stay(alone: tuple[Tuned, bytes]) -> None:
    before, found = load_robot("lilibot"), alone[0].robot
    assert found.trunk == before.trunk
    assert found.contact == before.contact
    for name in ("stall_torque", "no_load_speed", "reflected_inertia"):
        assert getattr(found.servo, name) == getattr(before.servo, name)


def test_the_command_says_what_was_kept() -> None:
    found = searched(candidates=0, allowed=Allowed(kept=("a1", "b1", "b2")), near=True)
    assert found.command.endswith("--near --keep a1,b1,b2")


def test_a_search_that_stays_near_begins_with_small_steps() -> None:
    def farthest(near: bool) -> float:
        robot = load_robot("lilibot")
        start = Start(robot, 60.0, MI_AIMED, variables_for(robot), near=near)
        return float(np.abs(np.array(_Strategy(start, 1).ask()) - start.first()).max())

    assert farthest(near=True) < 0.3 < farthest(near=False)


def test_a_search_that_stays_near_aims_at_the_mi_range_of_the_file(tmp_path: Path) -> None:
    file = tmp_path / "tuned.toml"
    text = path_of("lilibot").read_text("utf-8").replace("[0.04, 0.40]", "[0.12, 0.26]")
    file.write_text(text, encoding="utf-8")
    aimed, scale = {}, math.sqrt(0.12 * 0.26 / (0.08 * 0.28))
    for near in (False, True):
        found = tune(file, candidates=0, seeds=1, near=near)
        aimed[near] = found.best.candidate.robot.mi_range
        assert "--mi" not in found.command
    assert aimed[True] == pytest.approx((0.12, 0.26))
    assert aimed[False] == pytest.approx((0.08 * scale, 0.28 * scale))


@pytest.mark.parametrize(
    ("asked", "why"),
    [
        ({"minutes": 0.0}, r"minutes = 0\.0; allowed: above 0"),
        ({"minutes": float("nan")}, "minutes = nan"),
        ({"candidates": -1}, "candidates = -1; allowed: 0 and more"),
        ({"seed": 0}, "seed = 0; allowed: 1 to"),
        ({"seed": 2**20 + 1}, "allowed: 1 to 1048576"),
        ({"mi": (0.3, 0.1)}, r"mi = 0\.3,0\.1; allowed: 0 < low < high <= 1"),
        ({"mi": (0.1, 1.5)}, "allowed: 0 < low"),
        ({"mi": (float("nan"), 0.2)}, "mi = nan"),
        ({"workers": 0}, "workers = 0; allowed: 1 and more"),
        ({"seeds": 0}, "seeds = 0; allowed: 1 and more"),
        ({"allowed": Allowed(kept=("a3",))}, "a3 cannot be kept; allowed: stance.up, "),
        ({"allowed": Allowed(kept=("b1",))}, "b1 and b2 can be kept only together"),
    ],
)
def test_what_is_not_allowed_is_refused_before_anything_is_walked(
    asked: dict[str, Any], why: str, tmp_path: Path
) -> None:
    walked: Callable[[], bool] = lambda: pytest.fail("it began")  # noqa: E731
    log = tmp_path / "tuned.csv"
    with pytest.raises(ValueError, match=why):
        searched(log, stop=walked, **asked)
    assert not log.exists()

"""Where trials run: threads, processes and a cluster give the same results, and stop."""

from __future__ import annotations

import json
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import pytest
from made_up_results import quick

from apnc.studies.results import Result
from apnc.studies.runner import grid_of, run_study
from apnc.studies.study import Trial
from apnc.studies.workers import CHUNK, chunks_of, results_of
from research.registry import STUDIES as RESEARCH


def test_other_engines_walk_in_processes_and_say_what_they_need(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    asked: dict[str, Any] = {"trials": 2, "duration": 0.5}
    asked["chosen"] = {"engine": ["compiled", "exudyn"], "mi": [0.08]}
    results = run_study("engines", **asked, studies=RESEARCH, workers=2)
    assert results == run_study("engines", **asked, studies=RESEARCH)
    assert [result["engine"] for result in results] == ["compiled"] * 2 + ["exudyn"] * 2
    assert all(result["error"] == "" for result in results)
    monkeypatch.setitem(sys.modules, "loky", None)
    with pytest.raises(ValueError, match=r"engine exudyn needs the extra 'study': pip install"):
        run_study("engines", **asked, studies=RESEARCH, workers=2)
    assert len(run_study("damage", trials=1, duration=0.5, workers=2)) == 4


def test_a_chunk_is_of_one_kind_and_another_engine_goes_by_itself() -> None:
    rates = grid_of("rate", 20, ["apnc"], {"rate": [60.0, 30.0]})
    others = grid_of("engines", 2, chosen={"engine": ["exudyn"], "mi": [0.08]}, studies=RESEARCH)
    chunks = chunks_of([*others, *rates[:5], *rates[20:], *rates[5:20]])
    assert [len(chunk) for chunk in chunks] == [20, 20, 1, 1]
    assert all(len({trial.experiment.rate for trial in chunk}) == 1 for chunk in chunks)
    assert [len(c) for c in chunks_of(grid_of("damage", 5 * CHUNK, ["apnc"]))] == [CHUNK] * 5


def test_no_further_chunk_begins_after_a_stop() -> None:
    trials = grid_of("engines", 6, chosen={"engine": ["exudyn"], "mi": [0.08]}, studies=RESEARCH)
    begun: list[Trial] = []

    def walk(
        trials: Sequence[Trial], *, workers: int, stop: Callable[[], bool]
    ) -> Iterator[Result]:
        begun.extend(trials)
        return map(quick, trials)

    with ThreadPoolExecutor(2) as executor:
        results = results_of(
            trials, walk, executor, workers=2, cluster=False, stop=lambda: len(begun) >= 2
        )
        assert len(list(results)) == len(begun) < 6


def test_what_waits_on_a_cluster_is_taken_back_after_a_stop() -> None:
    trials = grid_of("engines", 6, chosen={"engine": ["exudyn"], "mi": [0.08]}, studies=RESEARCH)
    begun: list[Trial] = []
    stopping, taken_back = threading.Event(), threading.Event()
    asked = 0

    def walk(
        trials: Sequence[Trial], *, workers: int, stop: Callable[[], bool]
    ) -> Iterator[Result]:
        begun.extend(trials)
        if len(begun) > 1:  # it walks on while the others are taken back
            taken_back.wait(10.0)
        return map(quick, trials)

    def stop() -> bool:
        nonlocal asked
        asked += stopping.is_set()
        if asked > 1:  # the first time it is asked is before they are taken back
            taken_back.set()
        return stopping.is_set()

    with ThreadPoolExecutor(1) as executor:
        found = results_of(trials, walk, executor, workers=1, cluster=True, stop=stop)
        first = next(found)
        stopping.set()
        rest = list(found)
    assert len([first, *rest]) == len(begun) <= 2


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """A real Dask scheduler and two workers on loopback, each a process of its own."""
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    quiet: Any = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": tmp_path}
    file = tmp_path / "scheduler.json"
    dask = [sys.executable, "-m", "dask"]
    options = ["--host", "127.0.0.1", "--port", "0", "--no-dashboard"]
    start = [*dask, "scheduler", *options, "--scheduler-file", str(file)]
    processes = [subprocess.Popen(start, **quiet)]
    try:
        while not (file.is_file() and file.read_text()):
            assert processes[0].poll() is None
            time.sleep(0.1)
        address = json.loads(file.read_text())["address"]
        worker = [*dask, "worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
        processes += [subprocess.Popen(worker, **quiet) for _ in range(2)]
        yield address, processes
    finally:
        for process in processes:
            process.kill()
            process.wait()


@pytest.mark.thorough
def test_dask_gives_the_same_results_though_a_worker_is_killed(
    cluster: tuple[str, list[subprocess.Popen[bytes]]],
) -> None:
    address, processes = cluster
    asked: dict[str, Any] = {"trials": 2 * CHUNK, "duration": 5.0}
    here = run_study("damage", **asked)

    def kill_one(done: int, *_: float) -> None:
        if 0 < done < len(here):
            processes[1].kill()

    there = run_study("damage", **asked, scheduler=address, progress=kill_one)
    assert processes[1].wait() != 0
    assert there == here and all(result["error"] == "" for result in here)


def test_no_scheduler_is_said() -> None:
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    with pytest.raises(ValueError, match="no Dask scheduler at moo"):
        run_study("damage", scheduler="moo")

"""The paper's evaluation: grids, statistics, storage, workers, claims and report."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Iterator
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest
from apnc.studies.evaluation.claims import CLAIMS, FEW, findings
from apnc.studies.evaluation.grids import METHODS, STUDIES, trials_of
from apnc.studies.evaluation.report import write_evaluation
from apnc.studies.evaluation.run import run_study
from apnc.studies.evaluation.statistics import Comparison, compare, holm, median, rate
from apnc.studies.evaluation.store import Store, write_table
from apnc.studies.evaluation.trial import Trial, run_trial
from apnc.studies.evaluation.workers import DaskWorkers, LocalWorkers, workers
from browser import console_lines, look, needs_browser

from build_fmu.build import host_fmu

SHORT = [Trial("mi", method, mi, 0, duration=2.0) for mi in (0.08, 0.16) for method in METHODS]


def sizes(name: str) -> tuple[int, float]:
    trials = trials_of(name, 20, METHODS)
    return len(trials), sum(t.duration for t in trials)


def test_grids_have_the_papers_size() -> None:
    assert sizes("mi") == (13 * 20 * 3, 13 * 20 * 3 * 45.0)
    assert sizes("rate") == (12 * 20 * 3, 12 * 20 * 3 * 60.0)
    assert sizes("terrain") == (11 * 20 * 3, 11 * 20 * 3 * 45.0)
    assert sizes("conditions") == (4 * 20 * 3, 4 * 20 * 3 * 45.0)
    four = sum(sizes(name)[1] for name in ("mi", "rate", "terrain", "conditions"))
    assert four == pytest.approx(119_000, rel=0.01)


def test_every_trial_has_its_own_key() -> None:
    trials = trials_of("all", 20, METHODS)
    assert len({t.key for t in trials}) == len(trials)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("moo", 1, METHODS), "study 'moo' is not one of mi, rate"),
        (("mi", 0, METHODS), "trials = 0 is not at least 1"),
        (("mi", 1, ["moo"]), "method 'moo' is not one of apnc"),
        (("mi", 1, []), "no method"),
    ],
)
def test_bad_grids_are_refused(arguments: tuple[str, int, list[str]], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        trials_of(*arguments)


def test_rate_interval_is_exact() -> None:
    # Clopper-Pearson at 0 and n of n in closed form
    none, all_ = rate([False] * 20), rate([True] * 20)
    assert (none.low, none.high) == (0.0, pytest.approx(1 - 0.025 ** (1 / 20)))
    assert (all_.low, all_.high) == (pytest.approx(0.025 ** (1 / 20)), 1.0)


def test_median_interval_holds_the_median() -> None:
    result = median([float(i) for i in range(101)])
    assert result.low < result.value == 50.0 < result.high
    assert median([]).text() == "-"


def test_effect_size_is_signed_and_complete() -> None:
    low, high = [1.0, 2.0, 3.0, 4.0], [11.0, 12.0, 13.0, 14.0]
    assert compare(high, low).effect == 1.0
    assert compare(low, high).effect == -1.0
    assert compare(low, high).p == pytest.approx(2 / 70)  # 2 of the C(8, 4) orders
    assert compare(low, []).p == 1.0


def test_holm_steps_down() -> None:
    ps = [0.01, 0.04, 0.03, 0.005]
    corrected = [c.p for c in holm([Comparison(p, 0.0, 5, 5) for p in ps])]
    assert corrected == pytest.approx([0.03, 0.06, 0.06, 0.02])


def test_a_trial_is_a_pure_function_of_its_configuration() -> None:
    assert run_trial(SHORT[0]) == run_trial(SHORT[0])
    assert run_trial(SHORT[0]) != run_trial(replace(SHORT[0], seed=1))


def test_a_trial_that_raises_is_a_row_with_its_error() -> None:
    row = run_trial(replace(SHORT[0], condition="C9"))
    assert row["error"].startswith("ValueError: conditions 'C9'")
    assert row["key"] == replace(SHORT[0], condition="C9").key


def test_rows_do_not_depend_on_workers_or_order(tmp_path: Path) -> None:
    tables = []
    for count, trials in ((1, SHORT), (2, SHORT[::-1])):
        folder = tmp_path / str(count)
        folder.mkdir()
        run_study(trials, LocalWorkers(count), folder)
        tables.append((folder / "trials.csv").read_bytes())
    assert tables[0] == tables[1]


def test_series_are_kept_on_request(tmp_path: Path) -> None:
    run_study(SHORT[:1], LocalWorkers(1), tmp_path, series=True)
    series = tmp_path / "series" / f"{SHORT[0].key}.csv"
    assert len(series.read_text().splitlines()) == 121


def test_a_folder_with_trials_is_not_overwritten(tmp_path: Path) -> None:
    run_study(SHORT[:1], LocalWorkers(1), tmp_path)
    with pytest.raises(ValueError, match="--resume continues them"):
        run_study(SHORT[:1], LocalWorkers(1), tmp_path)


def test_torn_line_is_dropped_and_the_rest_kept(tmp_path: Path) -> None:
    path = tmp_path / "trials.jsonl"
    store = Store(path)
    store.add({"key": "a", "x": 1})
    store.add({"key": "b", "x": 2})
    store.close()
    path.write_bytes(path.read_bytes()[:-4])
    store = Store(path)
    assert store.rows == {"a": {"key": "a", "x": 1}}
    store.add({"key": "b", "x": 2})
    store.close()
    assert [json.loads(line)["key"] for line in path.read_text().splitlines()] == ["a", "b"]


@pytest.mark.skipif(os.name == "nt", reason="kills a process group with SIGKILL")
def test_killed_study_resumes_without_loss_or_repetition(tmp_path: Path) -> None:
    command = [sys.executable, "-m", "apnc", "study", "conditions", "--trials", "1"]
    command += ["--workers", "1", "--output", str(tmp_path)]
    path = tmp_path / "trials.jsonl"
    process = subprocess.Popen(command, stderr=subprocess.DEVNULL, start_new_session=True)
    try:
        while process.poll() is None and (not path.is_file() or path.read_text().count("\n") < 2):
            time.sleep(0.1)
    finally:
        os.killpg(process.pid, signal.SIGKILL)
        process.wait()
    before = [json.loads(line) for line in path.read_text().splitlines() if line.endswith("}")]
    assert 2 <= len(before) < 12
    done = subprocess.run([*command, "--resume"], capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    after = [json.loads(line) for line in path.read_text().splitlines()]
    assert after[: len(before)] == before
    keys = Counter(row["key"] for row in after)
    assert set(keys) == {t.key for t in trials_of("conditions", 1, METHODS)}
    assert set(keys.values()) == {1}
    assert (tmp_path / "report.html").is_file() and (tmp_path / "trials.csv").is_file()


@pytest.fixture
def cluster(tmp_path: Path) -> Iterator[tuple[str, list[subprocess.Popen[bytes]]]]:
    """A real Dask scheduler and two workers on loopback, each a process of its own."""
    pytest.importorskip("distributed", reason="the extra cluster is not installed")
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL, "cwd": tmp_path}
    file = tmp_path / "scheduler.json"
    dask = [sys.executable, "-m", "dask"]
    options = [
        "--host",
        "127.0.0.1",
        "--port",
        "0",
        "--no-dashboard",
        "--scheduler-file",
        str(file),
    ]
    processes = [subprocess.Popen([*dask, "scheduler", *options], **quiet)]  # type: ignore[call-overload]  # a dict
    try:
        for _ in range(300):
            if file.is_file() and file.read_text():
                break
            time.sleep(0.1)
        address = json.loads(file.read_text())["address"]
        worker = [*dask, "worker", address, "--nthreads", "1", "--no-nanny", "--no-dashboard"]
        processes += [subprocess.Popen(worker, **quiet) for _ in range(2)]  # type: ignore[call-overload]  # a dict
        yield address, processes
    finally:
        for process in processes:
            process.kill()
            process.wait()


def test_dask_gives_the_same_table_though_a_worker_is_killed(
    cluster: tuple[str, list[subprocess.Popen[bytes]]], tmp_path: Path
) -> None:
    host_fmu()
    address, processes = cluster
    trials = [
        Trial("mi", method, 0.08, seed, duration=4.0) for seed in (0, 1, 2, 3) for method in METHODS
    ]
    here, there = tmp_path / "here", tmp_path / "there"
    here.mkdir()
    there.mkdir()
    run_study(trials, LocalWorkers(1), here)

    def kill_one(done: int, simulated: float) -> None:
        if done == 3:
            processes[1].kill()

    run_study(trials, DaskWorkers(address), there, progress=kill_one)
    assert processes[1].wait() != 0
    assert (there / "trials.csv").read_bytes() == (here / "trials.csv").read_bytes()
    lines = (there / "trials.jsonl").read_text().splitlines()
    assert len(lines) == len(trials)


def test_no_workers_is_refused() -> None:
    with pytest.raises(ValueError, match="workers = 0 is not at least 1"):
        workers(0, None)


def made_up(fast: str, seeds: int = 8) -> list[dict[str, object]]:
    """Rows of the MI study in which one method converges early and the others late."""
    rng = np.random.default_rng(0)
    rows: list[dict[str, object]] = []
    for trial in trials_of("mi", seeds, METHODS):
        when = (4.0 if trial.method == fast else 9.0) + rng.uniform(0, 2)
        figures = {
            "convergence_time_s": when,
            "convergence_time_authors_s": when / 2,
            "duty_factor_mean": 0.5 + trial.mi,
            "stride_frequency_hz": 8.6 * trial.mi + 0.5,
            "path_speed_m_per_s": 0.1,
        }
        rest = {"fell": False, "error": "", "parameters": "x"}
        rows.append({"key": trial.key, **asdict(trial), **figures, **rest})
    return rows


def test_claims_follow_the_rows() -> None:
    def verdicts(rows: list[dict[str, object]]) -> dict[str, str]:
        return {claim.text: finding.verdict for claim, finding in findings(rows, "mi")}

    text = "APNC converges faster than Tegotae"
    assert verdicts(made_up("apnc"))[text] == "reproduced"
    assert verdicts(made_up("tegotae"))[text] == "not"
    assert (
        verdicts(made_up("apnc"))["the stride frequency is about 8.6 MI + 0.5 Hz"] == "reproduced"
    )
    assert set(verdicts(made_up("apnc", seeds=2)).values()) == {FEW}


def test_every_study_has_claims_and_every_claim_a_study() -> None:
    assert {claim.study for claim in CLAIMS} == set(STUDIES)


def test_report_shows_claims_and_figures(tmp_path: Path) -> None:
    rows = made_up("apnc")
    write_evaluation(rows, tmp_path, 60.0)
    write_table(rows, tmp_path / "trials.csv")
    page = (tmp_path / "report.html").read_text()
    assert "APNC converges faster than Tegotae" in page
    assert "default-src 'none'" in page and "<script src" not in page
    assert "**reproduced**" in (tmp_path / "claims.md").read_text()


@needs_browser
def test_report_draws_in_a_browser(tmp_path: Path) -> None:
    write_evaluation(made_up("apnc"), tmp_path)
    seen, log = look(tmp_path / "report.html", tmp_path)
    assert seen["errors"] == [] and console_lines(log) == []
    assert set(seen["plots"]) == {"mi-0", "mi-1", "mi-2", "mi-3"}
    assert all(drawn > 0 for drawn in seen["plots"].values())

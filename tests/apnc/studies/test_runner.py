"""The runner: results that are kept, run again, and the same wherever they run."""

from __future__ import annotations

import csv
import json
import os
import signal
import subprocess
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from made_up_results import quick

from apnc import controllers
from apnc.controllers import CONTROLLERS
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.studies import runner, store
from apnc.studies.registry import STUDIES
from apnc.studies.results import Result, StudyResults, id_of
from apnc.studies.runner import grid_of, run_study, run_trial, run_trials
from apnc.studies.study import Study, Trial, load
from apnc_plant.robot import ROBOTS
from build_fmu.build import host_fmu

SHORT: dict[str, Any] = {"trials": 1, "duration": 1.0, "chosen": {"mi": [0.08]}}


Made = Callable[[Trial], Result]


def without_runs(monkeypatch: pytest.MonkeyPatch, made: Made = quick) -> list[str]:
    """Results are made without runs from now on; the keys of the trials that were asked for."""
    asked: list[str] = []

    def walk(
        trials: Sequence[Trial], *, workers: int, stop: Callable[[], bool], series: Path | None
    ) -> Iterator[Result]:
        for trial in trials:
            if stop():
                return
            asked.append(trial.id.key)
            yield made(trial)

    monkeypatch.setattr(runner, "run_trials", walk)
    return asked


@pytest.fixture
def no_runs(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    return without_runs(monkeypatch)


def lines(folder: Path) -> list[Result]:
    """The results on disk, without the wall time that stands beside each."""
    found = [json.loads(line) for line in (folder / "trials.jsonl").read_text().splitlines()]
    assert all(result.pop("wall_s") >= 0.0 for result in found)
    return found


# --- one trial ---------------------------------------------------------------------------------


def test_a_trial_is_a_pure_function_of_its_experiment() -> None:
    (trial,) = grid_of("mi", controllers=["apnc"], **SHORT)
    result = run_trial(trial)
    assert result == run_trial(trial) and json.dumps(result, allow_nan=False)
    other = replace(trial, experiment=replace(trial.experiment, seed=1))
    assert run_trial(other)["key"] != result["key"]
    assert run_trial(other)["turned_deg"] != result["turned_deg"]


def exchanged(experiment: Experiment, path: Path, content: bytes) -> Experiment:
    """The experiment with a controller whose file is another when it walks."""
    path.write_bytes(host_fmu().read_bytes())
    changed = replace(experiment, fmu=str(path))
    path.write_bytes(content)
    return changed


def test_a_trial_that_raises_is_a_result_with_its_error(tmp_path: Path) -> None:
    (trial,) = grid_of("mi", controllers=["apnc"], **SHORT)
    spoilt = exchanged(trial.experiment, tmp_path / "own.fmu", b"no zip")
    result = run_trial(replace(trial, experiment=spoilt))
    assert result["error"].startswith("FmuError: ") and "\n" not in result["error"]
    assert result["end"] == "error" and result["mi"] == 0.08


@pytest.mark.parametrize("own", ["exudyn", "compiled"])
def test_trials_that_raise_spoil_no_other(
    own: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One with no controller, one with that of other legs, one whose figures cannot be measured."""
    trials = grid_of("mi", 4, controllers=["apnc"], chosen={"mi": [0.08]}, duration=0.5)
    sound, fails, none, six = (replace(t.experiment, engine=own) for t in trials)
    none = exchanged(none, tmp_path / "none.fmu", b"no zip")
    six = exchanged(six, tmp_path / "six.fmu", host_fmu(6).read_bytes())
    every = [
        replace(t, experiment=e) for t, e in zip(trials, [sound, fails, none, six], strict=True)
    ]

    def measured(study: str, record: Record) -> Result:
        if record.experiment.seed == fails.seed:
            raise ZeroDivisionError("moo")
        return {"error": ""}

    monkeypatch.setattr(runner, "measured", measured)
    results = {result["key"]: result["error"] for result in run_trials(every, workers=2)}
    found = [results[trial.id.key] for trial in every]
    assert found[:2] == ["", "ZeroDivisionError: moo"]
    assert found[2].startswith("FmuError: ") and "none.fmu" in found[2]
    assert found[3].startswith("ValueError: ") and "6 legs" in found[3]


def test_numbers_that_are_not_finite_are_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    measure = {"a": float("nan"), "b": float("inf"), "c": 1.0, "d": True}
    study = Study("mi", lambda: None, measure=lambda record: measure)  # type: ignore[arg-type, return-value]
    monkeypatch.setattr(runner, "load", lambda name: study)
    from records import synthetic_record  # noqa: PLC0415

    result = runner.measured("mi", synthetic_record(5.0))
    assert [result[name] for name in "abcd"] == [None, None, 1.0, True]


# --- a study -----------------------------------------------------------------------------------


def test_without_a_folder_the_results_come_back_and_no_file_is_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, no_runs: list[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    results = run_study("mi", controllers=["apnc"], trials=2)
    assert isinstance(results, StudyResults)
    assert [(result["mi"], result["seed"]) for result in results[:3]] == [
        (0.04, 0),
        (0.04, 1),
        (0.06, 0),
    ]
    assert len(results) == 26 and list(tmp_path.iterdir()) == []


def test_progress_counts_trials_and_simulated_time(no_runs: list[str]) -> None:
    told: list[tuple[int, int, float, float]] = []
    run_study(
        "mi", controllers=["apnc"], trials=2, chosen={"mi": [0.1]},
        progress=lambda *numbers: told.append(numbers),
    )  # fmt: skip
    assert told == [(0, 2, 0.0, 90.0), (1, 2, 45.0, 90.0), (2, 2, 90.0, 90.0)]


def test_the_folder_holds_results_table_report_and_claims(
    tmp_path: Path, no_runs: list[str]
) -> None:
    results = run_study("mi", output=tmp_path / "new" / "folder", trials=1)
    folder = tmp_path / "new" / "folder"
    names = {path.name for path in folder.iterdir()}
    assert names == {"trials.jsonl", "trials.csv", "report.html", "claims.md", "mi.md"}
    with (folder / "trials.csv").open(newline="") as file:
        table = list(csv.DictReader(file))
    assert [(r["key"], float(r["mi"])) for r in table] == [(r["key"], r["mi"]) for r in results]
    assert lines(folder) == results


def test_a_folder_with_trials_is_not_overwritten(tmp_path: Path, no_runs: list[str]) -> None:
    run_study("damage", output=tmp_path, trials=1)
    before = (tmp_path / "trials.jsonl").read_bytes()
    with pytest.raises(ValueError, match="holds trials already; --resume continues them"):
        run_study("damage", output=tmp_path, trials=1)
    assert (tmp_path / "trials.jsonl").read_bytes() == before


def test_stopped_and_resumed_is_the_same_as_run_through(tmp_path: Path, no_runs: list[str]) -> None:
    stops = iter([False, False, True, True, True])
    part = run_study("damage", output=tmp_path / "a", trials=2, stop=lambda: next(stops))
    assert len(part) == 2 and len(lines(tmp_path / "a")) == 2
    assert (tmp_path / "a" / "report.html").exists()
    no_runs.clear()
    run_study("damage", output=tmp_path / "a", trials=2, resume=True)
    resumed = Counter(no_runs)
    every = run_study("damage", output=tmp_path / "b", trials=2)
    # one experiment may stand in two places: a controller's best setting can be the paper's
    assert resumed + Counter(r["key"] for r in part) == Counter(r["key"] for r in every)
    a, b = ((tmp_path / name / "trials.csv").read_text() for name in "ab")
    assert a == b


def test_the_wall_time_is_that_of_all_runs_of_a_study(
    tmp_path: Path, no_runs: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = iter(range(0, 10_000, 60))
    monkeypatch.setattr(store.time, "perf_counter", lambda: float(next(clock)))
    stops = iter([False, True])
    run_study("damage", output=tmp_path, trials=1, stop=lambda: next(stops))
    assert "in 1.0 min" in (tmp_path / "report.html").read_text()
    results = run_study("damage", output=tmp_path, trials=1, resume=True)
    assert f"in {len(results)}.0 min" in (tmp_path / "report.html").read_text()
    assert not any(
        "wall_s" in result for result in csv.DictReader((tmp_path / "trials.csv").open())
    )


def test_resume_runs_results_with_an_error_again(
    tmp_path: Path, no_runs: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def broken(trial: Trial) -> Result:
        error = "RuntimeError: moo" if trial.cell["controller"] == "apnc" else ""
        return quick(trial) | {"error": error, "end": "error" if error else "complete"}

    with monkeypatch.context() as context:
        without_runs(context, broken)
        first = run_study("damage", output=tmp_path, trials=1)
    assert [result["error"] for result in first] == ["RuntimeError: moo", *[""] * 3]
    results = run_study("damage", output=tmp_path, trials=1, resume=True)
    assert no_runs == [first[0]["key"]]
    assert [result["error"] for result in results] == [""] * 4
    assert len(lines(tmp_path)) == 5  # the last line of a trial counts


def test_resume_does_not_keep_results_of_another_robot(
    tmp_path: Path, no_runs: list[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "own.toml"
    text = (ROBOTS / "lilibot.toml").read_text()
    study = load(STUDIES["damage"])
    own = replace(study, experiment=lambda **cell: study.experiment(robot=str(file), **cell))
    monkeypatch.setattr(runner, "load", lambda name: own)
    file.write_text(text)
    before = run_study("damage", output=tmp_path / "out", trials=1)
    again = run_study("damage", output=tmp_path / "out", trials=1, resume=True)
    assert again == before and len(no_runs) == 4
    friction = next(line for line in text.splitlines() if line.startswith("friction ="))
    file.write_text(text.replace(friction, "friction = 0.33"))
    after = run_study("damage", output=tmp_path / "out", trials=1, resume=True)
    assert len(no_runs) == 8
    assert not {result["key"] for result in before} & {result["key"] for result in after}


def test_an_error_in_the_loop_loses_nothing(tmp_path: Path, no_runs: list[str]) -> None:
    def progress(done: int, *_: float) -> None:
        if done == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_study("damage", output=tmp_path, trials=2, progress=progress)
    assert len(lines(tmp_path)) == 2


def test_labels_of_one_experiment_are_results_of_their_own(
    monkeypatch: pytest.MonkeyPatch, no_runs: list[str]
) -> None:
    """The best setting of a baseline may be the paper's."""
    paper = CONTROLLERS["tegotae"].settings_in("damage")
    best = CONTROLLERS["tegotae_best"]._replace(settings=paper)
    monkeypatch.setattr(controllers, "CONTROLLERS", {**CONTROLLERS, "tegotae_best": best})
    results = run_study("damage", trials=1, controllers=["tegotae", "tegotae_best"])
    assert [result["controller"] for result in results] == ["tegotae", "tegotae_best"]
    assert results[0]["key"] == results[1]["key"]


def test_series_are_kept_on_request(tmp_path: Path) -> None:
    (result,) = run_study("mi", controllers=["apnc"], output=tmp_path, series=True, **SHORT)
    series = tmp_path / "series" / f"mi-apnc-{result['key']}.csv"
    assert len(series.read_text().splitlines()) == 61
    with pytest.raises(ValueError, match="series are kept in a folder"):
        run_study("mi", series=True)


def test_no_workers_are_refused(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="workers = 0 is not at least 1"):
        run_study("mi", workers=0, output=tmp_path / "out")
    assert not (tmp_path / "out").exists()


KINDS: dict[str, Any] = {"trials": 5, "controllers": ["apnc", "apc"], "duration": 2.0}
"""Trials of two kinds, of which one fills no batch."""


def test_results_are_those_of_single_runs_whatever_walks_beside_them(tmp_path: Path) -> None:
    asked = {**KINDS, "chosen": {"rate": [60.0, 30.0]}}
    here = run_study("rate", **asked)
    assert here == run_study("rate", **asked, workers=3)
    alone = run_study("rate", **{**asked, "trials": 3}, output=tmp_path)
    assert [result for result in here if result["seed"] < 3] == alone
    assert here == run_study("rate", **asked, output=tmp_path, resume=True)
    singly = [run_trial(trial) for trial in grid_of("rate", **asked)]
    assert here == singly and all(result["error"] == "" for result in here)


def test_studies_of_the_product_walk_in_c(tmp_path: Path, no_runs: list[str]) -> None:
    assert {t.experiment.engine for name in STUDIES for t in grid_of(name, 1)} == {"compiled"}
    run_study("damage", trials=1, output=tmp_path)
    assert "<dt>engine</dt><dd>compiled</dd>" in (tmp_path / "report.html").read_text()


# --- kill --------------------------------------------------------------------------------------

KILLED = """
import sys
from apnc.studies.runner import run_study
run_study("damage", trials=400, duration=10.0, workers=1, output=sys.argv[1])
"""


@pytest.mark.skipif(os.name == "nt", reason="kills with SIGKILL")
def test_a_killed_study_resumes_without_loss_or_repetition(tmp_path: Path) -> None:
    host_fmu()
    path = tmp_path / "trials.jsonl"
    process = subprocess.Popen([sys.executable, "-c", KILLED, str(tmp_path)])
    try:
        while process.poll() is None and (not path.is_file() or path.read_text().count("\n") < 2):
            time.sleep(0.05)
    finally:
        process.send_signal(signal.SIGKILL)
        process.wait()
    path.write_text("".join(x for x in path.read_text().splitlines(True) if x.endswith("}\n")))
    before = lines(tmp_path)
    assert 2 <= len(before) < 1200
    results = run_study("damage", trials=1, duration=10.0, output=tmp_path, resume=True)
    assert lines(tmp_path)[: len(before)] == before
    assert len(results) == len({id_of(result) for result in results}) == 4

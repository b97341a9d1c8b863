"""Ctrl-C and SIGTERM: at once while there is nothing to lose, at the next tick while there is."""

from __future__ import annotations

import csv
import json
import os
import re
import signal
import sys
from pathlib import Path

import pytest

from apnc.cli.interrupt import Interrupted, StopRequest

if os.name == "nt":
    pytest.skip("sends SIGINT to a process", allow_module_level=True)

from terminal import APNC, interrupted

CODES = {signal.SIGINT: 130, signal.SIGTERM: 143}


@pytest.mark.parametrize(
    "by",
    [
        pytest.param(by, id=by.name, marks=pytest.mark.thorough if by is signal.SIGTERM else [])
        for by in CODES
    ],
)
def test_a_signal_in_an_endless_walk_keeps_what_was_recorded(
    by: signal.Signals, tmp_path: Path
) -> None:
    code, shown = interrupted(
        *APNC, "walk", "--duration", "1e9", at="x real time", cwd=tmp_path, by=by
    )
    assert code == CODES[by], shown
    assert "Traceback" not in shown
    assert "what was recorded is in apnc-walk" in shown
    summary = json.loads((tmp_path / "apnc-walk" / "summary.json").read_text())
    assert summary["end"] == "interrupted"
    assert 0.0 < summary["duration_s"] < 1e6
    assert (tmp_path / "apnc-walk" / "report.html").is_file()


@pytest.mark.parametrize("at", ["apnc.cli.console", "numpy", "fmpy", "apnc_plant.ground"])
def test_ctrl_c_during_the_imports_is_no_traceback(at: str, tmp_path: Path) -> None:
    command = (sys.executable, "-X", "importtime", "-m", "apnc", "walk", "--duration", "9")
    code, shown = interrupted(*command, at=f" {re.escape(at)}\r\n", cwd=tmp_path)
    said = [line for line in shown.splitlines() if not line.startswith("import time:")]
    assert code == 130, said
    assert "interrupted, nothing recorded" in shown
    assert not any("Traceback" in line or "reinstall" in line for line in said)
    assert not (tmp_path / "apnc-walk" / "summary.json").exists()


ROOT = Path(__file__).resolve().parents[3]
IN_C = ("apnc", "study", "mi", "--controllers", "apnc", "--duration", "900")
IN_PROCESSES = ("research.engines", "--engine", "exudyn", "--duration", "3")


def command(study: tuple[str, ...], folder: Path, *options: str) -> tuple[str, ...]:
    """Arguments of Python for a study that writes into a folder."""
    return (*options, "-m", *study, "--output", str(folder))


def place(study: tuple[str, ...], folder: Path) -> Path:
    """Where it runs: what is installed anywhere, the rest in the checkout."""
    return ROOT if study[0].startswith("research") else folder


@pytest.mark.parametrize(
    ("study", "at"),
    [
        pytest.param(IN_C, "of 4 trials", id="threads"),
        pytest.param(IN_PROCESSES, " loky", id="processes at their start"),
        pytest.param(IN_PROCESSES, "of 4 trials", id="processes", marks=pytest.mark.thorough),
    ],
)
def test_ctrl_c_in_a_study_also_reaches_workers_and_is_no_traceback(
    study: tuple[str, ...], at: str, tmp_path: Path
) -> None:
    some = ("--trials", "4", "--mi", "0.08", "--workers", "2")
    words = command((*study, *some), tmp_path / "out", "-X", "importtime")
    code, shown = interrupted(sys.executable, *words, at=at, cwd=place(study, tmp_path))
    said = [line for line in shown.splitlines() if not line.startswith("import time:")]
    assert code == 130, said
    assert not any("Traceback" in line or "segmentation" in line for line in said)
    store = tmp_path / "out" / "trials.jsonl"
    rows = store.read_text().splitlines() if store.exists() else []
    assert len(rows) < 4
    assert all(json.loads(row)["error"] == "" for row in rows)


IN_C_MANY = (*IN_C[:-1], "5", "--mi", "0.08", "--workers", "1", "--trials", "4000")
IN_PROCESSES_MANY = (*IN_PROCESSES, "--mi", "0.08", "--workers", "2", "--trials", "400")


@pytest.mark.parametrize(
    "study",
    [
        pytest.param(IN_C_MANY, id="threads"),
        pytest.param(IN_PROCESSES_MANY, id="processes", marks=pytest.mark.thorough),
    ],
)
def test_a_terminated_study_has_written_what_had_ended(
    study: tuple[str, ...], tmp_path: Path
) -> None:
    some = r"[1-9][0-9]* of 4000? trials"
    folder = tmp_path / "out"
    words = command(study, folder)
    code, shown = interrupted(
        sys.executable, *words, at=some, cwd=place(study, tmp_path), by=signal.SIGTERM
    )
    assert code == 143 and "interrupted; --resume finishes it" in shown, shown
    assert "Traceback" not in shown
    rows = [json.loads(line) for line in (folder / "trials.jsonl").read_text().splitlines()]
    assert 0 < len(rows) < 4000 and {row["error"] for row in rows} == {""}
    with (folder / "trials.csv").open(newline="", encoding="utf-8") as file:
        assert {row["key"] for row in csv.DictReader(file)} == {row["key"] for row in rows}
    assert (folder / "report.html").is_file()


def test_a_second_sigterm_changes_nothing_and_the_first_signal_has_the_code() -> None:
    stop = StopRequest()
    with stop.listening():
        assert not stop()
        for _ in range(3):
            signal.raise_signal(signal.SIGTERM)
        assert (stop(), stop.code) == (True, 143)
        with pytest.raises(Interrupted):
            signal.raise_signal(signal.SIGINT)
        assert stop.code == 143
    assert signal.getsignal(signal.SIGTERM) is signal.SIG_DFL


def test_before_a_loop_asks_ctrl_c_raises_afterwards_the_second_does() -> None:
    # a shell that starts something in the background has it ignore Ctrl-C
    signal.signal(signal.SIGINT, signal.default_int_handler)
    stop = StopRequest()
    with stop.listening():
        with pytest.raises(Interrupted):
            signal.raise_signal(signal.SIGINT)
        assert stop()  # an import that swallows the error changes nothing
    stop = StopRequest()
    with stop.listening():
        assert not stop()
        signal.raise_signal(signal.SIGINT)
        assert stop()
        with pytest.raises(Interrupted):
            signal.raise_signal(signal.SIGINT)
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler

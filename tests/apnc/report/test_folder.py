"""A folder holds one run's files or the older run's, never a mixture."""

from __future__ import annotations

import csv
import errno
import json
import os
from dataclasses import replace
from pathlib import Path

import pytest
from records import synthetic_record

from apnc.loop.columns import column_names
from apnc.loop.record import End
from apnc.report import folder as folder_module
from apnc.report.folder import write_run

FILES = {"summary.json", "record.csv", "report.html"}


def full(path: Path) -> None:
    """Writes half a file, as a full disk does."""
    path.write_text("half", encoding="utf-8")
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def texts(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.iterdir()}


def test_a_run_is_three_files_that_say_what_was_run(tmp_path: Path) -> None:
    record = synthetic_record(2.0)
    summary = write_run(record, tmp_path / "deep" / "walk")
    folder = tmp_path / "deep" / "walk"
    assert {path.name for path in folder.iterdir()} == FILES
    content = json.loads((folder / "summary.json").read_text())
    assert content["path_speed_m_per_s"] == summary.path_speed_m_per_s
    assert content["command"] == record.experiment.command()
    assert content["experiment"]["robot"] == "lilibot"
    assert content["parameters"]["Ts"] == 1 / 60
    assert "numpy" in content["versions"]
    with (folder / "record.csv").open() as file:
        header = next(csv.reader(file))
    assert header == list(content["columns"]) == [c.name for c in column_names(record)]
    assert content["columns"]["RF.joint_torque.hip"] == "N.m"


def test_a_run_of_no_tick_has_all_files(tmp_path: Path) -> None:
    record = replace(synthetic_record(0.0), end=End.interrupted)
    write_run(record, tmp_path)
    assert {path.name for path in tmp_path.iterdir()} == FILES
    assert "nothing to plot" in (tmp_path / "report.html").read_text()
    assert len((tmp_path / "record.csv").read_text().splitlines()) == 1


def test_a_full_disk_names_the_file_and_leaves_the_older_run(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write_run(synthetic_record(1.0), tmp_path)
    older = texts(tmp_path)
    monkeypatch.setattr(folder_module, "write_csv", lambda record, path: full(path))
    with pytest.raises(OSError, match="No space left") as caught:
        write_run(synthetic_record(2.0), tmp_path)
    assert caught.value.filename == str(tmp_path / "record.csv")
    assert texts(tmp_path) == older

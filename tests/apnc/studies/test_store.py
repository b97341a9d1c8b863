"""The file of results: every finished trial is in it, whatever happens."""

from __future__ import annotations

import json
import os
from pathlib import Path
from typing import Any

import pytest

from apnc.studies import store
from apnc.studies.results import Result
from apnc.studies.store import Store


def result(key: str, **more: Any) -> Result:
    return {"study": "mi", "controller": "apnc", "key": key, **more}


def test_a_torn_line_is_dropped_and_the_rest_kept(tmp_path: Path) -> None:
    path = tmp_path / "trials.jsonl"
    kept = Store(path)
    kept.add(result("a", x=1))
    kept.add(result("b", x=2))
    kept.close()
    path.write_bytes(path.read_bytes()[:-4])
    kept = Store(path)
    assert kept.results == {("mi", "apnc", "a"): result("a", x=1)}
    kept.add(result("b", x=2))
    kept.close()
    assert [json.loads(line)["key"] for line in path.read_text().splitlines()] == ["a", "b"]


def test_a_damaged_line_costs_its_own_trial_only(tmp_path: Path) -> None:
    path = tmp_path / "trials.jsonl"
    whole = json.dumps(result("b"))
    path.write_text(f'{{"study": "mi"\n"text"\n{{"key": "a"}}\n{whole}\n')
    kept = Store(path)
    assert list(kept.results) == [("mi", "apnc", "b")]
    kept.close()


def test_a_result_is_in_the_file_at_once_with_the_wall_time_it_took(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = iter([0.0, 2.5, 4.0])
    monkeypatch.setattr(store.time, "perf_counter", lambda: next(clock))
    path = tmp_path / "t.jsonl"
    with Store(path) as kept:
        for line, (key, wall_s) in enumerate({"a": 2.5, "b": 1.5}.items()):
            monkeypatch.setattr(store.os, "fsync", lambda file: None)
            monkeypatch.setattr(kept, "_sync", lambda: None)
            kept.add(result(key))
            text = path.read_text()
            assert text.endswith("}\n")
            assert json.loads(text.splitlines()[line]) == result(key, wall_s=wall_s)


def test_the_disk_is_waited_for_once_a_second_and_at_the_end(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    now, waited = [0.0], list[float]()
    monkeypatch.setattr(store.time, "perf_counter", lambda: now[0])
    monkeypatch.setattr(store.os, "fsync", lambda file: waited.append(now[0]))
    with Store(tmp_path / "t.jsonl") as kept:
        for now[0] in (0.5, 0.9, 1.1, 1.2, 2.0, 2.3, 2.4):
            kept.add(result("a"))
    assert waited == [1.1, 2.3, 2.4]


@pytest.mark.skipif(os.name == "nt", reason="Windows has no such locks")
def test_a_file_that_another_study_writes_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "trials.jsonl"
    with Store(path) as kept:
        kept.add(result("a"))
        with pytest.raises(ValueError, match=r"trials\.jsonl is being written by another study"):
            Store(path)
        kept.add(result("b"))
    with Store(path) as again:
        assert [key for _, _, key in again.results] == ["a", "b"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full on this system")
def test_a_full_disk_names_the_file(tmp_path: Path) -> None:
    kept = Store(tmp_path / "t.jsonl")
    kept._file = Path("/dev/full").open("ab")  # noqa: SIM115
    with pytest.raises(OSError, match="No space left on device: '/dev/full'"):
        kept.add(result("a"))

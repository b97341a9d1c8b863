"""Files are written whole or not at all, one alone or several together."""

from __future__ import annotations

import errno
import os
import threading
import time
from concurrent.futures import Future, ThreadPoolExecutor, wait
from pathlib import Path

import pytest

from build_fmu.writing import LEFT_S, write_atomically, write_together


def full(path: Path) -> None:
    """Writes half a file, as a full disk does."""
    path.write_text("half", encoding="utf-8")
    raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))


def texts(folder: Path) -> dict[str, str]:
    return {path.name: path.read_text() for path in folder.iterdir()}


def test_a_file_is_written_of_bytes_or_by_a_function(tmp_path: Path) -> None:
    write_atomically(tmp_path / "deep" / "a", b"bytes")
    write_atomically(tmp_path / "deep" / "b", lambda path: path.write_text("text"))
    assert texts(tmp_path / "deep") == {"a": "bytes", "b": "text"}


def test_a_full_disk_leaves_the_older_file_and_names_it(tmp_path: Path) -> None:
    path = tmp_path / "a"
    path.write_text("older")
    with pytest.raises(OSError, match="No space left") as caught:
        write_atomically(path, full)
    assert caught.value.filename == str(path)
    assert texts(tmp_path) == {"a": "older"}


def test_threads_that_write_the_same_file_do_not_meet(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    both, replace = threading.Barrier(2), Path.replace

    def together(part: Path, target: Path) -> Path:
        both.wait(10)
        return replace(part, target)

    monkeypatch.setattr(Path, "replace", together)
    with ThreadPoolExecutor(2) as threads:
        list(threads.map(lambda _: write_atomically(tmp_path / "x", b"whole"), range(2)))
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {"x": b"whole"}


@pytest.mark.parametrize("failing", range(6))
def test_a_move_that_fails_brings_the_older_run_back(
    failing: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    names = ("a", "b", "c")
    write_together(tmp_path, {n: lambda path, n=n: path.write_text(f"older {n}") for n in names})
    older, moves, rename = texts(tmp_path), [], Path.rename

    def stubborn(source: Path, target: Path) -> Path:
        moves.append(source)
        if len(moves) == failing + 1:
            raise OSError(errno.EACCES, "Permission denied")
        return rename(source, target)

    monkeypatch.setattr(Path, "rename", stubborn)
    with pytest.raises(OSError) as caught:
        write_together(tmp_path, {n: lambda path: path.write_text("newer") for n in names})
    assert caught.value.filename == str(tmp_path / names[failing % 3])
    assert texts(tmp_path) == older


def test_the_two_runs_never_stand_together(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    names = ("a", "b", "c")
    write_together(tmp_path, {n: lambda path: path.write_text("older") for n in names})
    seen, rename = [], Path.rename

    def watching(source: Path, target: Path) -> Path:
        result = rename(source, target)
        seen.append({p.read_text() for p in tmp_path.iterdir() if p.is_file()})
        return result

    monkeypatch.setattr(Path, "rename", watching)
    write_together(tmp_path, {n: lambda path: path.write_text("newer") for n in names})
    assert all(len(kinds) <= 1 for kinds in seen)
    assert texts(tmp_path) == dict.fromkeys(names, "newer")


def test_what_a_writer_killed_days_ago_left_is_removed_and_other_files_stay(
    tmp_path: Path,
) -> None:
    for name, age in (("killed", LEFT_S + 60.0), ("live", LEFT_S - 60.0)):
        left = tmp_path / f".writing-{name}"
        left.mkdir()
        (left / "record.csv").write_text("half")
        os.utime(left, (time.time() - age,) * 2)
    (tmp_path / "notes.txt").write_text("mine")
    write_together(tmp_path, {"a": lambda path: path.write_text("new")})
    assert {path.name for path in tmp_path.iterdir()} == {"a", "notes.txt", ".writing-live"}
    assert (tmp_path / ".writing-live" / "record.csv").read_text() == "half"


def test_writers_side_by_side_leave_each_other_alone(tmp_path: Path) -> None:
    """As two walks with --mcap logs/1.mcap and logs/2.mcap: one writes while the other does."""

    def writes_while_the_other_writes(path: Path) -> None:
        path.write_text("1")
        write_together(tmp_path, {"2.mcap": lambda other: other.write_text("2")})

    write_together(tmp_path, {"1.mcap": writes_while_the_other_writes})
    assert texts(tmp_path) == {"1.mcap": "1", "2.mcap": "2"}


@pytest.mark.skipif(os.name == "nt", reason="Windows refuses the second instead")
def test_of_writers_of_the_same_files_the_last_one_wins_whole(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    names, rename = ("a", "b", "c"), Path.rename

    def write(mine: str) -> None:
        write_together(tmp_path, {n: lambda path: path.write_text(mine) for n in names})

    write("older")
    with ThreadPoolExecutor() as threads:
        started: list[Future[None]] = []

        def while_another_comes(source: Path, target: Path) -> Path:
            if not started:
                started.append(threads.submit(write, "second"))
                wait(started, timeout=0.5)
            return rename(source, target)

        monkeypatch.setattr(Path, "rename", while_another_comes)
        write("first")
        started[0].result()
    assert texts(tmp_path) == dict.fromkeys(names, "second")


def test_a_file_in_the_place_of_the_folder_is_named(tmp_path: Path) -> None:
    (tmp_path / "taken").write_text("")
    with pytest.raises(OSError) as caught:
        write_together(tmp_path / "taken", {"a": full})
    assert caught.value.filename == str(tmp_path / "taken")

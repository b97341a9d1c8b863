"""``apnc tune``: refusals in one line, and Ctrl-C that keeps the best."""

from __future__ import annotations

import importlib.util
import os
import re
import tomllib
from pathlib import Path
from typing import Any

import pytest
from command_line import run

from apnc.tune.validation import validated
from apnc_plant.robot import ROBOTS, load_robot


@pytest.fixture(autouse=True)
def there(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def one_seed(monkeypatch: pytest.MonkeyPatch) -> None:
    """Validate with one seed."""
    monkeypatch.setattr(
        "apnc.tune.tuning.validated", lambda start, each, by, _: validated(start, each, by, 1)
    )


def refused(capsys: pytest.CaptureFixture[str], *words: str) -> str:
    """The one line with which a command is refused; it has written nothing."""
    before = {path: path.read_bytes() for path in Path.cwd().iterdir() if path.is_file()}
    code, out, err = run(capsys, "tune", *words)
    assert (code, out) == (2, "")
    assert len(err.splitlines()) == 1 and err.startswith("apnc: ")
    assert {p: p.read_bytes() for p in Path.cwd().iterdir() if p.is_file()} == before
    return err


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("lilibot", "--mi", "0.3"), "--mi is 0.3; allowed: two numbers as"),
        (("lilibot", "--mi", "0.3,0.1"), "mi = 0.3,0.1; allowed: 0 < low < high <= 1"),
        (("lilibot", "--seed", "0"), "seed = 0; allowed: 1 to 1048576"),
        (("lilibot", "--minutes", "-1"), "minutes = -1.0; allowed: above 0"),
        (("lilibot", "--candidates", "-1"), "candidates = -1; allowed: 0 and more"),
        (("lilibot", "--workers", "0"), "workers = 0; allowed: 1 and more"),
        (("lilibot", "--output", "tuned.txt"), "--output is tuned.txt; allowed: a name that ends"),
        (("nobody",), "robot 'nobody' is unknown; allowed: hexapod, lilibot, octopod"),
    ],
)
def test_bad_input_is_one_line(
    words: tuple[str, ...], why: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert why in refused(capsys, *words)


def test_a_robot_without_a_known_gait_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    text = (ROBOTS / "octopod.toml").read_text(encoding="utf-8")
    y = re.search(r"mount = \[[^,]*, (-[0-9.]+)", text)
    assert y is not None
    sides = zip(("R9", "L9"), (y[1], y[1].removeprefix("-")), strict=True)
    more = "".join(f'\n[[legs]]\nname = "{n}"\nmount = [-0.5, {at}, 0.0]\n' for n, at in sides)
    Path("ten.toml").write_text(text + more, encoding="utf-8")
    assert len(load_robot("ten.toml").legs) == 10
    assert "no gait is known for 10 legs; allowed: 4, 6 or 8" in refused(capsys, "ten.toml")


@pytest.mark.parametrize("package", ["cma", "tomlkit"])
def test_a_missing_extra_is_said_before_anything_is_searched(
    package: str, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    was = importlib.util.find_spec

    def without(name: str, *rest: Any) -> Any:
        return None if name == package else was(name, *rest)

    monkeypatch.setattr("importlib.util.find_spec", without)
    line = refused(capsys, "lilibot", "--candidates", "0")
    assert f"'{package}' is not installed: pip install" in line and "[tune]" in line


@pytest.mark.parametrize("name", ["tuned.csv", "tuned.toml", "tuned.html"])
def test_what_an_earlier_search_has_written_is_not_overwritten(
    name: str, capsys: pytest.CaptureFixture[str]
) -> None:
    Path(name).write_text("earlier", encoding="utf-8")
    line = refused(capsys, "lilibot", "--candidates", "0")
    assert f"an earlier search has written {name}; allowed: --resume" in line


def test_nothing_is_resumed_without_a_log_or_from_another_file(
    capsys: pytest.CaptureFixture[str],
) -> None:
    Path("tuned.toml").write_text("earlier", encoding="utf-8")
    assert "--resume needs the log tuned.csv" in refused(capsys, "lilibot", "--resume")
    Path("tuned.csv").write_text("time,x\n1,2\n", encoding="utf-8")
    assert "tuned.csv is no log of a search" in refused(capsys, "lilibot", "--resume")


def test_the_robot_itself_is_not_overwritten(capsys: pytest.CaptureFixture[str]) -> None:
    text = (ROBOTS / "lilibot.toml").read_text(encoding="utf-8")
    Path("mine.toml").write_text(text, encoding="utf-8")
    line = refused(capsys, "mine.toml", "--output", "mine.toml")
    assert "would overwrite a file of the robot" in line


@pytest.mark.skipif(os.name == "nt" or os.geteuid() == 0, reason="root may write everywhere")
def test_a_folder_that_cannot_be_written_is_refused_at_once(
    capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    locked = tmp_path / "locked"
    locked.mkdir(mode=0o500)
    assert "cannot be written" in refused(capsys, "lilibot", "--output", "locked/tuned.toml")


def test_an_output_in_place_of_a_folder_is_refused(capsys: pytest.CaptureFixture[str]) -> None:
    Path("file").write_text("", encoding="utf-8")
    line = refused(capsys, "lilibot", "--output", "file/tuned.toml")
    assert "output folder file cannot be written" in line


def test_the_robot_of_the_file_alone(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    one_seed(monkeypatch)
    code, out, err = run(capsys, "tune", "lilibot", "--candidates", "0", "--output", "a/b.toml")
    assert code == 0
    assert sorted(path.name for path in Path("a").iterdir()) == ["b.csv", "b.html", "b.toml"]
    assert "apnc walk --robot a/b.toml --engine compiled\n" in out
    assert re.search(r"^0\.\d+ +\d+ ", out, re.MULTILINE)
    assert "nothing better than the file itself was found" in out
    assert err.startswith("100%, 0 candidates: trot at ")
    low, high = load_robot("a/b.toml").mi_range or (0.0, 0.0)
    assert 0.08 <= low < high <= 0.28


def test_stopped_in_the_first_check_is_one_line_and_nothing_is_written(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("apnc.cli.tune.STOP", lambda: True)
    code, out, err = run(capsys, "tune", "lilibot")
    assert (code, out) == (130, "")
    assert err == "interrupted before a robot was found, nothing written\n"
    assert list(Path.cwd().iterdir()) == []


if os.name != "nt":
    from terminal import APNC, interrupted

    MI = ("--mi", "0.15,0.2")
    """Few MI are walked before there is something to keep."""

    def test_ctrl_c_keeps_the_best_and_resume_goes_on(
        tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
    ) -> None:
        command = (*APNC, "tune", "lilibot", "--minutes", "99", "--workers", "1", *MI)
        code, shown = interrupted(*command, at="trot at [0-9]+ of [0-9]+ MI", cwd=tmp_path)
        assert code == 130
        assert "Traceback" not in shown
        assert "interrupted; tuned.toml is the best so far, --resume goes on" in shown
        files = [Path(f"tuned.{kind}") for kind in ("toml", "html", "csv")]
        assert all(file.stat().st_size > 0 for file in files)
        assert "apnc tune lilibot --candidates 0 --seed 1" in files[0].read_text(encoding="utf-8")
        assert "--resume goes on with it" in files[1].read_text(encoding="utf-8")
        first = files[2].read_text(encoding="utf-8")
        tomllib.loads(files[0].read_text(encoding="utf-8"))
        one_seed(monkeypatch)
        code, _, _ = run(capsys, "tune", "lilibot", "--candidates", "0", "--resume", *MI)
        assert code == 0
        assert files[2].read_text(encoding="utf-8") == first
        assert "Interrupted" not in files[1].read_text(encoding="utf-8")

    def test_ctrl_c_before_anything_was_found_leaves_nothing(tmp_path: Path) -> None:
        code, shown = interrupted(*APNC, "tune", "lilibot", at="preparing", cwd=tmp_path)
        assert code == 130
        assert re.search("interrupted(, nothing recorded| before a robot was found)", shown)
        assert "Traceback" not in shown
        assert list(tmp_path.iterdir()) == []

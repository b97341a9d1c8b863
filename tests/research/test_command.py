"""``python -m research.NAME``: every study of the registry runs from a checkout."""

from __future__ import annotations

import csv
import runpy
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from apnc.studies.registry import STUDIES as OF_THE_PRODUCT
from apnc.studies.runner import grid_of, run_study
from apnc.studies.study import load
from research.registry import STUDIES

ROOT = Path(__file__).resolve().parents[2]


def run(name: str, *words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", f"research.{name}", *words]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


Here = Callable[..., str]
here_ignores = pytest.mark.filterwarnings("ignore:.*found in sys.modules")


@pytest.fixture
def here(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Here:
    """Runs a command in this process, which is faster, and gives what it prints."""

    def printed(name: str, *words: str) -> str:
        monkeypatch.setattr(sys, "argv", [name, *words])
        with pytest.raises(SystemExit) as end:
            runpy.run_module(f"research.{name}", run_name="__main__")
        said = capsys.readouterr()
        assert end.value.code == 0, said.err
        return said.out

    return printed


@here_ignores
@pytest.mark.parametrize("name", STUDIES)
def test_every_study_has_its_command_and_options(name: str, here: Here) -> None:
    said = here(name, "--help")
    assert STUDIES[name].title in said
    for option in (*STUDIES[name].options, "trials", "resume", "workers", "scheduler", "output"):
        assert f"--{option} " in said


@pytest.mark.parametrize("name", STUDIES)
def test_a_study_has_its_entry_and_the_axes_that_are_its_options(name: str) -> None:
    study = load(STUDIES[name])
    assert study.entry == STUDIES[name] and name not in OF_THE_PRODUCT
    assert set(STUDIES[name].options) - {"robot"} == set(study.axes)


@here_ignores
def test_a_study_writes_what_those_of_the_product_write_and_goes_on(
    tmp_path: Path, here: Here
) -> None:
    words = ("--mi", "0.08,0.12", "--duration", "1", "--output", str(tmp_path))
    some = ("--trials", "1", "--workers", "1")
    assert "2 trials" in here("symmetry", *words, *some)
    with (tmp_path / "trials.csv").open() as file:
        results = list(csv.DictReader(file))
    assert {result["study"] for result in results} == {"symmetry"}
    assert {result["key"].partition("-")[2] for result in results} != {""}  # the code of research
    assert "Equal loads" in (tmp_path / "report.html").read_text()
    assert "legs stay in phase" in (tmp_path / "claims.md").read_text()
    kept = (tmp_path / "trials.jsonl").read_text()
    here("symmetry", *words, *some, "--resume")
    assert (tmp_path / "trials.jsonl").read_text() == kept


def test_a_mistake_is_one_line_that_names_the_program() -> None:
    done = run("contact", "--steps", "9")
    assert done.returncode == 2
    assert done.stderr.startswith("python -m research.contact: steps '9' is not one of 12, 24")
    assert len(done.stderr.strip().splitlines()) == 1


def test_the_product_does_not_know_these_studies() -> None:
    with pytest.raises(ValueError, match="study 'symmetry' is not one of mi, rate"):
        run_study("symmetry", trials=1)
    assert grid_of("symmetry", 1, studies=STUDIES)

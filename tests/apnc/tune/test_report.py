"""The page of a tuned robot: one small file that says what was found, and draws in a browser."""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import pytest
from browser import console_lines, look, needs_browser
from made_up_tuned import tuned, validation

from apnc.tune import Tuned
from apnc.tune.log import Log
from apnc.tune.report import film, render, write_report
from apnc_plant.robot import load_robot

LARGEST = 2_500_000
"""Size of the largest page [bytes]."""

NEVER = validation({(kind, k): 4 for kind in ("walk", "apc", "varied") for k in range(5)})
OVER_MI = {"plot-formed", "plot-walked"}
OVER_TIME = {"plot-gait", "plot-phi"}


def weak() -> Tuned:
    """A robot that cannot hold itself."""
    robot = load_robot("lilibot")
    servo = replace(robot.servo, stiffness=0.2, damping=0.01, stall_torque=0.02)
    return tuned(NEVER, replace(robot, servo=servo))


def written(of: Tuned, folder: Path) -> str:
    output = folder / "tuned.toml"
    log = Log(output.with_suffix(".csv"))
    log.begin(["a1"], {"seed": 1}, resume=False)
    log.write_check(0, 5.0)
    log.write(0, [[0.1], [0.7]], [30.0, 4.0])  # type: ignore[list-item]
    log.write_check(1, 3.0)
    write_report(output.with_suffix(".html"), of, output)
    return output.with_suffix(".html").read_text(encoding="utf-8")


def test_the_page_says_what_was_found_and_what_to_do_with_it(tmp_path: Path) -> None:
    page = written(tuned(validation({("apc", 1): 3})), tmp_path)
    assert len(page.encode()) < LARGEST
    for words in (
        "Trot at 5 of 5 MI", "<h2>Not reached</h2>",
        "with APC alone, aimed at 4 of 4 in a trot that holds: 1 at MI 0.11",
        f"apnc walk --robot {tmp_path / 'tuned.toml'} --engine compiled", "apnc study mi --robot",
        "apnc build --robot", "apnc tune lilibot --candidates 32 --seed 1",
        "<code>controller.a1</code></td><td>0.14</td><td>0.2</td><td>rad",
    ):  # fmt: skip
        assert words in page
    text = re.sub(r"<script.*?</script>", "", page, flags=re.DOTALL)
    assert not re.findall(r'(?:src|href)="(?!data:,)', text)


def test_a_robot_that_never_walks_has_a_page_that_says_so(tmp_path: Path) -> None:
    page = written(weak(), tmp_path)
    assert "No trot that walks" in page
    assert "of the walk shown here" in page
    assert "in a trot that holds: 0 at MI 0.08, 0 at MI 0.11" in page


def test_an_interrupted_search_has_a_page(tmp_path: Path) -> None:
    page = written(tuned(None), tmp_path)
    assert "Trot at 11 of 11 MI" in page
    assert "--resume goes on with it" in page
    assert "Not reached" not in page


def test_without_a_log_there_is_no_progress(tmp_path: Path) -> None:
    assert "plot-progress" not in render(tuned(validation()), tmp_path / "tuned.toml")


def test_the_film_is_the_walk_of_the_line_to_paste() -> None:
    of = tuned(None)
    record = film(of)
    assert record.complete and record.ended_at == pytest.approx(20.0)
    assert (record.experiment.mi, record.experiment.seed) == (of.robot.mi, 0)
    fast = film(replace(of, robot=replace(of.robot, rate=300.0)))
    assert len(fast) == 2400


@needs_browser
@pytest.mark.parametrize(
    ("of", "plots"),
    [
        (lambda: tuned(validation()), OVER_MI | OVER_TIME),
        (weak, OVER_MI),
        (lambda: tuned(None), OVER_TIME),
    ],
    ids=["walks", "never walks", "interrupted"],
)
def test_the_page_draws_without_an_error(of: object, plots: set[str], tmp_path: Path) -> None:
    assert callable(of)
    written(of(), tmp_path)
    ready = "<script>window.apncReady = () => { apnc.drawAll(); return true; };</script>"
    seen, log = look(tmp_path / "tuned.html", tmp_path, ready)
    assert seen["errors"] == [] and console_lines(log) == []
    assert plots | {"plot-progress"} <= set(seen["plots"])
    assert seen["robot"] > 5

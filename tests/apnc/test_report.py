"""The report is one file, asks the network for nothing, and draws in a real browser."""

from __future__ import annotations

import html.parser
import re
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import console_lines, look, needs_browser
from records import FEMUR, TIBIA, TRIPOD, synthetic_record

from apnc.loop.recording import Record
from apnc.report import write_report
from apnc.report.skeleton import leg_chains
from apnc.report.wording import verdicts
from apnc.summary import Summary, summarise
from exudyn_models.robot.file import load_robot

LILIBOT = load_robot("lilibot")


def summary_of(record: Record) -> Summary:
    return summarise(record, method="apnc", mi=0.08, seed=0)


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    record = synthetic_record(45.0, formation=(2.0, 8.0))
    return write_report(
        record, summary_of(record), tmp_path_factory.mktemp("r") / "report.html", LILIBOT
    )


class Resources(html.parser.HTMLParser):
    """Everything an HTML file would load from elsewhere."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        wanted = [v for k, v in attrs if k in ("src", "href", "data", "srcset") and v]
        self.found += [v for v in wanted if v != "data:,"]


def test_page_loads_nothing_from_elsewhere(report: Path) -> None:
    text = report.read_text(encoding="utf-8")
    parser = Resources()
    parser.feed(text)
    assert parser.found == []
    # The browser enforces it, too: no fetch, no image, no font from anywhere.
    assert "default-src 'none'" in text
    css = re.search(r"<style>(.*?)</style>", text, re.DOTALL)
    assert css and "url(" not in css[1] and "@import" not in css[1]


def test_45_seconds_fit_into_8_megabytes(report: Path) -> None:
    assert report.stat().st_size < 8e6


@needs_browser
def test_page_draws_in_a_browser(report: Path, tmp_path: Path) -> None:
    seen, log = look(report, tmp_path)
    assert seen["errors"] == []
    assert console_lines(log) == []
    keys = {"gait", "phi", "grf", "cpg", "gamma", "kappa", "speed", "torque", "path"}
    assert set(seen["plots"]) == {f"plot-{key}" for key in keys}
    assert min(seen["plots"].values()) >= 1
    assert seen["robot"] > 20


@needs_browser
def test_controls_move_the_animation_and_link_the_plots(report: Path, tmp_path: Path) -> None:
    steps = """<script>window.apncProbe = () => {
      const image = () => document.getElementById("robot").toDataURL();
      apnc.player.pause();
      apnc.player.seek(10.0); const first = image();
      apnc.player.seek(10.3); const second = image();
      document.querySelector("[data-view=top]").click(); const third = image();
      document.querySelector("[data-window=first]").click();
      return { moved: first !== second, turned: second !== third,
        clock: document.getElementById("clock").textContent,
        cursor: document.querySelectorAll(".cursor").length,
        ranges: apnc.plots.filter((p) => p.overTime).map((p) => p.element.layout.xaxis.range) };
    };</script>"""
    seen, log = look(report, tmp_path, steps)
    assert console_lines(log) == [] and seen["errors"] == []
    assert seen["moved"] and seen["turned"]
    assert seen["clock"].startswith("10.30 /")
    assert seen["cursor"] == len(seen["ranges"]) == 8
    assert all(r == [0, 10] for r in seen["ranges"])


@needs_browser
def test_probe_notices_a_broken_page(report: Path, tmp_path: Path) -> None:
    seen, log = look(report, tmp_path, "<script>notDefinedAnywhere();</script>")
    assert "notDefinedAnywhere" in seen["errors"][0]
    assert console_lines(log)


@needs_browser
@pytest.mark.parametrize("samples", [0, 1, 7])
def test_an_interrupted_run_has_a_report(samples: int, tmp_path: Path) -> None:
    record = synthetic_record(samples / 60, complete=False)
    page = write_report(record, summary_of(record), tmp_path / "report.html", LILIBOT)
    seen, log = look(page, tmp_path)
    assert seen["errors"] == [] and console_lines(log) == []
    assert "interrupted" in page.read_text(encoding="utf-8")
    assert (seen["robot"] > 20) is (samples > 0)


@needs_browser
def test_six_legs_and_undefined_samples_are_drawn(tmp_path: Path) -> None:
    record = synthetic_record(5.0, TRIPOD)
    record.controller["gamma"][100:120] = np.nan
    page = write_report(record, summary_of(record), tmp_path / "report.html")
    seen, log = look(page, tmp_path)
    assert seen["errors"] == [] and console_lines(log) == []
    assert seen["robot"] > 20


def test_text_of_the_run_is_escaped(tmp_path: Path) -> None:
    record = synthetic_record(1.0)
    summary = replace(summary_of(record), method="<script>alert(1)</script>")
    text = write_report(record, summary, tmp_path / "r.html").read_text(encoding="utf-8")
    assert "alert(1)" in text
    assert "<script>alert(1)" not in text


def test_knees_close_the_legs() -> None:
    record = synthetic_record(3.0, roll_amplitude=0.0, pitch_amplitude=0.0, yaw=0.7)
    hip1, hip2, knee, foot = np.moveaxis(leg_chains(record, LILIBOT), 2, 0)
    assert np.linalg.norm(hip2 - hip1, axis=-1) == pytest.approx(0.03)
    assert np.linalg.norm(knee - hip2, axis=-1) == pytest.approx(FEMUR)
    # Holds only if the knee found from the angles fits the recorded foot.
    assert np.linalg.norm(foot - knee, axis=-1) == pytest.approx(TIBIA)


def test_positive_hip_and_knee_swing_forward() -> None:
    record = synthetic_record(0.1, roll_amplitude=0.0, pitch_amplitude=0.0)
    before = leg_chains(record, LILIBOT)[0, :, 2, 0]
    record.plant["joint_angle"][..., 1] += 0.1
    assert np.all(leg_chains(record, LILIBOT)[0, :, 2, 0] > before)


def test_pitch_and_roll_tilt_the_hips() -> None:
    record = synthetic_record(0.1)
    record.plant["rpy"][:] = [0.1, 0.0, 0.0]
    hips = leg_chains(record, LILIBOT)[0, :, 0, 2]
    # Positive roll lifts the left side (y > 0); legs are RF, RH, LF, LH.
    assert hips[2:].min() > hips[:2].max()
    record.plant["rpy"][:] = [0.0, 0.1, 0.0]
    hips = leg_chains(record, LILIBOT)[0, :, 0, 2]
    # Positive pitch lowers the nose.
    assert hips[[0, 2]].max() < hips[[1, 3]].min()


def test_robot_without_a_leg_of_the_record_is_refused(tmp_path: Path) -> None:
    record = synthetic_record(0.5, TRIPOD)
    with pytest.raises(ValueError, match="has no leg RM, LM"):
        write_report(record, summary_of(record), tmp_path / "r.html", LILIBOT)


@pytest.mark.parametrize(
    ("change", "answers"),
    [
        ({}, ["Yes", "After 2.0 s"]),
        ({"fell": True}, ["It fell", "After 2.0 s"]),
        ({"path_speed_m_per_s": 0.001}, ["No", "After 2.0 s"]),
        ({"speed_m_per_s": -0.05}, ["Not forward", "After 2.0 s"]),
        ({"converged": False}, ["Yes", "Not for good"]),
        ({"converged": False, "convergence_time_authors_s": None}, ["Yes", "No"]),
    ],
)
def test_header_says_what_happened(change: dict[str, Any], answers: list[str]) -> None:
    base = replace(summary_of(synthetic_record(10.0)), convergence_time_s=2.0)
    found = verdicts(replace(base, **change))
    assert [v.answer for v in found[:2]] == answers


@pytest.mark.parametrize("breaks", [lambda p: p / "missing" / "r.html", lambda p: p])
def test_an_unwritable_path_is_an_os_error(breaks: Callable[[Path], Path], tmp_path: Path) -> None:
    record = synthetic_record(0.5)
    with pytest.raises(OSError):
        write_report(record, summary_of(record), breaks(tmp_path))

"""The report is one file, asks the network for nothing, and draws in a real browser."""

from __future__ import annotations

import html.parser
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import console_lines, look, needs_browser
from records import FEMUR, TIBIA, TRIPOD, synthetic_record

from apnc.features import WalkFeatures, walk_features
from apnc.loop.experiment import Experiment
from apnc.loop.record import End, Record
from apnc.report.page import drawable, render
from apnc.report.samples import SHOWN
from apnc.report.skeleton import leg_chains, trunk_corners
from apnc.report.wording import facts, heading, rows, verdicts
from apnc_plant.conditions import Conditions
from apnc_plant.ground import Obstacles

KEYS = {
    *("gait", "phi", "speed", "path", "trunk", "clearance", "grf", "cpg"),
    *("gamma", "kappa", "hip", "knee", "torque"),
}


def diverged(seconds: float = 5.0, broken: int = 20) -> Record:
    """A run whose last samples are those of a diverged motion."""
    record = synthetic_record(seconds)
    for k in range(broken):
        size = 10.0 ** (5 + 15 * k) if k < 19 else np.nan
        for name in ("position", "velocity", "joint_angle", "foot_force", "foot_position"):
            record.signals[name][len(record) - broken + k] = size
    return replace(record, end=End.diverged, message="the motion diverged")


def long_run() -> Record:
    record = synthetic_record((SHOWN + 600) / 60.0)
    ground = Obstacles(roughness=0.5)
    return replace(record, experiment=replace(record.experiment, ground=ground))


RUNS = {
    "complete": lambda: synthetic_record(12.0, formation=(2.0, 8.0)),
    "fell": lambda: replace(synthetic_record(3.0), end=End.fell),
    "interrupted": lambda: replace(synthetic_record(3.0), end=End.interrupted),
    "no tick": lambda: replace(synthetic_record(0.0), end=End.interrupted),
    "one tick": lambda: replace(synthetic_record(1 / 60), end=End.interrupted),
    "seven ticks": lambda: replace(synthetic_record(7 / 60), end=End.fell),
    "hexapod": lambda: synthetic_record(5.0, TRIPOD),
    "diverged": diverged,
    "diverged at once": lambda: diverged(0.5, 30),
    "long": long_run,
}


def written(record: Record, path: Path) -> Path:
    path.write_text(render(record, walk_features(record)), encoding="utf-8")
    return path


@pytest.fixture(scope="module")
def report(tmp_path_factory: pytest.TempPathFactory) -> Path:
    record = synthetic_record(45.0, formation=(2.0, 8.0))
    return written(record, tmp_path_factory.mktemp("r") / "report.html")


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


# Starts and ends of the axes, and what the clock showed when the probe looked.
SEEN = """<script>
const clock = () => parseFloat(document.getElementById("clock")?.textContent);
window.apncReady = () => typeof apnc === "undefined" || clock() > apnc.window[0];
window.apncProbe = () => ({
  clock: clock(),
  starts: typeof apnc === "undefined" ? 0 : apnc.window[0],
  range: [...document.querySelectorAll(".js-plotly-plot")]
    .filter((p) => p.id !== "plot-path").map((p) => p.layout.xaxis.range),
  extent: [...document.querySelectorAll(".js-plotly-plot")].flatMap((p) =>
    Object.entries(p._fullLayout).flatMap(([k, axis]) => /^yaxis/.test(k) ? axis.range : [])),
});</script>"""


LONG = pytest.param("long", marks=pytest.mark.thorough)


@needs_browser
@pytest.mark.parametrize("name", [LONG if name == "long" else name for name in RUNS])
def test_page_draws_and_plays_in_a_browser(name: str, tmp_path: Path) -> None:
    record = RUNS[name]()
    seen, log = look(written(record, tmp_path / "report.html"), tmp_path, SEEN)
    assert seen["errors"] == []
    assert console_lines(log) == []
    if name in ("no tick", "diverged at once"):
        assert seen["plots"] == {} and seen["robot"] == 0
        return
    assert set(seen["plots"]) == {f"plot-{key}" for key in KEYS}
    assert min(seen["plots"].values()) >= 1
    assert seen["robot"] > 20
    if len(record) > 60:
        assert seen["clock"] > seen["starts"]
    # A diverged end does not flatten what was before it.
    assert max(map(abs, seen["extent"])) < 1000.0
    if name == "long":
        assert np.array(seen["range"]) == pytest.approx(
            np.broadcast_to([record.time[-1] - 10.0, record.time[-1]], (12, 2)), abs=0.2
        )


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
    assert seen["cursor"] == len(seen["ranges"]) == len(KEYS) - 1
    assert all(r == [0, 10] for r in seen["ranges"])


@needs_browser
def test_the_ground_is_drawn_as_its_lines_say(tmp_path: Path) -> None:
    colours = []
    for roughness in (0.0, 1.0):
        record = synthetic_record(2.0)
        ground = Obstacles(roughness=roughness)
        record = replace(record, experiment=replace(record.experiment, ground=ground))
        pause = (
            "<script>window.apncProbe = (painted) => { apnc.player.pause(); apnc.player.seek(1);"
        )
        count = """
          const context = document.getElementById("robot").getContext("2d");
          const { data } = context.getImageData(0, 0, 600, 300);
          let drawn = 0;
          for (let k = 3; k < data.length; k += 4) drawn += data[k] > 0;
          return { drawn }; };</script>"""
        seen, _ = look(written(record, tmp_path / "r.html"), tmp_path, pause + count)
        colours.append(seen["drawn"])
    assert colours[1] > 1.2 * colours[0]


@needs_browser
def test_probe_notices_a_broken_page(report: Path, tmp_path: Path) -> None:
    seen, log = look(report, tmp_path, "<script>notDefinedAnywhere();</script>")
    assert "notDefinedAnywhere" in seen["errors"][0]
    assert console_lines(log)


@needs_browser
def test_undefined_samples_are_gaps(tmp_path: Path) -> None:
    record = synthetic_record(5.0)
    record.signals["gamma"][100:120] = np.nan
    seen, log = look(written(record, tmp_path / "report.html"), tmp_path)
    assert seen["errors"] == [] and console_lines(log) == []


def test_text_of_the_run_is_escaped() -> None:
    record = synthetic_record(1.0)
    robot = replace(record.robot, name="<script>alert(1)</script>")
    text = render(replace(record, robot=robot), walk_features(record))
    assert "alert(1)" in text
    assert "<script>alert(1)" not in text


def test_the_end_of_a_diverged_motion_is_not_drawn_and_that_is_said() -> None:
    record = diverged(5.0, 20)
    shown = drawable(record)
    assert len(shown) == len(record) - 20
    assert all(len(v) == len(shown) for v in shown.signals.values())
    assert "From 4.67 s on the motion has no scale" in render(record, walk_features(record))
    # A sound run keeps all, whatever the numbers are.
    assert len(drawable(replace(record, end=End.complete))) == len(record)
    slow = synthetic_record(2.0)
    slow.signals["joint_work"][:] = 1e6
    assert len(drawable(replace(slow, end=End.diverged))) == len(slow)


def test_knees_close_the_legs() -> None:
    record = synthetic_record(3.0, roll_amplitude=0.0, pitch_amplitude=0.0, yaw=0.7)
    hip1, hip2, knee, foot = np.moveaxis(leg_chains(record.robot, record.signals), 2, 0)
    assert np.linalg.norm(hip2 - hip1, axis=-1) == pytest.approx(0.03)
    assert np.linalg.norm(knee - hip2, axis=-1) == pytest.approx(FEMUR)
    # Holds only if the knee found from the angles fits the recorded foot.
    assert np.linalg.norm(foot - knee, axis=-1) == pytest.approx(TIBIA)


def test_positive_hip_and_abduction_swing_forward_and_to_the_left() -> None:
    record = synthetic_record(0.1, roll_amplitude=0.0, pitch_amplitude=0.0)
    before = leg_chains(record.robot, record.signals)[0, :, 2]
    record.signals["joint_angle"][..., :2] += 0.1
    after = leg_chains(record.robot, record.signals)[0, :, 2]
    assert np.all(after[:, 0] > before[:, 0])
    assert np.all(after[:, 1] > before[:, 1])


@pytest.mark.parametrize("points", [leg_chains, trunk_corners])
def test_pitch_and_roll_tilt_the_robot(points: Any) -> None:
    record = synthetic_record(0.1)
    lower, upper = (
        (slice(0, 2), slice(2, 4)) if points is leg_chains else (slice(0, 4), slice(4, 8))
    )
    record.signals["rpy"][:] = [0.1, 0.0, 0.0]
    z = points(record.robot, record.signals)[0][..., 2].reshape(upper.stop, -1)[:, 0]
    # Positive roll lifts the left side (y > 0): legs LF and LH, the second half of the corners.
    assert z[upper].mean() > z[lower].mean() + 0.005
    record.signals["rpy"][:] = [0.0, 0.1, 0.0]
    front, hind = ([0, 2], [1, 3]) if points is leg_chains else ([2, 3, 6, 7], [0, 1, 4, 5])
    z = points(record.robot, record.signals)[0][..., 2].reshape(upper.stop, -1)[:, 0]
    # Positive pitch lowers the nose.
    assert z[front].mean() < z[hind].mean() - 0.005


GOOD = replace(walk_features(synthetic_record(10.0)), convergence_time_s=2.0)


@pytest.mark.parametrize(
    ("change", "answers", "moods"),
    [
        ({}, ["Yes", "After 2.0\xa0s"], ["good", "good"]),
        ({"end": "fell", "complete": False}, ["It fell", "–"], ["bad", "plain"]),
        ({"end": "diverged", "complete": False}, ["It diverged", "–"], ["bad", "plain"]),
        ({"end": "interrupted", "complete": False}, ["Interrupted", "After 2.0\xa0s"], None),
        ({"path_speed_m_per_s": 0.001}, ["No", "After 2.0\xa0s"], ["bad", "good"]),
        # Net displacement says nothing about a walk in a curve.
        ({"speed_m_per_s": -0.05, "distance_m": 0.1}, ["Yes", "After 2.0\xa0s"], None),
        ({"converged": False}, ["Yes", "Not for good"], ["good", "fair"]),
        ({"converged": False, "convergence_time_authors_s": None}, ["Yes", "No"], ["good", "bad"]),
        ({"converged": None}, ["Yes", "–"], ["good", "plain"]),
    ],
)
def test_head_says_what_happened(
    change: dict[str, Any], answers: list[str], moods: list[str] | None
) -> None:
    found = verdicts(replace(GOOD, **change), 10.0)
    assert [v.answer for v in found[:2]] == answers
    assert moods is None or [v.mood for v in found[:2]] == moods


@pytest.mark.parametrize("end", ["fell", "diverged", "interrupted"])
def test_an_early_end_is_said_with_its_time(end: str) -> None:
    walked = verdicts(replace(GOOD, end=end, complete=False, duration_s=7.25), 45.0)[0]
    assert walked.detail.startswith("at 7.25\xa0s")
    table = {name: (value, note) for name, value, note in rows(replace(GOOD, end=end))}
    assert table["Simulated"][1] == end


def test_path_speed_and_turn_lead_and_what_is_undefined_is_a_dash() -> None:
    curve = replace(GOOD, path_speed_m_per_s=0.146, turned_deg=-204.0, distance_m=0.17)
    fast = verdicts(curve, 45.0)[2]
    assert fast.answer == "0.146\xa0m/s"
    assert "turned 204° to the right" in fast.detail
    names = [name for name, _, _ in rows(curve)]
    assert names[:3] == ["Speed along the path", "Turned", "Net displacement"]
    standing = replace(GOOD, balance=None, coordination=None, path_speed_m_per_s=None)
    table = {name: value for name, value, _ in rows(standing)}
    assert table["Balance"] == table["Coordination"] == table["Speed along the path"] == "–"
    notes = {name: note for name, _, note in rows(GOOD)}
    assert "larger is steadier" in notes["Balance"]
    assert "larger is more even" in notes["Coordination"]


def test_feet_are_told_one_by_one() -> None:
    legs = ("RF", "RH", "LF", "LH")
    feet = replace(
        GOOD,
        stride_length_mm=71.24,
        touch_downs_per_stride=1.26,
        touch_downs_by_leg=dict(zip(legs, (1.0, 2.0, 1.0, 1.04), strict=True)),
        slip_share=dict(zip(legs, (0.116, None, 0.0, 0.35), strict=True)),
    )
    table = {name: value for name, value, _ in rows(feet)}
    assert table["Stride length"] == "71.2\xa0mm"
    assert table["Touch-downs per stride"] == (
        "RF\xa01.00, RH\xa02.00, LF\xa01.00, LH\xa01.04; mean 1.26"
    )
    assert table["Slip share"] == "RF\xa012, RH\xa0–, LF\xa00, LH\xa035"


def test_target_gait_has_its_name() -> None:
    six: WalkFeatures = walk_features(synthetic_record(5.0, TRIPOD))
    assert verdicts(six, 5.0)[1].question == "Did the tripod form?"
    assert "Tripod, strict" in [name for name, _, _ in rows(six)]


def test_heading_says_what_is_not_default() -> None:
    assert heading(Experiment()) == "all as by default"
    experiment = Experiment(
        robot="hexapod",
        preset="paper",
        mi=((0.0, 0.15), (25.0, 0.4)),
        conditions="C4",
        ground=Obstacles(roughness=0.5),
        settings={"xi": 0.05},
        rate=50.0,
    )
    expected = (
        "hexapod, MI 0:0.15,25:0.4, preset paper, obstacles:roughness=0.5, C4, rate 50 Hz, xi 0.05"
    )
    assert heading(experiment) == expected
    damaged = Conditions(damaged=("RF",), payload=0.5)
    assert heading(Experiment(conditions=damaged)) == "payload 0.5, damaged RF"


def test_facts_name_robot_preset_condition_ground_parameters_and_memory() -> None:
    record = synthetic_record(0.1)
    experiment = replace(
        record.experiment,
        conditions="C4",
        ground=Obstacles(roughness=0.5),
        settings={"xi": 0.05, "stored": True, "phi_stored": (3.0, 3.0, 0.0)},
    )
    found = dict(facts(replace(record, experiment=experiment)))
    assert found["Robot"] == "lilibot, 2.50 kg, legs RF, RH, LF, LH"
    assert found["Controller"] == "apnc, preset robot, 60 Hz"
    assert found["Changed parameters"] == "xi 0.05, stored True"
    assert found["Stored gait"] == "φ 3 3 0 rad at the start"
    assert found["Conditions"] == "C4"
    assert found["Ground"] == "obstacles:roughness=0.5"
    assert dict(facts(record))["Stored gait"] == "none at the start"


def test_page_carries_the_whole_experiment_and_the_command() -> None:
    record = synthetic_record(1.0)
    text = render(record, walk_features(record))
    assert f"<code>{record.experiment.command()}</code>" in text
    for name in ("robot_weight", "numpy", "conditions"):
        assert f"<code>{name}</code>" in text

"""The report is one file, asks the network for nothing, and draws in a real browser."""

from __future__ import annotations

import html.parser
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from browser import console_lines, look, needs_browser
from records import TRIPOD, synthetic_record

import apnc
from apnc.features import walk_features
from apnc.loop.record import End, Record
from apnc.report.page import drawable, render
from apnc.report.samples import SHOWN
from apnc.report.skeleton import leg_chains, trunk_corners
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


def test_45_seconds_fit_into_two_and_a_half_megabytes(report: Path) -> None:
    assert report.stat().st_size < 2.5e6


# Starts and ends of the axes, and what the clock showed when the probe looked.
SEEN = """<script>
const clock = () => parseFloat(document.getElementById("clock")?.textContent);
// a page of one tick never moves
window.apncReady = () =>
  typeof apnc === "undefined" || clock() > apnc.window[0] || performance.now() > 8000;
window.apncProbe = () => ({
  far: document.querySelectorAll(".js-plotly-plot").length,
  ...(typeof apnc === "undefined" ? {} : apnc.drawAll()),
  drawn: Object.fromEntries([...document.querySelectorAll(".js-plotly-plot")]
    .map((p) => [p.id, p.querySelectorAll("svg.main-svg").length])),
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
    # Plots far below the first screen wait until they are scrolled to.
    assert seen["far"] < len(KEYS) / 2
    assert set(seen["drawn"]) == {f"plot-{key}" for key in KEYS}
    assert min(seen["drawn"].values()) >= 1
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
      apnc.drawAll();
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
def test_the_first_screen_shows_verdicts_robot_gait_and_controls(
    report: Path, tmp_path: Path
) -> None:
    probe = """<script>window.apncProbe = () => ({
      bottoms: [".verdict", "#robot", "#strip", "#play"].map((s) =>
        document.querySelector(s).getBoundingClientRect().bottom),
      high: innerHeight, wide: document.documentElement.scrollWidth - innerWidth,
    });</script>"""
    seen, _ = look(report, tmp_path, probe)
    assert seen["bottoms"] == sorted(seen["bottoms"])
    assert seen["bottoms"][0] > 0 and seen["bottoms"][-1] < seen["high"]
    assert seen["wide"] <= 0


@needs_browser
def test_the_page_places_joints_and_trunk_as_they_were(tmp_path: Path) -> None:
    record = synthetic_record(5.0, roll_amplitude=0.2, pitch_amplitude=0.1, yaw=0.7)
    probe = """<script>window.apncProbe = () => {
      const scene = new apnc.Scene(document.getElementById("robot"), apnc.data.animation);
      const i = 200, four = [0, 1, 2, 3], eight = [0, 1, 2, 3, 4, 5, 6, 7];
      const corners = eight.map((k) => scene.placed(i, scene.vector(scene.corners, k)));
      const legs = four.map((leg) => four.map((joint) => scene.point(i, leg, joint)));
      return { corners, legs, track: scene.track(i) };
    };</script>"""
    seen, _ = look(written(record, tmp_path / "r.html"), tmp_path, probe)
    at = {name: values[200:201] for name, values in record.signals.items()}
    assert np.array(seen["legs"]) == pytest.approx(leg_chains(record.robot, at)[0], abs=1e-5)
    assert np.array(seen["corners"]) == pytest.approx(trunk_corners(record.robot, at)[0], abs=1e-6)
    assert seen["track"] == pytest.approx([*at["position"][0, :2], 0.0], abs=1e-6)


@needs_browser
def test_a_page_is_printed_light_with_all_plots(report: Path, tmp_path: Path) -> None:
    probe = """<script>window.apncProbe = () => {
      const widths = () => [...document.querySelectorAll(".js-plotly-plot")].map(
        (p) => p._fullLayout.width);
      window.dispatchEvent(new Event("beforeprint"));
      const printed = { widths: widths(), open: document.getElementById("run").open };
      window.dispatchEvent(new Event("afterprint"));
      return { printed, after: widths(), open: document.getElementById("run").open };
    };</script>"""
    seen, log = look(report, tmp_path, probe)
    assert console_lines(log) == [] and seen["errors"] == []
    assert seen["printed"] == {"widths": [680] * len(KEYS), "open": True}
    assert min(seen["after"]) > 1000 and seen["open"] is False


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
    assert "From 4.67 s on the motion is not drawn" in render(record, walk_features(record))
    # A sound run keeps all, whatever the numbers are.
    assert len(drawable(replace(record, end=End.complete))) == len(record)
    slow = synthetic_record(2.0)
    slow.signals["joint_work"][:] = 1e6
    assert len(drawable(replace(slow, end=End.diverged))) == len(slow)


def test_page_carries_the_whole_experiment_and_the_command() -> None:
    record = synthetic_record(1.0)
    text = render(record, walk_features(record))
    assert f"<code>{record.experiment.command()}</code>" in text
    for name in ("robot_weight", "numpy", "conditions"):
        assert f"<code>{name}</code>" in text


def test_a_page_of_six_legs_and_45_s_has_at_most_2_mb() -> None:
    record = apnc.simulate(apnc.Experiment(robot="hexapod", engine="compiled"))
    assert len(render(record, walk_features(record)).encode()) <= 2_000_000

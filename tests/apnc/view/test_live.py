"""A watched walk: the page gets every sample, its pushes are in the record, and a stop ends it."""

from __future__ import annotations

import json
import math
import os
import signal
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import numpy as np
import pytest

pytest.importorskip("websockets")

from browser import needs_browser
from command_line import run
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

import apnc
from apnc.cli import live as cli_live
from apnc.loop.simulate import plant_of
from apnc.view.live import LiveView
from apnc_plant.compiled import CompiledPlant
from apnc_plant.ground import Obstacles

if os.name != "nt":
    from driven import driven
    from terminal import APNC, interrupted

N = 4
ROW = 9 + 14 * N


class Page(threading.Thread):
    """What a page does, without a browser: it notes what it is told and asks for things."""

    def __init__(self, address: str, asks: dict[int, Any]) -> None:
        super().__init__(daemon=True)
        parts = urlsplit(address)
        self._address, self._origin = (
            f"ws://{parts.netloc}{parts.path}live",
            f"http://{parts.netloc}",
        )
        self.rows: list[np.ndarray] = []
        self.told: list[dict[str, Any]] = []
        self._asks = asks
        self.start()

    def run(self) -> None:
        with suppress(ConnectionClosed), connect(self._address, origin=self._origin) as socket:  # type: ignore[arg-type]
            for message in socket:
                if isinstance(message, str):
                    self.told.append(json.loads(message))
                    continue
                self.rows.extend(np.frombuffer(message).reshape(-1, ROW))
                for at in [at for at in self._asks if at <= len(self.rows)]:
                    socket.send(json.dumps(self._asks.pop(at)))

    def all(self, name: str) -> list[Any]:
        return [message[name] for message in self.told if name in message]


def watched(
    experiment: apnc.Experiment, asks: dict[int, Any], speed: float = math.inf, **more: Any
) -> tuple[apnc.Record, Page, LiveView]:
    plant = plant_of(experiment)
    view = LiveView(experiment, plant, speed, **more)
    page = Page(view.address, asks)
    view.wait_for_page()
    record = apnc.simulate(experiment, plant=plant, watch=view.watch, **more)
    view.end("done")
    page.join(timeout=20)
    return record, page, view


@pytest.mark.parametrize("engine", ["compiled", "exudyn", "mujoco"])
def test_a_page_sees_the_walk_and_its_push_is_in_the_record(engine: str) -> None:
    experiment = apnc.Experiment(duration=2.0, engine=engine)
    record, page, view = watched(experiment, {20: {"push": [0.3, -0.6]}}, speed=2.0)
    rows, signals = np.array(page.rows), record.signals
    assert len(rows) == len(record) == 120
    assert (rows[:, 0] == record.time).all()
    assert (rows[:, 1:4] == signals["position"]).all()
    assert (rows[:, 4:7] == signals["rpy"]).all()
    force = rows[:, 10 + 9 * N : 10 + 12 * N].reshape(-1, N, 3)
    assert (force == signals["foot_force"]).all()
    assert (rows[:, -3:] == np.vstack([np.zeros(3), signals["phi"]])[1:]).all()
    (push,) = record.experiment.pushes
    assert (push.x, push.y) == (0.3, -0.6) and push.at >= 19 / 60 - 1e-9
    assert page.all("pushed") == [[push.at, 0.3, -0.6]]
    assert page.all("over") == ["done"]
    assert "--push" in record.experiment.command()
    again = apnc.simulate(record.experiment)
    assert all(np.array_equal(values, again.signals[name]) for name, values in signals.items())
    assert view.behind < 1.0


def test_an_engine_that_is_too_slow_tells_how_far_it_is_behind(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    advance = CompiledPlant.advance

    def slowly(self: CompiledPlant, *arguments: Any) -> None:
        time.sleep(0.03)
        advance(self, *arguments)

    monkeypatch.setattr(CompiledPlant, "advance", slowly)
    _, page, view = watched(apnc.Experiment(duration=1.0, engine="compiled"), {}, speed=1.0)
    assert view.behind > 59 * (0.03 - 1 / 60) - 0.1
    status = page.all("status")[-1]
    assert status["wanted"] == 1.0 and status["behind"] == pytest.approx(view.behind, abs=0.5)


def test_a_pause_holds_the_walk_and_a_stop_ends_it() -> None:
    stopped = threading.Event()
    experiment = apnc.Experiment(duration=600.0, engine="compiled")

    def after_a_while() -> None:
        time.sleep(1.5)
        stopped.set()

    threading.Thread(target=after_a_while, daemon=True).start()
    record, page, _ = watched(experiment, {5: {"pause": True}}, speed=1.0, stop=stopped.is_set)
    assert record.end is apnc.End.interrupted
    assert 4 <= len(record) < 60
    assert page.all("status")[-1]["paused"]


def test_without_a_page_the_walk_goes_on_as_fast_as_it_can(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("apnc.view.live.ALONE", 0.0)
    experiment = apnc.Experiment(duration=20.0, engine="compiled")
    plant = plant_of(experiment)
    view = LiveView(experiment, plant, 0.01)
    record = apnc.simulate(experiment, plant=plant, watch=view.watch)
    view.end("done")
    assert record.complete


def test_the_ground_follows_the_robot() -> None:
    ground = Obstacles(roughness=0.5)
    experiment = apnc.Experiment(duration=0.1, engine="compiled", ground=ground)
    plant = plant_of(experiment)
    view = LiveView(experiment, plant, math.inf)
    try:
        sample, controller = plant.sample(), type("C", (), {"phi": np.zeros(3)})()
        view.watch(0.0, sample, controller)
        assert not any("ground" in str(note) for note in view._notes)
        far = sample | {"position": sample["position"] + [30.0, 0.0, 0.0]}
        for n in range(10):
            view.watch(n / 60, far, controller)
        grounds = [json.loads(note) for note in view._notes if "ground" in str(note)[:12]]
        assert grounds
    finally:
        view.close()


STAYS = """
import signal, sys
from urllib.parse import urlsplit
from websockets.sync.client import connect
signal.signal(signal.SIGINT, signal.SIG_IGN)  # a browser is in a session of its own
signal.signal(signal.SIGTERM, signal.SIG_IGN)
parts = urlsplit(sys.argv[1])
with connect(f"ws://{parts.netloc}{parts.path}live", origin=f"http://{parts.netloc}") as page:
    for _ in page:
        pass
"""


@pytest.fixture
def stays(tmp_path: Path) -> dict[str, str]:
    """A browser that shows the page until the walk ends."""
    script = tmp_path / "stays.py"
    script.write_text(STAYS)
    return {"BROWSER": f"{sys.executable} {script} %s"}


@pytest.mark.skipif(os.name == "nt", reason="uses a terminal of the system")
@pytest.mark.parametrize("by", [signal.SIGINT, signal.SIGTERM])
def test_an_interrupt_ends_a_watched_walk_and_keeps_the_record(
    by: signal.Signals, tmp_path: Path, stays: dict[str, str]
) -> None:
    words = ("walk", "--view", "--engine", "compiled", "--duration", "300")
    code, shown = interrupted(*APNC, *words, at=r"1\.\d s", cwd=tmp_path, env=stays, by=by)
    assert code == 128 + by
    assert "interrupted at" in shown and "Traceback" not in shown
    summary = json.loads((tmp_path / "apnc-walk" / "summary.json").read_text())
    assert summary["end"] == "interrupted" and 1.0 <= summary["duration_s"] < 60.0


@pytest.mark.skipif(os.name == "nt", reason="uses a terminal of the system")
def test_an_interrupt_before_a_page_is_open_leaves_nothing(tmp_path: Path) -> None:
    command = (*APNC, "walk", "--view", "--engine", "compiled")
    none = {"BROWSER": f"{sys.executable} -c pass %s"}
    code, shown = interrupted(*command, at="waiting for the page", cwd=tmp_path, env=none)
    assert code == 130 and "nothing recorded" in shown and "Traceback" not in shown
    assert not (tmp_path / "apnc-walk" / "summary.json").exists()


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--view-speed", "2"], "--view-speed is taken with --view only"),
        (["--view", "--view-speed", "0"], "--view-speed is 0.0; allowed: 0.01 to 100"),
        (["--view", "--view-speed", "nan"], "--view-speed is nan; allowed"),
    ],
)
def test_a_speed_that_makes_no_sense_is_refused_in_a_line(
    words: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, "walk", *words)
    assert (code, out) == (2, "") and said in err


def test_without_the_extra_the_message_names_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(cli_live.importlib.util, "find_spec", lambda name: None)
    code, _, err = run(capsys, "walk", "--view")
    assert code == 2 and "--view needs the extra 'view': pip install" in err


@pytest.fixture
def shown(tmp_path: Path) -> Iterator[tuple[Any, LiveView, dict[str, Any]]]:
    """A walk that goes on until it is stopped, in a browser."""
    stop, found = threading.Event(), {}
    experiment = apnc.Experiment(duration=600.0, engine="compiled")
    plant = plant_of(experiment)
    view = LiveView(experiment, plant, 1.0, stop.is_set)

    def walk() -> None:
        found["record"] = apnc.simulate(experiment, plant=plant, watch=view.watch, stop=stop.is_set)
        view.end("stopped")

    thread = threading.Thread(target=walk, daemon=True)
    with driven(tmp_path) as browser:
        browser.size(1400, 900)
        browser.open(view.address)
        view.wait_for_page()
        thread.start()
        found["stop"] = lambda: (stop.set(), thread.join(timeout=20))
        yield browser, view, found
        stop.set()
    thread.join(timeout=20)


PAINTED = """(() => {
  const canvas = document.getElementById("robot");
  const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
  return new Set(new Uint32Array(data.buffer)).size;
})()"""


@needs_browser
@pytest.mark.skipif(os.name == "nt", reason="drives the browser through pipes")
def test_the_page_draws_pushes_and_pauses_in_a_browser(
    shown: tuple[Any, LiveView, dict[str, Any]],
) -> None:
    browser, _, found = shown
    browser.until('typeof apnc !== "undefined" && apnc.live && apnc.live.scene.count > 30')
    assert browser.until(PAINTED) > 20
    box = browser.value(
        "(({x, y, width, height}) => [x + width / 2, y + height / 2])"
        '(document.getElementById("robot").getBoundingClientRect())'
    )
    azimuth = browser.value("apnc.live.scene.azimuth")
    browser.mouse("mousePressed", *box, shift=True)
    browser.mouse("mouseMoved", box[0] + 80, box[1], shift=True)
    browser.mouse("mouseReleased", box[0] + 80, box[1], shift=True)
    browser.until('document.getElementById("pushed").textContent.startsWith("pushed 0.80 N s")')
    assert browser.value("apnc.live.scene.azimuth") == azimuth
    browser.mouse("mousePressed", *box)
    browser.mouse("mouseMoved", box[0] + 80, box[1])
    browser.mouse("mouseReleased", box[0] + 80, box[1])
    browser.until(f"apnc.live.scene.azimuth !== {azimuth}")
    browser.value('document.getElementById("push").click()')
    browser.until('document.getElementById("pushed").textContent.startsWith("pushed 1.1")')
    browser.value('document.getElementById("play").click()')
    browser.until('apnc.live.paused() && document.getElementById("state").textContent === "paused"')
    browser.size(390, 844, dark=True)
    assert (
        browser.until("innerWidth === 390")
        and browser.value("document.documentElement.scrollWidth") == 390
    )
    assert browser.value("window.apncErrors") == []
    found["stop"]()
    browser.until('document.getElementById("message").textContent.includes("stopped")')
    pushes = found["record"].experiment.pushes
    assert len(pushes) == 2
    # to the right on the screen, as the first view shows the ground
    assert math.atan2(pushes[0].y, pushes[0].x) == pytest.approx(azimuth + math.pi / 2, abs=1e-6)
    assert math.hypot(pushes[0].x, pushes[0].y) == pytest.approx(0.32 * 2.5, rel=0.02)


def test_a_walk_that_was_watched_is_the_walk_that_was_not() -> None:
    experiment = apnc.Experiment(duration=1.0, engine="compiled")
    record, _, _ = watched(experiment, {})
    alone = apnc.simulate(replace(experiment))
    assert record.experiment == experiment
    assert all(np.array_equal(v, alone.signals[name]) for name, v in record.signals.items())

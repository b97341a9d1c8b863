"""The page to play with is one file that loads nothing, and walks as the product does."""

from __future__ import annotations

import html
import html.parser
import json
import math
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from browser import console_lines, look, needs_browser

from apnc import Experiment, simulate
from apnc.loop.columns import columns as columns_of
from apnc_plant.conditions import Conditions
from apnc_plant.ground import Obstacles
from play.build import build
from play.numbers import SHOWN, robot_of

LARGEST = 1.5e6  # [bytes] of the file
TICK = 300
WALKS: dict[str, dict[str, Any]] = {
    "lilibot": {"robot": "lilibot", "seed": 0, "mi": 0.18},
    "turning": {"robot": "lilibot", "seed": 4, "mi": 0.1, "turn": 0.4},
    "on bumps": {"robot": "lilibot", "seed": 7, "slope": 3.0, "bumps": 0.5, "load": 0.5},
    "blind": {"robot": "lilibot", "seed": 2, "off": ["RF", "LH"]},
    "hexapod": {"robot": "hexapod", "seed": 1, "mi": 0.15},
    "solo12": {"robot": "solo12", "seed": 1, "mi": 0.2},
    "a1, blind": {"robot": "a1", "seed": 2, "mi": 0.2, "off": ["RH"], "load": 0.5},
    **{label: {"robot": "lilibot", "seed": 3, "controller": label} for label in SHOWN},
}

PROBE = (Path(__file__).parent / "probe.js").read_text(encoding="utf-8")

WITHOUT = """<script>
delete window.WebAssembly;
window.apncProbe = () => ({
  still: document.body.classList.contains("still"),
  width: document.querySelector(".fallback img").naturalWidth,
  main: getComputedStyle(document.querySelector("main")).display,
});
</script>"""


@pytest.fixture(scope="module")
def page(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("play") / "play.html"
    build(file)
    return file


@pytest.fixture(scope="module")
def seen(page: Path, tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:

    given = f"const WALKS = {json.dumps(WALKS)}, TICK = {TICK};"
    script = f"<script>{given}\n{PROBE}</script>"
    found, log = look(page, tmp_path_factory.mktemp("browser"), script)
    assert console_lines(log) == []
    return found


class Resources(html.parser.HTMLParser):
    """Everything an HTML file would load from elsewhere."""

    def __init__(self) -> None:
        super().__init__()
        self.found: list[str] = []

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        wanted = [
            v for k, v in attrs if k in ("src", "data", "srcset", "href") and v and tag != "a"
        ]
        self.found += [v for v in wanted if not v.startswith("data:")]


def test_page_is_one_small_file_that_loads_nothing(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    parser = Resources()
    parser.feed(text)
    assert parser.found == []
    assert "default-src 'none'" in text  # the browser enforces it, too
    assert page.stat().st_size < LARGEST


@needs_browser
def test_page_asks_the_network_for_nothing(seen: dict[str, Any]) -> None:
    assert [name for name in seen["requests"] if not name.startswith("data:")] == []
    assert not seen["still"]


@needs_browser
def test_a_picture_stands_in_where_webassembly_is_missing(page: Path, tmp_path: Path) -> None:
    without, log = look(page, tmp_path, WITHOUT)
    assert console_lines(log) == []
    assert without["still"]
    assert without["width"] > 0  # of the picture: it could be read
    assert without["main"] == "none"


@needs_browser
@pytest.mark.parametrize("name", WALKS)
def test_walk_is_that_of_the_product(name: str, seen: dict[str, Any]) -> None:
    given = WALKS[name]
    ground = Obstacles(
        slope=given.get("slope", 0.0) * math.pi / 180.0,
        roughness=given.get("bumps", 0.0),
        seed=given["seed"],
    )
    robot = robot_of(given["robot"])
    record = simulate(
        Experiment(
            robot=robot,
            controller=given.get("controller", "apnc"),
            seed=given["seed"],
            mi=given.get("mi", 0.08),
            turn=given.get("turn", 0.0),
            ground=ground,
            conditions=Conditions(
                payload=given.get("load", 0.0), dropout=tuple(given.get("off", ()))
            ),
            duration=(TICK + 1) * Experiment(robot=robot).Ts,
            engine="compiled",
        )
    )
    walked = seen["walks"][name]
    assert walked["time"] == pytest.approx(record.time[TICK] + record.experiment.Ts)
    for signal in ("position", "phi"):
        expected = record.signals[signal][TICK]
        np.testing.assert_allclose(walked[signal], expected, rtol=0.0, atol=1e-9)


@needs_browser
def test_a_trot_forms_and_is_stored(seen: dict[str, Any]) -> None:
    assert seen["formed"]["gait"] == "trot"
    assert seen["formed"]["stored"]


@needs_browser
@pytest.mark.parametrize("what", ["blind", "loaded", "tilted", "rough", "shoved", "relearned"])
def test_it_walks_on(what: str, seen: dict[str, Any]) -> None:
    assert seen[what]["gait"] == "trot"
    assert seen[what]["stored"]
    assert seen[what]["fares"] == 0
    assert seen[what]["way"] > 0.3


@needs_browser
def test_stored_gait_alone_brings_the_legs_apart_again(seen: dict[str, Any]) -> None:
    assert seen["recalled"]["gait"] == "trot"
    assert seen["forgotten"]["gait"] != "trot"
    assert not seen["forgotten"]["stored"]
    assert seen["forgotten"]["way"] < 0.1


@needs_browser
def test_ground_carries_the_payload_that_is_put_on(seen: dict[str, Any]) -> None:
    robot = Experiment().description
    heavier = seen["loaded"]["load"] - seen["formed"]["load"]
    assert seen["formed"]["load"] == pytest.approx(robot.weight, rel=0.02)
    assert heavier == pytest.approx(9.81, rel=0.1)


@needs_browser
def test_a_push_moves_the_robot_to_its_side(seen: dict[str, Any]) -> None:
    assert 0.1 < seen["push"] < 0.3  # the feet brake it meanwhile


@needs_browser
def test_csv_has_the_columns_of_a_record(seen: dict[str, Any]) -> None:
    columns = seen["columns"]
    known = columns_of(simulate(Experiment(duration=0.1, engine="compiled")))
    assert set(columns) <= set(known)
    assert len(columns) == len(set(columns))
    assert set(seen["widths"]) == {len(columns)}
    assert len(seen["widths"]) == seen["lines"]


@needs_browser
def test_address_holds_what_is_set(seen: dict[str, Any]) -> None:
    assert [html.unescape(address) for address in seen["hash"]] == [
        "#off=RF",
        "#slope=-2&off=RF",
        "#controller=apc&slope=-2&off=RF",
        "#robot=hexapod&controller=apc",
        "#robot=hexapod&controller=apc",
    ]
    assert "LM works" in seen["broken"]


@needs_browser
def test_a_key_shows_the_frames_in_a_second_and_hides_them(seen: dict[str, Any]) -> None:
    with_frames, without = seen["clocks"]
    assert re.fullmatch(r"[0-9.]+ s · [0-9]+ frames/s", with_frames)
    assert re.fullmatch(r"[0-9.]+ s", without)

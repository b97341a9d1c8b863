"""The scene in Python is the one of the page, point by point."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from browser import look, needs_browser
from records import TRIPOD, synthetic_record

from apnc.features import walk_features
from apnc.film.scene import Scene, _cut
from apnc.loop.record import Record
from apnc.report.page import render

SIZE = (640, 400)
MOMENT = 200

SEEN = f"""<script>
window.apncProbe = () => {{
  const scene = new apnc.Scene(document.getElementById("robot"), apnc.data.animation), i = {MOMENT};
  [scene.width, scene.height] = [{SIZE[0]}, {SIZE[1]}];
  scene.centre = scene.vector(scene.focus, i);
  scene.scale = (scene.look.zoom * Math.min(scene.height, 0.7 * scene.width)) / scene.reach;
  const seen = (p) => scene.project(p), n = scene.n, legs = [...Array(n).keys()];
  const found = {{}};
  for (const view of ["3d", "side", "top", "front"]) {{
    scene.view(view);
    found[view] = {{
      legs: legs.map((leg) => [0, 1, 2, 3].map((joint) => seen(scene.point(i, leg, joint)))),
      box: [...Array(8).keys()].map((k) => seen(scene.placed(i, scene.vector(scene.corners, k)))),
      track: seen(scene.track(i)),
      prints: scene.prints.filter((p) => p.i <= i && i - p.i <= scene.look.prints)
        .map((p) => [...seen(p.place), p.leg]),
    }};
  }}
  return {{ found, radius: scene.radius * scene.scale }};
}};</script>"""


@needs_browser
@pytest.mark.parametrize("phases", [None, TRIPOD])
def test_every_point_is_where_the_page_has_it(
    phases: tuple[float, ...] | None, tmp_path: Path
) -> None:
    record = synthetic_record(5.0, *([phases] if phases else []))
    page = tmp_path / "report.html"
    page.write_text(render(record, walk_features(record)), encoding="utf-8")
    seen, _ = look(page, tmp_path, SEEN)
    for view, there in seen["found"].items():
        scene = Scene(record, *SIZE, view)
        assert scene.radius == pytest.approx(seen["radius"], rel=1e-6)
        assert scene.legs(MOMENT) == pytest.approx(np.array(there["legs"]), abs=0.05)
        assert scene.box(MOMENT)[0] == pytest.approx(np.array(there["box"]), abs=0.05)
        assert scene.track(MOMENT)[-1] == pytest.approx(there["track"], abs=6.0)
        prints = scene.prints(MOMENT)
        assert [leg for _, leg, _ in prints] == [leg for *_, leg in there["prints"]]
        places = np.array([place for place, _, _ in prints])
        assert places == pytest.approx(np.array(there["prints"])[:, :3], abs=0.05)


def fine(record: Record) -> Scene:
    return Scene(record, *SIZE)


def test_forces_are_drawn_in_proportion_and_small_ones_not_at_all() -> None:
    record = synthetic_record(2.0)
    record.signals["foot_force"][60] = 0.0
    weight = record.mass * 9.81
    record.signals["foot_force"][60, 1] = [0.0, 0.0, 0.5 * weight]
    record.signals["foot_force"][60, 2] = [0.0, 0.0, 0.01 * weight]
    (arrow,) = fine(record).forces(60)
    other = record.signals["foot_force"].copy()
    other[60, 1] *= 2.0
    record.signals["foot_force"][:] = other
    (longer,) = fine(record).forces(60)
    assert longer[1] - longer[0] == pytest.approx(2.0 * (arrow[1] - arrow[0]))
    assert arrow[1, 1] < arrow[0, 1]  # up is towards 0


def test_lines_of_the_ground_are_cut_at_the_square() -> None:
    nan = [np.nan] * 3
    line = np.array(
        [nan, [-5, 0, 0], [5, 0, 0], nan, [0, 3, 0], [1, 3, 0], nan, [0.5, 0.5, 1], [2, 2, 4]]
    )
    steps = np.stack([line[:-1], line[1:]], axis=1)
    cut = _cut(steps, np.zeros(3), 1.0)
    assert cut == pytest.approx(np.array([[[-1, 0, 0], [1, 0, 0]], [[0.5, 0.5, 1], [1, 1, 2]]]))


def test_the_ground_goes_along_with_the_robot() -> None:
    record = synthetic_record(3.0)
    record.signals["position"][:, 0] += np.linspace(0.0, 50.0, len(record))
    record.signals["foot_position"][..., 0] += np.linspace(0.0, 50.0, len(record))[:, None]
    scene = fine(record)
    for i in (0, 90, 179):
        steps = scene.floor(i)["landmarks"]
        assert len(steps) > 3
        assert np.abs(steps[..., 0] - SIZE[0] / 2).min() < SIZE[0] / 2

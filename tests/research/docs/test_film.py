"""The film of a made-up walk shows what is known of it."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from records import FOOT_RADIUS, HEIGHT, synthetic_record

from apnc.features import walk_features
from research.docs import film

WALK = synthetic_record(20.0, frequency=1.5, speed=0.09, yaw=0.6)


def test_the_frame_follows_place_and_heading() -> None:
    view = film.View(WALK)
    assert view.way[-1] == pytest.approx(90.0 * (20.0 - 1 / 60), abs=0.5)
    # legs move to and fro about the same place, 30 mm each way over 60 % of the stride
    feet = view.chains[60:-60, :, -1]
    assert np.ptp(feet[..., 0], axis=0) == pytest.approx([0.6 * 60.0] * 4, abs=1.0)
    assert feet[:, 0, 0].mean() - feet[:, 1, 0].mean() == pytest.approx(2 * 92.0, abs=2.0)
    assert view.trunk[..., 1].mean() == pytest.approx(1000 * HEIGHT, abs=30.0)
    lows = view.lows[60:-60, :, 1]
    assert lows.min() == pytest.approx(0.0, abs=1e-6) and lows.max() == pytest.approx(15.0, abs=0.2)
    assert (feet[..., 1] - lows) == pytest.approx(1000 * FOOT_RADIUS)


@pytest.mark.thorough
def test_the_film_shows_whole_strides_at_a_quarter_of_the_speed(tmp_path: Path) -> None:
    part = film.steady_part(WALK)
    assert part.time[0] == pytest.approx(12.0) and len(part.signals["grf"]) == len(part) == 480
    view, feet = film.View(part), walk_features(part)
    film.film(view, feet, tmp_path / "walk.gif")
    with Image.open(tmp_path / "walk.gif") as picture:
        # three strides of 2/3 s, four times as long, 25 pictures a second
        assert picture.n_frames == pytest.approx(3 / 1.5 * 4 * 25, abs=1)
        assert picture.info["duration"] == 40 and picture.info["loop"] == 0
        first = np.asarray(picture.convert("RGB"), dtype=int)
        picture.seek(picture.n_frames - 1)
        last = np.asarray(picture.convert("RGB"), dtype=int)
        picture.seek(picture.n_frames // 6)  # half a stride on
        half = np.asarray(picture.convert("RGB"), dtype=int)
    # it ends where it begins
    assert np.abs(last - first).mean() < 0.5 * np.abs(half - first).mean()
    assert (tmp_path / "walk.gif").stat().st_size < 1_500_000


def test_the_sheet_tells_the_feet(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    words: list[str] = []
    canvas = film.Canvas
    monkeypatch.setattr(canvas, "text", lambda self, x, y, text, *more: words.append(text))
    part = film.steady_part(WALK)
    feet = replace(walk_features(part), slip_share={"RF": 0.12, "RH": None, "LF": 0.0, "LH": 0.3})
    film.sheet(film.View(part), feet, tmp_path / "feet.png")
    assert words[0] == "MI 0.25: 0.090 m/s, 1.50 strides/s, trot"
    assert "RF lift 15.0 mm" in words and "LH lift 15.0 mm" in words
    shares = [text.split(" = ")[1] for text in words if text.startswith("slip")]
    assert shares == [f"{share} % of the stride" for share in ("12", "-", "0", "30")]
    assert [f"{k}/8" for k in range(8)] == [text for text in words if text.endswith("/8")]
    with Image.open(tmp_path / "feet.png") as picture:
        assert picture.size[0] == 1200 and len(picture.convert("RGB").getcolors(10**6)) > 20

"""Films: format, size, length and what is seen; and what is refused before the walk."""

from __future__ import annotations

import signal
from dataclasses import replace
from pathlib import Path

import av
import numpy as np
import pytest
from command_line import run
from PIL import Image
from records import synthetic_record

from apnc.cli import film as cli_film
from apnc.film.film import FORMATS, SIZES, Film, write_film
from apnc.film.picture import Pictures
from apnc.loop.record import End
from apnc.report.look import colours
from apnc.report.theme import leg_colours

WALK = ("walk", "--engine", "compiled", "--duration", "1")


def pixels(image: object) -> np.ndarray:
    return np.asarray(image.convert("RGB")).astype(int)  # type: ignore[attr-defined]


def near(found: np.ndarray, colour: str, away: float = 6.0) -> np.ndarray:
    wanted = [int(colour[k : k + 2], 16) for k in (1, 3, 5)]
    return np.abs(found - wanted).max(axis=-1) <= away


def test_a_picture_shows_legs_trunk_ground_time_and_gait() -> None:
    record = synthetic_record(3.0)
    for width, height in SIZES.values():
        found = pixels(Pictures(record, width, height).draw(90))
        assert found.shape == (height, width, 3)
        for colour in (*leg_colours(record.legs).values(), "#dde4ec", colours()["landmark"]):
            assert near(found, colour).sum() > 15, colour
        strip = found[-round(0.2 * height) :]
        assert near(strip, colours()["stance"]).sum() > 0.02 * strip[..., 0].size
        words = found[: height // 10, : width // 2]
        assert near(words, colours()["ink"], 60.0).sum() > 20


def test_pictures_move_and_the_mark_of_the_present_stays_in_the_middle() -> None:
    pictures = Pictures(synthetic_record(8.0), *SIZES["390"])
    first, second = (pixels(pictures.draw(i)) for i in (240, 270))
    assert (first != second).any(axis=-1).mean() > 0.02
    for found in (first, second):
        mark = np.flatnonzero(near(found[-60:-30], "#D55E00").all(axis=0))
        assert mark.mean() == pytest.approx(34 + (390 - 34) / 2, abs=1.5)


SMALL, *LARGE = SIZES


@pytest.mark.parametrize("suffix", FORMATS)
@pytest.mark.parametrize(
    "size", [SMALL, *(pytest.param(size, marks=pytest.mark.thorough) for size in LARGE)]
)
def test_a_film_has_its_size_its_rate_and_as_long_as_asked(
    suffix: str, size: str, tmp_path: Path
) -> None:
    record, kind = synthetic_record(3.0), FORMATS[suffix]
    film = Film(tmp_path / f"walk{suffix}", size, (1.0, 1.8))
    told: list[tuple[float, float]] = []
    write_film(record, film, film.path, lambda done, total: told.append((done, total)))
    count = round(0.8 * kind.rate)
    assert len(told) == count and told[-1][0] == pytest.approx(told[-1][1])
    if kind.codec:
        with av.open(str(film.path)) as file:
            stream = file.streams.video[0]
            assert (stream.width, stream.height) == SIZES[size]
            assert float(stream.average_rate) == kind.rate
            frames = [frame.to_image() for frame in file.decode(video=0)]
    else:
        with Image.open(film.path) as file:
            assert file.size == SIZES[size] and file.info["loop"] == 0
            frames = []
            for k in range(file.n_frames):
                file.seek(k)
                assert file.info["duration"] == round(1000 / kind.rate)
                frames.append(file.convert("RGB"))
    assert len(frames) == count
    own = pixels(Pictures(record, *SIZES[size]).draw(60))
    assert np.abs(pixels(frames[0]) - own).mean() < 4.0
    later = pixels(Pictures(record, *SIZES[size]).draw(60 + round(60 * (count - 1) / kind.rate)))
    assert np.abs(pixels(frames[-1]) - later).mean() < 4.0


def test_a_walk_of_one_sample_can_be_filmed(tmp_path: Path) -> None:
    record = replace(synthetic_record(1 / 60), end=End.interrupted)
    film = Film(tmp_path / "one.gif")
    write_film(record, film, film.path)
    with Image.open(film.path) as file:
        assert file.n_frames == 1


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["--video", "walk.avi"], "walk.avi is no film; allowed: .gif, .mp4, .webm"),
        (["--video", "a.gif", "--video-size", "4k"], "size '4k' is not one of 390, 720p"),
        (["--video", "a.gif", "--video-part", "3"], "--video-part 3 is not begin:end [s]"),
        (["--video", "a.gif", "--video-part", "3:2"], "part 3:2 is none"),
        (["--video", "a.gif", "--video-part", "nan:2"], "part nan:2 is none"),
        (["--video", "a.gif", "--video-part", "5:6"], "the walk of 1 s has nothing after 5 s"),
        (["--video", "a.gif", "--duration", "900"], "a GIF of 900 s is too large; allowed: 181 s"),
        (["--video-size", "390"], "--video-size is taken with --video only"),
        (["--video-part", "1:2"], "--video-part is taken with --video only"),
        (["--video", "x.gif", "--json", "x.gif"], "would overwrite a file of --json"),
        (["--video", "new/"], "'--video': new/ is a folder"),
    ],
)
def test_a_film_that_cannot_be_is_refused_before_the_walk(
    words: list[str], said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:  # fmt: skip
    monkeypatch.chdir(tmp_path)
    code, out, err = run(capsys, *WALK, *words)
    assert (code, out) == (2, "") and said in err
    assert not list(tmp_path.glob("*.gif")) and not list(tmp_path.glob("*/summary.json"))


def test_without_the_extra_the_message_names_it(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(cli_film.importlib.util, "find_spec", lambda name: None)
    code, _, err = run(capsys, *WALK, "--video", "a.gif")
    assert code == 2 and "--video needs the extra 'video': pip install" in err


def test_the_command_writes_the_film_beside_the_report(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    code, out, _ = run(capsys, *WALK, "--video", "films/walk.gif", "--video-part", "0.5:1")
    assert code == 0 and "film: films/walk.gif" in out
    with Image.open(tmp_path / "films/walk.gif") as file:
        assert file.n_frames == round(0.5 * FORMATS[".gif"].rate)


def test_an_interrupt_while_filming_leaves_no_film_but_the_rest(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], tmp_path: Path
) -> None:
    monkeypatch.chdir(tmp_path)
    draw, drawn = Pictures.draw, []

    def interrupted(self: Pictures, i: int) -> object:
        drawn.append(i)
        if len(drawn) == 5:
            signal.raise_signal(signal.SIGINT)
        return draw(self, i)

    monkeypatch.setattr(Pictures, "draw", interrupted)
    monkeypatch.setattr(cli_film.STOP, "asked", False)
    code, out, err = run(capsys, *WALK, "--video", "a.gif")
    assert code == 130 and "a.gif is not written; all else is" in out + err
    assert len(drawn) < 8
    assert not (tmp_path / "a.gif").exists()
    assert (tmp_path / "apnc-walk" / "report.html").exists()
    assert not [path for path in tmp_path.iterdir() if path.name.startswith(".")]

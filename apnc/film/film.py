"""Writes a walk as a film: GIF, MP4 or WebM."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from apnc.film.picture import Pictures
from apnc.loop.record import Record

if TYPE_CHECKING:
    from PIL import Image

SIZES: Final = {"390": (390, 340), "720p": (1280, 720)}
"""Width and height of the pictures [px], by name."""

COLOURS: Final = 96
"""Colours of a GIF; what is drawn has few."""

LARGEST: Final = 300e6
"""Most pixels of all pictures of a GIF together, which are in memory until it is written."""


@dataclass(frozen=True)
class Format:
    """A kind of film.

    Args:
        rate: pictures per second; those of a GIF last whole hundredths of a second.
        size: name of its usual size, see ``SIZES``.
        codec: of the video; empty for a GIF.
        options: of the codec.
        package: that writes it.
    """

    rate: float
    size: str
    codec: str
    options: dict[str, str]
    package: str


FORMATS: Final = {
    ".gif": Format(12.5, "390", "", {}, "PIL"),
    ".mp4": Format(
        30, "720p", "libx264", {"crf": "21", "preset": "veryfast", "movflags": "+faststart"}, "av"
    ),
    ".webm": Format(
        30, "720p", "libvpx-vp9", {"crf": "30", "b": "0", "cpu-used": "6", "row-mt": "1"}, "av"
    ),
}
"""Kinds of films by the ends of their names."""


@dataclass(frozen=True)
class Film:
    """What is filmed, and how.

    Args:
        path: file to write; its end says the format.
        size: one of ``SIZES``; the usual one of the format if omitted.
        part: begin and end of what is shown [s]; all of the walk if omitted.

    Raises:
        ValueError: another format or size, or a part that is none.
    """

    path: Path
    size: str | None = None
    part: tuple[float, float] | None = None

    def __post_init__(self) -> None:
        """Check the values."""
        if self.path.suffix.lower() not in FORMATS:
            raise ValueError(f"{self.path} is no film; allowed: {', '.join(FORMATS)}")
        if self.size is not None and self.size not in SIZES:
            raise ValueError(f"size '{self.size}' is not one of {', '.join(SIZES)}")
        if self.part is not None and not 0.0 <= self.part[0] < self.part[1]:
            begin, end = self.part
            raise ValueError(f"part {begin:g}:{end:g} is none; allowed: begin:end [s] that grow")

    @property
    def format(self) -> Format:
        """The kind of film."""
        return FORMATS[self.path.suffix.lower()]

    @property
    def shape(self) -> tuple[int, int]:
        """Width and height [px]."""
        return SIZES[self.size or self.format.size]

    def times(self, duration: float) -> np.ndarray[Any, np.dtype[np.float64]]:
        """Times of the pictures of a walk [s].

        Args:
            duration: of the walk [s].

        Raises:
            ValueError: nothing of the walk is in the part, or the GIF would be too large.
        """
        begin, end = self.part or (0.0, duration)
        end = min(end, duration)
        if begin >= end:
            raise ValueError(f"the walk of {duration:g} s has nothing after {begin:g} s to film")
        count = max(1, round((end - begin) * self.format.rate))
        width, height = self.shape
        if not self.format.codec and count * width * height > LARGEST:
            most = LARGEST / width / height / self.format.rate
            raise ValueError(
                f"a GIF of {end - begin:g} s is too large; allowed: {most:.0f} s in this size, "
                "or .mp4 and .webm of any length"
            )
        times: np.ndarray[Any, np.dtype[np.float64]]
        times = begin + np.arange(count) / self.format.rate
        return times


def write_film(
    record: Record,
    film: Film,
    path: Path,
    progress: Callable[[float, float], None] = lambda done, total: None,
) -> None:
    """Write a film of a run.

    Args:
        record: the run, with at least one sample.
        film: what is filmed.
        path: file to write; it has the end of the film's.
        progress: called with the seconds that are drawn and those of all. What it raises ends the
            work.

    Raises:
        ModuleNotFoundError: the extra ``video`` is not installed.
        ValueError: see :meth:`Film.times`.
        OSError: the file cannot be written.
    """
    times = film.times(record.ended_at)
    pictures = Pictures(record, *film.shape)
    total = float(times[-1] - times[0])

    def drawn(chosen: Iterable[float]) -> Iterator[Image.Image]:
        for t in chosen:
            at = int(np.searchsorted(record.time, t + 1e-9, side="right")) - 1
            yield pictures.draw(max(0, at))

    def told() -> Iterator[Image.Image]:
        for t, picture in zip(times, drawn(times), strict=True):
            yield picture
            progress(float(t - times[0]), total)

    if film.format.codec:
        _write_video(path, film, told())
    else:
        _write_gif(path, film, told(), list(drawn(times[[0, len(times) // 2, -1]])))


def _write_gif(
    path: Path, film: Film, drawn: Iterator[Image.Image], sample: list[Image.Image]
) -> None:
    """Write a GIF whose colours are those of a sample of its pictures."""
    from PIL import Image  # noqa: PLC0415  # an extra

    width, height = film.shape
    together = Image.new("RGB", (width, height * len(sample)))
    for k, picture in enumerate(sample):
        together.paste(picture, (0, k * height))
    palette = together.quantize(COLOURS, dither=Image.Dither.NONE)
    quantized = (each.quantize(palette=palette, dither=Image.Dither.NONE) for each in drawn)
    first = next(quantized)
    first.save(
        path, format="GIF", save_all=True, append_images=quantized, loop=0,
        duration=round(1000 / film.format.rate), optimize=False, disposal=1,
    )  # fmt: skip


def _write_video(path: Path, film: Film, drawn: Iterator[Image.Image]) -> None:
    import av  # noqa: PLC0415  # an extra

    kind = film.format
    with av.open(str(path), "w") as file:
        stream: Any = file.add_stream(kind.codec, rate=Fraction(kind.rate), options=kind.options)
        stream.width, stream.height = film.shape
        stream.pix_fmt = "yuv420p"
        for image in drawn:
            file.mux(stream.encode(av.VideoFrame.from_ndarray(np.asarray(image), format="rgb24")))
        file.mux(stream.encode())

"""A small film of each robot as it walks, in real time and without an end."""

from __future__ import annotations

from pathlib import Path
from typing import Final

import numpy as np

from apnc.loop.experiment import Experiment
from apnc.many import simulate_many
from apnc_plant.robot import RobotDescription
from research.docs.film import Canvas, View, draw_robot, with_few_colours
from research.gallery.measure import FIRST_SEED, LATE, duration_of, mi_values

SIZE: Final = (360.0, 250.0)
"""Of the film [px]."""

HEAD: Final = 26.0
"""Height of the line of words [px]."""

RATE: Final = 15.0
"""Pictures per second."""

STRIDES: Final = 2
"""Strides of the first leg that the film repeats."""

LARGEST: Final = 150_000
"""Largest film [bytes]: a page has one per robot."""


def film(title: str, robot: RobotDescription, file: Path) -> None:
    """Walk a robot with ANC at the middle of its MI range and draw whole strides of it.

    Args:
        title: name of the robot.
        robot: its tuned file.
        file: the film, WebP.

    Raises:
        ValueError: the walk ended early or has too few strides, or the film is too large.
    """
    mis = mi_values(robot)
    experiment = Experiment(
        robot=robot, mi=mis[len(mis) // 2], seed=FIRST_SEED, duration=duration_of(robot),
        engine="compiled",
    )  # fmt: skip
    (record,) = simulate_many([experiment], records=True)
    assert record is not None
    part = record[round(LATE * len(record.time)) :]
    view = View(part)
    if not record.complete or min(map(len, view.starts)) < STRIDES + 2:
        raise ValueError(f"{title}: {record.end} at {record.ended_at:g} s, too few strides to film")
    begin, end = view.starts[0][1], view.starts[0][1 + STRIDES]
    count = max(8, round((end - begin) / experiment.rate * RATE))
    pictures = []
    for sample in np.linspace(begin, end, count, endpoint=False):
        canvas = Canvas(*SIZE)
        canvas.text(12.0, 20.0, f"{title}, MI {experiment.mi:g}", 14.0)
        draw_robot(
            canvas, view, view.at(float(sample)),
            (12.0, HEAD, SIZE[0] - 24.0, SIZE[1] - HEAD - 16.0),
        )  # fmt: skip
        pictures.append(with_few_colours(view, canvas.done()).convert("RGB"))
    file.parent.mkdir(parents=True, exist_ok=True)
    pictures[0].save(
        file, save_all=True, append_images=pictures[1:], duration=round(1000.0 / RATE), loop=0,
        quality=40, method=4,
    )  # fmt: skip
    if file.stat().st_size > LARGEST:
        raise ValueError(f"{file}: {file.stat().st_size} bytes; allowed: {LARGEST}")

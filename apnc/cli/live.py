"""``apnc walk --view``: the page of a walk, opened before the robot starts."""
# ruff: noqa: PLC0415  # what takes seconds to import waits until it is needed

from __future__ import annotations

import importlib.util
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Final

from apnc.cli.browser import open_page
from apnc.cli.console import say, status
from apnc.cli.interrupt import STOP
from apnc.extras import install_command
from apnc.view.wishes import SPEEDS

if TYPE_CHECKING:
    from apnc.loop.experiment import Experiment
    from apnc.loop.simulate import Watch
    from apnc.view.live import LiveView
    from apnc_plant.plant import Plant

OWN_SPEED: Final = 1.0
"""Simulated time per time of the clock if none is asked for."""

LATE: Final = 1.0
"""Delay of a walk that is said at its end [s]."""


class View:
    """A walk's robot at its start, and the page that shows it, if one is asked for.

    Attributes:
        plant, watch: arguments of ``apnc.simulate``; None without a page.
    """

    def __init__(self, plant: Plant | None = None, live: LiveView | None = None) -> None:
        self.plant, self._live = plant, live
        self.watch: Watch | None = live.watch if live else None

    def end(self, words: str) -> None:
        """Tell the page how the walk ended, and the console if it took longer than asked for."""
        if self._live:
            self._live.end(words)
            if self._live.behind > LATE:
                say(f"the view fell {self._live.behind:.1f} s behind the speed that was asked for")


@contextmanager
def viewed(experiment: Experiment, asked: bool, speed: float | None) -> Iterator[View]:
    """The view of a walk, whose page is open.

    Args:
        experiment: what is run.
        asked: whether there shall be one.
        speed: simulated time per time of the clock.
    """
    if not asked:
        yield View()
        return
    with status("starting"):
        from apnc.loop.simulate import plant_of
        from apnc.view.live import LiveView
        from apnc_plant.plant import LivePlant

        plant = plant_of(experiment)
        assert isinstance(plant, LivePlant)
        live = LiveView(experiment, plant, speed or OWN_SPEED, lambda: STOP.asked)
    try:
        say(f"view: {live.address}")
        # some browsers return when they are closed only
        threading.Thread(target=open_page, args=(live.address,), daemon=True).start()
        with status("waiting for the page"):
            live.wait_for_page()
        yield View(plant, live)
    finally:
        live.close()


def check_view(asked: bool, speed: float | None) -> None:
    """Check what is asked of a view, before anything is computed.

    Raises:
        ValueError: the extra is not installed, or a speed that is not allowed.
    """
    if speed is not None and not asked:
        raise ValueError("--view-speed is taken with --view only")
    low, high = SPEEDS
    if speed is not None and not low <= speed <= high:
        raise ValueError(f"--view-speed is {speed}; allowed: {low:g} to {high:g}")
    if asked and importlib.util.find_spec("websockets") is None:
        raise ValueError(f"--view needs the extra 'view': {install_command('view')}")

"""A walk that is watched: what the loop gives to the page, and the page to the loop."""

from __future__ import annotations

import json
import math
import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from typing import Any, Final

import numpy as np

from apnc.loop.experiment import Experiment
from apnc.loop.simulate import Shown
from apnc.report.animation import fixed_data, ground_lines, reach_of, still_parts
from apnc.report.encoding import Signal, plain
from apnc.report.html import page
from apnc.report.theme import leg_colours
from apnc.report.wording import heading
from apnc.view.pace import SLICE, Pace
from apnc.view.samples import Sample, rows_of, thinned
from apnc.view.server import Server
from apnc.view.wishes import wish_of
from apnc_core.types import Array
from apnc_plant.plant import LivePlant

WAITING: Final = 2000
"""Samples that wait for a page that does not take them; older ones are not shown."""

AT_ONCE: Final = 20
"""Most samples in a message."""

TOLD: Final = 0.25
"""Time between two messages about speed and delay [s]."""

ALONE: Final = 3.0
"""Time without a page after which the walk goes on as fast as it can [s]."""

FOLLOWS: Final = 0.5
"""Time constant with which the camera follows the trunk [s]."""


class LiveView:
    """A page that shows a walk, and pushes.

    Args:
        experiment: what is run.
        plant: its robot at the start.
        speed: simulated time per time of the clock; infinity: as fast as it goes.
        stop: whether the walk shall end; it is asked in a pause, too.

    Attributes:
        address: of the page.

    Raises:
        ModuleNotFoundError: the extra ``view`` is not installed.
        OSError: no port is free.
    """

    def __init__(
        self,
        experiment: Experiment,
        plant: LivePlant,
        speed: float = 1.0,
        stop: Callable[[], bool] = lambda: False,
    ) -> None:
        self._experiment, self._robot = experiment, experiment.description
        self._mass, self._stop = plant.mass, stop
        self._pace, self._paused = Pace(speed), False
        self._samples: deque[Sample] = deque(maxlen=WAITING)
        self._notes: deque[str | bytes] = deque()
        self._pushes: deque[tuple[float, float]] = deque()
        self._pushed, self._told_at = 0, 0.0
        self._some, self._over = threading.Condition(), ""
        first = {name: values[None] for name, values in plant.sample().items()}
        self._still, chains = still_parts(self._robot, first)
        self._reach = reach_of(self._still, chains)
        self._focus = first["position"][0].copy()
        self._ground_at, self._ground = self._focus, self._lines(self._focus)
        self._server = Server(self._page, self)
        self.address = self._server.address

    def _page(self, socket: str) -> str:
        ground, robot = self._experiment.ground, self._robot
        still = {name: Signal(values, exact=True) for name, values in self._still.items()}
        fixed = fixed_data(robot, self._mass, ground, self._reach)
        return page(
            "view.html.j2",
            (),
            package="apnc.view",
            scripts=("scene.js", "stage.js", "live_scene.js", "view.js"),
            data={
                "animation": {**fixed, "arrays": {**still, **self._ground}},
                "socket": socket,
                "mass": self._mass,
                "duration": self._experiment.duration,
                "speed": None if math.isinf(self._pace.speed) else self._pace.speed,
            },
            heading=heading(self._experiment),
            colours=leg_colours([leg.name for leg in robot.legs]),
            socket=socket,
        )

    def _lines(self, at: Array) -> dict[str, Signal]:
        """The ground around a point, twice as far as it is drawn."""
        lines = ground_lines(self._experiment.ground, at[None], 2.0 * self._reach)
        return {name: Signal(values) for name, values in lines.items()}

    def wait_for_page(self) -> None:
        """Wait until a page is open."""
        while not self._server.wait(SLICE):
            pass

    def watch(
        self, t: float, sample: Mapping[str, Array], controller: Shown
    ) -> list[tuple[float, float]]:
        """See ``apnc.loop.simulate.Watch``: show a sample, wait for its time, and give pushes."""
        share = min(1.0, self._experiment.Ts / FOLLOWS)
        self._focus = self._focus + share * (sample["position"] - self._focus)
        with self._some:
            self._samples.append(Sample(t, sample, self._focus, np.array(controller.phi)))
            if np.abs(self._focus - self._ground_at)[:2].max() > self._reach:
                self._ground_at, self._ground = self._focus, self._lines(self._focus)
                self._notes.append(_text(ground=self._ground))
            self._some.notify()
        self._keep_time(t)
        pushes = [self._pushes.popleft() for _ in range(len(self._pushes))]
        self._pushed += len(pushes)
        for x, y in pushes:
            self._note(pushed=[t, x, y])
        return pushes

    def _keep_time(self, t: float) -> None:
        if not self._server.shown and time.monotonic() - self._server.left_at > ALONE:
            self._paused = False
            self._pace.restart()
            return
        if self._paused:
            self._note(status=self._status())
            while self._paused and self._server.shown and not self._stop():
                time.sleep(SLICE)
            self._pace.restart()
        self._pace.wait(t, self._stop)
        if time.monotonic() - self._told_at > TOLD:
            self._told_at = time.monotonic()
            self._note(status=self._status())

    def _status(self) -> dict[str, Any]:
        pace = self._pace
        return {
            "speed": None if math.isnan(pace.measured) else pace.measured,
            "wanted": None if math.isinf(pace.speed) else pace.speed,
            "behind": pace.behind,
            "paused": self._paused,
            "pushes": self._pushed,
        }

    def _note(self, **content: Any) -> None:
        with self._some:
            self._notes.append(_text(**content))
            self._some.notify()

    @property
    def behind(self) -> float:
        """How much longer than asked for the walk took [s]."""
        return self._pace.behind

    def end(self, words: str, wait: float = 2.0) -> None:
        """Tell the page that the walk is over, and close.

        Args:
            words: how it ended.
            wait: for a page that has not yet shown all [s].
        """
        self._over = words
        self._note(over=words)
        until = time.monotonic() + wait
        while self._server.shown and (self._notes or self._samples) and time.monotonic() < until:
            time.sleep(SLICE)
        self._server.close()

    def close(self) -> None:
        """End the page's connection."""
        self._server.close()

    def greeting(self) -> list[str | bytes]:
        """See ``apnc.view.server.Source``."""
        over = [_text(over=self._over)] if self._over else []
        return [_text(ground=self._ground), _text(status=self._status()), *over]

    def news(self, wait: float) -> list[str | bytes]:
        """See ``apnc.view.server.Source``."""
        with self._some:
            self._some.wait_for(lambda: self._samples or self._notes, wait)
            samples, notes = list(self._samples), list(self._notes)
            self._samples.clear()
            self._notes.clear()
        if not samples:
            return notes
        shown = thinned(samples, AT_ONCE)
        return [rows_of(self._robot, shown).astype("<f8").tobytes(), *notes]

    def hear(self, message: str | bytes) -> None:
        """See ``apnc.view.server.Source``."""
        wish = wish_of(message, self._mass)
        if wish.pause is not None:
            self._paused = wish.pause
        if wish.speed is not None:
            self._pace.speed = wish.speed
        if wish.push is not None and len(self._pushes) < AT_ONCE:
            self._pushes.append(wish.push)


def _text(**content: Any) -> str:
    return json.dumps(plain(content))

"""Keeps a walk in step with the clock, and says how far it falls behind."""

from __future__ import annotations

import math
import time
from collections import deque
from collections.abc import Callable
from typing import Final

SLACK: Final = 0.1
"""Delay that a walk may catch up [s]; a longer one counts as lost, so that it does not race."""

SLICE: Final = 0.05
"""Longest sleep before ``stop`` is asked again [s]."""

OVER: Final = 1.0
"""Time over which the present speed is measured [s]."""


class Pace:
    """Lets simulated time pass no faster than the clock times a factor.

    Args:
        speed: simulated time per time of the clock; infinity: as fast as it goes.
        clock: present time [s].
        sleep: waits for a time [s].

    Attributes:
        speed: may be changed at any time, also by another thread.
    """

    def __init__(
        self,
        speed: float = 1.0,
        clock: Callable[[], float] = time.perf_counter,
        sleep: Callable[[float], None] = time.sleep,
    ) -> None:
        self.speed, self._clock, self._sleep = speed, clock, sleep
        self._lost = self._late = 0.0
        self._begin: tuple[float, float, float] | None = None
        self._passed: deque[tuple[float, float]] = deque()

    @property
    def behind(self) -> float:
        """How much longer than asked for the walk has taken so far [s]."""
        return self._lost + self._late

    @property
    def measured(self) -> float:
        """Simulated time per time of the clock over the last second; NaN at the begin."""
        if len(self._passed) < 2:
            return math.nan
        (before, since), (now, t) = self._passed[0], self._passed[-1]
        return (t - since) / max(now - before, 1e-9)

    def restart(self) -> None:
        """Forget when it began, after a pause."""
        self._lost, self._late = self.behind, 0.0
        self._begin = None
        self._passed.clear()

    def wait(self, t: float, stop: Callable[[], bool] = lambda: False) -> None:
        """Wait until the clock allows a simulated time.

        Args:
            t: simulated time [s].
            stop: True ends the waiting.
        """
        while True:
            now, speed = self._clock(), self.speed
            if self._begin is None or self._begin[2] != speed:
                self._lost, self._late = self.behind, 0.0
                self._begin = (now, t, speed)
            began, since, _ = self._begin
            ahead = 0.0 if math.isinf(speed) else began + (t - since) / speed - now
            if ahead <= 0.0 or stop():
                break
            self._sleep(min(ahead, SLICE))
        self._late = max(0.0, -ahead)
        if self._late > SLACK:
            self._begin = (now - SLACK / 2, t, speed)
            self._lost, self._late = self.behind - SLACK / 2, SLACK / 2
        self._passed.append((now, t))
        while self._passed[-1][0] - self._passed[0][0] > OVER:
            self._passed.popleft()

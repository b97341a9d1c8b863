"""Load cells in the feet: late, smoothed and noisy."""

from __future__ import annotations

from collections import deque

import numpy as np

from apnc_plant.conditions import Conditions
from apnc_plant.robot.model import Array, Sensor


class LoadSensor:
    """The loads of all feet as the controller gets to see them.

    Per control tick the load is read, arrives ``delay`` later (interpolated between readings if
    the delay is no whole number of ticks, zero before the first), passes a first-order low-pass
    y += (1 - exp(-dt/time_constant)) (x - y), discretised exactly so that it is the same filter
    at every tick rate, and gets white Gaussian noise. A load cell under a foot cannot pull, so
    the reading never falls below zero.
    """

    def __init__(
        self, sensor: Sensor, legs: tuple[str, ...], weight: float, noise: np.random.Generator
    ) -> None:
        """Start with unloaded feet at time 0.

        Args:
            sensor: delay, time constant and noise.
            legs: names of the legs.
            weight: weight of the robot [N], the scale of noise and stuck values.
            noise: source of the noise.
        """
        self._sensor, self._legs, self._half = sensor, legs, weight / 2.0
        self._noise = noise
        self._history: deque[tuple[float, Array]] = deque([(0.0, np.zeros(len(legs)))])
        self._filtered = np.zeros(len(legs))
        self.disturb(Conditions())

    def disturb(self, conditions: Conditions) -> None:
        """From now on add noise, stick at a value or deliver nothing, as ``conditions`` says."""
        self._deviation = np.hypot(self._sensor.noise, conditions.grf_noise) * self._half
        stuck = {leg: value * self._half for leg, value in conditions.stuck.items()}
        stuck |= dict.fromkeys(conditions.silent(self._legs), 0.0)
        self._broken = [self._legs.index(leg) for leg in stuck]
        self._constant = list(stuck.values())

    def update(self, time: float, load: Array, duration: float) -> Array:
        """Take the load at the end of a control tick and return what the sensor delivers [N].

        Args:
            time: end of the tick [s].
            load: load of each foot [N], shape (n_legs,); kept, so not to be changed afterwards.
            duration: length of the tick [s].
        """
        self._history.append((time, load))
        late = self._at(time - self._sensor.delay)
        self._filtered = self._filtered + self._share(duration) * (late - self._filtered)
        noise = self._deviation * self._noise.standard_normal(len(load))
        delivered: Array = np.maximum(0.0, self._filtered + noise)
        delivered[self._broken] = self._constant
        return delivered

    def _share(self, duration: float) -> float:
        if self._sensor.time_constant == 0.0:
            return 1.0
        return float(-np.expm1(-duration / self._sensor.time_constant))

    def _at(self, time: float) -> Array:
        history = self._history
        while len(history) > 1 and history[1][0] <= time:
            history.popleft()
        start, before = history[0]
        if time <= start or len(history) == 1:
            return before
        end, after = history[1]
        return before + (after - before) * ((time - start) / (end - start))

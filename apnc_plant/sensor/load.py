"""Load cells in the feet, with delay, low-pass and noise."""

from __future__ import annotations

from typing import Final

import numpy as np

from apnc_core.types import Array
from apnc_plant.chance import checked_seed
from apnc_plant.conditions import Conditions
from apnc_plant.library import aligned_memory, library
from apnc_plant.numbers import conditions_numbers, sensor_numbers
from apnc_plant.robot.model import Sensor

SHORTEST: Final = 1e-4
"""Shortest control tick [s] for which no delayed load is lost."""


class LoadSensor:
    """Load cells of all feet, which deliver what the controller gets.

    The load is read once per control tick and arrives ``delay`` later. Between two readings it is
    interpolated linearly; before the first it is zero. It then passes a first-order low-pass,
    y += (1 - exp(-dt/time_constant)) (x - y), which is the same filter at every tick length. White
    Gaussian noise is added. A load cell under a foot cannot pull, so the result is cut off at zero.
    """

    def __init__(self, sensor: Sensor, legs: tuple[str, ...], weight: float, seed: int = 0) -> None:
        """Start with unloaded feet.

        Args:
            sensor: delay, time constant and noise.
            legs: names of the legs.
            weight: weight of the robot [N], which scales noise and stuck values.
            seed: seed of the noise, 0 to 2^64 - 1.

        Raises:
            ValueError: the seed is not allowed.
        """
        ffi, lib = library()
        self._legs, self._weight = legs, weight
        history = lib.plant_history(0.0, sensor.delay, SHORTEST)
        self._cells, self._owner = aligned_memory(lib.plant_sensor_size(len(legs), history))
        numbers = ffi.new("plant_sensor *", sensor_numbers(sensor))
        lib.plant_sensor_start(self._cells, len(legs), history, numbers, weight, checked_seed(seed))
        self._load, self._reading = np.zeros(len(legs)), np.zeros(len(legs))
        self._load_in_c = ffi.from_buffer("double[]", self._load)
        self._reading_in_c = ffi.from_buffer("double[]", self._reading)

    def disturb(self, conditions: Conditions) -> None:
        """Set what is wrong with the sensors by ``conditions`` from now on."""
        _, lib = library()
        numbers = conditions_numbers(conditions, self._legs, self._weight)
        lib.plant_sensor_disturb(self._cells, numbers.at)

    def update(self, load: Array, duration: float) -> Array:
        """Read the loads at the end of a control tick; return what the sensors deliver [N].

        Args:
            load: load of each foot [N], shape (n_legs,).
            duration: length of the tick [s].
        """
        _, lib = library()
        self._load[:] = load
        lib.plant_sensor_read(self._cells, duration, self._load_in_c, self._reading_in_c)
        return self._reading.copy()

"""Robots in C that trot on fixed phases: ticks of the plant and nothing else."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, Final

import numpy as np

from apnc_core.types import Array
from apnc_plant.ground import GroundInC, Plane
from apnc_plant.library import aligned_memory, declarations, library
from apnc_plant.numbers import robot_numbers
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.start import start_coordinates
from apnc_plant.step import own_step
from build_fmu.compile import compile_library
from build_fmu.library import sources
from build_fmu.platforms import PLATFORMS, host_platform
from research.contact.measure import TICK, commands

KINDS: Final = {"scalar": "PLANT_SCALAR", "legs": "PLANT_LEGS", "robots": "PLANT_ROBOTS"}
"""Ways to compute robots, and their names in ``plant.h``."""

STEPS: Final = round(TICK / own_step(load_robot("lilibot")))
"""Integration steps per tick of a walk."""


def robot_with(legs: int) -> RobotDescription:
    """Lilibot with an even number of legs, spread between the places of its front and hind legs."""
    own = load_robot("lilibot")
    if legs == len(own.legs):
        return own
    places = np.linspace(own.legs[0].mount[0], own.legs[1].mount[0], legs // 2)
    more = (
        replace(leg, name=f"{leg.name[0]}{i}", mount=(float(x), *leg.mount[1:]))
        for leg in (own.legs[0], own.legs[-1])
        for i, x in enumerate(places)
    )
    return replace(own, legs=tuple(more))


def trot_commands(ticks: int, legs: int = 4) -> tuple[Array, Array]:
    """Commands of hip and knee [rad] of the open-loop trot, shape (ticks, legs) each."""
    hip, knee = np.array([commands(tick) for tick in range(ticks)]).transpose(1, 0, 2)
    places = np.arange(legs) % hip.shape[1]
    return np.ascontiguousarray(hip[:, places]), np.ascontiguousarray(knee[:, places])


class Trotting:
    """A plant full of robots.

    Args:
        kind: how they are computed, see ``KINDS``.
        level: instruction set, see ``plant.h``.
        legs: their number of legs, even.
        steps: integration steps per tick.

    Attributes:
        lanes: robots side by side.
    """

    def __init__(self, kind: str, level: int, legs: int = 4, steps: int = STEPS) -> None:
        ffi, lib = library()
        robot = robot_with(legs)
        self._legs, self._steps = legs, steps
        self._ground = GroundInC(Plane(), robot.contact.foot_radius)
        self._robot = robot_numbers(robot)
        self._start = start_coordinates(self._robot, self._ground, PlantOptions())
        history = lib.plant_history(robot.servo.latency, robot.sensor.delay, TICK)
        self._shape = (getattr(lib, KINDS[kind]), level, legs, 0, history)
        self.lanes = int(lib.plant_lanes(*self._shape[:2]))
        self._plant, self._kept = aligned_memory(lib.plant_size(*self._shape))
        self._grounds = ffi.new("plant_ground *[]", [self._ground.at] * self.lanes)

    def walk(self, ticks: int) -> None:
        """Put the robots to their start and let them trot for so many ticks.

        Raises:
            RuntimeError: one fell, so what was timed is no trot.
        """
        ffi, lib = library()
        lib.plant_create(self._plant, *self._shape)
        start = ffi.from_buffer("double[]", self._start)
        robot, ground = self._robot.at, self._ground.at
        for lane in range(self.lanes):
            lib.plant_place(self._plant, lane, robot, ground, lane, start, 0.0, TICK)
        hip, knee = (ffi.from_buffer("double[]", rows) for rows in trot_commands(ticks, self._legs))
        _timed().bench_ticks(
            lib.plant_command, lib.plant_advance, self._plant, self.lanes, self._legs,
            self._grounds, hip, knee, ticks, TICK, TICK / self._steps,
        )  # fmt: skip
        if any(lib.plant_state_of(self._plant, lane) for lane in range(self.lanes)):
            raise RuntimeError(f"a robot with {self._legs} legs fell within {ticks} ticks")


@cache
def _timed() -> Any:
    """The loop in C, compiled and loaded."""
    ffi, _ = library()
    own, platform = Path(__file__).parent, PLATFORMS[host_platform()]
    ffi.cdef(declarations((own / "ticks.h").read_text()))
    with tempfile.TemporaryDirectory(prefix="apnc-", ignore_cleanup_errors=True) as folder:
        headers = {name: text for name, text in sources().items() if name.endswith(".h")}
        files = {name: (own / name).read_bytes() for name in ("ticks.c", "ticks.h")}
        for name, text in (headers | files).items():
            (Path(folder) / name).write_bytes(text)
        made = compile_library(
            Path(folder), ["ticks.c"], platform, "ticks", ("-fvisibility=default",)
        )
        path = Path(folder) / f"ticks{platform.suffix}"
        path.write_bytes(made)
        return ffi.dlopen(str(path))

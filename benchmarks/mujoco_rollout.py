"""The robot in C against MuJoCo with its own contact, at the same error of the foot forces.

The robot in MuJoCo is the exported MJCF, many of it at once by ``mujoco.rollout``. Error: rms
difference of the vertical forces on the feet to those at 256 steps a tick of the same program, over
their rms, in the open-loop trot of ``python -m research.contact``; of the forces after each step,
and of their means over each tick.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from functools import cache
from typing import Any, Final

import mujoco
import numpy as np
from mujoco import rollout

from apnc_plant.ground import GroundInC, Plane
from apnc_plant.numbers import robot_numbers
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.start import start_coordinates
from benchmarks.command import Size, main
from benchmarks.fits import Between, between
from benchmarks.machine import levels, one_core
from benchmarks.rows import Row, in_turn, processor_s, wall_s
from benchmarks.ticks import STEPS, Trotting, trot_commands
from mujoco_models.tree import export_mjcf
from research.contact.measure import GRADUAL, OPEN_LOOP, TICK, Trot, errors, trot

INTEGRATORS: Final = ("implicitfast", "Euler")
"""As exported; and the one with which MuJoCo is fastest at equal error."""

ERRORS: Final = {"force_error": "each step", "tick_force_error": "mean over a tick"}
"""Errors of ``research.contact.measure``, and of which forces they are."""

AIMED_AT: Final = "force_error"
NEEDED: Final = 40.0
"""Times as fast as MuJoCo that robots side by side should be at equal error of that kind."""

THREADS: Final = 2

_FINEST: Final = 256
_STEPS: Final = (8, 16, 24, 32, 48, 64)
_TICKS: Final = round(OPEN_LOOP / TICK)
_SETTLING: Final = 60
"""Ticks before the forces count."""

_UNIT: Final = "us per tick and robot"


class Exported:
    """The exported robot in MuJoCo.

    Args:
        integrator: its name in MuJoCo.
        steps: integration steps per tick.
        sensors: whether MuJoCo computes the robot's sensors.
        robot: the robot; Lilibot if omitted.
    """

    def __init__(
        self,
        integrator: str,
        steps: int,
        *,
        sensors: bool = False,
        robot: RobotDescription | None = None,
    ) -> None:
        robot, options = robot or load_robot("lilibot"), PlantOptions()
        self.model: Any = mujoco.MjModel.from_xml_string(export_mjcf(robot))
        self.model.opt.integrator = getattr(mujoco.mjtIntegrator, f"mjINT_{integrator.upper()}")
        self.model.opt.timestep = TICK / steps
        # only the feet touch, as pairs: the robot in C has no other contact
        self.model.geom_contype[:] = self.model.geom_conaffinity[:] = 0
        if not sensors:
            self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_SENSOR
        self.steps = steps
        self.feet = [self.model.sensor(f"{leg.name}_grf").adr[0] for leg in robot.legs]
        ground = GroundInC(Plane(), robot.contact.foot_radius)
        start = start_coordinates(robot_numbers(robot), ground, options)
        data, kind = mujoco.MjData(self.model), mujoco.mjtState.mjSTATE_FULLPHYSICS
        data.qpos[:3], data.qpos[7:] = start[:3], start[6:]
        self.start = np.zeros(mujoco.mj_stateSize(self.model, kind))
        mujoco.mj_getState(self.model, data, self.start, kind)

    def walk(self, robots: int = 1, threads: int = 1, ticks: int = _TICKS) -> tuple[Any, Any]:
        """The open-loop trot: states and sensors of every robot after every step."""
        hip, knee = trot_commands(ticks)
        commands = np.stack([np.zeros_like(hip), hip, knee], axis=2).reshape(ticks, -1)
        control = np.repeat(commands, self.steps, axis=0)
        data = [mujoco.MjData(self.model) for _ in range(threads)]
        starts, controls = (np.stack([array] * robots) for array in (self.start, control))
        states, sensors = rollout.rollout(self.model, data, starts, controls)
        return states, sensors

    def trot(self) -> Trot:
        """The forces on the feet, as ``python -m research.contact`` has them."""
        states, sensors = self.walk()
        vertical = sensors[0, _SETTLING * self.steps :][:, self.feet]
        forces = np.zeros((*vertical.shape, 3))
        forces[:, :, 2] = vertical
        return Trot(forces, states[0, -1, 1:4])


@cache
def steps_at_equal_error(integrator: str, kind: str) -> Between:
    """Steps of MuJoCo at the error that the robot in C has with the steps of a walk."""
    own = errors(trot(GRADUAL, STEPS, "compiled"), trot(GRADUAL, _FINEST, "compiled"))
    finest = Exported(integrator, _FINEST, sensors=True).trot()
    return between(
        {
            steps: float(errors(Exported(integrator, steps, sensors=True).trot(), finest)[kind])
            for steps in _STEPS
        },
        float(own[kind]),
    )


def in_mujoco(way: str, steps: int, threads: int, size: Size) -> Callable[[], float]:
    """A measurement of ``Exported``: time of a tick of one robot [us]."""
    robots, ticks = (2, 60) if size.quick else (16, _TICKS)
    model = Exported(way, steps)
    return lambda: _taken(threads, lambda: model.walk(robots, threads, ticks)) / (ticks * robots)


def in_c(kind: str, level: int, threads: int, size: Size) -> Callable[[], float]:
    """A measurement of ``Trotting``, a plant for each thread: time of a tick of one robot [us]."""
    plants, ticks = [Trotting(kind, level) for _ in range(threads)], 60 if size.quick else 1000

    def work() -> None:
        with ThreadPoolExecutor(threads) as executor:
            list(executor.map(lambda plant: plant.walk(ticks), plants))

    return lambda: _taken(threads, work) / (ticks * sum(plant.lanes for plant in plants))


def _taken(threads: int, work: Callable[[], object]) -> float:
    """Time of the processor for one thread, wall time for more [us]."""
    return 1e6 * (processor_s(work) if threads == 1 else wall_s(work))


def measure(size: Size) -> list[Row]:
    """Time of a tick on one core, and on two threads."""
    names = levels()
    best = max(names)
    at = {(way, kind): steps_at_equal_error(way, kind) for way in INTEGRATORS for kind in ERRORS}
    needed = {(way, n) for (way, _), found in at.items() for n in (found.coarse, found.fine)}
    ways = {f"robots, {names[n]}": ("robots", n) for n in names}
    ways[f"legs, {names[best]}"] = ("legs", best)
    fastest = f"robots, {names[best]}"
    rows = []
    for threads, shown in ((1, list(ways)), (THREADS, [fastest])):
        with one_core(size.core if threads == 1 else -1):
            times = in_turn(
                {what: in_c(*ways[what], threads, size) for what in shown}
                | {f"{way} {n}": in_mujoco(way, n, threads, size) for way, n in sorted(needed)},
                size.rounds,
            )
        for (way, kind), found in at.items():
            if threads != 1 and kind != AIMED_AT:
                continue
            pairs = zip(times[f"{way} {found.coarse}"], times[f"{way} {found.fine}"], strict=True)
            others = tuple(found.cost(*pair) for pair in pairs)
            against = f"MuJoCo, {way}, {found.steps:.0f} steps; error: {ERRORS[kind]}"
            for what in shown if kind == AIMED_AT else [fastest]:
                least = NEEDED if kind == AIMED_AT and what.startswith("robots") else None
                words = f"C, {what}, threads: {threads}"
                rows.append(Row(words, _UNIT, times[what], against, others, least))
    return rows


if __name__ == "__main__":
    main({"mujoco_rollout": measure}, __doc__)

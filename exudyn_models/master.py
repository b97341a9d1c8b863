"""Co-simulation master: exchanges loads and joint commands once per control tick."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from exudyn_models.plant import Plant, PlantError
from exudyn_models.recording import Array, Record


@dataclass(frozen=True)
class Commands:
    """Inputs of the controller that are not loads."""

    MI: float = 0.08
    turn: float = 0.0
    reset: bool = False


class Controller(Protocol):
    """What the master needs of a controller; ``FmuController`` is one."""

    wall_s: float
    theta_hip: Array
    theta_knee: Array

    def step(self, t: float, h: float, grf: Array, MI: float, turn: float, reset: bool) -> None:
        """Step from ``t`` by ``h`` [s] on the loads [N] and commands given."""

    def sample(self) -> Mapping[str, Array]:
        """All inputs and outputs now, by row name of the table of variables."""


Schedule = Callable[[float], Commands]
Progress = Callable[[float, Controller], None]


def run(
    plant: Plant,
    controller: Controller,
    duration: float,
    Ts: float,
    schedule: Schedule,
    progress: Progress = lambda t, controller: None,
    stop: Callable[[], bool] = lambda: False,
) -> Record:
    """Walk the robot under the controller.

    At tick n the controller gets the loads that the sensors show at t_n = n Ts and its joint
    commands act on the servos from t_n to t_n+1: what a control computer on the robot does.

    Args:
        plant: the robot, at its start.
        controller: the controller, before its first step.
        duration: simulated time [s], rounded to whole ticks.
        Ts: time of one tick [s].
        schedule: commands at a time [s].
        progress: called after every tick with the time [s].
        stop: asked before every tick; True ends the run.

    Returns:
        The record. A plant that diverges or ``stop`` end it early, and what was recorded stays.
    """
    begin = time.perf_counter()
    times: list[float] = []
    bodies: list[Mapping[str, Array]] = []
    brains: list[Mapping[str, Array]] = []
    planned, error = round(duration / Ts), ""
    for n in range(planned):
        if stop():
            break
        t = n * Ts
        commands = schedule(t)
        controller.step(t, Ts, plant.grf(), commands.MI, commands.turn, commands.reset)
        times.append(t)
        bodies.append(plant.sample())
        brains.append(controller.sample())
        try:
            plant.advance(controller.theta_hip, controller.theta_knee, Ts)
        except PlantError as problem:
            error = str(problem)
            break
        progress(t + Ts, controller)
    return Record(
        legs=plant.legs,
        time=np.array(times),
        plant=_stacked(bodies),
        controller=_stacked(brains),
        mass=plant.mass,
        complete=len(times) == planned and not error,
        error=error,
        fmu_wall_s=controller.wall_s,
        wall_s=time.perf_counter() - begin,
    )


def _stacked(samples: list[Mapping[str, Array]]) -> dict[str, Array]:
    if not samples:
        return {}
    return {name: np.array([sample[name] for sample in samples]) for name in samples[0]}

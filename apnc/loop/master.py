"""Co-simulation master: exchanges loads and joint commands once per control tick."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from apnc.loop.recording import Array, Record
from exudyn_models.conditions import Conditions
from exudyn_models.physics.plant import Plant, PlantError
from exudyn_models.trace import Trace


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

    def trace(self, ticks: int) -> Trace:
        """A recorder of all inputs and outputs, by row name of the table of variables."""


Schedule = Callable[[float], Commands]
Circumstances = Callable[[float], Conditions]
Progress = Callable[[float, Controller], None]


def run(
    plant: Plant,
    controller: Controller,
    duration: float,
    Ts: float,
    schedule: Schedule,
    progress: Progress = lambda t, controller: None,
    stop: Callable[[], bool] = lambda: False,
    circumstances: Circumstances | None = None,
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
        circumstances: conditions of the robot at a time [s]; those it was built with if omitted.

    Returns:
        The record. A plant that diverges or ``stop`` end it early, and what was recorded stays.
    """
    begin = time.perf_counter()
    planned, error = round(duration / Ts), ""
    times: list[float] = []
    body, brain = plant.trace(planned), controller.trace(planned)
    present: Conditions | None = None
    for n in range(planned):
        if stop():
            break
        t = n * Ts
        if circumstances and (conditions := circumstances(t)) is not present:
            plant.set_conditions(conditions)
            present = conditions
        commands = schedule(t)
        controller.step(t, Ts, plant.grf(), commands.MI, commands.turn, commands.reset)
        times.append(t)
        body.take()
        brain.take()
        try:
            plant.advance(controller.theta_hip, controller.theta_knee, Ts)
        except PlantError as problem:
            error = str(problem)
            break
        progress(t + Ts, controller)
    return Record(
        legs=plant.legs,
        time=np.array(times),
        plant=body.channels() if times else {},
        controller=brain.channels() if times else {},
        mass=plant.mass,
        complete=len(times) == planned and not error,
        error=error,
        fmu_wall_s=controller.wall_s,
        wall_s=time.perf_counter() - begin,
    )

"""The co-simulation master: the closed loop of robot and controller."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace
from pathlib import Path
from typing import Any, Final, Protocol

import numpy as np

from apnc.loop.batch import Batch, Run, Stop, contacts_of, lanes_of
from apnc.loop.engines import COMPILED, plant_in
from apnc.loop.experiment import Experiment, conditions_of
from apnc.loop.fmu_controller import FmuController
from apnc.loop.of_robot import warn_of_mi
from apnc.loop.push import Push, velocity_changes
from apnc.loop.record import End, Record, merged
from apnc.loop.schedule import ScheduleLookup
from apnc_core.types import Array
from apnc_plant.options import PlantOptions
from apnc_plant.plant import LivePlant, Plant, PlantError
from build_fmu.build import host_fmu


class Shown(Protocol):
    """State of the controller that can be shown while a robot walks."""

    @property
    def phi(self) -> Any:
        """Relative phases [rad], shape (n_legs - 1,)."""


WalkProgress = Callable[[float, Shown], None]
"""Called with the time [s] and what is shown of the controller."""

Watch = Callable[[float, Mapping[str, Array], Shown], Iterable[tuple[float, float]]]
"""Called with the time [s], a sample of the plant and what is shown of the controller.

It gives the pushes that begin then: impulses along x and y of the world [N s].
"""

IN_C_S: Final = 0.25
"""Simulated time that is walked in C between two calls of ``progress`` and ``stop`` [s]."""


def simulate(
    experiment: Experiment,
    *,
    plant: Plant | None = None,
    progress: WalkProgress = lambda t, controller: None,
    stop: Stop = lambda: False,
    watch: Watch | None = None,
) -> Record:
    """Walk a robot under the controller FMU. It warns of an MI outside the robot's ``mi_range``.

    At tick n the controller gets the loads that the sensors show at t_n = n Ts, and its joint
    commands act on the servos from t_n to t_n+1: what a control computer on the robot does.

    Args:
        experiment: what is run.
        plant: the robot at its start. If omitted, it is made from the experiment, in its engine.
        progress: called with the time [s] and the state of the controller after every tick; with
            ``engine="compiled"`` every quarter of a simulated second.
        stop: called as often; True ends the run.
        watch: called at every tick before the robot moves, also with ``engine="compiled"``, which
            then walks tick by tick in Python with the same bits. The experiment of the record has
            the pushes that it gave, so that the run can be repeated.

    Returns:
        The record. A fall, a motion that diverges or ``stop`` end the run early; the record then
        holds the samples up to there.

    Raises:
        ValueError: the FMU cannot be used, or is for another number of legs; the plant cannot be
            watched or pushed.
    """
    warn_of_mi([experiment])
    return walk_one(experiment, plant=plant, progress=progress, stop=stop, watch=watch)


def walk_one(
    experiment: Experiment,
    *,
    plant: Plant | None = None,
    progress: WalkProgress = lambda t, controller: None,
    stop: Stop = lambda: False,
    watch: Watch | None = None,
) -> Record:
    """As :func:`simulate`, without a warning."""
    if plant is None and watch is None and experiment.engine == COMPILED:
        return _run_in_c(experiment, progress, stop)
    robot = experiment.description
    path = Path(experiment.fmu) if experiment.fmu else host_fmu(len(robot.legs))
    with FmuController(path, experiment.starts()) as controller:
        if controller.n_legs != len(robot.legs):
            raise ValueError(
                f"{path} is for {controller.n_legs} legs; robot '{robot.name}' has "
                f"{len(robot.legs)}"
            )
        return _run(experiment, plant or plant_of(experiment), controller, progress, stop, watch)


def plant_of(experiment: Experiment) -> Plant:
    """The robot of an experiment in its engine, at its start.

    Raises:
        ValueError: the engine's package is not installed.
    """
    return plant_in(experiment.engine)(
        experiment.description,
        experiment.seed,
        options=PlantOptions(step=experiment.step),
        ground=experiment.ground,
        conditions=conditions_of(
            ScheduleLookup(experiment.conditions).at(0.0), experiment.description
        ),
    )


def _run(
    experiment: Experiment,
    plant: Plant,
    controller: FmuController,
    progress: WalkProgress,
    stop: Stop,
    watch: Watch | None,
) -> Record:
    live = plant if isinstance(plant, LivePlant) else None
    if live is None and (watch or experiment.pushes):
        raise ValueError(f"a {type(plant).__name__} can be neither watched nor pushed")
    begin, Ts = time.perf_counter(), experiment.Ts
    mi, turn = ScheduleLookup(experiment.mi), ScheduleLookup(experiment.turn)
    reset, conditions = ScheduleLookup(experiment.reset), ScheduleLookup(experiment.conditions)
    body, brain, parameters = plant.trace(), controller.trace(), controller.parameters()
    end, message, present = End.complete, "", conditions.at(0.0)
    pushes = experiment.pushes
    changes = velocity_changes(pushes, plant.mass, Ts, experiment.ticks)
    for n in range(experiment.ticks):
        if stop():
            end = End.interrupted
            break
        t = n * Ts
        if (wanted := conditions.at(t)) is not present:
            plant.set_conditions(conditions_of(wanted, experiment.description))
            present = wanted
        controller.step(t, Ts, plant.grf(), mi.at(t), turn.at(t), reset.at(t))
        body.take()
        brain.take()
        if watch and live:
            given = [Push(t, x, y) for x, y in watch(t, live.sample(), controller)]
            if given:
                pushes += tuple(given)
                changes = velocity_changes(pushes, plant.mass, Ts, experiment.ticks)
        if live and n in changes:
            live.shift_velocity(*changes[n])
        try:
            plant.advance(controller.theta_hip, controller.theta_knee, Ts)
        except PlantError as problem:
            end, message = End.diverged, str(problem)
            break
        if plant.fell:
            end = End.fell
            break
        progress(t + Ts, controller)
    if pushes != experiment.pushes:
        experiment = replace(experiment, pushes=pushes)
    return Record(
        legs=plant.legs,
        time=np.arange(len(body), dtype=np.float64) * Ts,
        signals=merged(plant=body.signals(), controller=brain.signals()),
        mass=plant.mass,
        experiment=experiment,
        robot=experiment.description,
        parameters=parameters,
        end=end,
        message=message,
        fmu_wall_s=controller.wall_s,
        wall_s=time.perf_counter() - begin,
    )


def _run_in_c(experiment: Experiment, progress: WalkProgress, stop: Stop) -> Record:
    batch = Batch(lanes_of(experiment), contacts_of([experiment]), single=True)
    run = Run(experiment, batch.controller)
    ticks = max(1, round(IN_C_S * experiment.rate))
    try:
        batch.begin(run)
        while not stop():
            ended = batch.walk(ticks)
            progress(run.ticks * experiment.Ts, run)
            if ended:
                return run.record()
        return run.record(End.interrupted)
    finally:
        batch.close()

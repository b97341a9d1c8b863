"""The search loop of ``apnc tune`` with the robot in C, beside the same loop with MuJoCo's rollout.

A generation of candidates walks in closed loop with its own bodies, MI and seeds; every run is
measured and gets its cost. In MuJoCo every run has a model of its own, exported and compiled, and
all of them go through ``mujoco.rollout`` tick by tick, with the steps that give the force error of
the robot in C (see ``benchmarks.mujoco_rollout``). What is measured there are the records of the
same runs in C, so that both loops do the same work beside the robot. To start the controllers does
not count. Time of the processor for one thread, wall time for two.
"""

from __future__ import annotations

import math
import statistics
from collections.abc import Callable, Sequence
from contextlib import ExitStack
from dataclasses import replace
from functools import partial
from typing import Final

import mujoco
import numpy as np
from mujoco import rollout

from apnc.loop.batch import fmu_of
from apnc.loop.experiment import Experiment
from apnc.loop.fmu_controller import FmuController
from apnc.loop.record import Record
from apnc.many import simulate_many
from apnc.tune import MI_AIMED
from apnc.tune.costs import total
from apnc.tune.design import Candidate, Start, candidate, variables_for
from apnc.tune.evaluate import evaluator_of, seconds
from apnc.tune.measured import Measured, measured
from apnc.tune.runs import Task, of_generation
from apnc_core.types import Array
from apnc_plant.chance import side_offset
from apnc_plant.robot import RobotDescription, load_robot
from benchmarks.command import Size, main
from benchmarks.mujoco_rollout import AIMED_AT, INTEGRATORS, Exported, steps_at_equal_error
from benchmarks.rows import Row, in_turn, processor_s, wall_s

CANDIDATES: Final = 8
"""Candidates of a generation; the lanes of two threads are filled some times."""

KINDS: Final = ("walk", "apc")
"""Runs that both walk: payload, broken sensors and the air are no part of an exported robot."""

THREADS: Final = (1, 2)

NEEDED: Final = 4000.0
"""Robot-seconds a second that the search should do on two threads."""

_SEED: Final = 3
_UNIT: Final = "ms for a robot-second"


def start_of(robot: str) -> Start:
    """What a search of a robot begins with."""
    description = load_robot(robot)
    return Start(
        description, description.rate or 60.0, MI_AIMED,
        variables_for(description, servo=True, body=False, scale=True), False,
    )  # fmt: skip


def generation(start: Start, size: Size) -> list[list[Task]]:
    """Runs of the candidates around the start, by candidate."""
    rng = np.random.default_rng(_SEED)
    tried: list[Candidate] = []
    for _ in range(1 if size.quick else CANDIDATES):
        near = np.clip(np.array(start.first()) + rng.normal(0.0, 0.05, len(start.variables)), 0, 1)
        tried.append(candidate(start, near))
    plan = of_generation(start, tried, _SEED)
    if not size.quick:
        return plan
    short = [
        replace(task, experiment=replace(task.experiment, duration=size.duration))
        for task in plan[0]
    ]
    return [short]


class Loops:
    """Closed loops of controller FMUs and exported robots in MuJoCo.

    Args:
        runs: the experiments, all at one rate.
        integrator: its name in MuJoCo.
        steps: integration steps per tick.
    """

    def __init__(self, runs: Sequence[Experiment], integrator: str, steps: int) -> None:
        self._runs, self._steps = runs, steps
        self._robots = [
            Exported(integrator, steps, sensors=True, robot=_lopsided(run)) for run in runs
        ]

    def walk(self, controllers: Sequence[FmuController], threads: int) -> Array:
        """Walk all runs to their end and return the last states."""
        models = [robot.model for robot in self._robots]
        feet = np.array([robot.feet for robot in self._robots])
        states = np.stack([robot.start for robot in self._robots])
        data = [mujoco.MjData(models[0]) for _ in range(threads)]
        loads, commands = np.zeros(feet.shape), np.zeros((*feet.shape, 3))
        Ts = self._runs[0].Ts
        with rollout.Rollout(nthread=threads) as pool:
            for tick in range(self._runs[0].ticks):
                for k, (run, each) in enumerate(zip(self._runs, controllers, strict=True)):
                    assert isinstance(run.mi, float)
                    each.step(tick * Ts, Ts, loads[k], run.mi, 0.0, False)
                    commands[k, :, 1], commands[k, :, 2] = each.theta_hip, each.theta_knee
                control = np.repeat(commands.reshape(len(feet), 1, -1), self._steps, axis=1)
                found, sensors = pool.rollout(models, data, states, control)
                states, loads = found[:, -1], np.take_along_axis(sensors[:, -1], feet, axis=1)
        return states


def _lopsided(run: Experiment) -> RobotDescription:
    """The robot with the sideways error of its seed in the file, which an export leaves out.

    Without it the legs stay in phase, and no gait forms.
    """
    robot = run.description
    x, y, z = robot.trunk.com
    com = (x, y + side_offset(robot, run.seed), z)
    return replace(robot, trunk=replace(robot.trunk, com=com))


Plan = Sequence[Sequence[Task]]
"""Runs of a generation, by candidate."""


def judged(plan: Plan, found: Sequence[Measured]) -> list[float]:
    """Cost of every candidate."""
    each = len(plan[0])
    parts = (found[k * each : (k + 1) * each] for k in range(len(plan)))
    return [total(own, part) for own, part in zip(plan, parts, strict=True)]


def in_c(start: Start, plan: Plan, threads: int) -> float:
    """Time of a generation in C for a robot-second [ms]."""
    tasks = [task for own in plan for task in own]
    with evaluator_of(start, threads, None, lambda: False) as evaluate:
        return _taken(threads, lambda: judged(plan, evaluate(tasks))) / seconds(tasks)


def in_mujoco(
    start: Start, plan: Plan, records: Sequence[Record], way: tuple[str, int], threads: int
) -> float:
    """Time of a generation in MuJoCo for a robot-second [ms]."""
    tasks = [task for own in plan for task in own]
    runs = [task.experiment for task in tasks]
    with ExitStack() as open_:
        controllers = [
            open_.enter_context(FmuController(fmu_of(run), run.starts())) for run in runs
        ]

        def work() -> None:
            Loops(runs, *way).walk(controllers, threads)
            judged(plan, [measured(start, *pair) for pair in zip(tasks, records, strict=True)])

        return _taken(threads, work) / seconds(tasks)


def _taken(threads: int, work: Callable[[], object]) -> float:
    return 1000.0 * (processor_s(work) if threads == 1 else wall_s(work))


def measure(size: Size) -> list[Row]:
    """Time of a generation, on one thread and on two."""
    start = start_of("lilibot")
    whole = generation(start, size)
    walks = [[task for task in own if task.kind in KINDS] for own in whole]
    found = simulate_many([task.experiment for own in walks for task in own], records=True)
    records = [record for record in found if record is not None]
    ways = {}
    for integrator in INTEGRATORS:
        steps = math.ceil(steps_at_equal_error(integrator, AIMED_AT).steps)
        ways[f"MuJoCo, {integrator}, {steps} steps"] = (integrator, steps)
    rows = []
    for threads in THREADS:
        own = {"all runs": partial(in_c, start, whole, threads)}
        own["walks"] = partial(in_c, start, walks, threads)
        others = {n: partial(in_mujoco, start, walks, records, w, threads) for n, w in ways.items()}
        times = in_turn(own | others, size.rounds)
        words, aim = f"C, threads: {threads}", NEEDED if threads == max(THREADS) else None
        rows.append(_row(f"{words}, all runs", times["all runs"], aim=aim))
        rows += [_row(f"{words}, walks", times["walks"], name, times[name]) for name in ways]
        rows += [_row(f"{name}, threads: {threads}", times[name]) for name in ways]
    return rows


def _row(
    what: str,
    times: tuple[float, ...],
    against: str = "",
    others: tuple[float, ...] = (),
    aim: float | None = None,
) -> Row:
    fast = f"{1000.0 / statistics.median(times):.0f} robot-seconds a second"
    most = None if aim is None else 1000.0 / aim
    return Row(what, _UNIT, times, against, others, most=most, note=fast)


if __name__ == "__main__":
    main({"tune": measure}, __doc__)

"""Which integration step is fine enough: the step is halved until nothing moves any more."""

from __future__ import annotations

import csv
import math
import time
from collections.abc import Callable
from dataclasses import astuple, dataclass, fields, replace
from pathlib import Path
from typing import Final

import numpy as np

from apnc.loop.fmu_controller import FmuController
from apnc.loop.master import Commands
from apnc.loop.master import run as co_simulate
from apnc.loop.recording import Array
from apnc.loop.walk import WalkOptions
from apnc.studies.contact_picture import picture
from apnc.summary import summarise
from build_fmu.build import host_fmu
from exudyn_models.physics.plant import Plant, PlantError, PlantOptions
from exudyn_models.robot.file import load_robot
from exudyn_models.robot.model import RobotDescription

TICK: Final = 1 / 60
STEPS_PER_TICK: Final = (8, 16, 32, 64, 128, 256)

SUDDEN: Final = 1e-6
"""Damping depth [m] that is as good as none: damping jumps in at first touch."""

OPEN_LOOP: Final = 3.0
"""Length of the open-loop trot [s]; its first second does not count."""

CLOSED_LOOP: Final = 30.0
"""Length of the closed-loop walk [s]."""

Progress = Callable[[float], None]


@dataclass(frozen=True)
class Row:
    """One law of contact at one step.

    Args:
        damping_depth_mm: depth over which damping sets in [mm].
        step_ms: integration step [ms].
        real_time_factor: simulated time over processor time of the closed loop.
        peak_N: largest vertical force on a foot in open-loop trot [N].
        force_error: rms difference of the vertical forces, eight times per tick, to the finest
            step, over their rms [1].
        tick_force_error: the same for the forces averaged over each control tick.
        chatter: share of loaded steps at which a lateral force turns round twice in two steps.
        distance_error_mm: end of open-loop trot against the finest step [mm].
        converged_s, path_speed_m_per_s, duty_factor, cost_of_transport: of one closed-loop walk
            with the FMU at MI 0.08; ``converged_s`` is nan if no trot formed.
    """

    damping_depth_mm: float
    step_ms: float
    real_time_factor: float
    peak_N: float
    force_error: float
    tick_force_error: float
    chatter: float
    distance_error_mm: float
    converged_s: float
    path_speed_m_per_s: float
    duty_factor: float
    cost_of_transport: float


@dataclass(frozen=True)
class Trot:
    """Forces on the feet after every step, shape (steps, n_legs, 3), and the place at the end."""

    forces: Array
    place: Array


def open_loop_trot(robot: RobotDescription, steps: int) -> Trot:
    """Trot on fixed phases, integrated with ``steps`` steps per tick."""
    plant = Plant(robot, options=PlantOptions(step=TICK / steps))
    side = np.array([1.0, -1.0, -1.0, 1.0])
    forces = []
    for tick in range(round(OPEN_LOOP / TICK)):
        hip = 0.13 * math.sin(0.12 * tick) * side - 0.111
        knee = 0.08 * math.cos(0.12 * tick) * side - 0.039
        for _ in range(steps):
            plant.advance(hip, knee, TICK / steps)
            if tick >= 60:
                forces.append(plant.sample()["foot_force"])
    return Trot(np.array(forces), plant.sample()["position"])


def closed_loop_walk(robot: RobotDescription, steps: int) -> tuple[float, ...]:
    """Real-time factor, convergence [s], speed [m/s], duty factor and cost of transport."""
    options = WalkOptions(duration=CLOSED_LOOP)
    parameters = {"robot_weight": robot.weight} | options.parameters()
    with FmuController(host_fmu(len(robot.legs)), parameters) as controller:
        plant = Plant(robot, options.seed, options=PlantOptions(step=TICK / steps))
        commands = Commands(MI=options.mi)
        begin = time.process_time()
        record = co_simulate(plant, controller, CLOSED_LOOP, TICK, lambda t: commands)
        spent = time.process_time() - begin
    if record.error:
        raise PlantError(record.error)
    summary = summarise(record, method=options.method, mi=options.mi, seed=options.seed)
    duty = [math.nan if value is None else value for value in summary.duty_factor.values()]
    measured = (
        CLOSED_LOOP / spent,
        summary.convergence_time_s,
        summary.path_speed_m_per_s,
        float(np.mean(duty)),
        summary.cost_of_transport,
    )
    return tuple(math.nan if value is None else value for value in measured)


def chatter(forces: Array) -> float:
    """Share of loaded samples at which a lateral force turns round twice in two steps."""
    loaded = forces[2:, :, 2] > 1.0
    change = np.diff(forces[:, :, :2], axis=0)
    sharp = np.abs(change) > 0.1
    turned = (change[1:] * change[:-1] < 0.0) & sharp[1:] & sharp[:-1]
    return float((turned.any(axis=2) & loaded).sum() / loaded.sum())


def _per_tick(trot: Trot, steps: int) -> Array:
    """Vertical forces by tick, step in the tick and leg."""
    return trot.forces[:, :, 2].reshape(-1, steps, trot.forces.shape[1])


def _relative(values: Array, reference: Array) -> float:
    return float(np.sqrt(((values - reference) ** 2).mean() / (reference**2).mean()))


def _row(robot: RobotDescription, steps: int, trot: Trot, finest: Trot) -> Row:
    forces, reference = _per_tick(trot, steps), _per_tick(finest, STEPS_PER_TICK[-1])
    coarsest = STEPS_PER_TICK[0]
    every, ref_every = steps // coarsest, STEPS_PER_TICK[-1] // coarsest
    try:
        walked = closed_loop_walk(robot, steps)
    except PlantError:
        walked = (math.nan,) * 5
    return Row(
        1e3 * robot.contact.damping_depth,
        1e3 * TICK / steps,
        walked[0],
        float(trot.forces[:, :, 2].max()),
        _relative(forces[:, every - 1 :: every], reference[:, ref_every - 1 :: ref_every]),
        _relative(forces.mean(axis=1), reference.mean(axis=1)),
        chatter(trot.forces),
        1e3 * float(np.linalg.norm(trot.place - finest.place)),
        *walked[1:],
    )


def run(output: Path, progress: Progress = lambda share: None) -> list[Row]:
    """Halve the step from 2 ms to 65 us, with gradual and with sudden damping of the contact.

    Writes ``contact.csv``, a row per law and step, and ``contact.svg`` into an existing folder.

    Args:
        output: the folder.
        progress: called with the share of the work done [1].

    Raises:
        OSError: a file cannot be written.
    """
    robot = load_robot("lilibot")
    depths = (robot.contact.damping_depth, SUDDEN)
    rows: list[Row] = []
    trots: dict[tuple[float, int], Trot] = {}
    for depth in depths:
        variant = replace(robot, contact=replace(robot.contact, damping_depth=depth))
        finest = open_loop_trot(variant, STEPS_PER_TICK[-1])
        for steps in STEPS_PER_TICK:
            is_finest = steps == STEPS_PER_TICK[-1]
            trots[depth, steps] = finest if is_finest else open_loop_trot(variant, steps)
            rows.append(_row(variant, steps, trots[depth, steps], finest))
            progress(len(rows) / (len(depths) * len(STEPS_PER_TICK)))
    with (output / "contact.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(field.name for field in fields(Row))
        writer.writerows([f"{value:.6g}" for value in astuple(row)] for row in rows)
    touch_down = {
        f"{1e3 * TICK / steps:.3g} ms, damping depth {1e3 * depth:g} mm": _touch_down(
            trots[depth, steps], steps
        )
        for depth, steps in (
            (depths[1], STEPS_PER_TICK[-1]),
            (depths[0], STEPS_PER_TICK[-1]),
            (depths[0], 32),
            (depths[0], 16),
        )
    }
    (output / "contact.svg").write_text(picture(rows, touch_down), encoding="utf-8")
    return rows


def _touch_down(trot: Trot, steps: int) -> tuple[Array, Array]:
    """Time [ms] and vertical force [N] of the first leg around its first touch-down."""
    force = trot.forces[:, 0, 2]
    first = int(np.flatnonzero((force[1:] > 0.0) & (force[:-1] == 0.0))[0])
    window = slice(first - steps // 4, first + 2 * steps)
    time = (np.arange(len(force))[window] - first) * 1e3 * TICK / steps
    return time, force[window]

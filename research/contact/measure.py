"""Forces on the feet in an open-loop trot, and their error against the finest step."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Final, NamedTuple

import numpy as np

from apnc.loop.engines import OWN_ENGINE, plant_in
from apnc.loop.record import Record
from apnc.studies.results import Result
from apnc.studies.robots import changed, constant
from apnc_core.types import Array
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot

TICK: Final = 1 / 60
STEPS: Final = (12, 24, 48, 96, 192)
"""Numbers of integration steps per tick, from about the longest step that is allowed."""

GRADUAL: Final = load_robot("lilibot").contact.damping_depth
"""Shipped depth over which damping sets in [m]."""

SUDDEN: Final = 1e-6
"""Damping depth of almost zero [m]: full damping from the first touch on."""

OPEN_LOOP: Final = 3.0
"""Length of the open-loop trot [s]. Its first second is not measured."""


class Trot(NamedTuple):
    """Forces on the feet after every step [N], shape (steps, n_legs, 3), and last position [m]."""

    forces: Array
    position: Array


def robot(depth: float) -> RobotDescription:
    """Lilibot with another damping depth of its feet [m]."""
    return changed(load_robot("lilibot"), "contact.damping_depth", constant(depth))


def commands(tick: int) -> tuple[Array, Array]:
    """Commands of hip and knee [rad], shape (4,), of the trot at a tick."""
    side = np.array([1.0, -1.0, -1.0, 1.0])
    hip = 0.13 * math.sin(0.12 * tick) * side - 0.111
    return hip, 0.08 * math.cos(0.12 * tick) * side - 0.039


@lru_cache
def trot(depth: float, steps: int, engine: str = OWN_ENGINE) -> Trot:
    """The open-loop trot with ``steps`` integration steps per tick."""
    plant = plant_in(engine)(robot(depth), options=PlantOptions(step=TICK / steps))
    forces = []
    for tick in range(round(OPEN_LOOP / TICK)):
        hip, knee = commands(tick)
        for _ in range(steps):
            plant.advance(hip, knee, TICK / steps)
            if tick >= 60:
                forces.append(plant.sample()["foot_force"])
    return Trot(np.array(forces), plant.sample()["position"])


def measure(record: Record) -> Result:
    """Errors of the open-loop trot with the step of a walk, and the speed of the computation."""
    depth = record.robot.contact.damping_depth
    steps = round(TICK / record.experiment.step)
    return {
        "step_ms": 1e3 * TICK / steps,
        "real_time_factor": record.ended_at / record.wall_s,
        **errors(trot(depth, steps), trot(depth, STEPS[-1])),
    }


def errors(own: Trot, finest: Trot) -> Result:
    """How a trot differs from one with the finest step.

    Returns:
        ``peak_N``: largest vertical force on a foot [N].
        ``force_error``: rms difference of the vertical forces over their rms [1], sampled at the
        times of the coarsest step that both have.
        ``tick_force_error``: the same of the mean forces of each tick [1].
        ``chatter``: see :func:`chatter` [1].
        ``distance_error_mm``: distance between the last positions [mm].
    """
    forces, reference = _per_tick(own), _per_tick(finest)
    grid = math.gcd(STEPS[0], forces.shape[1], reference.shape[1])
    return {
        "peak_N": float(own.forces[:, :, 2].max()),
        "force_error": _relative(_coarser(forces, grid), _coarser(reference, grid)),
        "tick_force_error": _relative(forces.mean(axis=1), reference.mean(axis=1)),
        "chatter": chatter(own.forces),
        "distance_error_mm": 1e3 * float(np.linalg.norm(own.position - finest.position)),
    }


def chatter(forces: Array) -> float:
    """Share of loaded samples at which a lateral force reverses its change between two steps."""
    loaded = forces[2:, :, 2] > 1.0
    change = np.diff(forces[:, :, :2], axis=0)
    sharp = np.abs(change) > 0.1
    turned = (change[1:] * change[:-1] < 0.0) & sharp[1:] & sharp[:-1]
    return float((turned.any(axis=2) & loaded).sum() / loaded.sum())


def _per_tick(trot: Trot) -> Array:
    """Vertical forces by tick, step in the tick and leg."""
    ticks = round(OPEN_LOOP / TICK) - 60
    return trot.forces[:, :, 2].reshape(ticks, -1, trot.forces.shape[1])


def _coarser(forces: Array, grid: int) -> Array:
    """Forces at so many times in a tick, which all that are compared have."""
    every = forces.shape[1] // grid
    return forces[:, every - 1 :: every]


def _relative(values: Array, reference: Array) -> float:
    return float(np.sqrt(((values - reference) ** 2).mean() / (reference**2).mean()))


def touch_down(trot: Trot, steps: int) -> tuple[Array, Array]:
    """Time [ms] and vertical force [N] of the first leg around its first touch-down."""
    force = trot.forces[:, 0, 2]
    first = int(np.flatnonzero((force[1:] > 0.0) & (force[:-1] == 0.0))[0])
    window = slice(first - steps // 4, first + 2 * steps)
    return (np.arange(len(force))[window] - first) * 1e3 * TICK / steps, force[window]

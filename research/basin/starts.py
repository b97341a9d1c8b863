"""Walks that begin at any phases of the oscillators."""

from __future__ import annotations

from collections import deque
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import numpy as np

from apnc import metrics
from apnc.loop.batch import Batch, Run, contacts_of, lanes_of
from apnc.loop.experiment import Experiment
from apnc_core.interface import Parameters
from apnc_core.types import Array
from research.basin.apart import begun_at
from research.modes.gaits import CANDIDATES, gait_of, mirrored
from research.modes.returns import Cycle, free_cycle

RANDOM: Final = "random"
"""Name of a start at phases by chance."""

SIGNALS: Final = frozenset({"o1", "o2", "foot_force"})
"""Signals of a record that a walk keeps."""

Found = dict[str, Any]


@dataclass(frozen=True)
class Walk:
    """Outputs of the oscillators, shape (T, n), loads of the ground [N], and whether it fell."""

    o1: Array
    o2: Array
    force: Array
    fell: bool


def phases_of(start: str, n_legs: int, seed: int) -> Array:
    """Phases of the oscillators at the start [rad], shape (n_legs,).

    Args:
        start: ``RANDOM``, or the name of a gait. A gait begins at a common phase by chance.
        n_legs: number of legs.
        seed: of chance.
    """
    rng = np.random.default_rng(seed)
    if start == RANDOM:
        return rng.uniform(-np.pi, np.pi, n_legs)
    gait = np.concatenate([[0.0], CANDIDATES[n_legs][start]])
    return np.asarray(metrics.wrap(gait + rng.uniform(-np.pi, np.pi)))


def starts_of(n_legs: int) -> tuple[str, ...]:
    """Names of all starts of a robot."""
    return (RANDOM, *CANDIDATES.get(n_legs, {}))


def outputs_at(experiment: Experiment, phases: Array) -> tuple[Array, Array]:
    """o1 and o2 of oscillators on their free cycle, shape (n_legs,) each.

    Args:
        experiment: its MI, one value, and its parameters decide the cycle.
        phases: of every oscillator [rad], shape (n_legs,). They grow evenly with time.
    """
    assert isinstance(experiment.mi, float)
    return _cycle(_parameters(experiment), experiment.mi).at(phases)


@cache
def _cycle(p: Parameters, MI: float) -> Cycle:
    return free_cycle(p, MI)


def _parameters(experiment: Experiment) -> Parameters:
    return Parameters(**experiment.parameters())  # type: ignore[arg-type]  # checked per name


def walks_from(
    experiments: Sequence[Experiment], starts: Sequence[tuple[Array, Array]]
) -> Iterator[tuple[int, Walk]]:
    """Walk robots whose oscillators begin at these outputs, side by side in C.

    Args:
        experiments: what is run; they must have in common what ``Lanes`` names.
        starts: o1 and o2 of every oscillator at the first tick, shape (n_legs,) each.

    Yields:
        Index of an experiment, and its walk, as the walks end.
    """
    batch = Batch(lanes_of(experiments[0]), contacts_of(experiments), signals=SIGNALS)
    left, walking = deque(range(len(experiments))), dict[Run, int]()
    while left or walking:
        while left and batch.free:
            index = left.popleft()
            run = Run(experiments[index], batch.controller, SIGNALS)
            with begun_at(batch.controller, *starts[index]):
                batch.begin(run)
            walking[run] = index
        for run in batch.walk(max(experiment.ticks for experiment in experiments)):
            record = run.record()
            signals = record.signals
            force = signals["foot_force"][..., 2]
            yield walking.pop(run), Walk(signals["o1"], signals["o2"], force, record.end == "fell")
    batch.close()


def found_in(walk: Walk, weight: float, Ts: float) -> Found:
    """In which gait a walk ended, and when it was reached.

    Args:
        walk: the walk.
        weight: of the robot [N].
        Ts: time of a tick [s].

    Returns:
        ``gait``, the name of the gait or of its mirror image at the end, or "other";
        ``after_s``, the time from the touch moment until every phase stayed within 0.6 rad of it,
        None if the gait has no name or came in the last second; ``fell``.
    """
    time = np.arange(len(walk.o1), dtype=np.float64) * Ts
    final = metrics.final_phases(walk.o1, walk.o2, Ts)
    gait = "fell" if walk.fell else gait_of(final) if np.isfinite(final).all() else "other"
    after = None
    if gait in CANDIDATES.get(walk.o1.shape[1], {}):
        touch = metrics.touch_moment(walk.force, weight)
        own = np.asarray(CANDIDATES[walk.o1.shape[1]][gait])
        near = min((own, mirrored(own)), key=lambda g: float(np.abs(metrics.wrap(final - g)).max()))
        after = metrics.convergence_time(time, walk.o1, walk.o2, touch, near)
    return {"gait": gait, "after_s": after, "fell": walk.fell}

"""The phase return map of the closed loop near a gait. Its eigenvalues are Floquet multipliers.

The oscillators are forced along their free cycle, with phases slightly off those of a gait, until
loads and learners have settled. They are then released, without couplings. A linear map is fitted
from the phase differences of each cycle to those of the next.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from apnc.loop.experiment import Experiment
from apnc.metrics.convergence import STRICT_TOLERANCE
from apnc.metrics.phases import cpg_phase, wrap
from apnc_core import oscillator
from apnc_core.controller import Controller
from apnc_core.enumerations import Method
from apnc_core.interface import Inputs, Parameters
from apnc_core.types import Array
from apnc_plant.plant import Plant
from research.modes.stance import patterns

GRID: Final = 256

TURNS: Final = 9
"""Number of cycles after the release."""

NEAR: Final = 1.0
"""Distance from a gait up to which the map is fitted [rad]."""


@dataclass(frozen=True)
class Cycle:
    """The cycle of an oscillator without load.

    Args:
        outputs: o1 and o2 at equally spaced phases, shape (GRID, 2).
        ticks: its length [ticks].
    """

    outputs: Array
    ticks: float

    def at(self, phase: Array) -> tuple[Array, Array]:
        """o1 and o2 at phases [rad], shape (n,)."""
        grid = 2.0 * np.pi / GRID * np.arange(GRID)
        o1, o2 = (np.interp(phase, grid, each, period=2.0 * np.pi) for each in self.outputs.T)
        return o1, o2


def free_cycle(p: Parameters, MI: float, ticks: int = 4000) -> Cycle:
    """The cycle without load, found in a path of ``ticks`` ticks."""
    path = np.empty((ticks, 2))
    o1, o2 = np.array([p.o1_start]), np.array([p.o2_start])
    for row in path:
        row[:] = o1[0], o2[0]
        o1, o2 = map(oscillator.output, oscillator.activation(o1, o2, MI, p))
    path = path[ticks // 10 :]
    turns = np.unwrap(cpg_phase(*path.T)) / (2.0 * np.pi)
    whole = np.arange(np.ceil(turns[0]), np.floor(turns[-1]) + 1)
    peaks = np.interp(whole, turns, np.arange(len(turns)))
    period = (peaks[-1] - peaks[0]) / (len(peaks) - 1)
    phase = 2.0 * np.pi * (np.arange(len(path)) - peaks[0]) / period % (2.0 * np.pi)
    grid, order = 2.0 * np.pi / GRID * np.arange(GRID), np.argsort(phase)
    o1, o2 = (np.interp(grid, phase[order], o[order], period=2.0 * np.pi) for o in path.T)
    return Cycle(np.stack([o1, o2], axis=1), float(period))


@dataclass(frozen=True)
class ReturnMap:
    """delta' = A delta + c over one cycle, for phase differences delta from a gait.

    Args:
        matrix: A in the coordinates of ``patterns``. NaN if the gait is lost within a cycle.
        drift: c, change of the exact gait in a cycle, in the same coordinates [rad].
        patterns: patterns over the legs by name, without heave, which is the common phase.
    """

    matrix: Array
    drift: Array
    patterns: Mapping[str, Array]

    @property
    def multipliers(self) -> Array:
        """Magnitudes of the eigenvalues in descending order. Above 1 the gait is unstable."""
        if not np.isfinite(self.matrix).all():
            return np.full(len(self.drift), np.nan)
        return np.asarray(np.sort(np.abs(np.linalg.eigvals(self.matrix)))[::-1])

    @property
    def orbit(self) -> float:
        """Largest distance of phi_1k at the map's fixed point from the gait [rad], NaN if none.

        Pitfall: with small multipliers alone the fixed point may still be another gait.
        """
        try:
            fixed = np.linalg.solve(np.eye(len(self.drift)) - self.matrix, self.drift)
        except np.linalg.LinAlgError:
            return float("nan")
        legs = fixed @ np.array(list(self.patterns.values()))
        return float(np.abs(legs - legs[0]).max())

    @property
    def holds(self) -> bool:
        """Whether the gait is predicted to last, by the strict criterion."""
        return bool(self.multipliers[0] < 1.0) and self.orbit <= STRICT_TOLERANCE


Release = Callable[[Array], Array]
"""Start phases [rad], shape (n,), to the phases of every tick after the release, (T, n)."""


def parameters_of(experiment: Experiment) -> Parameters:
    """Parameters of an experiment, the preset of its robot and its settings, for ``apc``."""
    p = Parameters(**experiment.parameters())  # type: ignore[arg-type]  # checked per name
    return replace(p, method=Method.apc)


def release(
    plant: Callable[[], Plant], p: Parameters, MI: float, *, settling: int = 4, turns: int = TURNS
) -> Release:
    """The closed loop of plant and controller, forced along phases and then released.

    Args:
        plant: function that makes the plant at its start, the same one every time.
        p: parameters, see :func:`parameters_of`.
        MI: modulatory input.
        settling: number of forced cycles.
        turns: number of cycles of leg 1 after the release. The run ends before if the robot falls,
            leg 1 stops, or the phases are far from the forced ones.

    Returns:
        Function from the forced phases [rad], shape (n,), to the phases after the release [rad],
        unwrapped, shape (ticks, n).
    """
    cycle = free_cycle(p, MI)
    held, slowest = round(settling * cycle.ticks), round((turns + 1) * 1.5 * cycle.ticks)

    def path(phases: Array) -> Array:
        controller, body = Controller(p, len(phases)), plant()
        c = controller.circuits

        def tick() -> None:
            out = controller.tick(Inputs(grf=body.grf(), MI=MI))
            body.advance(out.theta_hip, out.theta_knee, p.Ts)

        for n in range(held):
            c.o1, c.o2 = cycle.at(phases + 2.0 * np.pi * n / cycle.ticks)
            tick()
        seen = [cpg_phase(c.o1, c.o2)]
        for _ in range(slowest):
            tick()
            seen.append(seen[-1] + wrap(cpg_phase(c.o1, c.o2) - seen[-1]))
            turned = (seen[-1][0] - seen[0][0]) / (2.0 * np.pi)
            off = wrap(seen[-1] - seen[-1][0] - phases + phases[0])
            gone = turned > 2.1 and np.abs(off).max() > 2.0 * NEAR
            if body.fell or gone or turned > turns + 0.1:
                break
        return np.array(seen)

    return path


def return_map(released: Release, gait: Sequence[float], *, push: float = 0.3) -> ReturnMap:
    """Linearise a closed loop near a gait, by least squares over all cycles of all runs.

    Args:
        released: closed loop of :func:`release`.
        gait: phi_12 .. phi_1n [rad].
        push: size of the perturbation along each pattern, in both directions [rad].
    """
    named = dict(list(patterns(len(gait) + 1).items())[1:])
    basis, base = np.array(list(named.values())), np.concatenate([[0.0], gait])
    starts = (base + side * push * direction for direction in basis for side in (1.0, -1.0))
    offs = np.array([offsets(released(phases), base) for phases in starts])
    near = np.logical_and.accumulate(np.abs(offs).max(axis=2) < NEAR, axis=1)
    pairs = near[:, :-1] & np.isfinite(offs[:, 1:]).all(axis=2)
    before, after = offs[:, :-1][pairs] @ basis.T, offs[:, 1:][pairs] @ basis.T
    known = np.hstack([before, np.ones((len(before), 1))])
    fit = np.full((len(basis) + 1, len(basis)), np.nan)
    if len(known) and np.linalg.matrix_rank(known) == len(fit):
        fit = np.linalg.lstsq(known, after, rcond=None)[0]
    return ReturnMap(fit[:-1].T, fit[-1], named)


def offsets(phases: Array, base: Array, turns: int = TURNS) -> Array:
    """Mean distance from a gait in each cycle of leg 1 [rad], shape (turns, n). NaN after its last.

    Args:
        phases: phases of every tick [rad], unwrapped, shape (T, n).
        base: phases of the gait: 0, phi_12 .. phi_1n [rad].
        turns: number of cycles.
    """
    found = np.full((turns, len(base)), np.nan)
    turned = np.maximum.accumulate(phases[:, 0] - phases[0, 0]) / (2.0 * np.pi)
    ends = np.searchsorted(turned, np.arange(turns + 1))
    off = np.exp(1j * (phases - phases[:, :1] - base))
    for turn in range(turns):
        if ends[turn + 1] < len(phases):
            found[turn] = np.angle(off[ends[turn] : ends[turn + 1]].mean(axis=0))
    return found

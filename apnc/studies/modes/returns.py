"""The phase return map of the closed loop near a gait; its eigenvalues are Floquet multipliers.

The oscillators are led along their free cycle with the phases of a gait, slightly off, until loads
and learners have settled, and are then let go, without couplings. Where the phase differences are
in the first cycle and some cycles later is fitted by a linear map.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from apnc.loop.plant import Plant
from apnc.metrics.phases import cpg_phase, wrap
from apnc.studies.modes.stance import patterns
from apnc_core import oscillator
from apnc_core.controller import Controller
from apnc_core.enumerations import Method
from apnc_core.interface import Inputs, Parameters

Array = NDArray[np.float64]

GRID = 256


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
    """The cycle without load, from a path of so many ticks."""
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
        matrix: over the cycles between the two looks, in the patterns of ``names``.
        drift: where the gait itself goes in that time [rad], same patterns.
        names: the patterns over the legs, all but heave, which is the common phase.
        cycles: between the two looks.
    """

    matrix: Array
    drift: Array
    names: tuple[str, ...]
    cycles: int

    @property
    def multipliers(self) -> Array:
        """Size of the eigenvalues per cycle, the largest first; above 1 the gait is left."""
        sizes = np.abs(np.linalg.eigvals(self.matrix)) ** (1.0 / self.cycles)
        return np.asarray(np.sort(sizes)[::-1])

    @property
    def growth(self) -> dict[str, float]:
        """Growth of each pattern into itself per cycle, with its sign."""
        own = self.matrix.diagonal()
        each = np.sign(own) * np.abs(own) ** (1.0 / self.cycles)
        return dict(zip(self.names, each.tolist(), strict=True))


def return_map(
    plant: Callable[[], Plant],
    p: Parameters,
    MI: float,
    gait: Sequence[float],
    *,
    push: float = 0.15,
    settling: int = 4,
    cycles: int = 2,
) -> ReturnMap:
    """Linearise the closed loop of plant and controller near a gait.

    Args:
        plant: makes the plant at its start; the same one every time.
        p: parameters; the method becomes ``apc``.
        MI: modulatory input.
        gait: phi_12 .. phi_1n [rad].
        push: size of a perturbation along each pattern [rad], to both sides.
        settling: cycles before the oscillators are let go.
        cycles: cycles between the two looks.
    """
    names, basis = zip(*list(patterns(len(gait) + 1).items())[1:], strict=True)
    p, cycle = replace(p, method=Method.apc), free_cycle(p, MI)
    base = np.concatenate([[0.0], gait])
    looks = []
    for direction in basis:
        for side in (1.0, -1.0):
            phases = _released(
                plant(), p, MI, cycle, base + side * push * direction, settling, cycles
            )
            looks.append([_look(phases, base, first, cycle, basis) for first in (0, cycles)])
    before, after = np.array(looks).transpose(1, 0, 2)
    known = np.hstack([before, np.ones((len(before), 1))])
    fit = np.linalg.lstsq(known, after, rcond=None)[0]
    return ReturnMap(fit[:-1].T, fit[-1], names, cycles)


def _released(
    plant: Plant, p: Parameters, MI: float, cycle: Cycle, phases: Array, settling: int, cycles: int
) -> Array:
    """Phases [rad] of every tick from the release on, (T, n)."""
    controller = Controller(p, len(phases))
    held = round(settling * cycle.ticks)
    path = []
    for n in range(held + round((cycles + 2) * cycle.ticks * 1.5)):
        c = controller.circuits
        if n < held:
            c.o1, c.o2 = cycle.at(phases + 2.0 * np.pi * n / cycle.ticks)
        else:
            path.append(cpg_phase(c.o1, c.o2))
        out = controller.tick(Inputs(grf=plant.grf(), MI=MI))
        plant.advance(out.theta_hip, out.theta_knee, p.Ts)
    return np.unwrap(np.array(path), axis=0)


def _look(phases: Array, base: Array, first: int, cycle: Cycle, basis: Sequence[Array]) -> Array:
    """Mean over one turn of leg 1, that many turns after the release, in the patterns."""
    turned = (phases[:, 0] - phases[0, 0]) / (2.0 * np.pi)
    begin, end = np.searchsorted(turned, [first, first + 1])
    off = wrap(phases[begin:end] - phases[begin:end, :1] - base)
    mean = np.angle(np.exp(1j * off).mean(axis=0))
    return np.array([mean @ direction for direction in basis])

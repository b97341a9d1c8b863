"""Drives the FMU and the Python reference with the same inputs and compares every variable."""

from __future__ import annotations

import random
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

import numpy as np
from hypothesis import strategies as st

from apnc.loop.fmu_controller import FmuController
from apnc_core.controller import Controller
from apnc_core.enumerations import Method
from apnc_core.interface import Inputs, Outputs, Parameters
from apnc_core.schema import Causality, Shape, Type
from apnc_core.variables import variables_of


def random_loads(rng: np.random.Generator, ticks: int, n_legs: int, weight: float) -> np.ndarray:
    """Rectangular stance patterns of random timing and height, with noise; shape (ticks, n)."""
    phase = rng.uniform(0, 2 * np.pi, n_legs)
    rate = rng.uniform(0.1, 0.25, n_legs)
    wave = np.sin(phase + rate * np.arange(ticks)[:, None] + rng.normal(0, 0.2, (ticks, n_legs)))
    height = weight / n_legs * 2 * rng.uniform(0.5, 1.5, (ticks, n_legs))
    return np.where(wave > 0, height, 0.0)


@dataclass
class Comparison:
    """Largest absolute difference, and largest absolute value, of every output over a run."""

    difference: dict[str, float] = field(default_factory=dict)
    size: dict[str, float] = field(default_factory=dict)

    def add(self, name: str, value: np.ndarray, expected: np.ndarray) -> None:
        off = float(np.abs(value - expected).max())
        # a difference that is not a number must not be lost in max()
        self.difference[name] = max(self.difference.get(name, 0.0), off if off == off else np.inf)
        self.size[name] = max(self.size.get(name, 0.0), float(np.abs(expected).max()))

    @property
    def worst(self) -> float:
        return max(self.difference.values())


def random_inputs(seed: int, ticks: int, n_legs: int, weight: float) -> list[Inputs]:
    """Random loads and commands with resets, a standstill and sensor faults."""
    rng = np.random.default_rng(seed)
    loads = random_loads(rng, ticks, n_legs, weight)
    loads[50:51] = np.nan
    loads[60:61, 0] = -1.0
    MI = np.repeat(rng.uniform(0.0, 0.3, ticks // 150 + 1), 150)
    MI[170:175] = 0.0
    turn = np.repeat(rng.uniform(-1.2, 1.2, ticks // 90 + 1), 90)
    return [
        Inputs(loads[n], float(MI[n]), float(turn[n]), reset=120 <= n < 123) for n in range(ticks)
    ]


def compare(
    path: Path, changes: dict[str, object], n_legs: int, ticks: int, seed: int = 1
) -> Comparison:
    """Run FMU and reference with the same parameters and random inputs."""
    p = Parameters(**changes)  # type: ignore[arg-type]  # typed per name
    reference = Controller(p, n_legs)
    result = Comparison()
    with FmuController(path, changes) as fmu:  # type: ignore[arg-type]  # typed per name
        for n, given in enumerate(random_inputs(seed, ticks, n_legs, p.robot_weight)):
            fmu.step(n * p.Ts, p.Ts, given.grf, given.MI, given.turn, given.reset)
            expected = reference.tick(given)
            sample = fmu.sample()
            for name in Outputs.__dataclass_fields__:
                result.add(name, sample[name], np.asarray(getattr(expected, name), dtype=float))
    return result


# Parts of the ranges in which every rule is met within some hundred ticks. At sigma = 0 the last
# bit of d decides.
_LIKELY: Final = {
    "Ts": (1e-3, 0.1), "robot_weight": (1.0, 1e3), "F_max": (0.1, 3.0), "w11": (1.2, 2.0),
    "w12_0": (0.0, 0.5), "bias": (-0.1, 0.1), "sigma": (0.05, 2.0), "kappa_hold": (1, 20),
    "gamma_tegotae": (0.0, 0.5), "grf_reset": (0.8, 2.0), "B_f": (0.0, 0.5), "xi": (0.001, 0.1),
}  # fmt: skip
# most rules belong to the method of the paper
_MORE_OFTEN: Final = {"method": [*Method, Method.apnc, Method.apnc, Method.phase_reset]}


def settings_of(
    n_legs: int,
    real: Callable[[float, float], float],
    integer: Callable[[int, int], int],
) -> dict[str, object]:
    """A value for every parameter of the table, from pickers of numbers in a range."""
    picked: dict[str, object] = {}
    for v in variables_of(Causality.parameter):
        low, high = _LIKELY.get(v.name, (v.min, v.max))
        if v.enumeration:
            items = _MORE_OFTEN.get(v.name, list(v.enumeration.items))
            picked[v.name] = items[integer(0, len(items) - 1)]
        elif v.type is Type.boolean:
            picked[v.name] = bool(integer(0, 1))
        elif v.type is Type.integer:
            picked[v.name] = integer(int(low or 0), int(high or 0))
        elif v.shape is Shape.scalar:
            picked[v.name] = real(low or 0.0, high or 0.0)
        else:
            picked[v.name] = tuple(real(low or 0.0, high or 0.0) for _ in range(v.count(n_legs)))
    return picked


Run = tuple[int, dict[str, object], int]
"""Number of legs, a value for every parameter, seed of the inputs."""


def uniform_run(seed: int) -> Run:
    """Spread over all rules and ranges."""
    rng = random.Random(seed)
    n_legs = rng.choice((4, 6))
    return n_legs, settings_of(n_legs, rng.uniform, rng.randint), seed


@st.composite
def drawn_runs(draw: st.DrawFn) -> Run:
    """With a liking for the ends of the ranges and for zeros."""
    n_legs = draw(st.sampled_from((4, 6)))
    picked = settings_of(
        n_legs, lambda a, b: draw(st.floats(a, b)), lambda a, b: draw(st.integers(a, b))
    )
    return n_legs, picked, draw(st.integers(0, 1000))

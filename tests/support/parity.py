"""Drives the FMU and the Python reference with the same inputs and compares every variable."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from apnc.loop.fmu_controller import FmuController
from apnc_core.controller import Controller
from apnc_core.interface import Inputs, Outputs, Parameters


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


def compare(path: Path, changes: dict[str, object], n_legs: int, ticks: int) -> Comparison:
    """Run both with random loads, commands, resets and sensor faults."""
    p = Parameters(**changes)  # type: ignore[arg-type]  # typed per name
    reference = Controller(p, n_legs)
    rng = np.random.default_rng(1)
    loads = random_loads(rng, ticks, n_legs, p.robot_weight)
    loads[50] = np.nan
    loads[60, 0] = -1.0
    MI = np.repeat(rng.uniform(0.0, 0.3, ticks // 500 + 1), 500)
    MI[1000:1020] = 0.0
    turn = np.repeat(rng.uniform(-1.2, 1.2, ticks // 300 + 1), 300)
    reset = np.zeros(len(MI), dtype=bool)
    reset[700:705] = True
    result = Comparison()
    with FmuController(path, changes) as fmu:  # type: ignore[arg-type]  # typed per name
        for n in range(ticks):
            fmu.step(n * p.Ts, p.Ts, loads[n], MI[n], turn[n], bool(reset[n]))
            expected = reference.tick(Inputs(loads[n], MI[n], turn[n], bool(reset[n])))
            sample = fmu.sample()
            for name in Outputs.__dataclass_fields__:
                result.add(name, sample[name], np.asarray(getattr(expected, name), dtype=float))
    return result

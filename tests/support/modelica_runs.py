"""Compiles models of the Modelica package with rumoca, runs them and reads them tick by tick."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pytest

rumoca = pytest.importorskip("rumoca", reason="rumoca is not installed: no Modelica model was run")

ROOT = Path(__file__).resolve().parents[2]
LIBRARY = ROOT / "modelica"
PACKAGE = LIBRARY / "Apnc"


@dataclass
class Run:
    """A finished run: values over all rows, or at the ticks of the controller."""

    result: Any
    first: np.ndarray
    """Rows in which a new tick shows for the first time, with the inputs of that tick."""

    def at_ticks(self, name: str, count: int = 0) -> np.ndarray:
        """``controller.<name>`` at every tick, (ticks,), or (ticks, count) for an array."""
        if count:
            return np.stack([self.at_ticks(f"{name}[{i + 1}]") for i in range(count)], axis=1)
        return np.asarray(self.result[f"controller.{name}"], dtype=float)[self.first]


def run(source: str, duration: float, library: Path = LIBRARY) -> Run:
    """Compile ``model Test`` in ``source`` and run it with an explicit solver.

    The model's controller is called ``controller`` and ticks every 1/60 s.
    """
    model = rumoca.Session(roots=[str(library)]).loads(source, model="Test")
    config = rumoca.SimConfig(solver="rk-like", rtol=1e-6, atol=1e-8, dt=1 / 60)
    result = model.simulate(t=(0.0, duration), config=config)
    tick = np.asarray(result["controller.tick"])
    return Run(result, np.flatnonzero(np.append(True, np.diff(tick) > 0)))


def driven(modification: str, n_legs: int = 4) -> str:
    """A controller under loads and commands made by equations.

    Loads swing by diagonals, fall below zero in part of the cycle (a fault), and cross the
    threshold of touch-down; MI and turn vary, turn beyond its range; reset holds for five ticks.
    """
    return f"""
model Test
  Apnc.Blocks.Controller controller(n={n_legs}{modification and ", " + modification});
equation
  for i in 1:{n_legs} loop
    controller.grf[i] = 12.0 * (0.48 + 0.5 * sin(10.0 * time + 3.0 * i + 0.1 * i * i));
  end for;
  controller.MI = 0.1 + 0.05 * sin(0.3 * time);
  controller.turn = 1.2 * sin(0.5 * time);
  controller.reset = time > 8.01 and time < 8.1;
end Test;
"""

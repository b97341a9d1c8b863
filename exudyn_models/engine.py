"""Exudyn, loaded at its first use: the fast build, without greeting and warning."""

from __future__ import annotations

import contextlib
import importlib
import io
import sys
from functools import cache
from typing import Any


@cache
def exu() -> Any:
    """The module; untyped, since the stubs Exudyn ships contradict its signatures.

    Pitfall: what other threads print during the first call is lost.
    """
    # Exudyn reads this flag at its first import only; the build without range checks is 1.4x
    # faster.
    vars(sys).setdefault("exudynFast", True)
    # What it says then belongs to nobody: stdout is that of the program that uses this package.
    with contextlib.redirect_stdout(io.StringIO()):
        exudyn = importlib.import_module("exudyn")
        _take_a_step(exudyn)
    return exudyn


@cache
def items() -> Any:
    """Classes of the items that a system is made of."""
    exu()
    return importlib.import_module("exudyn.itemInterface")


def _take_a_step(exudyn: Any) -> None:
    """Integrate nothing for a step.

    At its first step in a process, and only then, Velocity Verlet says on stdout that it is under
    development. An empty system has nothing else to say.
    """
    settings = exudyn.SimulationSettings()
    settings.timeIntegration.solverType = exudyn.DynamicSolverType.VelocityVerlet
    settings.timeIntegration.numberOfSteps = 1
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    container = exudyn.SystemContainer()
    system = container.AddSystem()
    system.Assemble()
    exudyn.MainSolverExplicit().SolveSystem(system, settings)

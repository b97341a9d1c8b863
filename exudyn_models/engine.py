"""Exudyn, loaded at its first use, in its fast build and without messages on stdout."""

from __future__ import annotations

import contextlib
import importlib
import io
import sys
from functools import cache
from typing import Any


@cache
def exu() -> Any:
    """The module. It is untyped because its type stubs contradict its signatures.

    Pitfall: output that other threads print during the first call is lost.
    """
    # Exudyn reads this flag at its first import only; the build without range checks is faster
    vars(sys).setdefault("exudynFast", True)
    # stdout belongs to the program that uses this package, so Exudyn's messages are dropped
    with contextlib.redirect_stdout(io.StringIO()):
        exudyn = importlib.import_module("exudyn")
        _take_a_step(exudyn)
    return exudyn


@cache
def items() -> Any:
    """Module with the classes of the items of a system."""
    exu()
    return importlib.import_module("exudyn.itemInterface")


def _take_a_step(exudyn: Any) -> None:
    """Integrate an empty system for one step.

    At the first step in a process, Velocity Verlet prints on stdout that it is under development.
    This call makes it print that before the first walk.
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

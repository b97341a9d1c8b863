"""Exudyn, imported once for the whole package: the fast build, without greeting and warning."""

from __future__ import annotations

import contextlib
import io
import sys
from typing import Any

# Exudyn reads this flag at its first import only; the build without range checks is 1.4x faster.
vars(sys).setdefault("exudynFast", True)
# The import announces the build on stdout, which belongs to the program that uses this package.
with contextlib.redirect_stdout(io.StringIO()):
    import exudyn
    from exudyn import advancedUtilities, itemInterface

# Untyped: the stubs Exudyn ships contradict its signatures.
exu: Any = exudyn
items: Any = itemInterface
create_symbolic_user_function: Any = advancedUtilities.CreateSymbolicUserFunction


def _take_a_step() -> None:
    """Integrate nothing for a step.

    At its first step in a process, and only then, Velocity Verlet says on stdout that it is under
    development. An empty system has nothing else to say.
    """
    settings = exu.SimulationSettings()
    settings.timeIntegration.solverType = exu.DynamicSolverType.VelocityVerlet
    settings.timeIntegration.numberOfSteps = 1
    settings.timeIntegration.verboseMode = 0
    settings.solution.file.write = False
    container = exu.SystemContainer()
    system = container.AddSystem()
    system.Assemble()
    with contextlib.redirect_stdout(io.StringIO()):
        exu.MainSolverExplicit().SolveSystem(system, settings)


_take_a_step()

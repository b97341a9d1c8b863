"""The plant in Exudyn."""

from __future__ import annotations

from typing import Any, ClassVar

import numpy as np

from apnc_core.types import Array
from apnc_plant.legged import Engine, LeggedPlant, Setup
from apnc_plant.signals import PlantError
from exudyn_models.engine import exu
from exudyn_models.tree import add_tree


class ExudynTree(Engine):
    """The robot as a kinematic tree in its own Exudyn system, integrated by Velocity Verlet.

    Attributes:
        mbs, solver: Exudyn's system and its solver.
        tree: item number of the tree in it; link k moves with coordinate k.
    """

    name: ClassVar[str] = "exudyn"

    def __init__(self, setup: Setup) -> None:
        """Assemble the system; see ``Engine``."""
        options, self._forces = setup.options, setup.forces
        # The container owns the system; without this reference Exudyn would free it.
        self._container = exu().SystemContainer()
        self.mbs: Any = self._container.AddSystem()
        self.tree = add_tree(
            self.mbs, setup.robot, setup.trunk, options.gravity, setup.start, setup.forces
        )
        self.mbs.Assemble()
        self._settings = _solver_settings(setup.step)
        self.solver: Any = exu().MainSolverExplicit()
        if not self.solver.InitializeSolver(self.mbs, self._settings):
            raise PlantError("Exudyn refused the model")

    def advance(self, end: float, steps: int, q: Array, v: Array) -> bool:
        """Integrate; see ``Engine``."""
        iteration = self.solver.it
        iteration.maxStepSize = iteration.currentStepSize = self._forces.step
        iteration.endTime = end
        solved = self.solver.SolveSteps(self.mbs, self._settings)
        data = self.mbs.systemData
        q[:], v[:] = data.GetODE2Coordinates(), data.GetODE2Coordinates_t()
        return bool(solved)

    def set_speeds(self, v: Array) -> None:
        """Replace the speeds; see ``Engine``."""
        self.mbs.systemData.SetODE2Coordinates_t(v)

    def mass_matrix(self) -> Array:
        """Mass matrix; see ``Engine``."""
        self.solver.ComputeMassMatrix(self.mbs)
        return np.array(self.solver.GetSystemMassMatrix())


class ExudynPlant(LeggedPlant):
    """One robot in its own Exudyn system; see :class:`LeggedPlant`."""

    engine = ExudynTree


def _solver_settings(step: float) -> Any:
    settings = exu().SimulationSettings()
    integration = settings.timeIntegration
    integration.solverType = exu().DynamicSolverType.VelocityVerlet
    integration.numberOfSteps = 1
    integration.endTime = step
    integration.verboseMode = 0
    integration.explicit.useLieGroupIntegration = False
    settings.linearSolver.solverType = exu().LinearSolverType.EigenDense
    settings.solution.file.write = False
    settings.solution.sensors.active = False
    return settings

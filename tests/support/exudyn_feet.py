"""Markers at the feet of a robot in Exudyn, to ask the engine itself where they are."""

from __future__ import annotations

from typing import Any

from apnc_plant.coordinates import BASE
from apnc_plant.legged import Setup
from apnc_plant.robot import RobotDescription
from exudyn_models.engine import items
from exudyn_models.plant import ExudynPlant, ExudynTree


def add_feet(engine: ExudynTree, robot: RobotDescription) -> list[Any]:
    """Add a marker at the centre of every foot ball; returns their numbers.

    Pitfall: Exudyn goes on only once it has assembled the system anew, which is then at its start.
    """
    return [
        engine.mbs.AddMarker(
            items().MarkerKinematicTreeRigid(
                objectNumber=engine.tree,
                linkNumber=BASE + 3 * k + 2,
                localPosition=[0.0, 0.0, -leg.tibia_length],
            )
        )
        for k, leg in enumerate(robot.legs)
    ]


def assemble(engine: ExudynTree) -> None:
    """Assemble the system with what was added to it, at its start."""
    engine.mbs.Assemble()
    assert engine.solver.InitializeSolver(engine.mbs, engine._settings)


class MarkedTree(ExudynTree):
    """The robot in Exudyn with markers at its feet.

    Attributes:
        feet: their numbers, one per leg.
    """

    def __init__(self, setup: Setup) -> None:
        super().__init__(setup)
        self.feet = add_feet(self, setup.robot)
        assemble(self)


class MarkedPlant(ExudynPlant):
    """A plant whose engine has markers at the feet."""

    engine = MarkedTree

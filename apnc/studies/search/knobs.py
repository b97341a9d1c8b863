"""The numbers that are searched, each with the range that is plausible for it."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Final, NamedTuple

from apnc.studies.robots import changed, constant
from exudyn_models.robot import RobotDescription, load_robot


class Knob(NamedTuple):
    """One number that is searched: parameter of the controller, or ``part.field`` of the robot."""

    name: str
    low: float
    high: float
    start: float
    log: bool = False

    def value(self, x: float) -> float:
        """Value at ``x`` in [0, 1]."""
        if self.log:
            return float(self.low * (self.high / self.low) ** x)
        return self.low + x * (self.high - self.low)

    def place(self, value: float) -> float:
        """``x`` of a value."""
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


Candidate = Mapping[str, float]
"""Values by the names of their knobs."""

KNOBS: Final = (
    Knob("b1", -0.5, 0.0, -0.26),
    Knob("b2", -0.4, 0.2, 0.05),
    Knob("trunk.com_x", 0.0, 0.06, 0.0445),
    Knob("trunk.com_z", -0.016, 0.02, -0.014),
    Knob("servo.stiffness", 14.0, 24.0, 20, log=True),
    Knob("servo.damping", 0.7, 1.1, 0.86, log=True),
    Knob("servo.reflected_inertia", 0.0075, 0.02, 0.0082, log=True),
    Knob("contact.stiffness", 3e3, 4e4, 4800, log=True),
    Knob("contact.damping", 450.0, 800.0, 500, log=True),
    Knob("sensor.delay", 0.005, 0.07, 0.011),
    Knob("B_f", 0.02, 0.5, 0.21, log=True),
    Knob("B_s", 1e-4, 1e-2, 0.00075, log=True),
    Knob("turn_gain", 0.4, 1.0, 0.95),
)

PUBLISHED: Final[Candidate] = {"a1": 0.14, "a2": 0.14, "xi": 0.01}
"""The authors' slopes and the paper's gain of the couplings: not searched."""


def built_robot(candidate: Candidate) -> RobotDescription:
    """Lilibot with the physical unknowns of a candidate."""
    robot = load_robot("lilibot")
    for name, value in candidate.items():
        if name in ("trunk.com_x", "trunk.com_z"):
            com = list(robot.trunk.body.com)
            com["xyz".index(name[-1])] = value
            robot = changed(robot, "trunk.body.com", constant(tuple(com)))
        elif "." in name:
            robot = changed(robot, name, constant(value))
    return robot


def gains(candidate: Candidate) -> dict[str, float]:
    """Parameters of the controller of a candidate."""
    return {n: value for n, value in {**PUBLISHED, **candidate}.items() if "." not in n}

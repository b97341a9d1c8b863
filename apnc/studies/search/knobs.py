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


KNOBS: Final = (
    Knob("a1", 0.06, 0.22, 0.120),
    Knob("a2", 0.03, 0.22, 0.060),
    Knob("b1", -0.35, 0.10, -0.065),
    Knob("b2", -0.35, 0.15, -0.120),
    Knob("B_f", 0.015, 0.3, 0.049, log=True),
    Knob("B_s", 1e-4, 1.2e-2, 3e-3, log=True),
    Knob("xi", 0.01, 0.045, 0.021, log=True),
    Knob("trunk.com_x", 0.0, 0.015, 0.011),
    Knob("trunk.com_z", -0.005, 0.02, -0.002),
    Knob("servo.stiffness", 5.0, 40.0, 28.0, log=True),
    Knob("servo.damping", 0.2, 1.5, 0.85, log=True),
    Knob("servo.reflected_inertia", 0.008, 0.02, 0.0085, log=True),
    Knob("contact.stiffness", 5e3, 6e4, 24e3, log=True),
    Knob("contact.damping", 60.0, 800.0, 550.0, log=True),
    Knob("sensor.delay", 0.025, 0.07, 0.040),
)
"""Rotors of less than 0.008 kg m^2 let the feet chatter at the default step."""

Candidate = Mapping[str, float]
"""Values by the names of their knobs."""


def built_robot(candidate: Candidate) -> RobotDescription:
    """Lilibot with the physical unknowns of a candidate."""
    robot = load_robot("lilibot")
    for name, value in candidate.items():
        if name.startswith("trunk.com_"):
            com = list(robot.trunk.body.com)
            com["xyz".index(name[-1])] = value
            robot = changed(robot, "trunk.body.com", constant(tuple(com)))
        elif "." in name:
            robot = changed(robot, name, constant(value))
    return robot


def gains(candidate: Candidate) -> dict[str, float]:
    """Parameters of the controller of a candidate."""
    return {name: value for name, value in candidate.items() if "." not in name}

"""The design variables of the search, each with its plausible range."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import replace
from typing import Final, NamedTuple

from apnc.studies.robots import changed, constant
from apnc_core.interface import Parameters
from apnc_core.schema import Causality, Type
from apnc_core.variables import variables_of
from apnc_plant.robot import Leg, RobotDescription, load_robot


class DesignVariable(NamedTuple):
    """A number that is searched.

    Args:
        name: name of a parameter of the controller, or ``part.field`` of the robot.
        low: lower end of the range.
        high: upper end of the range.
        log: whether the range is searched on a logarithmic scale.
    """

    name: str
    low: float
    high: float
    log: bool = False

    def value(self, x: float) -> float:
        """Value at ``x`` in [0, 1]."""
        if self.log:
            return float(self.low * (self.high / self.low) ** x)
        return self.low + x * (self.high - self.low)

    def scaled(self, value: float) -> float:
        """``x`` in [0, 1] of a value."""
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


Candidate = Mapping[str, float]
"""Values by name of the design variable."""

_UNKNOWN: Final = (
    DesignVariable("servo.reflected_inertia", 0.0075, 0.02, log=True),
    DesignVariable("contact.stiffness", 3e3, 4e4, log=True),
    DesignVariable("contact.damping", 300.0, 800.0, log=True),
    DesignVariable("sensor.delay", 0.005, 0.07),
)
"""Numbers that are not published for any robot."""

_BODY: Final = (
    DesignVariable("servo.stiffness", 14.0, 24.0, log=True),
    DesignVariable("servo.damping", 0.7, 1.1, log=True),
    *_UNKNOWN,
)

_POSE: Final = (DesignVariable("b1", -0.6, 0.0), DesignVariable("b2", -0.4, 0.4))

_LEARNING: Final = (
    DesignVariable("B_f", 0.02, 0.5, log=True),
    DesignVariable("B_s", 1e-4, 1e-2, log=True),
    DesignVariable("turn_gain", 0.4, 1.0),
)

_MANY_LEGS: Final = (
    DesignVariable("a1", 0.1, 0.22),
    DesignVariable("a2", 0.1, 0.25),
    DesignVariable("b1", -0.3, 0.2),
    DesignVariable("b2", -0.3, 0.2),
    DesignVariable("outer.y", 0.03, 0.10),
    DesignVariable("inner.y", 0.07, 0.15),
    DesignVariable("inner.z", -0.004, 0.004),
    DesignVariable("trunk.com_x", -0.05, 0.05),
    DesignVariable("trunk.com_z", -0.016, 0.02),
    DesignVariable("trunk.com_side_offset", 0.002, 0.02),
    DesignVariable("servo.stiffness", 14.0, 80.0, log=True),
    DesignVariable("servo.damping", 0.7, 2.5, log=True),
    *_UNKNOWN,
    DesignVariable("B_f", 0.1, 1.0, log=True),
    DesignVariable("B_s", 1e-4, 2e-2, log=True),
    DesignVariable("kappa_hold", 100.0, 500.0, log=True),
    DesignVariable("o1_start", 0.005, 0.2, log=True),
)

DESIGN: Final[Mapping[str, tuple[DesignVariable, ...]]] = {
    "lilibot": (
        DesignVariable("a2", 0.12, 0.20),
        *_POSE,
        DesignVariable("trunk.com_x", 0.0, 0.06),
        DesignVariable("trunk.com_z", -0.016, 0.02),
        DesignVariable("trunk.com_side_offset", 0.0, 0.006),
        *_BODY,
        *_LEARNING,
    ),
    "hexapod": (*_MANY_LEGS, DesignVariable("inner.x", -0.03, 0.03)),
    "octopod": _MANY_LEGS,
}
"""By robot."""

OWN: Final[Mapping[str, DesignVariable]] = {
    "tegotae": DesignVariable("gamma_tegotae", 0.004, 0.4, log=True),
    "phase_reset": DesignVariable("grf_reset", 0.05, 1.6, log=True),
}
"""The free parameter of each baseline."""


def design_variables(
    robot: str, controller: str, *, own_robot: bool = False
) -> tuple[DesignVariable, ...]:
    """Design variables for a robot and a controller.

    Args:
        robot: name of the robot.
        controller: name of the controller; of a baseline its own number.
        own_robot: for a baseline the pose and the robot, too, as they are for APNC.

    Raises:
        ValueError: a robot or a controller that is not searched.
    """
    if robot not in DESIGN:
        raise ValueError(f"robot '{robot}' is not one of {', '.join(DESIGN)}")
    if controller == "apnc":
        return DESIGN[robot]
    if controller not in OWN:
        raise ValueError(f"controller '{controller}' is not one of apnc, {', '.join(OWN)}")
    learning = {variable.name for variable in _LEARNING}
    shared = [variable for variable in DESIGN[robot] if own_robot and variable.name not in learning]
    return (OWN[controller], *shared)


def start(robot: RobotDescription, name: str) -> float:
    """Shipped value of a design variable."""
    if "." not in name:
        return float(robot.controller.get(name, getattr(Parameters(), name)))
    if name in ("trunk.com_x", "trunk.com_z"):
        return robot.trunk.com["xyz".index(name[-1])]
    part, field = name.split(".")
    if part in ("inner", "outer"):
        leg = next(leg for leg in robot.legs if _is_outer(robot, leg) == (part == "outer"))
        return abs(leg.mount[1]) if field == "y" else leg.mount["xyz".index(field)]
    return float(getattr(getattr(robot, part), field))


def built_robot(candidate: Candidate, name: str = "lilibot") -> RobotDescription:
    """The robot of a candidate."""
    robot = load_robot(name)
    for variable, value in candidate.items():
        part, _, field = variable.partition(".")
        if variable in ("trunk.com_x", "trunk.com_z"):
            com = list(robot.trunk.com)
            com["xyz".index(field[-1])] = value
            robot = changed(robot, "trunk.com", constant(tuple(com)))
        elif part in ("inner", "outer"):
            robot = _stood(robot, part == "outer", "xyz".index(field), value)
        elif field:
            robot = changed(robot, variable, constant(value))
    return robot


def _is_outer(robot: RobotDescription, leg: Leg) -> bool:
    """Whether a leg is of the first or the last pair."""
    along = [other.mount[0] for other in robot.legs]
    return leg.mount[0] in (min(along), max(along))


def _stood(robot: RobotDescription, outer: bool, axis: int, value: float) -> RobotDescription:
    """The robot with its outer or inner legs moved. y points away from the middle plane."""
    legs = []
    for leg in robot.legs:
        mount = list(leg.mount)
        mount[axis] = leg.side * value if axis == 1 else value
        moved = _is_outer(robot, leg) == outer
        legs.append(replace(leg, mount=(mount[0], mount[1], mount[2])) if moved else leg)
    return replace(robot, legs=tuple(legs))


def gains(candidate: Candidate) -> dict[str, float]:
    """Parameters of the controller of a candidate. Whole numbers are rounded."""
    whole = {v.name for v in variables_of(Causality.parameter) if v.type is Type.integer}
    own = {name: value for name, value in candidate.items() if "." not in name}
    return {name: round(value) if name in whole else value for name, value in own.items()}

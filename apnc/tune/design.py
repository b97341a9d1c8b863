"""What is searched: design variables of a robot, and the robot that a point of them makes."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final, NamedTuple

from apnc.tune.servos import geared, with_rotors
from apnc.tune.stance import StanceChange, stood
from apnc_core.interface import Parameters
from apnc_core.schema import Type
from apnc_core.types import Array
from apnc_core.variables import variable_named
from apnc_plant.robot import RobotDescription
from apnc_plant.robot.size import mean_leg_length

MI_AIMED: Final = (0.08, 0.28)
"""MI range that is aimed at before it is scaled: that of the paper's gaits, slow to fast."""


FEW_LEGS: Final = 4
"""Number of legs of the paper's robot, for which the default gains were found."""

MI_OF_PAPER: Final = (0.04, 0.40)
"""MI range of the paper's experiments; it is not scaled."""


class DesignVariable(NamedTuple):
    """A number that is searched.

    Args:
        name: its name; those with a dot are changes of the robot, others of the controller.
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

    def place(self, value: float) -> float:
        """``x`` in [0, 1] of a value; of one outside the range, that of the nearest end."""
        value = min(max(value, self.low), self.high)
        if self.log:
            return math.log(value / self.low) / math.log(self.high / self.low)
        return (value - self.low) / (self.high - self.low)


STANCE: Final = (
    DesignVariable("stance.up", -0.15, 0.3),
    DesignVariable("stance.back", -0.2, 0.2),
    DesignVariable("stance.apart", -0.12, 0.12),
    DesignVariable("stance.fore_up", -0.08, 0.08),
)
"""How the robot stands, in leg lengths."""

POSE: Final = (
    DesignVariable("b1", -0.5, 0.5),
    DesignVariable("b2", -0.5, 0.5),
)
"""How a robot with coxae stands: offsets of the motor neurons [rad], in place of the stance."""

GAINS: Final = (
    DesignVariable("a1", 0.08, 0.26),
    DesignVariable("a2", 0.06, 0.40),
    DesignVariable("B_f", 0.02, 0.6, log=True),
    DesignVariable("B_s", 1e-4, 1e-2, log=True),
    DesignVariable("mi.scale", 0.5, 1.45, log=True),
)
"""The controller: slopes of the motor neurons, learning rates, and the MI range."""

MANY_LEGS: Final = (
    DesignVariable("kappa_hold", 60.0, 500.0, log=True),
    DesignVariable("o1_start", 0.005, 0.2, log=True),
)
"""More of the controller for more than four legs, whose gait forms slowly."""

SERVO: Final = (
    DesignVariable("servo.stiffness", 0.4, 2.5, log=True),
    DesignVariable("servo.lag", 0.025, 0.13, log=True),
)
"""Gains of the servos: the stiffness as a share of that in the file; damping over stiffness [s],
in the time of a robot of Lilibot's size. Torque and speed limits are those of the file."""

BODY: Final = (
    DesignVariable("trunk.com_x", -0.13, 0.13),
    DesignVariable("trunk.com_z", -0.13, 0.13),
    DesignVariable("trunk.share", 0.85, 1.15),
    DesignVariable("servo.reflected_inertia", 0.5, 2.0, log=True),
    DesignVariable("contact.stiffness", 0.2, 3.0, log=True),
    DesignVariable("contact.damping", 0.2, 2.0, log=True),
)
"""What is uncertain of a robot that was never weighed: the centre of mass of its trunk, in leg
lengths from where the file has it; the mass of its trunk, as a share of that in the file, with the
total mass kept; rotors and feet, as shares of what the file has."""


@dataclass(frozen=True)
class Start:
    """The robot that is tuned, and what a search of it needs to know.

    Args:
        robot: the robot of the file.
        rate: update rate of its controller [Hz].
        mi: MI range that is aimed at before it is scaled.
        variables: what is searched.
        paper: whether it is judged by the paper's other experiments, too.
        near: whether the search stays near the robot of the file.
        reference: whether its stance changes by the reference pose alone, with b1 and b2 kept.
    """

    robot: RobotDescription
    rate: float
    mi: tuple[float, float]
    variables: tuple[DesignVariable, ...]
    paper: bool = False
    near: bool = False
    reference: bool = False

    @property
    def length(self) -> float:
        """Leg length [m]."""
        return mean_leg_length(self.robot)

    @property
    def has_many_legs(self) -> bool:
        """Whether there are more legs than the paper's robot has."""
        return len(self.robot.legs) > FEW_LEGS

    @property
    def gravity_speed(self) -> float:
        """Speed that counts as one for this size, sqrt(g L) [m/s] (a Froude number of 1)."""
        return math.sqrt(9.81 * self.length)

    def first(self) -> list[float]:
        """Where the file is among the ranges, each in [0, 1]."""
        return [each.place(self._now(each.name)) for each in self.variables]

    def _now(self, name: str) -> float:
        robot = self.robot
        match name:
            case "mi.scale":
                low, high = robot.mi_range or self.mi
                return math.sqrt((low * high) / (self.mi[0] * self.mi[1]))
            case "servo.lag":
                return robot.servo.damping / robot.servo.stiffness / self.time
            case "servo.stiffness" | "trunk.share" | "servo.reflected_inertia":
                return 1.0
            case "contact.stiffness" | "contact.damping":
                return 1.0
        return 0.0 if "." in name else float(_parameter(robot, name))

    @property
    def time(self) -> float:
        """Time scale of a robot of this size, 1 for Lilibot [1]: its ticks over those at 60 Hz."""
        return 60.0 / self.rate


@dataclass(frozen=True)
class Candidate:
    """A robot with its controller, as a point of the search makes it.

    Args:
        robot: the robot, whose preset and MI range are those of the point.
        values: of the design variables, by name.
    """

    robot: RobotDescription
    values: Mapping[str, float]

    def mi(self, share: float) -> float:
        """MI at a share of the range: 0 for its lowest, 1 for its highest, even steps of log MI."""
        assert self.robot.mi_range is not None
        low, high = self.robot.mi_range
        return float(low * (high / low) ** share)


def candidate(start: Start, x: Sequence[float] | Array) -> Candidate:
    """The candidate of a point.

    Args:
        start: what is tuned.
        x: a coordinate in [0, 1] for each variable.
    """
    pairs = zip(start.variables, x, strict=True)
    values = {variable.name: variable.value(float(at)) for variable, at in pairs}
    return Candidate(robot_of(start, values), values)


def robot_of(start: Start, values: Mapping[str, float]) -> RobotDescription:
    """The robot of values of the design variables."""
    robot = _body(start.robot, values, start.length)
    if "servo.stiffness" in values:
        robot = geared(robot, values["servo.stiffness"], values["servo.lag"] * start.time)
    b = float(_parameter(robot, "b1")), float(_parameter(robot, "b2"))
    stance = {name[7:]: value for name, value in values.items() if name.startswith("stance.")}
    robot, (b1, b2) = stood(robot, b, StanceChange(**stance), keep=start.reference)
    gains: dict[str, Any] = {
        name: round(value) if variable_named(name).type is Type.integer else value
        for name, value in values.items()
        if "." not in name
    }
    if stance:
        gains |= {"b1": b1, "b2": b2}
    scale = values.get("mi.scale", 1.0)
    low, high = (min(limit * scale, 0.40) for limit in start.mi)
    return replace(
        robot,
        controller={**robot.controller, **gains},
        rate=start.rate,
        mi_range=(low, high),
        mi=None,  # that of the file may lie outside
    )


def _body(robot: RobotDescription, values: Mapping[str, float], length: float) -> RobotDescription:
    """The robot with what is uncertain of its body."""
    trunk = robot.trunk
    if "trunk.com_x" in values:
        x, y, z = trunk.com
        x, z = x + length * values["trunk.com_x"], z + length * values["trunk.com_z"]
        trunk = replace(trunk, com=(x, y, z))
    share = values.get("trunk.share", 1.0)
    if share != 1.0:
        of_legs = (robot.mass - share * trunk.mass) / (robot.mass - trunk.mass)
        trunk = replace(trunk, mass=share * trunk.mass)
        legs = tuple(
            replace(
                leg,
                **{
                    name: replace(link, mass=of_legs * link.mass)
                    for name in ("hip", "femur", "tibia")
                    if (link := getattr(leg, name))
                },
            )
            for leg in robot.legs
        )
        robot = replace(robot, legs=legs)
    robot = replace(robot, trunk=trunk)
    if "contact.stiffness" in values:
        shares = {name: values[f"contact.{name}"] for name in ("stiffness", "damping")}
        own = {name: getattr(robot.contact, name) * share for name, share in shares.items()}
        robot = replace(robot, contact=replace(robot.contact, **own))
    if "servo.reflected_inertia" in values:
        robot = with_rotors(robot, values["servo.reflected_inertia"])
    return robot


def variables_for(
    robot: RobotDescription,
    *,
    servo: bool = True,
    body: bool = False,
    scale: bool = True,
    kept: Sequence[str] = (),
) -> tuple[DesignVariable, ...]:
    """What is searched.

    Args:
        robot: the robot.
        servo: whether the gains of the servos may be changed.
        body: whether what is uncertain of the body may be changed.
        scale: whether the MI range may be scaled.
        kept: names of variables of stance and controller that stay as they are; b1 and b2 among
            them turn the reference pose in their place, see :attr:`Start.reference`.

    Raises:
        ValueError: one of these is no such variable.
    """
    gains = [each for each in GAINS if scale or each.name != "mi.scale"]
    many = MANY_LEGS if len(robot.legs) > FEW_LEGS else ()
    stance = POSE if any(leg.has_coxa for leg in robot.legs) else STANCE
    own = (*stance, *gains, *many)
    names = [*dict.fromkeys(each.name for each in (*own, *POSE))]
    for name in kept:
        if name not in names:
            raise ValueError(f"{name} cannot be kept; allowed: {', '.join(names)}")
    if stance is STANCE and ("b1" in kept) != ("b2" in kept):
        raise ValueError("b1 and b2 can be kept only together: the stance turns both joints")
    own = tuple(each for each in own if each.name not in kept)
    return (*own, *(SERVO if servo else ()), *(BODY if body else ()))


def _parameter(robot: RobotDescription, name: str) -> Any:
    return robot.controller.get(name, getattr(Parameters(), name))

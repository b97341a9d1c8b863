"""The table of variables of a robot's FMU: names, units, ranges, start values, descriptions.

Description, C structs and the table in C are made from it (``python -m apnc_plant.generate``), with
the numbers of ``apnc_plant/variable_numbers.py``. Start values of a robot's own numbers are those
of the robot that is built, see :func:`starts_of`.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from enum import IntEnum
from typing import Any, Final

from apnc_core.enumerations import Enumeration
from apnc_core.schema import Causality, Shape, Type, Value, Variable
from apnc_core.variables import variable_named as controller_variable
from apnc_plant.conditions import PAYLOAD
from apnc_plant.robot.model import RobotDescription
from apnc_plant.signals import PLANT_SIGNALS, Signal
from apnc_plant.step import SHORTEST_STEP, own_step

COMMANDS: Final = ("theta_hip", "theta_knee")
LOAD: Final = "grf"
LARGEST_SEED: Final = 2**31 - 1


class Condition(IntEnum):
    """Conditions of the paper, by the names of ``apnc_plant.conditions``."""

    C1 = 1
    C2 = 2
    C3 = 3
    C4 = 4
    S1 = 5
    S2 = 6
    S3 = 7


class LoadComponent(IntEnum):
    """Part of the force on a foot that its sensor measures."""

    normal = 1
    norm = 2


ENUMERATIONS: Final = (
    Enumeration(
        Condition,
        (
            "nothing is wrong",
            "noisy loads",
            "the right front leg is damaged: its hip and knee are held at 0",
            f"a payload of {PAYLOAD:g} of the robot's mass, which cannot be added or removed "
            "between steps",
            "held in the air",
            "the sensors of both front legs are stuck",
            "no sensor delivers a load",
        ),
    ),
    Enumeration(LoadComponent, ("along the normal of the ground", "length of the whole force")),
)
_CONDITION, _COMPONENT = ENUMERATIONS


def _input(name: str) -> Variable:
    """A command, with the properties of the controller's output of the same name."""
    return replace(
        controller_variable(name),
        causality=Causality.input,
        variability="continuous",
        start=0.0,
        initial_from=(),
        equation="",
    )


def _fixed(name: str, description: str, **rest: Any) -> Variable:
    return Variable(name, "", description, Causality.parameter, "fixed", **rest)


def _tunable(name: str, description: str, **rest: Any) -> Variable:
    return Variable(name, "", description, Causality.parameter, "tunable", **rest)


_MOST_S: Final = 1.0
"""Longest latency or delay [s]."""

_PARAMETERS: Final = (
    _fixed(
        "seed", "decides the asymmetry of the robot, the noise of its sensors and the obstacles",
        type=Type.integer, start=0, min=0, max=LARGEST_SEED),
    _fixed(
        "roughness", "height of the obstacles on the ground over the robot's step height; 0 for "
        "none", start=0.0, unit="1", min=0.0, max=1.0),
    _fixed(
        "slope", "angle by which the ground rises along x",
        start=0.0, unit="rad", display_unit="deg", min=-1.5, max=1.5),
    _fixed(
        "payload", "mass of a box on the trunk, added to that of the condition",
        start=0.0, unit="kg", min=0.0, max=100.0),
    _tunable(
        "condition", "what is wrong with the robot",
        type=Type.enumeration, enumeration=_CONDITION, start=Condition.C1.value),
    _fixed(
        "step", "longest integration step; a step of the FMU is divided into equal parts",
        start=1e-3, unit="s", min=SHORTEST_STEP, max=1 / 60),
    _tunable(
        "servo.stiffness", "torque of a servo per position error",
        start=1.0, unit="N.m/rad", min=1e-6, max=1e6),
    _tunable(
        "servo.damping", "torque of a servo per joint speed",
        start=0.0, unit="N.m.s/rad", min=0.0, max=1e6),
    _tunable(
        "servo.stall_torque", "largest torque of a servo",
        start=1.0, unit="N.m", min=1e-6, max=1e6),
    _tunable(
        "servo.no_load_speed", "speed at which a servo has no driving torque left",
        start=1.0, unit="rad/s", min=1e-6, max=1e6),
    _fixed(
        "servo.reflected_inertia", "rotor inertia times the gear ratio squared",
        start=0.0, unit="kg.m2", min=0.0, max=1e3),
    _tunable(
        "servo.latency", "age of a command when the servo starts to follow it",
        start=0.0, unit="s", min=0.0, max=_MOST_S),
    _tunable(
        "servo.slew_rate", "fastest change of a command that a servo follows; 0 for no limit",
        start=0.0, unit="rad/s", min=0.0, max=1e6),
    _fixed(
        "contact.foot_radius", "radius of the foot balls",
        start=0.01, unit="m", min=1e-4, max=1.0),
    _tunable(
        "contact.stiffness", "normal force on a foot per depth",
        start=1e4, unit="N/m", min=1e-12, max=1e9),
    _tunable(
        "contact.damping", "normal force per approach speed, from the damping depth on",
        start=0.0, unit="N.s/m", min=0.0, max=1e9),
    _tunable(
        "contact.damping_depth", "depth over which the damping sets in",
        start=1e-4, unit="m", min=1e-9, max=1.0),
    _tunable(
        "contact.friction", "Coulomb coefficient of the feet",
        start=0.8, unit="1", min=0.0, max=1e3),
    _tunable(
        "contact.friction_speed", "sliding speed below which friction is proportional to it",
        start=0.03, unit="m/s", min=1e-6, max=1e3),
    _tunable(
        "sensor.delay", "age of a load when it arrives",
        start=0.0, unit="s", min=0.0, max=_MOST_S),
    _tunable(
        "sensor.time_constant", "time constant of the low-pass of the loads; 0 for none",
        start=0.0, unit="s", min=0.0, max=1e3),
    _tunable(
        "sensor.noise", "standard deviation of the loads' noise over half the weight",
        start=0.0, unit="1", min=0.0, max=1e3),
    _tunable(
        "sensor.component", "part of the force on a foot that its sensor measures",
        type=Type.enumeration, enumeration=_COMPONENT, start=LoadComponent.normal.value),
)  # fmt: skip

_PARTS: Final = ("servo", "contact", "sensor")
"""Names of the parts of a robot whose numbers are parameters."""


def _outputs(signal: Signal) -> list[Variable]:
    """Variables of a signal: one per component, with an entry per leg."""
    names = [f"{signal.name}.{c}" for c in signal.components] or [signal.name]
    description = "; ".join(filter(None, (signal.description, signal.frame, signal.sign)))
    return [
        Variable(
            name, "", description, Causality.output, "continuous",
            shape=Shape.leg if signal.per_leg else Shape.scalar,
            unit=signal.unit, initial_from=tuple(v.name for v in _PARAMETERS),
        )
        for name in names
    ]  # fmt: skip


FELL: Final = Variable(
    "fell",
    "",
    "true once the trunk has tipped by more than 60 degrees or touched the ground; nothing moves "
    "from then on",
    Causality.output,
    "discrete",
    type=Type.boolean,
    initial_from=tuple(v.name for v in _PARAMETERS),
)

TABLE: Final = (
    *map(_input, COMMANDS),
    *_PARAMETERS,
    *(v for signal in PLANT_SIGNALS for v in _outputs(signal)),
    FELL,
)


def is_of_robot(variable: Variable) -> bool:
    """Whether the start value of a parameter is a number of the robot."""
    return variable.name.split(".")[0] in (*_PARTS, "step")


def starts_of(robot: RobotDescription) -> Mapping[str, tuple[Value, ...]]:
    """Start values of the parameters that are numbers of a robot, by name.

    Args:
        robot: the robot.

    Raises:
        ValueError: a number of the robot that its variable does not allow.
    """
    starts: dict[str, tuple[Value, ...]] = {}
    # the step comes last: that of a robot with a number outside its range may not exist
    for v in sorted(filter(is_of_robot, _PARAMETERS), key=lambda v: v.name == "step"):
        part, _, name = v.name.partition(".")
        value: Any = getattr(getattr(robot, part), name) if name else own_step(robot)
        if v.enumeration:
            value = v.enumeration.items[value].value
        elif not v.min <= value <= v.max:
            raise ValueError(
                f"{v.name} is {value:g} in robot '{robot.name}'; an FMU takes {v.min:g} to "
                f"{v.max:g} [{v.unit}]"
            )
        starts[v.name] = (value,)
    return starts


def variable_named(name: str) -> Variable:
    """The variable of that name; KeyError if there is none."""
    for variable in TABLE:
        if variable.name == name:
            return variable
    raise KeyError(f"no variable '{name}' in the table of a robot")

"""The system of controller and plant as plain data, from which all of its files are made."""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Final

from apnc.loop.experiment import Experiment
from apnc.system.plant_fmu import MODEL_SUFFIX, PlantBuild, plant_model
from apnc_core.schema import Causality, Scalar, Type, Value
from apnc_core.settings import Setting, checked_in
from apnc_core.variables import scalars, variable_named, variables_of
from apnc_plant.conditions import Conditions, paper_conditions
from apnc_plant.ground import Obstacles
from apnc_plant.robot.size import times_longer
from apnc_plant.variables import COMMANDS, FELL, LOAD, TABLE, Condition
from build_fmu.description_parts import UNITS
from build_fmu.platforms import MODEL

CONTROLLER: Final = "controller"
PLANT: Final = "plant"
RESOURCES: Final = "resources"

_CONTROLLER_SHOWS: Final = (*COMMANDS, "o1", "o2", "phi", "kappa")
_PLANT_SHOWS: Final = (LOAD, "position", "rpy", "velocity", FELL.name)
_INPUTS_SET: Final = ("MI", "turn")
"""Inputs that are not connected and that get their value from the experiment."""

PLANT_PARAMETERS: Final = {v.name: v for v in TABLE if v.causality is Causality.parameter}
"""Parameters of the plant by name."""

_OF_EXPERIMENT: Final = ("seed", "roughness", "slope", "payload", "condition", "step")
"""Parameters of the plant that the experiment sets."""


class UnfitExperimentError(ValueError):
    """An experiment that a system cannot hold."""


@dataclass(frozen=True)
class Connector:
    """An input or output of an FMU that is a connector of its component.

    Args:
        name: of the variable.
        kind: its causality.
        type: its FMI type.
        unit: its unit, if it has one.
        reference: its value reference.
    """

    name: str
    kind: str
    type: str
    unit: str | None
    reference: int


@dataclass(frozen=True)
class Component:
    """One FMU of the system.

    Args:
        name: of the component.
        model: name of the model, and of its libraries.
        connectors: its inputs and outputs.
    """

    name: str
    model: str
    connectors: tuple[Connector, ...]

    @property
    def source(self) -> str:
        """Path of the FMU in the archive."""
        return f"{RESOURCES}/{self.model}.fmu"


@dataclass(frozen=True)
class Start:
    """A start value, of a parameter or an input.

    Args:
        component: name of the FMU.
        name: of the variable.
        type: its FMI type: Real, Integer or Boolean.
        value: the value.
        unit: its unit, if it has one.
        reference: its value reference.
    """

    component: str
    name: str
    type: str
    value: Value
    unit: str | None
    reference: int


@dataclass(frozen=True)
class Structure:
    """A system.

    Args:
        name: its name.
        legs: names of the legs.
        components: controller and plant.
        connections: pairs of (component, connector), from output to input.
        starts: start values.
        step: communication step [s].
        stop: end of the default experiment [s].
    """

    name: str
    legs: tuple[str, ...]
    components: tuple[Component, Component]
    connections: tuple[tuple[tuple[str, str], tuple[str, str]], ...]
    starts: tuple[Start, ...]
    step: float
    stop: float

    @property
    def units(self) -> dict[str, dict[str, str]]:
        """Units in use by exponents of the base units."""
        shown = {c.unit for part in self.components for c in part.connectors}
        used = (shown | {start.unit for start in self.starts}) - {None}
        return {name: UNITS[name] for name in sorted(filter(None, used))}


def system_name(robot: str) -> str:
    """Name of the system: ``Lilibot`` for robot ``lilibot``, by name or file."""
    return plant_model(robot).removesuffix(MODEL_SUFFIX)


def plant_build(experiment: Experiment, naming: str, platforms: tuple[str, ...] = ()) -> PlantBuild:
    """The plant FMU of a system; its enumerations are numbers, which every tool takes.

    Args:
        experiment: the experiment; its robot is given by name or file.
        naming: naming of the variables.
        platforms: names of the binaries to include.
    """
    assert isinstance(experiment.robot, str)
    return PlantBuild(
        robot=experiment.robot, naming=naming, platforms=platforms, enumerations="integer"
    )


def plant_setting(text: str) -> tuple[str, Setting] | None:
    """``"servo.stiffness=40"`` -> ``("servo.stiffness", 40.0)``.

    Args:
        text: name, equals sign and value; the value as in JSON, an enumeration by item name.

    Returns:
        Name and value, or None if the robot has no number of that name.

    Raises:
        ValueError: a value outside what is allowed.
    """
    name, _, value = (part.strip() for part in text.partition("="))
    if name not in PLANT_PARAMETERS or name in _OF_EXPERIMENT:
        return None
    try:
        return name, checked_in(PLANT_PARAMETERS[name], json.loads(value))
    except json.JSONDecodeError:
        return name, checked_in(PLANT_PARAMETERS[name], value)


def structure_of(
    experiment: Experiment,
    naming: str = "structured",
    numbers: Mapping[str, Setting] | None = None,
) -> Structure:
    """The system that walks an experiment.

    Args:
        experiment: the experiment. Its robot is given by name or file, its ground is a plane or the
            paper's obstacles with the seed of the experiment, and nothing changes over time.
        naming: naming of the variables of both FMUs.
        numbers: values of servo, contact and sensor in place of those of the robot's file, by the
            names of the plant's parameters, such as ``servo.stiffness``.

    ``MI``, ``turn`` and ``reset`` are no connectors: fmpy.ssp feeds an input that is listed and not
    connected with what the input listed before it gets. They keep their start values, which for
    ``MI`` and ``turn`` are in the parameter set.

    Raises:
        UnfitExperimentError: an experiment that a system cannot hold.
        ValueError: a number of the robot outside what is allowed, or as ``PlantBuild``.
    """
    _refuse(experiment)
    model, n_legs = plant_build(experiment, naming).model(), len(experiment.description.legs)
    loads = [variable_named(LOAD).scalar_name(leg, naming) for leg in range(n_legs)]
    commands = [
        variable_named(c).scalar_name(leg, naming) for c in COMMANDS for leg in range(n_legs)
    ]
    return Structure(
        name=model.identifier.removesuffix(MODEL_SUFFIX),
        legs=model.legs,
        components=(
            Component(
                CONTROLLER,
                MODEL,
                _connectors(scalars(n_legs, naming), (LOAD, *_CONTROLLER_SHOWS)),
            ),
            Component(
                PLANT,
                model.identifier,
                _connectors(model.scalars(), (*COMMANDS, *_PLANT_SHOWS)),
            ),
        ),
        connections=(
            *(((PLANT, name), (CONTROLLER, name)) for name in loads),
            *(((CONTROLLER, name), (PLANT, name)) for name in commands),
        ),
        starts=(
            *_controller_starts(experiment, naming),
            *_plant_starts(experiment, naming, numbers or {}),
        ),
        step=experiment.Ts,
        stop=experiment.duration,
    )


def _connectors(known: Iterable[Scalar], shown: tuple[str, ...]) -> tuple[Connector, ...]:
    return tuple(
        Connector(s.name, s.variable.causality, s.variable.type, s.variable.unit, s.value_reference)
        for s in known
        if s.variable.name.split(".")[0] in shown
    )


def _refuse(experiment: Experiment) -> None:
    ground, seed = experiment.ground, experiment.seed
    rough = Obstacles(
        slope=ground.slope,
        roughness=getattr(ground, "roughness", 0.0),
        seed=seed,
        scale=times_longer(experiment.description),
    )
    most = int(PLANT_PARAMETERS["seed"].max or 0)
    for name, value, fits, allowed in (
        ("robot", experiment.robot, isinstance(experiment.robot, str), "a name or a file"),
        ("mi", experiment.mi, isinstance(experiment.mi, float), "one value"),
        ("turn", experiment.turn, isinstance(experiment.turn, float), "one value"),
        ("reset", experiment.reset, experiment.reset is False, "false"),
        ("conditions", experiment.conditions, _condition(experiment) is not None,
         "one, named, and a payload"),
        ("ground", ground.text(), ground.flat or ground == rough,
         "a plane, or obstacles with the seed of the system and the scale of the robot"),
        ("seed", seed, seed <= most, f"0 to {most}"),
        ("fmu", experiment.fmu, experiment.fmu is None, "the built one"),
    ):  # fmt: skip
        if not fits:
            raise UnfitExperimentError(f"{name} = {value} of a system; allowed: {allowed}")


def _condition(experiment: Experiment) -> tuple[Condition, float] | None:
    """Named condition of an experiment, and its payload beyond that of the condition [kg]."""
    wanted = experiment.conditions
    if isinstance(wanted, str):
        return Condition[wanted], 0.0
    if not isinstance(wanted, Conditions):
        return None
    robot = experiment.description
    wanted = wanted.of_legs(robot.leg_names)
    for name, known in paper_conditions(robot).items():
        more = wanted.payload - known.payload
        if more >= 0.0 and replace(wanted, payload=known.payload) == known:
            return Condition[name], more
    return None


def _controller_starts(experiment: Experiment, naming: str) -> list[Start]:
    """Start values of inputs and parameters. Flags are left out where they have their default.

    FMPy reads every flag in a parameter set as true.
    """
    known: dict[str, list[Scalar]] = {}
    for scalar in scalars(len(experiment.description.legs), naming):
        known.setdefault(scalar.variable.name, []).append(scalar)
    given = {"MI": experiment.mi, "turn": experiment.turn}
    values = given | experiment.parameters()
    starts = []
    for v in (*map(variable_named, _INPUTS_SET), *variables_of(Causality.parameter)):
        value = values[v.name]
        if v.type is Type.boolean and value == v.start:
            continue
        kind = Type.integer if v.enumeration else v.type
        entries = value if isinstance(value, tuple | list) else [value]
        for s, entry in zip(known[v.name], entries, strict=False):
            plain = int(entry) if kind is Type.integer else entry
            starts.append(Start(CONTROLLER, s.name, kind, plain, v.unit, s.value_reference))
    return starts


def _plant_starts(
    experiment: Experiment, naming: str, numbers: Mapping[str, Setting]
) -> list[Start]:
    """Start values of all parameters of the plant; those of the robot are from its file."""
    found = _condition(experiment)
    assert found is not None
    condition, payload = found
    own: dict[str, Setting] = {
        "seed": experiment.seed,
        "roughness": getattr(experiment.ground, "roughness", 0.0),
        "slope": experiment.ground.slope,
        "payload": payload,
        "condition": condition.value,
        "step": experiment.step,
    }
    free = [name for name in PLANT_PARAMETERS if name not in own]
    for name in numbers:
        if name not in free:
            raise ValueError(f"number '{name}' of the robot is not one of {', '.join(free)}")
    model = plant_build(experiment, naming).model()
    starts = []
    for s in model.scalars():
        v = s.variable
        if v.causality is not Causality.parameter:
            continue
        value = checked_in(v, (own | dict(numbers)).get(v.name, model.start(v)[0]))
        assert not isinstance(value, tuple)
        starts.append(Start(PLANT, s.name, model.type_of(v), value, v.unit, s.value_reference))
    return starts

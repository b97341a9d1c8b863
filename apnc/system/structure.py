"""Controller and plant connected, as plain data; the files of SSP and OSP are made from it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from apnc.loop.experiment import Experiment
from apnc.system.plant_fmu import MODEL_SUFFIX, PlantBuild, plant_model
from apnc_core.schema import Causality, Scalar, Type
from apnc_core.variables import row, rows, scalars
from apnc_plant.variables import COMMANDS, FELL, LOAD, Condition
from build_fmu.description_parts import UNITS
from build_fmu.platforms import MODEL

CONTROLLER: Final = "controller"
PLANT: Final = "plant"
RESOURCES: Final = "resources"

_CONTROLLER_SHOWS: Final = (*COMMANDS, "o1", "o2", "phi", "kappa")
_PLANT_SHOWS: Final = (LOAD, "position", "rpy", "velocity", FELL.name)
_PLANT_STARTS: Final = ("seed", "roughness", "slope", "payload", "condition")


class UnfitExperimentError(ValueError):
    """An experiment that a system cannot hold, in one line."""


@dataclass(frozen=True)
class Connector:
    """An input or output that the system shows; ``kind`` is its causality."""

    name: str
    kind: str
    type: str
    unit: str | None


@dataclass(frozen=True)
class Component:
    """One FMU of the system and what it shows."""

    name: str
    source: str
    connectors: tuple[Connector, ...]


@dataclass(frozen=True)
class Start:
    """A start value, of a parameter or an input."""

    component: str
    name: str
    type: str
    value: float | int | bool | str
    unit: str | None = None


@dataclass(frozen=True)
class Structure:
    """A system.

    Args:
        name: its name.
        components: controller and plant.
        connections: pairs of (component, connector), from output to input.
        starts: start values.
        step: communication step [s].
        stop: end of the default experiment [s].
    """

    name: str
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
    """The plant FMU of a system; its condition is a number, which every tool takes.

    Args:
        experiment: what walks; its robot by name or file.
        naming: of its variables.
        platforms: names of the binaries to include.
    """
    assert isinstance(experiment.robot, str)
    return PlantBuild(
        robot=experiment.robot, naming=naming, platforms=platforms, enumerations="integer"
    )


def structure_of(experiment: Experiment, naming: str = "structured") -> Structure:
    """The system that walks an experiment.

    Args:
        experiment: what walks; its robot by name or file, its ground level, and nothing in it
            changes over time.
        naming: of both FMUs.

    ``MI``, ``turn`` and ``reset`` are no connectors. FMPy writes 0 to every input connector that
    nothing is connected to, and MI = 0 is a reset: the robot would never walk. They keep their
    start values, of which ``MI`` is in the parameter set.

    Raises:
        UnfitExperimentError: an experiment that a system cannot hold.
        ValueError: as ``PlantBuild``.
    """
    _refuse(experiment)
    model, n_legs = plant_build(experiment, naming).model(), len(experiment.description.legs)
    controller = [
        Connector(s.name, s.variable.causality, s.variable.type, s.variable.unit)
        for s in scalars(n_legs, naming)
        if s.variable.name in (LOAD, *_CONTROLLER_SHOWS)
    ]
    plant = [
        Connector(s.name, s.variable.causality, s.variable.type, s.variable.unit)
        for s in model.scalars()
        if s.variable.name.split(".")[0] in (*COMMANDS, *_PLANT_SHOWS)
    ]
    loads = [row(LOAD).scalar_name(leg, naming) for leg in range(n_legs)]
    commands = [row(c).scalar_name(leg, naming) for c in COMMANDS for leg in range(n_legs)]
    return Structure(
        name=model.identifier.removesuffix(MODEL_SUFFIX),
        components=(
            Component(CONTROLLER, f"{RESOURCES}/{MODEL}.fmu", tuple(controller)),
            Component(PLANT, f"{RESOURCES}/{model.identifier}.fmu", tuple(plant)),
        ),
        connections=(
            *(((PLANT, name), (CONTROLLER, name)) for name in loads),
            *(((CONTROLLER, name), (PLANT, name)) for name in commands),
        ),
        starts=(*_controller_starts(experiment, naming), *_plant_starts(experiment, naming)),
        step=experiment.Ts,
        stop=experiment.duration,
    )


def _refuse(experiment: Experiment) -> None:
    level = {"kind": "plane", "slope": 0.0}
    for name, value, fits, allowed in (
        ("robot", experiment.robot, isinstance(experiment.robot, str), "a name or a file"),
        ("mi", experiment.mi, isinstance(experiment.mi, float | int), "one value"),
        ("turn", experiment.turn, experiment.turn == 0.0, "0"),
        ("reset", experiment.reset, experiment.reset is False, "false"),
        ("conditions", experiment.conditions, isinstance(experiment.conditions, str), "a name"),
        ("ground", experiment.ground, experiment.ground.to_dict() == level, "the level plane"),
    ):
        if not fits:
            raise UnfitExperimentError(f"{name} = {value} of a system; allowed: {allowed}")


def _controller_starts(experiment: Experiment, naming: str) -> list[Start]:
    """``MI`` and the whole preset, but flags and enumerations only where they are not the default.

    FMPy takes every flag of a parameter set for true, and libcosim knows no enumerations.
    """
    known: dict[str, list[Scalar]] = {}
    for scalar in scalars(len(experiment.description.legs), naming):
        known.setdefault(scalar.variable.name, []).append(scalar)
    starts = [Start(CONTROLLER, "MI", Type.real, float(experiment.mi), "1")]  # type: ignore[arg-type]
    values = experiment.parameters()
    for v in rows(Causality.parameter):
        value = values[v.name]
        if v.type in (Type.boolean, Type.enumeration) and value == v.start:
            continue
        if v.enumeration:
            assert isinstance(value, int)
            starts.append(Start(CONTROLLER, v.name, v.type, v.enumeration.items(value).name))
            continue
        entries = value if isinstance(value, tuple | list) else [value]
        for scalar, entry in zip(known[v.name], entries, strict=False):
            starts.append(Start(CONTROLLER, scalar.name, v.type, entry, v.unit))
    return starts


def _plant_starts(experiment: Experiment, naming: str) -> list[Start]:
    """What a walk sets; the numbers of the robot are in its FMU."""
    assert isinstance(experiment.conditions, str)
    own = {"seed": experiment.seed, "condition": Condition[experiment.conditions].value}
    model = plant_build(experiment, naming).model()
    return [
        Start(PLANT, name, model.type_of(v), own.get(name, model.start(v)[0]), v.unit)
        for name in _PLANT_STARTS
        for v in (model.row(name),)
    ]

"""The robot in Exudyn behind PythonFMU: what runs inside the plant FMU."""

from __future__ import annotations

import ctypes
import functools
import math
from dataclasses import replace
from functools import partial
from pathlib import Path
from typing import Any, ClassVar, Final
from xml.etree.ElementTree import Element, SubElement

import numpy as np
from pythonfmu import (
    Boolean,
    DefaultExperiment,
    Fmi2Causality,
    Fmi2Initial,
    Fmi2Slave,
    Fmi2Variability,
    Integer,
    Real,
    String,
)
from pythonfmu.enums import Fmi2Status

from apnc.loop.experiment import Experiment
from apnc.system.plant_variables import UNITS, PlantVariable, plant_variables
from apnc_core import __version__
from apnc_core.schema import Causality
from apnc_plant.channels import PLANT_CHANNELS, PlantError
from apnc_plant.conditions import Conditions, named_conditions
from apnc_plant.ground import Ground, Plane, Surface
from apnc_plant.robot import load_robot
from build_fmu.description_parts import ABOUT, STOP_TIME, number
from exudyn_models.engine import exu
from exudyn_models.plant import Plant

ROBOT_FILE: Final = "robot.toml"
"""The robot, in the resources of the FMU."""

TICK: Final = Experiment().Ts
"""Longest time between two readings of the foot sensors [s]; a longer step is cut."""

TOO_SHORT: Final = 1e-9
"""A step below this [s] changes nothing: importers end runs with what rounding has left."""


@functools.cache
def _load_exudyn() -> None:
    """Load Exudyn in a thread state that stays.

    In a host that is not Python, PythonFMU makes a thread state for every call and deletes it
    again.
    Exudyn keeps the one it was loaded in, and would wait for ever for the next.
    """
    exu()
    ctypes.pythonapi.PyGILState_Ensure()


def hold(*things: object) -> None:
    """Add a reference that nobody gives back.

    PythonFMU 0.7.0 gives back references that it has not taken: of the names of the script and of
    the class with every instance, and of class, instance and log with every exception. The process
    would crash sooner or later, often not before it ends.
    """
    for thing in things:
        ctypes.pythonapi.Py_IncRef(ctypes.py_object(thing))


def _outlived(method: Any) -> Any:
    """The method, after whose exceptions the instance lives on."""

    @functools.wraps(method)
    def outlived(self: PlantSlave, *arguments: Any) -> Any:
        try:
            return method(self, *arguments)
        except Exception:
            hold(type(self), self, self.log_queue)
            raise

    return outlived


class PlantSlave(Fmi2Slave):  # type: ignore[misc]  # the package has no types
    """One robot; a subclass in the FMU says which.

    Attributes:
        NAMING: of the variables, ``structured`` or ``flat``.
        BUILT_BY: version of this package that the FMU was built with.
        GUID: of the FMU.

    Raises:
        RuntimeError: this package is of another version than the FMU.
    """

    NAMING: ClassVar = "structured"
    BUILT_BY: ClassVar = __version__
    GUID: ClassVar = ""

    def __init_subclass__(cls) -> None:
        """Keep the class for ever, and load what it walks in."""
        super().__init_subclass__()
        _load_exudyn()
        hold(cls)

    def __init__(self, **kwargs: Any) -> None:
        super().__init__(**kwargs)
        if __version__ != self.BUILT_BY:
            raise RuntimeError(
                f"{type(self).__name__} was built with apnc {self.BUILT_BY}, this Python has "
                f"{__version__}: build it again"
            )
        self._robot = load_robot(str(Path(self.resources) / ROBOT_FILE))
        self._plant: Plant | None = None
        self._started = self._fell = False
        self._shown: list[float] | None = None
        self._time: float | None = None
        n_legs = len(self._robot.legs)
        self._commands = np.zeros(2 * n_legs)
        self._describe()
        variables = plant_variables(n_legs, self.NAMING)
        inputs = [v.name for v in variables if v.causality is Causality.input]
        outputs = [v.name for v in variables if v.causality is Causality.output]
        self._inputs, commands = inputs, self._commands
        self._set: dict[str, Any] = {}
        for v in variables:
            if v.causality is Causality.parameter:
                self._set[v.name] = v.start
                self._register(v, partial(self._chosen, v.name), partial(self._choose, v))
            elif v.causality is Causality.input:
                at = inputs.index(v.name)
                self._register(v, partial(commands.item, at), partial(commands.__setitem__, at))
            elif v.unit:
                self._register(v, partial(self._value, outputs.index(v.name)))
            else:
                self._register(v, lambda: self._fell)

    def _describe(self) -> None:
        self.guid = self.GUID
        self.author, self.license = ABOUT["author"], ABOUT["license"]
        self.copyright, self.version = ABOUT["copyright"], ABOUT["version"]
        self.description = f"Robot '{self._robot.name}' on the ground, in Exudyn"
        self.default_experiment = DefaultExperiment(0, float(STOP_TIME), TICK)

    def _register(self, v: PlantVariable, getter: Any, setter: Any = None) -> None:
        def refuse(value: Any) -> None:
            raise ValueError(f"{v.name} is an output: it cannot be set")

        continuous, discrete = Fmi2Variability.continuous, Fmi2Variability.discrete
        variability, initial = {
            Causality.input: (continuous, None),
            Causality.parameter: (
                Fmi2Variability.tunable if v.tunable else Fmi2Variability.fixed,
                Fmi2Initial.exact,
            ),
            Causality.output: (continuous if v.unit else discrete, Fmi2Initial.calculated),
        }[v.causality]
        variable = _KINDS[v.type](
            v.name,
            causality=Fmi2Causality[v.causality.value],
            variability=variability,
            initial=initial,
            description=v.description,
            getter=getter,
            setter=setter or refuse,
        )
        variable.row = v
        self.register_variable(variable, nested=False)

    def _chosen(self, name: str) -> Any:
        return self._set[name]

    def _choose(self, v: PlantVariable, value: Any) -> None:
        if self._started and not v.tunable:
            raise ValueError(f"{v.name} is fixed: it can only be set before the first step")
        if v.low is not None and v.high is not None and not v.low <= value <= v.high:
            raise ValueError(f"{v.name} = {value} is not in {v.low:g} ... {v.high:g}")
        chosen = self._set | {v.name: value}
        conditions = _conditions(chosen)
        if self._started and self._plant:
            self._plant.set_conditions(conditions)
        else:
            self._plant = self._shown = None
        self._set = chosen

    def _made(self) -> Plant:
        if self._plant is None:
            self._plant = Plant(
                self._robot,
                self._set["seed"],
                ground=_ground(self._set),
                conditions=_conditions(self._set),
            )
        return self._plant

    def _value(self, at: int) -> float:
        if self._shown is None:
            sample = self._made().sample()
            self._shown = np.concatenate([sample[c.name].ravel() for c in PLANT_CHANNELS]).tolist()
        return self._shown[at]

    def setup_experiment(
        self, start_time: float, stop_time: float | None = None, tolerance: float | None = None
    ) -> None:
        """Take the start time [s]."""
        self._time = start_time

    get_real = _outlived(Fmi2Slave.get_real)
    set_real = _outlived(Fmi2Slave.set_real)
    set_integer = _outlived(Fmi2Slave.set_integer)
    set_boolean = _outlived(Fmi2Slave.set_boolean)
    set_string = _outlived(Fmi2Slave.set_string)

    @_outlived
    def exit_initialization_mode(self) -> None:
        """Put the robot on the ground.

        Raises:
            ValueError: parameters that do not fit.
        """
        self._made()
        self._started = True

    def do_step(self, current_time: float, step_size: float) -> bool:
        """Follow the commands for one communication step [s].

        Returns:
            False, which PythonFMU makes fmi2Discard, with the reason in the log: a command that is
            not finite, a step that begins elsewhere than the last one ended, a motion that
            diverged. An exception would be fmi2Fatal.
        """
        try:
            self._advance(current_time, step_size)
        except (ValueError, PlantError) as error:
            self.log(str(error), Fmi2Status.error)
            return False
        return True

    def _advance(self, start: float, duration: float) -> None:
        if self._time is not None and abs(start - self._time) > TICK / 2.0:
            raise ValueError(
                f"step starts at {start} s, but the one before ended at {self._time} s"
            )
        for name, value in zip(self._inputs, self._commands, strict=True):
            if not math.isfinite(value):
                raise ValueError(f"{name} = {value}; allowed: a finite angle")
        self._time = start + duration
        if duration < TOO_SHORT or self._fell:
            return
        plant = self._made()
        hip, knee = self._commands.reshape(2, -1)
        parts = max(1, math.ceil(duration / TICK - 1e-6))
        self._shown = None
        for _ in range(parts):
            plant.advance(hip, knee, duration / parts)
            self._fell = plant.fell
            if self._fell:
                break

    def to_xml(self, model_options: dict[str, str] | None = None) -> Element:
        """The model description, with the units, limits and dependencies PythonFMU leaves out."""
        root: Element = super().to_xml(model_options or {})
        root.set("variableNamingConvention", self.NAMING)
        root.set("generationTool", ABOUT["generationTool"])
        del root.attrib["generationDateAndTime"]  # the same build is the same file
        units = Element("UnitDefinitions")
        for name in sorted({v.row.unit for v in self.vars.values()} - {None}):
            unit = SubElement(units, "Unit", name=name)
            SubElement(unit, "BaseUnit", UNITS[name])
        root.insert(1, units)
        _add_dependencies(root)
        return root


class _Quantity(Real):  # type: ignore[misc]
    """A Real with a unit and limits."""

    row: PlantVariable

    def to_xml(self) -> Element:
        element: Element = super().to_xml()
        typed = element[0]
        assert self.row.unit
        typed.set("unit", self.row.unit)
        for name, value in (("min", self.row.low), ("max", self.row.high)):
            if value is not None:
                typed.set(name, number(value))
        return element


_KINDS: Final = {"Real": _Quantity, "Integer": Integer, "Boolean": Boolean, "String": String}


def _add_dependencies(root: Element) -> None:
    """Outputs follow from the last step alone, and at the start from the parameters."""
    variables = root.find("ModelVariables")
    structure = root.find("ModelStructure")
    assert variables is not None and structure is not None
    parameters = [i for i, v in enumerate(variables, 1) if v.get("causality") == "parameter"]
    outputs = structure.find("Outputs")
    assert outputs is not None
    initial = SubElement(structure, "InitialUnknowns")
    for unknown in outputs:
        unknown.set("dependencies", "")
        dependencies = " ".join(map(str, parameters))
        SubElement(initial, "Unknown", index=unknown.get("index", ""), dependencies=dependencies)


def _conditions(chosen: dict[str, Any]) -> Conditions:
    named = named_conditions(chosen["condition"])
    return replace(named, payload=named.payload + chosen["payload"])


def _ground(chosen: dict[str, Any]) -> Surface:
    if chosen["roughness"] == 0.0:
        return Plane(slope=chosen["slope"])
    return Ground(slope=chosen["slope"], roughness=chosen["roughness"], seed=chosen["seed"])

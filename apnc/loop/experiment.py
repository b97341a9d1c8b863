"""An experiment: everything that a run depends on, as plain data."""

from __future__ import annotations

import hashlib
import json
import math
import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import field, fields
from functools import cached_property, lru_cache, partial
from pathlib import Path
from typing import Annotated, Any, Final

from pydantic import AfterValidator, WrapValidator

from apnc.controllers import OWN_CONTROLLER, named_controller
from apnc.loop.as_dict import to_dict
from apnc.loop.code import code_hash
from apnc.loop.engines import OWN_ENGINE, check_engine
from apnc.loop.of_robot import own_mi, own_rate
from apnc.loop.push import Push, pushes_text
from apnc.loop.schedule import Schedule, checked_schedule, schedule_text, steps_of
from apnc_core.enumerations import Method
from apnc_core.frozen import Frozen
from apnc_core.presets import PRESETS, preset_values
from apnc_core.settings import Setting, SettingLike
from apnc_core.settings import checked as checked_setting
from apnc_core.variables import variable_named
from apnc_plant.chance import LARGEST_SEED
from apnc_plant.conditions import (
    CONDITIONS,
    Conditions,
    checked_name,
    named_conditions,
    paper_conditions,
)
from apnc_plant.files import Number, checked, checked_table, limits
from apnc_plant.ground import Ground, Plane, from_dict
from apnc_plant.options import PlantOptions
from apnc_plant.robot import ROBOTS, RobotDescription, load_robot
from apnc_plant.robot.model import OF_THE_RUN
from apnc_plant.step import checked_step, own_step

OWN_PRESET: Final = "robot"
"""The preset that takes the table's defaults and what the robot's file sets of them."""

SET_ELSEWHERE: Final = {"Ts": "rate", "method": "controller"}
"""Parameters that are no settings, and the field that each comes from."""


def _over_time(check: Callable[[Any], Any]) -> WrapValidator:
    """Validator of a schedule; ``check`` gives each value its type, or refuses it."""
    return WrapValidator(lambda value, _: checked_schedule(value, check))


def _in_range(variable: str) -> Callable[[Any], float]:
    limits = variable_named(variable)
    low, high = limits.min, limits.max
    assert low is not None and high is not None

    def check(value: Any) -> float:
        if isinstance(value, bool) or not isinstance(value, int | float):
            raise ValueError(f"{value!r} is not a number")
        if not low <= value <= high:
            raise ValueError(f"{value} is not in {low:g} ... {high:g}")
        return float(value)

    return check


def _boolean(value: Any) -> bool:
    if not isinstance(value, bool):
        raise ValueError(f"{value!r} is not true or false")
    return value


def _conditions(value: Any) -> str | Conditions:
    if isinstance(value, str):
        return checked_name(value)
    if isinstance(value, Mapping):
        return checked_table(Conditions, value)
    if not isinstance(value, Conditions):
        raise ValueError(f"{value!r} is not a name or conditions")
    return value


def _robot(value: Any, _: Any) -> str | RobotDescription:
    if isinstance(value, Mapping):
        return RobotDescription(**value)
    if not isinstance(value, str | RobotDescription):
        raise ValueError(f"{value!r} is not a name, a file or a description")
    return value


def _ground(value: Any, _: Any) -> Ground:
    if isinstance(value, Mapping):
        return from_dict(value)
    if not isinstance(value, Ground):
        raise ValueError(f"{value!r} is not a ground")
    return value


def _if_given(value: Any, check: Callable[[Any], Any]) -> Any:
    return None if value is None else check(value)


def _settings(values: Mapping[str, Any]) -> Frozen[Setting]:
    for name in SET_ELSEWHERE:
        if name in values:
            raise ValueError(
                f"{name} = {values[name]} is not set here, but by {SET_ELSEWHERE[name]}"
            )
    return Frozen({name: checked_setting(name, value) for name, value in values.items()})


Seed = Annotated[
    int, limits(allowed="a whole number from 0 to 2^64 - 1", strict=True, ge=0, le=LARGEST_SEED)
]
Settings = Annotated[Mapping[str, Any], AfterValidator(_settings)]


@checked(ValueError)
class Experiment:
    """Everything that a run depends on. It is checked when it is made and cannot change.

    Args:
        robot: name of a shipped robot, its file, or a description.
        mi: modulatory input [1], one value or steps over time ``((start [s], value), ...)``; the
            robot's own if omitted, else 0.08, clipped into the robot's ``mi_range``.
        duration: simulated time [s], rounded to whole ticks.
        seed: seed of the robot's asymmetry and the sensor noise.
        controller: label of a method of the FMU with its settings, see ``apnc.controllers``.
            ``apnc`` if omitted; None of an FMU of one's own that keeps its method and settings.
        preset: ``robot`` (the defaults and what the robot's file sets), ``lilibot`` (the defaults)
            or ``paper`` (as printed).
        settings: parameters that differ from those of the preset and the controller, by name.
        ground: the ground.
        conditions: payload, damage and broken sensors: a name of the paper or ``Conditions``; one
            value or steps. Legs may be named by place or as on other robots.
        turn: steering [1], positive turns left; one value or steps.
        reset: whether the controller is held in its start state; one value or steps.
        rate: update rate of the controller [Hz]; if omitted, the FMU's own, else the robot's, else
            60.
        step: longest integration step of the plant [s]; the robot's own if omitted, see
            ``apnc_plant.step``.
        engine: what integrates the equations of motion, ``exudyn``, ``mujoco`` or ``compiled``.
        fmu: file of the controller; the built one if omitted. Its own start values, those that are
            not the defaults, hold unless ``rate``, ``controller``, ``settings`` or a preset other
            than ``robot`` say otherwise; they go before what the robot's file sets.
        pushes: impulses from outside while it walks.

    Numbers and arrays of numpy become numbers and tuples, and paths become texts.

    Pitfall: ``dataclasses.replace(experiment, fmu=...)`` keeps the rate and the controller of the
    experiment; with ``rate=None, controller=None`` besides, those of the FMU hold. In the same way
    ``replace(experiment, robot=..., rate=None, mi=None, step=None)`` takes those of the new robot.

    Raises:
        ValueError: a value outside what is allowed, or names that the robot does not have.
    """

    robot: Annotated[str | RobotDescription, WrapValidator(_robot)] = "lilibot"
    mi: Annotated[Schedule[float], _over_time(_in_range("MI")), WrapValidator(_if_given)] = None  # type: ignore[assignment]  # as rate
    duration: Number = 45.0
    seed: Seed = 0
    controller: str | None = None
    preset: str = OWN_PRESET
    settings: Settings = field(default_factory=partial(Frozen, {}))
    ground: Annotated[Ground, WrapValidator(_ground)] = field(default_factory=Plane)
    conditions: Annotated[Schedule[str | Conditions], _over_time(_conditions)] = "C1"
    turn: Annotated[Schedule[float], _over_time(_in_range("turn"))] = 0.0
    reset: Annotated[Schedule[bool], _over_time(_boolean)] = False
    rate: Annotated[Number, WrapValidator(_if_given)] = None  # type: ignore[assignment]  # a number once it is made
    step: Annotated[Number, WrapValidator(_if_given)] = None  # type: ignore[assignment]  # as rate
    engine: str = OWN_ENGINE
    fmu: Annotated[str, limits(allowed="the path of a file")] | None = None
    pushes: tuple[Push, ...] = ()

    def __post_init__(self) -> None:
        """Check everything before anything runs."""
        for name, value in self._omitted().items():
            if getattr(self, name) is None:
                object.__setattr__(self, name, value)
        robot = self.description
        present = [conditions_of(value, robot) for _, value in steps_of(self.conditions)]
        if len(loads := {each.payload for each in present}) > 1:
            raise ValueError(f"payload changes during the run: {sorted(loads)} kg; allowed: one")
        if self.controller is not None:
            named_controller(self.controller)
        self._check_times()
        check_engine(self.engine)
        PlantOptions(step=self.step)
        object.__setattr__(self, "step", checked_step(self.step, self.description))
        self.parameters()

    def _omitted(self) -> dict[str, Any]:
        """Defaults that depend on the robot and on an FMU of one's own."""
        Ts: Any = self.fmu_starts.get("Ts")
        return {
            "rate": own_rate(self.description, Ts),
            "mi": own_mi(self.description),
            "controller": OWN_CONTROLLER if self.fmu is None else None,
        }

    def _check_times(self) -> None:
        limits = variable_named("Ts")
        assert limits.min is not None and limits.max is not None
        if not (self.rate > 0.0 and limits.min <= 1.0 / self.rate <= limits.max):
            allowed = f"{1.0 / limits.max:g} ... {1.0 / limits.min:g} Hz"
            raise ValueError(f"rate = {self.rate} Hz is not in {allowed}")
        if not (math.isfinite(self.duration * self.rate) and self.duration > 0.0):
            raise ValueError(f"duration = {self.duration} s is not a positive time")
        if self.ticks < 1:
            raise ValueError(
                f"duration = {self.duration} s is not one tick; allowed: {self.Ts:.4g} s and more"
            )

    @property
    def Ts(self) -> float:  # noqa: N802  # the paper's symbol
        """Time of one tick [s]."""
        return 1.0 / self.rate

    @property
    def ticks(self) -> int:
        """Number of ticks of the whole run."""
        return round(self.duration / self.Ts)

    @cached_property
    def description(self) -> RobotDescription:
        """The robot that walks."""
        if isinstance(self.robot, RobotDescription):
            return self.robot
        return _shipped(self.robot) if Path(self.robot).suffix == "" else load_robot(self.robot)

    @cached_property
    def fmu_starts(self) -> Mapping[str, SettingLike]:
        """Own start values of ``fmu``: parameters by name that are not at their default in it.

        Raises:
            ValueError: no FMU of the controller, or one for another number of legs.
        """
        if self.fmu is None:
            return {}
        from apnc.loop.fmu_controller import own_starts  # noqa: PLC0415  # takes long to import

        n_legs, values = own_starts(self.fmu)
        robot = self.description
        if n_legs != len(robot.legs):
            raise ValueError(
                f"{self.fmu} is for {n_legs} legs; robot '{robot.name}' has {len(robot.legs)}"
            )
        return values

    @property
    def controller_name(self) -> str:
        """Label of the controller; of an FMU that keeps its own, the name of its method."""
        if self.controller is not None:
            return self.controller
        method: Any = self.parameters()["method"]
        return Method(method).name

    def parameters(self) -> dict[str, SettingLike]:
        """Every parameter of the controller by name, as it is set.

        What comes first holds: ``settings``, those of the controller, a preset that is named, own
        start values of the FMU, what the robot's file sets, and the weight of the robot, the
        defaults. ``Ts`` and ``method`` are set by the fields ``rate`` and ``controller``, and a
        preset sets nothing that belongs to the run.
        """
        own, of_fmu = {}, dict(self.fmu_starts)
        if self.preset == OWN_PRESET:
            chosen, own = "lilibot", dict(self.description.controller)
        elif self.preset in PRESETS:
            chosen = self.preset
            of_fmu = {name: value for name, value in of_fmu.items() if name in OF_THE_RUN}
        else:
            allowed = ", ".join((OWN_PRESET, *PRESETS))
            raise ValueError(f"preset '{self.preset}' is not one of {allowed}")
        values: dict[str, SettingLike] = dict(preset_values(chosen))
        values |= {"robot_weight": self.description.weight, **own, **of_fmu}
        values["Ts"] = self.Ts
        if self.controller is not None:
            used = named_controller(self.controller)
            values |= {"method": Method[used.method], **used.settings}
        values |= self.settings
        relations, legs = values["phi_stored"], len(self.description.legs)
        assert isinstance(relations, Sequence)
        if len(relations) not in (0, legs - 1):
            raise ValueError(
                f"phi_stored has {len(relations)} values; {legs} legs take {legs - 1} or none"
            )
        return values

    def starts(self) -> dict[str, SettingLike]:
        """Parameters to set in the FMU. Relations of 0 are set only where the FMU has others."""
        values = self.parameters()
        if not values["phi_stored"]:
            values["phi_stored"] = (0.0,) * (len(self.description.legs) - 1)
            if "phi_stored" not in self.fmu_starts:
                del values["phi_stored"]
        return values

    def changed(self) -> dict[str, Any]:
        """Fields by name that differ from the default.

        The values of an FMU, and rate, MI and step of the robot are defaults.
        """
        default = {f.name: getattr(_default(), f.name) for f in fields(self)} | self._omitted()
        default["step"] = own_step(self.description)
        own = {name: getattr(self, name) for name in default}
        return {name: value for name, value in own.items() if value != default[name]}

    def to_dict(self) -> dict[str, Any]:
        """Every field as plain data for JSON. A robot given by name stays a name."""
        values: dict[str, Any] = to_dict(self)
        return values | {"ground": self.ground.to_dict()}

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Experiment:
        """The experiment of data that :meth:`to_dict` has made, also after a way through JSON.

        Raises:
            ValueError: the data lack a field or hold a value that is not allowed.
        """
        if not isinstance(data, Mapping):
            raise ValueError(f"not an experiment: a {type(data).__name__} in place of a table")
        if missing := [f.name for f in fields(cls) if f.name not in data]:
            raise ValueError(f"not an experiment: {missing[0]} is missing")
        try:
            return checked_table(cls, data)
        except ValueError as error:
            raise ValueError(f"not an experiment: {error}") from None

    def key(self) -> str:
        """Hash of everything that a run depends on, also the robot and the code; 16 hex digits."""
        told = {"preset", "settings", "controller"}  # they are in the parameters
        content = {
            **{f.name: getattr(self, f.name) for f in fields(self) if f.name not in told},
            "robot": _hash_of(self.description),
            "ground": self.ground.to_dict(),
            "parameters": self.parameters(),
            "conditions": [
                (t, conditions_of(c, self.description)) for t, c in steps_of(self.conditions)
            ],
            "fmu": self.fmu and hashlib.sha256(Path(self.fmu).read_bytes()).hexdigest(),
            "code": code_hash(),
        }
        return _digest(content)[:16]

    def command(self) -> str:
        """The command line that runs the experiment again.

        A robot or conditions given as an object have no option. Then it is a comment that says so.
        """
        if objects := self._objects():
            return f"# from Python only: {' and '.join(objects)} given as an object"
        words = ["apnc", "walk"]
        for name, value in self.changed().items():
            if name == "settings":
                words += [
                    f"--set={key}={_setting_text(key, entry)}" for key, entry in value.items()
                ]
            elif name == "ground":
                words += ["--ground", value.text()]
            elif name == "robot":
                words += ["--robot", value if isinstance(value, str) else value.name]
            elif name == "pushes":
                words += ["--push", pushes_text(value)]
            elif name == "conditions":
                words += ["--condition", schedule_text(value, self._name_of)]
            else:
                words += [f"--{name}", schedule_text(value)]
        return shlex.join(words)

    def _objects(self) -> list[str]:
        """Objects that were given and that equal nothing with a name."""
        found = []
        robot = self.robot
        if isinstance(robot, RobotDescription):
            shipped = (ROBOTS / f"{robot.name}.toml").is_file()
            if not shipped or _shipped(robot.name) != robot:
                found.append(f"robot '{robot.name}'")
        values = [value for _, value in steps_of(self.conditions)]
        if any(self._name_of(value) not in CONDITIONS for value in values):
            found.append("conditions")
        return found

    def _name_of(self, value: str | Conditions) -> str:
        """Name of the conditions of the paper that a value is; else the value as text."""
        if isinstance(value, str):
            return value
        own = conditions_of(value, self.description)
        paper = paper_conditions(self.description).items()
        named = (name for name, each in paper if each == own)
        return next(named, str(value))


def conditions_of(value: str | Conditions, robot: RobotDescription) -> Conditions:
    """The conditions of a robot that a value of ``Experiment.conditions`` stands for."""
    if isinstance(value, Conditions):
        return value.of_legs(robot.leg_names)
    return named_conditions(value, robot)


def _digest(value: Any) -> str:
    return hashlib.sha256(json.dumps(to_dict(value), sort_keys=True).encode()).hexdigest()


@lru_cache
def _hash_of(robot: RobotDescription) -> str:
    """Cached, since writing a description down takes longer than all the rest."""
    return _digest(robot)


@lru_cache
def _shipped(name: str) -> RobotDescription:
    return load_robot(name)


def _setting_text(name: str, value: Any) -> str:
    enumeration = variable_named(name).enumeration
    if enumeration:
        return enumeration.items(value).name
    return json.dumps(to_dict(value))


@lru_cache
def _default() -> Experiment:
    return Experiment()

"""An experiment as plain data: everything that a run depends on."""

from __future__ import annotations

import hashlib
import json
import math
import shlex
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from functools import cached_property, lru_cache
from pathlib import Path
from typing import Any, Final

from apnc.controllers import OWN_CONTROLLER, named_controller
from apnc.loop.code import code_hash
from apnc.loop.engines import OWN_ENGINE, check_engine
from apnc.loop.plain import made, plain
from apnc.loop.steps import Over, check_steps, mapped, steps_of, steps_text
from apnc_core.enumerations import Method
from apnc_core.frozen import Frozen
from apnc_core.in_python import in_python
from apnc_core.presets import PRESETS, preset
from apnc_core.schema import Causality
from apnc_core.settings import SettingLike, checked
from apnc_core.variables import variable_named, variables_of
from apnc_plant.chance import LARGEST_SEED
from apnc_plant.conditions import CONDITIONS, Conditions, named_conditions
from apnc_plant.ground import Ground, Plane, from_dict
from apnc_plant.options import PlantOptions
from apnc_plant.robot import ROBOTS, RobotDescription, load_robot
from apnc_plant.robot.model import OF_THE_RUN

OWN_PRESET: Final = "robot"
"""The preset that takes the table's defaults and what the robot's file sets of them."""

_OVER_TIME: Final[Mapping[str, Callable[[Any], Any]]] = {
    "mi": float,
    "turn": float,
    "reset": bool,
    "conditions": lambda value: value,
}
"""Fields that hold one value or steps over time, and what gives each value its type."""

SET_ELSEWHERE: Final = {"Ts": "rate", "method": "controller"}
"""Parameters that are no settings, and the field that each comes from."""

_NUMBERS: Final = ("duration", "rate", "step")
"""Fields that hold a number."""


@dataclass(frozen=True)
class Experiment:
    """What is run. Frozen plain data, checked when it is made.

    Args:
        robot: name of a shipped robot, its file, or a description.
        mi: modulatory input [1], one value or steps over time ``((start [s], value), ...)``.
        duration: simulated time [s], rounded to whole ticks.
        seed: of the robot's asymmetry and the sensor noise.
        controller: label of a method of the FMU with its settings, see ``apnc.controllers``.
            ``apnc`` if omitted; None of an FMU of one's own that keeps its method and settings.
        preset: ``robot`` (the defaults and what the robot's file sets), ``lilibot`` (the defaults)
            or ``paper`` (as printed).
        settings: parameters that differ from those of the preset and the controller, by name.
        ground: what it walks on.
        conditions: payload, damage and the like: a name of the paper, ``Conditions``, or steps.
        turn: steering [1], positive turns left; one value or steps.
        reset: holds the controller in its start state; one value or steps.
        rate: update rate of the controller [Hz]; 60 or the FMU's own if omitted.
        step: longest integration step of the plant [s].
        engine: what integrates the equations of motion, ``exudyn``, ``mujoco`` or ``compiled``.
        fmu: file of the controller; the built one if omitted. Its own start values, those that are
            not the defaults, hold unless ``rate``, ``controller``, ``settings`` or a preset other
            than ``robot`` say otherwise; they go before what the robot's file sets.

    Numbers and arrays of numpy and paths become what Python has for them.

    Raises:
        ValueError: a value outside what is allowed, or names that the robot does not have.
    """

    robot: str | RobotDescription = "lilibot"
    mi: Over[float] = 0.08
    duration: float = 45.0
    seed: int = 0
    controller: str | None = None
    preset: str = OWN_PRESET
    settings: Mapping[str, SettingLike] = field(default_factory=dict)
    ground: Ground = field(default_factory=Plane)
    conditions: Over[str | Conditions] = "C1"
    turn: Over[float] = 0.0
    reset: Over[bool] = False
    rate: float = None  # type: ignore[assignment]  # a number once it is made
    step: float = PlantOptions().step
    engine: str = OWN_ENGINE
    fmu: str | None = None

    def __post_init__(self) -> None:
        """Check everything before anything runs."""
        self._put({f.name: in_python(getattr(self, f.name)) for f in fields(self)})
        self._check_kinds()
        omitted = {n: value for n, value in self._of_fmu().items() if getattr(self, n) is None}
        self._put(omitted)
        check_steps("mi", self.mi, lambda name, value: _in_range("MI", value, name))
        check_steps("turn", self.turn, lambda name, value: _in_range("turn", value, name))
        check_steps("reset", self.reset, _boolean)
        check_steps("conditions", self.conditions, self._known_conditions)
        loads = {conditions_of(value).payload for _, value in steps_of(self.conditions)}
        if len(loads) > 1:
            raise ValueError(f"payload changes during the run: {sorted(loads)} kg; allowed: one")
        if self.controller is not None:
            named_controller(self.controller)
        self._check_times()
        check_engine(self.engine)
        PlantOptions(step=self.step)
        self.parameters()
        # equal experiments are equal however their numbers came, and nothing in them can change
        own = {name: checked(name, value) for name, value in self.settings.items()}
        self._put({name: float(getattr(self, name)) for name in _NUMBERS})
        self._put({name: mapped(getattr(self, name), kind) for name, kind in _OVER_TIME.items()})
        self._put({"settings": Frozen(own)})

    def _put(self, values: Mapping[str, Any]) -> None:
        for name, value in values.items():
            object.__setattr__(self, name, value)

    def _check_kinds(self) -> None:
        """Refuse what is of another kind than its field."""
        if not isinstance(self.robot, str | RobotDescription):
            raise ValueError(f"robot = {self.robot!r} is not a name, a file or a description")
        if not isinstance(self.fmu, str | None):
            raise ValueError(f"fmu = {self.fmu!r} is not a file")
        if not isinstance(self.settings, Mapping):
            raise ValueError(f"settings = {self.settings!r} are not values by name")
        if not isinstance(self.ground, Ground):
            raise ValueError(f"ground = {self.ground!r} is not a ground")
        whole = isinstance(self.seed, int) and not isinstance(self.seed, bool)
        if not whole or not 0 <= self.seed <= LARGEST_SEED:
            raise ValueError(f"seed = {self.seed} is not a whole number from 0 to 2^64 - 1")

    def _of_fmu(self) -> dict[str, Any]:
        """Fields that the FMU says itself, or else the defaults."""
        Ts: Any = self.fmu_starts.get("Ts", variable_named("Ts").start)
        return {"rate": 1.0 / Ts, "controller": OWN_CONTROLLER if self.fmu is None else None}

    def _check_times(self) -> None:
        for name in _NUMBERS:
            _number(name, getattr(self, name))
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

    def _known_conditions(self, _: str, value: Any) -> None:
        conditions_of(value).check_legs(tuple(leg.name for leg in self.description.legs))

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
        known = [v.name for v in variables_of(Causality.parameter)]
        own, of_fmu = {}, dict(self.fmu_starts)
        if self.preset == OWN_PRESET:
            chosen, own = preset("lilibot"), dict(self.description.controller)
        elif self.preset in PRESETS:
            chosen = preset(self.preset)
            of_fmu = {name: value for name, value in of_fmu.items() if name in OF_THE_RUN}
        else:
            allowed = ", ".join((OWN_PRESET, *PRESETS))
            raise ValueError(f"preset '{self.preset}' is not one of {allowed}")
        values: dict[str, SettingLike] = {name: getattr(chosen, name) for name in known}
        values |= {"robot_weight": self.description.weight, **own, **of_fmu}
        values["Ts"] = self.Ts
        if self.controller is not None:
            used = named_controller(self.controller)
            values |= {"method": Method[used.method], **used.settings}
        for name, value in self.settings.items():
            if name in SET_ELSEWHERE:
                raise ValueError(f"{name} = {value} is not set here, but by {SET_ELSEWHERE[name]}")
            values[name] = checked(name, value)
        relations, legs = values["phi_stored"], len(self.description.legs)
        assert isinstance(relations, Sequence)
        if len(relations) not in (0, legs - 1):
            raise ValueError(
                f"phi_stored has {len(relations)} values; {legs} legs take {legs - 1} or none"
            )
        return values

    def starts(self) -> dict[str, SettingLike]:
        """What the controller is set to: relations that are 0 only if it starts with others."""
        values = self.parameters()
        if not values["phi_stored"]:
            values["phi_stored"] = (0.0,) * (len(self.description.legs) - 1)
            if "phi_stored" not in self.fmu_starts:
                del values["phi_stored"]
        return values

    def changed(self) -> dict[str, Any]:
        """Fields that are not the default, by name; of an FMU its own values are the default."""
        default = {f.name: getattr(_default(), f.name) for f in fields(self)} | self._of_fmu()
        own = {name: getattr(self, name) for name in default}
        return {name: value for name, value in own.items() if value != default[name]}

    def to_dict(self) -> dict[str, Any]:
        """Every field as plain data for JSON, the robot by its name unless it is an object."""
        values: dict[str, Any] = plain(self)
        return values | {"ground": self.ground.to_dict()}

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> Experiment:
        """The experiment that :meth:`to_dict` gave, also after a way through JSON.

        Raises:
            ValueError: not such data.
        """
        if not isinstance(data, Mapping):
            raise ValueError(f"not an experiment: a {type(data).__name__} in place of a table")
        values = dict(data)
        try:
            values["robot"] = made(RobotDescription, values["robot"])
            values["ground"] = from_dict(values["ground"])
            for name in _OVER_TIME:
                values[name] = mapped(values[name], lambda value: made(Conditions, value))
            return cls(**values)
        except KeyError as error:
            raise ValueError(f"not an experiment: it has no {error}") from None
        except (AttributeError, TypeError) as error:  # a text or a list in place of a table
            raise ValueError(f"not an experiment: {error}") from None

    def key(self) -> str:
        """Hash of all that a run depends on: robot, parameters, code; 16 hex digits."""
        told = {"preset", "settings", "controller"}  # by the parameters
        content = {
            **{f.name: getattr(self, f.name) for f in fields(self) if f.name not in told},
            "robot": _hash_of(self.description),
            "ground": self.ground.to_dict(),
            "parameters": self.parameters(),
            "conditions": [(t, conditions_of(c)) for t, c in steps_of(self.conditions)],
            "fmu": self.fmu and hashlib.sha256(Path(self.fmu).read_bytes()).hexdigest(),
            "code": code_hash(),
        }
        return _digest(content)[:16]

    def command(self) -> str:
        """The command line that runs it again.

        A robot or conditions that are an object have no words there; then a comment says so.
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
            elif name == "conditions":
                words += ["--condition", steps_text(value, _name_of)]
            else:
                words += [f"--{name}", steps_text(value)]
        return shlex.join(words)

    def _objects(self) -> list[str]:
        """What was given as an object and equals nothing that has a name."""
        found = []
        robot = self.robot
        if isinstance(robot, RobotDescription):
            shipped = (ROBOTS / f"{robot.name}.toml").is_file()
            if not shipped or _shipped(robot.name) != robot:
                found.append(f"robot '{robot.name}'")
        values = [value for _, value in steps_of(self.conditions)]
        if any(_name_of(value) not in CONDITIONS for value in values):
            found.append("conditions")
        return found


def conditions_of(value: str | Conditions) -> Conditions:
    """The conditions that a value of ``Experiment.conditions`` means."""
    if isinstance(value, Conditions):
        return value
    return named_conditions(value)


def _name_of(value: str | Conditions) -> str:
    named = (name for name, each in CONDITIONS.items() if value in (name, each))
    return next(named, str(value))


def _digest(value: Any) -> str:
    return hashlib.sha256(json.dumps(plain(value), sort_keys=True).encode()).hexdigest()


@lru_cache
def _hash_of(robot: RobotDescription) -> str:
    """Asked once per robot: a description takes longer to write down than all the rest."""
    return _digest(robot)


@lru_cache
def _shipped(name: str) -> RobotDescription:
    return load_robot(name)


def _number(name: str, value: Any) -> None:
    if isinstance(value, bool) or not isinstance(value, int | float):
        raise ValueError(f"{name} = {value!r} is not a number")


def _in_range(variable: str, value: Any, name: str) -> None:
    limits = variable_named(variable)
    assert limits.min is not None and limits.max is not None
    _number(name, value)
    if not limits.min <= value <= limits.max:
        raise ValueError(f"{name} = {value} is not in {limits.min:g} ... {limits.max:g}")


def _boolean(name: str, value: Any) -> None:
    if not isinstance(value, bool):
        raise ValueError(f"{name} = {value} is not true or false")


def _setting_text(name: str, value: Any) -> str:
    enumeration = variable_named(name).enumeration
    if enumeration:
        return enumeration.items(value).name
    return json.dumps(plain(value))


@lru_cache
def _default() -> Experiment:
    return Experiment()

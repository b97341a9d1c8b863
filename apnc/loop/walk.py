"""One closed-loop walk: robot, controller, record, summary and report."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from apnc.loop.fmu_controller import FmuController, Setting
from apnc.loop.master import Commands, Progress, run
from apnc.loop.recording import Record, write_csv
from apnc.report import write_report
from apnc.summary import Summary, summarise
from apnc_core.enumerations import Method
from apnc_core.interface import Parameters
from apnc_core.presets import preset
from apnc_core.schema import Causality
from apnc_core.variables import row, rows
from exudyn_models.conditions import named_conditions
from exudyn_models.physics.plant import Plant, PlantOptions
from exudyn_models.robot.file import load_robot
from exudyn_models.robot.model import RobotDescription


@dataclass(frozen=True)
class WalkOptions:
    """What to walk.

    Args:
        mi: modulatory input, constant over the run [1].
        duration: simulated time [s].
        method: name of the controller, see ``Method``.
        seed: of the sensor noise and of the robot's asymmetry.
        preset: name of the set of parameters.
        settings: parameters that differ from the preset, by name.
        robot: name or file of the robot.
        contact: contact law of the feet, see ``PlantOptions``.
        condition: name of the paper's condition the robot is in, see ``CONDITIONS``.

    Raises:
        ValueError: a value outside what is allowed.
    """

    mi: float = 0.08
    duration: float = 45.0
    method: str = "apnc"
    seed: int = 0
    preset: str = "lilibot"
    settings: Mapping[str, Setting] = field(default_factory=dict)
    robot: str = "lilibot"
    condition: str = "C1"
    contact: str = "compiled"

    def __post_init__(self) -> None:
        """Check the values."""
        MI = row("MI")
        assert MI.min is not None and MI.max is not None
        if not MI.min <= self.mi <= MI.max:
            raise ValueError(f"mi = {self.mi} is not in {MI.min:g} ... {MI.max:g}")
        if not 0.0 < self.duration < float("inf"):
            raise ValueError(f"duration = {self.duration} s is not a positive time")
        if self.method not in Method.__members__:
            allowed = ", ".join(Method.__members__)
            raise ValueError(f"method '{self.method}' is not one of {allowed}")
        if self.seed < 0:
            raise ValueError(f"seed = {self.seed} is negative")
        named_conditions(self.condition)
        PlantOptions(contact=self.contact)
        self.parameters()

    def parameters(self) -> dict[str, Setting]:
        """Parameters of the FMU by name: preset, then method, then settings."""
        chosen: Parameters = preset(self.preset)
        values: dict[str, Setting] = {
            v.name: getattr(chosen, v.name) for v in rows(Causality.parameter)
        }
        del values["phi_stored"], values["robot_weight"]
        values["method"] = int(Method[self.method])
        for name in self.settings:
            if name not in values and name not in ("phi_stored", "robot_weight"):
                raise ValueError(f"parameter '{name}' is not one of {', '.join(values)}")
        return values | dict(self.settings)


def walk(
    options: WalkOptions,
    fmu: Path,
    progress: Progress = lambda t, controller: None,
    stop: Callable[[], bool] = lambda: False,
    robot: RobotDescription | None = None,
) -> Record:
    """Walk the robot under the FMU.

    Args:
        options: what to walk.
        fmu: the controller FMU.
        progress: called after every tick.
        stop: asked before every tick; True ends the run.
        robot: what walks; the one that ``options.robot`` names if omitted.

    Raises:
        ValueError: the FMU or the robot cannot be used, or they do not fit together.
    """
    robot = robot or load_robot(options.robot)
    parameters = {"robot_weight": robot.weight} | options.parameters()
    with FmuController(fmu, parameters) as controller:
        if controller.n_legs != len(robot.legs):
            raise ValueError(
                f"{fmu} is for {controller.n_legs} legs; robot '{robot.name}' has {len(robot.legs)}"
            )
        Ts = parameters["Ts"]
        assert isinstance(Ts, float)
        commands = Commands(MI=options.mi)
        plant = Plant(
            robot,
            options.seed,
            options=PlantOptions(contact=options.contact),
            conditions=named_conditions(options.condition),
        )
        return run(plant, controller, options.duration, Ts, lambda t: commands, progress, stop)


def save(record: Record, options: WalkOptions, folder: Path) -> Summary:
    """Write ``summary.json``, ``record.csv`` and ``report.html`` into an existing folder.

    Raises:
        OSError: a file cannot be written.
    """
    summary = summarise(record, method=options.method, mi=options.mi, seed=options.seed)
    (folder / "summary.json").write_text(summary.to_json(), encoding="utf-8")
    write_csv(record, folder / "record.csv")
    write_report(record, summary, folder / "report.html", load_robot(options.robot))
    return summary


def parse_setting(text: str) -> tuple[str, Setting]:
    """``"xi=0.02"`` -> ``("xi", 0.02)``; enumerations by item name, Booleans true or false.

    Raises:
        ValueError: no such parameter, or a value of the wrong type.
    """
    name, _, value = text.partition("=")
    name = name.strip()
    known = [v.name for v in rows(Causality.parameter)]
    if name not in known:
        raise ValueError(f"parameter '{name}' is not one of {', '.join(known)}")
    enumeration = row(name).enumeration
    if enumeration:
        if value not in enumeration.items.__members__:
            allowed = ", ".join(enumeration.items.__members__)
            raise ValueError(f"{name} = '{value}' is not one of {allowed}")
        return name, int(enumeration.items[value])
    try:
        parsed = json.loads(value)
    except json.JSONDecodeError:
        raise ValueError(f"{name} = '{value}' is not a number, true, false or a list") from None
    return name, parsed

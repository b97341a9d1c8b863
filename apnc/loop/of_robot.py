"""What a run takes from the robot where nothing else is asked for: update rate and MI."""

from __future__ import annotations

import logging
from collections.abc import Iterable
from functools import cache
from typing import TYPE_CHECKING, Any, Final

from apnc.loop.schedule import steps_of
from apnc_core.variables import variable_named
from apnc_plant.robot import RobotDescription

if TYPE_CHECKING:
    from apnc.loop.experiment import Experiment

LOG: Final = logging.getLogger("apnc")


def own_rate(robot: RobotDescription, Ts: float | None = None) -> float:
    """Update rate of a run that asks for none [Hz].

    Args:
        robot: the robot.
        Ts: own time of a tick of the controller's FMU [s], if it is not the default.
    """
    if Ts is None:
        return 1.0 / _default("Ts") if robot.rate is None else robot.rate
    if robot.rate is not None and Ts == 1.0 / robot.rate:  # without the rounding of 1 / Ts
        return robot.rate
    return 1.0 / Ts


def own_mi(robot: RobotDescription) -> float:
    """MI of a run that asks for none: the robot's, or the default, clipped into its range."""
    if robot.mi is not None:
        return robot.mi
    low, high = robot.mi_range or (0.0, 1.0)
    return min(max(_default("MI"), low), high)


def source_of_rate(experiment: Experiment) -> str:
    """Where the update rate of an experiment comes from, in words."""
    robot = experiment.description
    if "Ts" in experiment.fmu_starts and experiment.rate == own_rate(
        robot, _number(experiment.fmu_starts["Ts"])
    ):
        return "that of the FMU"
    return _source(experiment.rate, robot.rate, own_rate(robot))


def source_of_mi(experiment: Experiment) -> str:
    """Where the MI of an experiment comes from, in words."""
    robot = experiment.description
    own = robot.mi_range and own_mi(robot)
    return _source(experiment.mi, own if robot.mi is None else robot.mi, own_mi(robot))


def _source(value: Any, of_robot: float | None, default: float) -> str:
    if of_robot is not None and value == of_robot:
        return "from the robot's file"
    return "the default" if value == default else "as asked for"


def outside(experiments: Iterable[Experiment]) -> str | None:
    """A line on MI outside the range in which the gait of a robot was found; None if there is none.

    MI 0, which stands still, is not counted.
    """
    found: dict[RobotDescription, set[float]] = {}
    for experiment in experiments:
        robot = experiment.description
        if robot.mi_range is not None:
            low, high = robot.mi_range
            values = {mi for _, mi in steps_of(experiment.mi) if mi and not low <= mi <= high}
            if values:
                found.setdefault(robot, set()).update(values)
    parts = []
    for robot, values in found.items():
        assert robot.mi_range is not None
        low, high = robot.mi_range
        listed = ", ".join(f"{mi:.6g}" for mi in sorted(values))
        parts.append(f"MI {listed}: the gait of robot '{robot.name}' is for {low:g} ... {high:g}")
    return "; ".join(parts) or None


def warn_of_mi(experiments: Iterable[Experiment]) -> None:
    """Warn in one line of MI outside the range of a robot; the same line is not said twice."""
    if text := outside(experiments):
        _say(text)


@cache
def _say(text: str) -> None:
    LOG.warning(text)


def _default(name: str) -> float:
    return _number(variable_named(name).start)


def _number(value: Any) -> float:
    assert isinstance(value, float)
    return value

"""Parameters of the controller from a file."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic import BaseModel

from apnc.controllers import CONTROLLERS
from apnc_core.settings import checked
from apnc_plant.files import checked_table, read_table
from build_fmu.ssv import read_ssv


class _Experiment(BaseModel):
    """What is read of the experiment in a ``summary.json``."""

    controller: str | None = None
    settings: dict[str, Any] = {}


class _Summary(BaseModel):
    """What is read of a ``summary.json``."""

    parameters: dict[str, Any]
    experiment: _Experiment = _Experiment()


def read_parameters(path: Path, controller: str | None = None) -> dict[str, Any]:
    """Parameters by name, checked.

    Args:
        path: SSV file; TOML or JSON with values by name; or the ``summary.json`` of a walk, of
            which ``robot_weight`` counts only if it was set: else it belongs to the robot.
        controller: label of the controller that walks in place of that of a ``summary.json``. Then
            what either of the two sets counts only if it was set in that walk.

    Raises:
        ValueError: no such file, none of these, or a parameter that does not exist or fit.
    """
    if path.suffix == ".ssv":
        return dict(read_ssv(path))
    try:
        table: Mapping[str, Any] = read_table(path)
        if "parameters" in table:
            table = _of_walk(checked_table(_Summary, table), controller)
        return {name: checked(name, value) for name, value in table.items()}
    except ValueError as error:
        raise ValueError(f"parameter file {path}: {error}") from None


def _of_walk(walk: _Summary, controller: str | None) -> dict[str, Any]:
    """Parameters of a walk without what belonged to its robot, or to another controller."""
    others = {"robot_weight"}
    if controller is not None:
        for label in CONTROLLERS.keys() & {controller, walk.experiment.controller}:
            others |= CONTROLLERS[label].settings.keys()
    left_out = others - walk.experiment.settings.keys()
    return {name: value for name, value in walk.parameters.items() if name not in left_out}

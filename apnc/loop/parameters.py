"""Parameters of the controller from a file."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

from apnc.controllers import CONTROLLERS
from apnc_core.settings import checked
from build_fmu.ssv import read_ssv


def read_parameters(path: Path, controller: str | None = None) -> dict[str, Any]:
    """Parameters by name, checked.

    Args:
        path: SSV file; TOML or JSON with values by name; or the ``summary.json`` of a walk, of
            which ``robot_weight`` counts only if it was set: else it belongs to the robot.
        controller: label of the one that walks in place of that of a ``summary.json``. Then what
            either of the two sets counts only if it was set in that walk.

    Raises:
        ValueError: no such file, none of these, or a parameter that does not exist or fit.
    """
    if path.suffix == ".ssv":
        return dict(read_ssv(path))
    try:
        text = path.read_text(encoding="utf-8")
        content = tomllib.loads(text) if path.suffix == ".toml" else json.loads(text)
        values = _table(content, "")
        if "parameters" in values:
            experiment = _table(values.get("experiment", {}), "experiment")
            settings = _table(experiment.get("settings", {}), "experiment.settings")
            values = dict(_table(values["parameters"], "parameters"))
            others = {"robot_weight"}
            if controller is not None:
                for label in CONTROLLERS.keys() & {controller, experiment.get("controller")}:
                    others |= CONTROLLERS[label].settings.keys()
            values = {n: v for n, v in values.items() if n in settings or n not in others}
        return {name: checked(name, value) for name, value in values.items()}
    except OSError as error:
        raise ValueError(f"parameter file {path} cannot be read: {error.strerror}") from None
    except (ValueError, RecursionError) as error:
        raise ValueError(f"parameter file {path}: {error}") from None


def _table(value: Any, name: str) -> dict[str, Any]:
    if isinstance(value, dict):
        return value
    raise ValueError(f"{name and f'{name} is '}not a table of NAME: VALUE")

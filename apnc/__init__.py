"""Adaptive neural control for legged robots: simulate walks, measure them and run studies.

>>> import apnc
>>> record = apnc.simulate(apnc.Experiment(mi=0.15, duration=20))  # doctest: +SKIP
>>> apnc.write_report(record, "walk/")  # doctest: +SKIP

A module is imported when a name of it is used for the first time.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, Final

from apnc_core import __version__

if TYPE_CHECKING:
    from apnc.features import WalkFeatures, walk_features
    from apnc.loop.experiment import Experiment
    from apnc.loop.gait import Gait, gait_of_run, read_gait, write_gait
    from apnc.loop.push import Push
    from apnc.loop.record import End, Record
    from apnc.loop.simulate import simulate
    from apnc.many import simulate_many
    from apnc.report.folder import write_run as write_report
    from apnc.studies.results import StudyResults
    from apnc.studies.runner import run_study
    from apnc_plant.conditions import Conditions
    from apnc_plant.ground import Ground, Kerb, Obstacles, Plane, Waves
    from apnc_plant.plant import Plant
    from apnc_plant.robot import RobotDescription, load_robot

_PLACES: Final = {
    "Experiment": "apnc.loop.experiment",
    **dict.fromkeys(("Gait", "gait_of_run", "read_gait", "write_gait"), "apnc.loop.gait"),
    "Plant": "apnc_plant.plant",
    "Push": "apnc.loop.push",
    **dict.fromkeys(("End", "Record"), "apnc.loop.record"),
    "simulate": "apnc.loop.simulate",
    "simulate_many": "apnc.many",
    "write_report": "apnc.report.folder:write_run",
    "run_study": "apnc.studies.runner",
    "StudyResults": "apnc.studies.results",
    **dict.fromkeys(("WalkFeatures", "walk_features"), "apnc.features"),
    "Conditions": "apnc_plant.conditions",
    **dict.fromkeys(("Ground", "Kerb", "Obstacles", "Plane", "Waves"), "apnc_plant.ground"),
    **dict.fromkeys(("RobotDescription", "load_robot"), "apnc_plant.robot"),
}

__all__ = [
    "Conditions",
    "End",
    "Experiment",
    "Gait",
    "Ground",
    "Kerb",
    "Obstacles",
    "Plane",
    "Plant",
    "Push",
    "Record",
    "RobotDescription",
    "StudyResults",
    "WalkFeatures",
    "Waves",
    "__version__",
    "gait_of_run",
    "load_robot",
    "read_gait",
    "run_study",
    "simulate",
    "simulate_many",
    "walk_features",
    "write_gait",
    "write_report",
]


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"module 'apnc' has no attribute '{name}'")
    module, _, attribute = _PLACES[name].partition(":")
    return getattr(importlib.import_module(module), attribute or name)


def __dir__() -> list[str]:
    return sorted(__all__)

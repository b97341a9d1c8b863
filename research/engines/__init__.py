"""Does the gait form in MuJoCo and in C as it does in Exudyn?"""

from __future__ import annotations

from collections.abc import Sequence
from importlib.util import find_spec
from typing import Any, Final

from apnc.loop.engines import COMPILED, EXTRAS, OWN_ENGINE
from apnc.loop.experiment import Experiment
from apnc.loop.simulate import simulate
from apnc.report.figure import Figure
from apnc.studies.results import (
    STRICT,
    Result,
    cells_in,
    gait_in,
    matching,
    phases_in,
    successes,
    values,
)
from apnc.studies.statistics import rate
from apnc.studies.study import WALK_S, Robot, Study
from apnc.studies.table import markdown, middle
from research.engines import figures
from research.registry import STUDIES

MI_VALUES: Final = tuple(round(0.06 + 0.02 * i, 2) for i in range(12))

ENGINES: Final = (OWN_ENGINE, "mujoco", COMPILED)
"""Engines to compare. One whose package is missing is run only if it is asked for."""

SHOWN_MI: Final = 0.15
"""MI of the walk that is drawn over time."""


def installed() -> list[str]:
    """The engines whose packages are installed."""
    return [engine for engine in ENGINES if engine not in EXTRAS or find_spec(engine)]


def experiment(engine: str, **fields: Any) -> Experiment:
    """A walk in an engine."""
    return Experiment(duration=WALK_S, engine=engine, **fields)


def table(results: Sequence[Result]) -> str:
    """A line per engine and MI."""
    cells = [(mi, engine) for mi in cells_in(results, "mi") for engine in ENGINES]
    groups = [(*cell, matching(results, mi=cell[0], engine=cell[1])) for cell in cells]
    gait = gait_in(results)
    return markdown(_line(gait, *group) for group in groups if group[2])


def _line(gait: str, mi: float, engine: str, results: list[Result]) -> dict[str, str]:
    phases = [middle(values(results, name), 2) for name in phases_in(results)]
    return {
        "MI": f"{mi:.2f}",
        "engine": figures.STYLES[engine][0],
        f"{gait} kept, strict (95 % interval)": str(rate(successes(results))),
        "strict time [s]": middle(values(results, STRICT), 1),
        "speed [m/s]": middle(values(results, "late_speed_m_per_s"), 3),
        "stride [Hz]": middle(values(results, "stride_frequency_hz"), 2),
        "duty factor": middle(values(results, "duty_factor_mean"), 2),
        "phases at the end [rad]": "; ".join(phases),
        "fell": str(len(matching(results, fell=True))),
    }


def scenes(robot: Robot) -> list[Figure]:
    """Draw one walk of the robot in each engine, and Lilibot's replays, over time."""
    runs = {name: experiment(name, robot=robot, seed=1, mi=SHOWN_MI) for name in installed()}
    records = {name: simulate(run) for name, run in runs.items()}
    others = [engine for engine in runs if engine != OWN_ENGINE]
    return [figures.walks(records), figures.replay(others)]


STUDY: Final = Study(
    STUDIES["engines"],
    experiment,
    {"engine": ENGINES, "mi": MI_VALUES},
    controllers=("apnc",),
    seeds=lambda cell, trials: trials if cell["engine"] in installed() else 0,
    figures=figures.over_mi,
    scenes=scenes,
    table=table,
    engine=None,
)

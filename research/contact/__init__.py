"""Which integration step is fine enough for the contact? It is halved until nothing changes."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

import numpy as np

from apnc.loop.engines import OWN_ENGINE
from apnc.loop.experiment import Experiment
from apnc.report import theme
from apnc.report.encoding import Signal
from apnc.report.figure import Figure, Trace
from apnc.report.lines import line
from apnc.studies.plots import COLOURS
from apnc.studies.results import STRICT, Result, cells_in, is_number, matching
from apnc.studies.study import WALK_MI, Robot, Study
from apnc.studies.table import markdown
from research.contact.measure import (
    GRADUAL,
    STEPS,
    SUDDEN,
    TICK,
    measure,
    robot,
    touch_down,
    trot,
)
from research.registry import STUDIES

MAX_FORCE_ERROR: Final = 0.05
"""Largest force error of a step that is fine enough."""

MAX_CHATTER: Final = 0.01
"""Largest chatter of a step that is fine enough."""


def experiment(controller: str, seed: int, depth: float, steps: int) -> Experiment:
    """A walk with a damping depth of the feet [m] and a number of integration steps per tick."""
    own, step = robot(depth), TICK / steps
    return Experiment(
        robot=own, controller=controller, seed=seed, mi=WALK_MI, duration=30.0, step=step
    )


def table(results: Sequence[Result]) -> str:
    """A line per damping depth and step, with whether the step is fine enough."""
    return markdown(_line(result) for result in results if is_number(result.get("force_error")))


def _line(result: Result) -> dict[str, str]:
    shown: dict[str, str] = {}
    for title, column, scale, form in (
        ("damping depth [mm]", "depth", 1e3, "g"),
        ("step [ms]", "step_ms", 1.0, ".3f"),
        ("real time", "real_time_factor", 1.0, ".0f"),
        ("peak force [N]", "peak_N", 1.0, ".0f"),
        ("force error [%]", "force_error", 100.0, ".1f"),
        ("chatter [%]", "chatter", 100.0, ".2f"),
        ("place [mm]", "distance_error_mm", 1.0, ".2f"),
        ("trot after [s]", STRICT, 1.0, ".2f"),
        ("speed [m/s]", "late_speed_m_per_s", 1.0, ".4f"),
        ("duty", "duty_factor_mean", 1.0, ".3f"),
        ("COT", "cost_of_transport", 1.0, ".3f"),
    ):
        value = result.get(column)
        shown[title] = f"{scale * float(value):{form}}" if value is not None else "-"
    return shown | {TARGET: "yes" if fine_enough(result) else "no"}


TARGET: Final = f"error <= {100 * MAX_FORCE_ERROR:g} %, chatter <= {100 * MAX_CHATTER:g} %"


def fine_enough(result: Result) -> bool:
    """Whether force error and chatter of a step are within their limits."""
    return bool(result["force_error"] <= MAX_FORCE_ERROR and result["chatter"] <= MAX_CHATTER)


def figures(results: Sequence[Result]) -> list[Figure]:
    """Force error and chatter over the step, for each damping depth."""
    data: list[Trace] = []
    for depth in cells_in(results, "depth"):
        for column, words in (("force_error", "force error"), ("chatter", "chatter")):
            shown = [result for result in matching(results, depth=depth) if result.get(column)]
            y = np.array([result[column] for result in shown])
            x = {"x": [result["step_ms"] for result in shown], "mode": "lines+markers"}
            label = f"{words}, damping depth {1e3 * depth:g} mm"
            data.append(line(y, label, COLOURS[len(data) % len(COLOURS)]) | x)
    axes = {"xaxis": theme.axis("step [ms]", type="log"), "hovermode": "closest"}
    layout = theme.layout(380, yaxis=theme.axis("error, chatter [1]", type="log"), **axes)
    note = "Open-loop trot against the finest step. Zero does not show."
    return [Figure("contact-error", "Error over the step", note, data, layout, over_time=False)]


def scenes(_: Robot) -> list[Figure]:
    """Force under a foot of Lilibot at its first touch-down, by damping depth and step."""
    data = []
    laws = ((SUDDEN, STEPS[-1]), (GRADUAL, STEPS[-1]), (GRADUAL, STEPS[2]), (GRADUAL, STEPS[1]))
    for (depth, steps), colour in zip(laws, COLOURS, strict=False):
        time, force = touch_down(trot(depth, steps), steps)
        label = f"{1e3 * TICK / steps:.3g} ms, damping depth {1e3 * depth:g} mm"
        data.append(line(force, label, colour) | {"x": Signal(time)})
    layout = theme.layout(
        340,
        xaxis=theme.axis("time from touch-down [ms]"),
        yaxis=theme.axis("vertical force on foot RF [N]"),
    )
    note = "Of the open-loop trot."
    return [Figure("contact-force", "First touch-down", note, data, layout, over_time=False)]


STUDY: Final = Study(
    STUDIES["contact"],
    experiment,
    {"depth": (GRADUAL, SUDDEN), "steps": STEPS},
    controllers=("apnc",),
    measure=measure,
    figures=figures,
    scenes=scenes,
    table=table,
    engine=OWN_ENGINE,
)

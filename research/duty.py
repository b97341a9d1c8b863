"""Section 3.1.1: does any body of Lilibot's size stand for 72 % of a stride in a trot?

Servos that lag by more or less, feet that are softer or stiffer, and steps that are wider or
higher, each with and without couplings.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from itertools import product
from typing import Any, Final

import numpy as np

from apnc.controllers import OWN_CONTROLLER, named_controller
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.studies import gait
from apnc.studies.gains import LATE_SPEED
from apnc.studies.mi import DUTY
from apnc.studies.results import Result, cells_in, controllers_in, matching, successes, values
from apnc.studies.robots import changed, constant
from apnc.studies.states.measure import WALKS
from apnc.studies.study import Study
from apnc.studies.table import markdown, middle
from apnc_plant.robot import RobotDescription, load_robot
from research.command import main
from research.registry import STUDIES

LILIBOT: Final = load_robot("lilibot")

LAGS: Final = (0.030, 0.045, 0.066, 0.090, 0.120, 0.150)
"""Lags D/P of the servos [s]."""

FEET: Final = (1000.0, 2600.0, 5000.0, 10000.0, 20000.0)
"""Stiffnesses of the feet [N/m]."""

SLOPES: Final = (0.6, 1.0, 1.4)
"""Factors on the slopes of the motor neurons."""

HIGH, LOW = 0.28, 0.08
"""MI at which the paper's duty factor has settled, and one at which it is still small [1]."""

WALK: Final = 30.0
"""Length of a walk [s]."""

LATE: Final = 10.0
"""Time at the end of a walk over which the commands are looked at [s]."""

LIFTS: Final = (0.0, 1.0, 2.0, 3.0, 5.0)
"""Lifts that every foot must have [mm]; 0 asks for nothing, not even for a touch-down."""

ONE_TOUCH: Final = 0.1
"""Largest deviation from one touch-down in a stride."""

COMMANDED: Final = "commanded_stance"


def robot(lag: float, foot: float) -> RobotDescription:
    """Lilibot with another lag D/P of its servos [s] and other feet [N/m]."""
    slower = changed(LILIBOT, "servo.damping", constant(lag * LILIBOT.servo.stiffness))
    return changed(slower, "contact.stiffness", constant(foot))


def experiment(
    controller: str, seed: int, mi: float, lag: float, foot: float, a1: float, a2: float
) -> Experiment:
    """A walk of a body at multiples of the slopes."""
    walk = Experiment(
        robot=robot(lag, foot), controller=controller, seed=seed, mi=mi, duration=WALK
    )
    own: Mapping[str, Any] = walk.parameters()
    return replace(walk, settings={"a1": a1 * float(own["a1"]), "a2": a2 * float(own["a2"])})


def seeds(cell: Mapping[str, Any], trials: int) -> int:
    """All seeds, at ``LOW`` only with the robot's own slopes."""
    return trials if cell["mi"] == HIGH or cell["a1"] == cell["a2"] == 1.0 else 0


def measure(record: Record) -> Result:
    """How the feet step, and the share of the last 10 s in which the commands hold a foot down.

    Returns:
        ``commanded_stance``: share of the time in which o2 is below 0, mean over the legs [1].
        The others are those of the study ``gait``.
    """
    down = record.signals["o2"][record.time >= record.ended_at - LATE] < 0.0
    return {COMMANDED: float(down.mean()) if down.size else None} | gait.measure(record)


def trots(results: Sequence[Result]) -> list[Result]:
    """The runs that are in the strict trot at the end and go ahead."""
    return [
        result
        for result, formed in zip(results, successes(results), strict=True)
        if formed and (result.get(LATE_SPEED) or 0.0) >= WALKS  # NaN is not
    ]


def bodies(results: Sequence[Result]) -> list[list[Result]]:
    """The runs at ``HIGH`` of each body and its slopes, the controllers apart."""
    axes = ("controller", "lag", "foot", "a1", "a2")
    cells = product(*(dict.fromkeys(result[axis] for result in results) for axis in axes))
    found = (matching(results, mi=HIGH, **dict(zip(axes, cell, strict=True))) for cell in cells)
    return [own for own in found if own]


def table(results: Sequence[Result]) -> str:
    """Duty factor by lag and feet, its range by slopes, and what is left if feet must lift."""
    return "\n".join((
        by_body(matching(results, controller=OWN_CONTROLLER, a1=1.0, a2=1.0)),
        by_slopes(results),
        by_lift(results),
    ))  # fmt: skip


def by_body(results: Sequence[Result]) -> str:
    """A line per lag, a column per stiffness: duty factor at both MI, of the runs that trot."""

    def told(lag: float, foot: float) -> str:
        duty, runs = [], []
        for mi in (LOW, HIGH):
            own = matching(results, lag=lag, foot=foot, mi=mi)
            trotting = trots(own)
            duty.append(f"{np.median(values(trotting, DUTY)):.2f}" if trotting else "-")
            runs.append(f"{len(trotting)}/{len(own)}")
        return f"{duty[0]}, {duty[1]} ({runs[0]}, {runs[1]})"

    return markdown(
        {"D/P [ms]": f"{1000 * lag:g}"}
        | {f"{foot:g} N/m": told(lag, foot) for foot in cells_in(results, "foot")}
        for lag in cells_in(results, "lag")
    )


def by_slopes(results: Sequence[Result]) -> str:
    """A line per pair of slopes and controller: bodies that trot in every run, their duty."""
    lines = []
    for a1, a2 in product(cells_in(results, "a1"), cells_in(results, "a2")):
        entries = {"a1 x": f"{a1:g}", "a2 x": f"{a2:g}"}
        for label in controllers_in(results):
            own = bodies(matching(results, controller=label, a1=a1, a2=a2))
            good = [runs for runs in own if len(trots(runs)) == len(runs)]
            name = named_controller(label).name
            entries[f"{name}: bodies that trot"] = f"{len(good)}/{len(own)}"
            entries[f"{name}: duty factor"] = middle([mid(runs, DUTY) for runs in good], 2)
        lines.append(entries)
    return markdown(lines)


def by_lift(results: Sequence[Result]) -> str:
    """A line per lift that every foot must have: how many bodies, and the largest duty factor."""
    good = [runs for runs in bodies(results) if len(trots(runs)) == len(runs)]
    lines = []
    for lift in LIFTS:
        clear = [runs for runs in good if lift == 0.0 or _steps_clearly(runs, lift)]
        top = max(clear, key=lambda runs: mid(runs, DUTY), default=[])
        lines.append(
            {
                "every foot lifts by": f"{lift:g} mm" if lift else "any",
                "bodies": str(len(clear)),
                "from 0.6 up": str(sum(mid(runs, DUTY) >= 0.6 for runs in clear)),
                "from 0.67 up": str(sum(mid(runs, DUTY) >= 0.67 for runs in clear)),
                "largest duty factor": f"{mid(top, DUTY):.2f}",
                "its speed [m/s]": f"{mid(top, LATE_SPEED):.3f}",
                "its slip [%]": f"{100 * mid(top, gait.SLIP):.0f}",
            }
        )
    return markdown(lines)


def _steps_clearly(runs: Sequence[Result], lift: float) -> bool:
    """Whether every foot lifts by so much [mm] and touches down once in a stride, in every run."""
    lifts, touches = values(runs, gait.LIFT), values(runs, gait.TOUCHES)
    return (
        len(lifts) == len(touches) == len(runs)
        and min(lifts) >= lift
        and all(abs(count - 1.0) <= ONE_TOUCH for count in touches)
    )


def mid(results: Sequence[Result], column: str) -> float:
    """Median of a column [as the column]; NaN without a number."""
    return float(np.median(values(results, column) or [np.nan]))


STUDY: Final = Study(
    STUDIES["duty"],
    experiment,
    {"mi": (LOW, HIGH), "lag": LAGS, "foot": FEET, "a1": SLOPES, "a2": SLOPES},
    controllers=("apnc", "apc"),
    seeds=seeds,
    measure=measure,
    table=table,
)

if __name__ == "__main__":
    main(STUDY.name)

"""How exact must each number of the robot be? Each is changed alone, and the walk is judged."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, Final

import numpy as np

from apnc.loop.experiment import Experiment
from apnc.studies.results import SPEED, STRICT, Result, cells_in, is_number, matching, values
from apnc.studies.robots import changed, constant
from apnc.studies.study import WALK_S, Study
from apnc.studies.table import markdown, middle
from apnc_plant.robot import RobotDescription, load_robot
from research.command import main
from research.registry import STUDIES

Change = Callable[[RobotDescription], RobotDescription]


def _set(path: str, value: Any) -> Change:
    return lambda robot: changed(robot, path, constant(value))


def _times(path: str, factor: float) -> Change:
    return lambda robot: changed(robot, path, lambda value: factor * value)


def _shifted(ahead: float = 0.0, up: float = 0.0) -> Change:
    """Move the centre of mass of the trunk [m]."""
    return lambda robot: changed(
        robot, "trunk.com", lambda com: (com[0] + ahead, com[1], com[2] + up)
    )


def _lighter_tibiae(moved: float) -> Change:
    """Move mass from each tibia to its femur [kg]."""

    def leg(own: Any) -> Any:
        heavier = changed(own, "femur.mass", lambda mass: mass + moved)
        return changed(heavier, "tibia.mass", lambda mass: mass - moved)

    return lambda robot: changed(robot, "legs", lambda legs: tuple(map(leg, legs)))


def _soft(robot: RobotDescription) -> RobotDescription:
    return _set("servo.damping", 1.5)(_set("servo.stiffness", 12.0)(robot))


SOFT: Final = "soft servos: P 12 and D 1.5"

CHANGES: Final[Mapping[str, Change]] = {
    "nothing": lambda robot: robot,
    "foot stiffness x 0.7": _times("contact.stiffness", 0.7),
    "foot stiffness x 1.3": _times("contact.stiffness", 1.3),
    "foot damping x 0.7": _times("contact.damping", 0.7),
    "foot damping x 1.3": _times("contact.damping", 1.3),
    "damping depth x 0.5": _times("contact.damping_depth", 0.5),
    "damping depth x 2": _times("contact.damping_depth", 2.0),
    "friction 0.5": _set("contact.friction", 0.5),
    "friction 1.0": _set("contact.friction", 1.0),
    "friction speed x 0.7": _times("contact.friction_speed", 0.7),
    "friction speed x 1.5": _times("contact.friction_speed", 1.5),
    "P x 0.8": _times("servo.stiffness", 0.8),
    "P x 1.2": _times("servo.stiffness", 1.2),
    "D x 0.8": _times("servo.damping", 0.8),
    "D x 1.2": _times("servo.damping", 1.2),
    SOFT: _soft,
    "reflected inertia x 0.7": _times("servo.reflected_inertia", 0.7),
    "reflected inertia x 2": _times("servo.reflected_inertia", 2.0),
    "servo latency 5 ms": _set("servo.latency", 0.005),
    "servo latency 16.7 ms": _set("servo.latency", 1 / 60),
    "trunk's centre of mass 10 mm higher": _shifted(up=0.010),
    "10 mm lower, 10 mm below the trunk": _shifted(up=-0.010),
    "5 mm further ahead": _shifted(ahead=0.005),
    "5 mm further back": _shifted(ahead=-0.005),
    "25 g from each tibia to its femur": _lighter_tibiae(0.025),
    "sensor delay 8 ms": _set("sensor.delay", 0.008),
    "sensor delay 16.7 ms": _set("sensor.delay", 1 / 60),
    "sensor noise x 3": _times("sensor.noise", 3.0),
    "sensor shows the norm": _set("sensor.component", "norm"),
}
"""Changes of the robot, by name in the table."""


OVER_MI: Final = ("nothing", SOFT)
"""Changes that walk at all MI. Does the duty factor rise with MI, as in the paper?"""

MI_VALUES: Final = (0.04, 0.08, 0.16, 0.24, 0.32, 0.4)
USUAL_MI: Final = (0.04, 0.16, 0.4)
DUTY: Final = "duty_factor_mean"


def seeds(cell: Mapping[str, Any], trials: int) -> int:
    """All seeds at ``USUAL_MI``, and at the other MI for the changes of ``OVER_MI`` only."""
    return trials if cell["mi"] in USUAL_MI or cell["change"] in OVER_MI else 0


def experiment(controller: str, seed: int, change: str, mi: float) -> Experiment:
    """A walk of the changed robot."""
    robot = CHANGES[change](load_robot("lilibot"))
    return Experiment(robot=robot, controller=controller, seed=seed, mi=mi, duration=WALK_S)


def table(results: Sequence[Result]) -> str:
    """Two tables: strict times and mean speed per change, and duty factor and speed over MI.

    The first has the MI at which all changes walked; "-" stands for a run that did not form the
    gait. The second has the changes of ``OVER_MI``.
    """
    changes, mis = _in_order(results), cells_in(results, "mi")
    common = [mi for mi in mis if all(matching(results, change=c, mi=mi) for c in changes)]
    text = markdown(_line(c, matching(results, change=c), common) for c in changes)
    over = [c for c in changes if c in OVER_MI and len(mis) > len(USUAL_MI)]
    return (
        f"{text}\n{markdown(_duty(matching(results, change=c), c) for c in over)}" if over else text
    )


def _duty(results: Sequence[Result], change: str) -> dict[str, str]:
    entries = {"change": change}
    for mi in cells_in(results, "mi"):
        duty, speed = (middle(values(results, c, mi=mi), d) for c, d in ((DUTY, 2), (SPEED, 3)))
        entries |= {f"MI {mi:.2f}: duty factor": duty, f"MI {mi:.2f}: speed [m/s]": speed}
    return entries


def _in_order(results: Sequence[Result]) -> list[str]:
    return list(dict.fromkeys(result["change"] for result in results))


def _line(change: str, results: Sequence[Result], mis: Sequence[float]) -> dict[str, str]:
    entries = {"change": change}
    for mi in mis:
        own = matching(results, mi=mi)
        times = [result.get(STRICT) for result in own]
        shown = (f"{time:.1f}" if is_number(time) else "-" for time in times)
        speed = values(own, SPEED)
        entries[f"MI {mi:.2f}: trot after [s]"] = ", ".join(shown)
        entries[f"MI {mi:.2f}: speed [m/s]"] = f"{np.mean(speed):.3f}" if speed else "-"
    return entries | {"fell": f"{len(matching(results, fell=True))}/{len(results)}"}


STUDY: Final = Study(
    STUDIES["sensitivity"],
    experiment,
    {"change": tuple(CHANGES), "mi": MI_VALUES},
    controllers=("apnc",),
    seeds=seeds,
    table=table,
)

if __name__ == "__main__":
    main(STUDY.name)

"""Which studies there are; nothing heavy is imported before a study is loaded."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Final, NamedTuple

if TYPE_CHECKING:
    from apnc.studies.study import Study

ALL: Final = "all"
"""The name that means every experiment of the paper."""

METHODS: Final = "methods"
"""The option of studies that compare controllers."""


ROBOT: Final = "robot"
"""The option of studies that any robot can walk."""


class Entry(NamedTuple):
    """A study before it is loaded.

    ``place`` is where the paper has it, empty for a study of the model itself; ``options`` is what
    may be chosen besides the number of trials: methods, the robot, or axes of the grid.
    """

    name: str
    title: str
    place: str = ""
    options: tuple[str, ...] = ()


STUDIES: Final = {
    entry.name: entry
    for entry in (
        Entry("mi", "Stepping frequencies", "Fig. 4, S4, S5", (METHODS, ROBOT, "mi")),
        Entry("rate", "Update rates", "Fig. 5", (METHODS, ROBOT, "rate")),
        Entry("terrain", "Rough terrain", "Fig. 6", (METHODS, ROBOT, "roughness")),
        Entry("conditions", "Robot conditions", "Fig. 7", (METHODS, ROBOT, "condition")),
        Entry("damage", "Damaged leg", "Fig. 8", (METHODS, ROBOT)),
        Entry("states", "Motor memory", "Fig. 9-12", (ROBOT,)),
        Entry("steering", "Speed and direction", "Fig. 13, 14", (ROBOT, "course")),
        Entry("gains", "Strength of the feedback", "4.1", (METHODS, "mi", "gain")),
        Entry("symmetry", "Equal loads", "4.1.1", ("mi",)),
        Entry("gait", "How it walks", "", (ROBOT, "mi")),
        Entry("departures", "Departures taken back", "", ("removed", "task")),
        Entry("sensitivity", "Numbers of the robot", "", ("change", "mi")),
        Entry("forward_model", "Forward models", "", ("model", "mi")),
        Entry("engines", "Three engines", "", (ROBOT, "engine", "mi")),
        Entry("contact", "Integration step of the ground contact", "", ("depth", "steps")),
    )
}


def names_of(name: str) -> list[str]:
    """The studies that a name means.

    Raises:
        ValueError: an unknown name.
    """
    if name == ALL:
        return [entry.name for entry in STUDIES.values() if entry.place]
    if name not in STUDIES:
        raise ValueError(f"study '{name}' is not one of {', '.join(STUDIES)}, {ALL}")
    return [name]


def load(name: str) -> Study:
    """A study of the registry, ready to run."""
    study: Study = importlib.import_module(f"apnc.studies.{name}").STUDY
    return study

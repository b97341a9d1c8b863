"""The studies of the product. A study is imported when it is loaded, not here."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Final, NamedTuple

ALL: Final = "all"
"""Name that stands for all studies of the paper."""

CONTROLLERS_OPTION: Final = "controllers"
"""Option of studies that compare controllers."""

MIN_SEEDS: Final = 5
"""Smallest number of seeds, and of numbers on each side of a comparison, for a verdict."""

ROBOT: Final = "robot"
"""Option of studies that any robot can walk."""


class Entry(NamedTuple):
    """An entry of the registry: a study before it is loaded.

    Args:
        name: name of the study and of its module. The module holds the study as ``STUDY``.
        title: title of its report.
        section: section or figures of the paper. Empty for a study of the model itself.
        options: options besides those of all studies: controllers, robot, or axes of the grid.
        package: package of the module.
    """

    name: str
    title: str
    section: str = ""
    options: tuple[str, ...] = ()
    package: str = "apnc.studies"


Registry = Mapping[str, Entry]
"""Studies by name."""


STUDIES: Final[Registry] = {
    entry.name: entry
    for entry in (
        Entry("mi", "Stepping frequencies", "Fig. 4, S4, S5", (CONTROLLERS_OPTION, ROBOT, "mi")),
        Entry("rate", "Update rates", "Fig. 5", (CONTROLLERS_OPTION, ROBOT, "rate")),
        Entry("terrain", "Rough terrain", "Fig. 6", (CONTROLLERS_OPTION, ROBOT, "roughness")),
        Entry("conditions", "Robot conditions", "Fig. 7", (CONTROLLERS_OPTION, ROBOT, "condition")),
        Entry("damage", "Damaged leg", "Fig. 8", (CONTROLLERS_OPTION, ROBOT)),
        Entry("states", "Motor memory", "Fig. 9-12", (ROBOT,)),
        Entry("steering", "Speed and direction", "Fig. 13, 14", (ROBOT, "schedule")),
        Entry("gains", "Strength of the feedback", "4.1", (CONTROLLERS_OPTION, "mi", "gain")),
        Entry("gait", "How it walks", "", (ROBOT, "mi")),
    )
}


def names_of(name: str, studies: Registry = STUDIES) -> list[str]:
    """Names of the studies that a name stands for.

    Raises:
        ValueError: an unknown name.
    """
    if name == ALL:
        return [entry.name for entry in studies.values() if entry.section]
    if name not in studies:
        raise ValueError(f"study '{name}' is not one of {', '.join(studies)}, {ALL}")
    return [name]

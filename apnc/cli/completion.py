"""Values of options that the shell completes. They are looked up when the tab key is pressed."""
# ruff: noqa: PLC0415  # so that the command line itself starts fast

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from apnc.studies.registry import Entry

Completion = Callable[[str], list[str]]
"""What Typer calls, by the name ``incomplete``: the values that begin with that text."""


def one_of(*values: str) -> Completion:
    """A completion to one of these values."""
    return lambda incomplete: _beginning(incomplete, values)


def several_of(values: Callable[[], Iterable[str]]) -> Completion:
    """A completion to values separated by commas; the last one is completed.

    Args:
        values: function that lists them.
    """

    def complete(incomplete: str) -> list[str]:
        done, comma, last = incomplete.rpartition(",")
        chosen = done.split(",")
        left = [value for value in values() if value not in chosen]
        return [f"{done}{comma}{value}" for value in _beginning(last, left)]

    return complete


def robots(incomplete: str) -> list[str]:
    """Shipped robots."""
    from apnc_plant.robot import ROBOTS

    return _beginning(incomplete, sorted(path.stem for path in ROBOTS.glob("*.toml")))


def controllers(incomplete: str) -> list[str]:
    """Labels of controllers."""
    from apnc.controllers import CONTROLLERS

    return _beginning(incomplete, CONTROLLERS)


def conditions(incomplete: str) -> list[str]:
    """Names of conditions."""
    from apnc_plant.conditions import CONDITIONS

    return _beginning(incomplete, CONDITIONS)


def engines(incomplete: str) -> list[str]:
    """Names of engines."""
    from apnc.loop.engines import ENGINES

    return _beginning(incomplete, ENGINES)


def presets(incomplete: str) -> list[str]:
    """Names of presets, and that of a robot's own."""
    from apnc.loop.experiment import OWN_PRESET
    from apnc_core.presets import PRESETS

    return _beginning(incomplete, (OWN_PRESET, *PRESETS))


def grounds(incomplete: str) -> list[str]:
    """Kinds of ground."""
    from apnc_plant.ground import GROUNDS

    return _beginning(incomplete, GROUNDS)


def platforms(incomplete: str) -> list[str]:
    """Platforms that an FMU can be built for, ``host`` and ``all``."""
    from build_fmu.platforms import PLATFORMS

    return _beginning(incomplete, ("host", "all", *PLATFORMS))


def settings(incomplete: str) -> list[str]:
    """Parameters of the controller that ``--set`` takes, each with ``=``."""
    from apnc.loop.experiment import SET_ELSEWHERE
    from apnc_core.variables import TABLE

    names = [v.name for v in TABLE if v.causality == "parameter" and v.name not in SET_ELSEWHERE]
    return _beginning(incomplete, [f"{name}=" for name in names])


def axis_of(study: Entry | None, axis: str) -> Completion:
    """A completion to the values that a study has along an axis, or to its controllers.

    Args:
        study: entry of the study; None stands for all of them.
        axis: name of the axis.
    """

    def values() -> list[str]:
        from apnc.controllers import CONTROLLERS
        from apnc.studies.registry import CONTROLLERS_OPTION
        from apnc.studies.study import load

        if study is None or axis == CONTROLLERS_OPTION:
            return list(CONTROLLERS)
        # a shell would take a value with a blank in it for two words
        return [text for text in map(str, load(study).axes[axis]) if " " not in text]

    return several_of(values)


def _beginning(incomplete: str, values: Iterable[str]) -> list[str]:
    return [value for value in values if value.startswith(incomplete)]

"""The grids of the paper's experiments, as lists of trials."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Final

from apnc.studies.evaluation.trial import STATES, Trial
from apnc.studies.scenarios import Timeline
from apnc_core.enumerations import Method

METHODS: Final = ("apnc", "tegotae", "phase_reset")
MI_VALUES: Final = tuple(round(0.04 + 0.02 * i, 2) for i in range(13))
RATES: Final = tuple(float(5 * i) for i in range(1, 13))
ROUGHNESS: Final = tuple(round(0.1 * i, 1) for i in range(11))
CONDITIONS: Final = ("C1", "C2", "C3", "C4")
DEFAULT_MI: Final = 0.08
STEERING_MI: Final = 0.15

Grid = Callable[[int, Sequence[str]], list[Trial]]


def _mi(trials: int, methods: Sequence[str]) -> list[Trial]:
    return [
        Trial("mi", method, mi, seed)
        for mi in MI_VALUES
        for seed in range(trials)
        for method in methods
    ]


def _rate(trials: int, methods: Sequence[str]) -> list[Trial]:
    return [
        Trial("rate", method, DEFAULT_MI, seed, duration=60.0, rate=rate)
        for rate in RATES
        for seed in range(trials)
        for method in methods
    ]


def _terrain(trials: int, methods: Sequence[str]) -> list[Trial]:
    return [
        Trial("terrain", method, DEFAULT_MI, seed, roughness=roughness)
        for roughness in ROUGHNESS
        for seed in range(trials)
        for method in methods
    ]


def _conditions(trials: int, methods: Sequence[str]) -> list[Trial]:
    return [
        Trial("conditions", method, DEFAULT_MI, seed, condition=condition)
        for condition in CONDITIONS
        for seed in range(trials)
        for method in methods
    ]


def _damage(trials: int, methods: Sequence[str]) -> list[Trial]:
    return [
        Trial("damage", method, STEERING_MI, seed, condition="C3")
        for seed in range(trials)
        for method in methods
    ]


def _memory(trials: int, methods: Sequence[str]) -> list[Trial]:
    duration, mi = Timeline().end, Timeline().mi
    return [
        Trial("memory", method, mi, seed, duration=duration, course=STATES)
        for seed in range(trials)
        for method in ("apnc", "apc")
    ]


def _steering(trials: int, methods: Sequence[str]) -> list[Trial]:
    return [
        Trial("steering", "apnc", STEERING_MI, seed, duration=60.0, course=course)
        for course in ("speeds", "turns")
        for seed in range(trials)
    ]


@dataclass(frozen=True)
class Study:
    """A study: its grid, what varies along its axis, and where the paper has it."""

    name: str
    place: str
    title: str
    axis: str
    axis_title: str
    grid: Grid


STUDIES: Final[dict[str, Study]] = {
    s.name: s
    for s in (
        Study("mi", "Fig. 4, S4, S5", "Stepping frequencies", "mi", "MI [1]", _mi),
        Study("rate", "Fig. 5", "Update rates", "rate", "update rate [Hz]", _rate),
        Study("terrain", "Fig. 6", "Rough terrain", "roughness", "roughness R [1]", _terrain),
        Study("conditions", "Fig. 7", "Robot conditions", "condition", "condition", _conditions),
        Study("damage", "Fig. 8", "Damaged leg", "method", "method", _damage),
        Study("memory", "Fig. 9-12", "Motor memory", "method", "method", _memory),
        Study("steering", "Fig. 13, 14", "Speed and direction", "course", "course", _steering),
    )
}


def trials_of(name: str, trials: int, methods: Sequence[str]) -> list[Trial]:
    """The trials of a study, or of all of them for ``all``.

    Args:
        name: a study or ``all``.
        trials: seeds per cell of the grid.
        methods: names of the controllers to compare.

    Raises:
        ValueError: an unknown study or method, or no trial.
    """
    if name not in STUDIES and name != "all":
        raise ValueError(f"study '{name}' is not one of {', '.join(STUDIES)}, all")
    if trials < 1:
        raise ValueError(f"trials = {trials} is not at least 1")
    for method in methods:
        if method not in Method.__members__:
            raise ValueError(f"method '{method}' is not one of {', '.join(Method.__members__)}")
    if not methods:
        raise ValueError("no method is given")
    names = STUDIES if name == "all" else (name,)
    return [trial for each in names for trial in STUDIES[each].grid(trials, methods)]

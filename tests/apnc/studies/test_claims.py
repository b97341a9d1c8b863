"""Every rule on results that must give each verdict."""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import pytest
from made_up_results import Result, made_up
from scipy import stats

from apnc.controllers import BASELINES, named_controller
from apnc.studies import (
    conditions,
    damage,
    gains,
    mi,
    rate,
    states,
    steering,
    terrain,
)
from apnc.studies.claims import (
    FEW,
    NO,
    NOT_RUN,
    PARTLY,
    YES,
    Claim,
    always,
    faster,
    judgements,
    of_all,
    of_criteria,
    of_decided,
    trend,
)
from apnc.studies.registry import STUDIES
from apnc.studies.results import AUTHORS, STRICT, values

Number = Callable[[Result], float | None]
MIS = (0.04, 0.12, 0.2, 0.24, 0.28)
RATES = (5.0, 15.0, 25.0, 30.0, 60.0)
ROUGH = (0.0, 0.3, 0.5, 0.8, 0.9, 1.0)


def of_label(by_label: Mapping[str, Any], label: str) -> Any:
    """What is given for a label, or for its controller: both settings of a baseline are alike."""
    return by_label[label] if label in by_label else by_label[named_controller(label).method]


def when(**by_label: Any) -> Callable[[Result], Result]:
    """Strict and authors' times: a number, a function of the cell, or both of them in a tuple."""

    def figures(cell: Result) -> Result:
        given = of_label(by_label, cell["controller"])
        strict, authors = given if isinstance(given, tuple) else (given, given)
        jitter = 0.01 * cell["seed"]

        def time(value: Any) -> float | None:
            value = value(cell) if callable(value) else value
            return None if value is None else value + jitter

        return {STRICT: time(strict), AUTHORS: time(authors)}

    return figures


def verdict(claim: Claim, results: Sequence[Result]) -> str:
    return judgements(results, [claim])[0][1].verdict


def claims_of(study: str) -> tuple[Claim, ...]:
    # made anew: a mutation run switches a mutant on after modules were imported
    module = importlib.reload(importlib.import_module(f"apnc.studies.{study}"))
    claims: tuple[Claim, ...] = module.STUDY.claims
    return claims


def claim_of(study: str, text: str) -> Claim:
    (found,) = [claim for claim in claims_of(study) if claim.text.startswith(text)]
    return found


def never(cell: Result) -> None:
    return None


def by(axis: str, limit: float, low: float | None, high: float | None) -> Number:
    """One value up to a limit of an axis, another above it."""
    return lambda cell: high if cell[axis] > limit else low


def seldom(cell: Result) -> float | None:
    """Forms in two of three runs."""
    return None if cell["seed"] % 3 == 0 else 3.0


def barely(cell: Result) -> float | None:
    """Fails in one run up to R = 0.8 and in two above."""
    return None if (cell["roughness"], cell["seed"]) in ((0.0, 1), (0.9, 0), (1.0, 0)) else 3.0


def over_mi(**times: Any) -> list[Result]:
    return made_up({"mi": MIS}, when(**times))


def over_rate(**times: Any) -> list[Result]:
    return made_up({"rate": RATES}, when(**times), study="rate")


def over_r(**times: Any) -> list[Result]:
    return made_up({"roughness": ROUGH}, when(**times), study="terrain")


def duty(low: float | None, high: float) -> list[Result]:
    def figures(cell: Result) -> Result:
        return {mi.DUTY: None if low is None else low + (high - low) * cell["mi"] / 0.28}

    return made_up({"mi": MIS}, figures)


def stride(slope: float, offset: float) -> list[Result]:
    return made_up({"mi": MIS}, lambda c: {"stride_frequency_hz": slope * c["mi"] + offset})


def speed_over_rate(slope: float | None) -> list[Result]:
    def figures(cell: Result) -> Result:
        speed = None if slope is None else 0.1 + slope * cell["rate"] + 1e-6 * cell["seed"]
        return {"late_speed_m_per_s": speed}

    return made_up({"rate": RATES}, figures, study="rate")


def scatter(smooth: Mapping[str, float], rough: Mapping[str, float | None]) -> list[Result]:
    """Times around 10 s, as wide as given up to R = 0.5 and above."""

    def figures(cell: Result) -> Result:
        wide = of_label(rough if cell["roughness"] > 0.5 else smooth, cell["controller"])
        # more than two places, or the distance to the median would be the same in every run
        time = None if wide is None else 10.0 + wide * (cell["seed"] - 2.5)
        return {STRICT: time, AUTHORS: time}

    return made_up({"roughness": ROUGH}, figures, study="terrain")


def metrics(**edge: float) -> list[Result]:
    """APNC is better by ``edge`` in a condition: steadier, better coordinated, cheaper."""

    def figures(cell: Result) -> Result:
        better = edge.get(cell["condition"], 0.0) if cell["controller"] == "apnc" else 0.0
        noise = 0.01 * ((cell["seed"] * 7 + len(cell["controller"])) % 10)
        return {
            "balance": 10.0 + noise + better,
            "coordination": 5.0 + noise + better,
            "cost_of_transport": 3.0 + noise - better,
        }

    cells = {"condition": ("C1", "C2", "C3", "C4")}
    return made_up(cells, figures, seeds=10, study="conditions")


def worse_balance(condition: str) -> list[Result]:
    results = metrics(**{condition: 1.0})
    return [r | {"balance": r["balance"] - 2.0 * (r["controller"] == "apnc")} for r in results]


def without(
    results: Sequence[Result], left: int, *columns: str, controller: str = "tegotae"
) -> list[Result]:
    """Results in which a controller has these columns in the first few runs only."""
    return [
        r | (dict.fromkeys(columns) if r["controller"] == controller and r["seed"] >= left else {})
        for r in results
    ]


def standing(left: int) -> list[Result]:
    """Every baseline has its metrics in the first few of ten runs only."""
    results = metrics(C1=1.0, C2=1.0, C3=1.0, C4=1.0)
    for label in BASELINES:
        results = without(results, left, *conditions.METRICS, controller=label)
    return results


def speeds(**by_label: float | None) -> list[Result]:
    def figures(cell: Result) -> Result:
        speed = of_label(by_label, cell["controller"])
        return {"path_speed_m_per_s": None if speed is None else speed + 1e-4 * cell["seed"]}

    return made_up({"condition": ("C3",)}, figures, study="damage")


def in_states(name: str, controller: str, hits: int) -> list[Result]:
    """So many of ten runs of a controller went as the paper says, all of the other did or none."""

    def figures(cell: Result) -> Result:
        good = cell["seed"] < hits if cell["controller"] == controller else hits == 0
        others = {f"state_{s}": hits == 0 for s in ("S1", "S2", "S3")}
        return others | {f"state_{name}": good}

    return made_up({}, figures, controllers=("apnc", "apc"), seeds=10, study="states")


def kept(name: str, *, formed: int = 10, **hits: int) -> list[Result]:
    """So many of ten runs of the baselines form the trot, and so many trot in a state."""

    def figures(cell: Result) -> Result:
        return {
            "state_S1": cell["seed"] < formed,
            f"state_{name}": cell["seed"] < of_label(hits, cell["controller"]),
        }

    return made_up({}, figures, controllers=BASELINES, seeds=10, study="states")


def gammas(ratio: float | None) -> list[Result]:
    """Gamma falls to this part of it with all feedback kept, and to a fifth where it is imposed."""

    def figures(cell: Result) -> Result:
        part = 0.2 if cell["controller"] == "apnc" else ratio
        after = None if part is None else part * 0.3
        return dict(zip(states.GAMMA, (0.3, after), strict=True))

    return made_up({}, figures, controllers=("apnc", "apnc_kept"), study="states")


def sections(column: str, *means: float | None) -> list[Result]:
    def figures(cell: Result) -> Result:
        wobble = 1e-3 * cell["seed"]
        return {
            f"{column}_section_{i}": None if mean is None else mean + wobble
            for i, mean in enumerate(means, start=1)
        }

    schedule = "speeds" if column == "speed" else "turns"
    return made_up({"schedule": (schedule,)}, figures, controllers=("apnc",), study="steering")


def on_slopes(*means: float | None) -> list[Result]:
    def figures(cell: Result) -> Result:
        mean = means[list(steering.SLOPES).index(cell["schedule"])]
        return {"speed_section_1": None if mean is None else mean + 1e-4 * cell["seed"]}

    cells = {"schedule": tuple(steering.SLOPES)}
    return made_up(cells, figures, controllers=("apnc",), study="steering")


def over_gain(
    weak: Any = 20.0, good: Any = 2.0, strong: Any = 5.0, stopped: Any = (0, 0, 4)
) -> list[Result]:
    """Times and stopped oscillators at a weak gain, at the best or the robot's own and a strong."""

    def figures(cell: Result) -> Result:
        at = (0.01, 1.0, 4.0).index(cell["gain"])
        number = stopped[at]
        time = when(apnc=(weak, good, strong)[at])({**cell, "controller": "apnc"})
        return time | {
            "late_speed_m_per_s": 0.0 if time[STRICT] is None else 0.1,
            gains.STILL: number(cell) if callable(number) else number,
        }

    cells = {"mi": (0.08,), "gain": (0.01, 1.0, 4.0)}
    return made_up(cells, figures, controllers=("tegotae", "apnc"), study="gains")


FAST = {"apnc": 2.0, "tegotae": 9.0, "phase_reset": 1.0}
ALIKE = dict.fromkeys(("apnc", "tegotae", "phase_reset"), 5.0)
SLOW = {"apnc": 9.0, "tegotae": 2.0, "phase_reset": 9.5}
LATER = dict.fromkeys(ALIKE, lambda c: 20.0 - c.get("rate", 0) / 10)
ROUGHER = dict.fromkeys(ALIKE, lambda c: 3.0 + c["roughness"])
ONLY_ABOVE = by("rate", 25.0, None, 3.0)

CASES: list[tuple[str, str, list[Result], str]] = [
    ("mi", "the gait forms rapidly", over_mi(**FAST), YES),
    ("mi", "the gait forms rapidly", over_mi(**FAST | {"apnc": by("mi", 0.04, None, 2.0)}), PARTLY),
    ("mi", "the gait forms rapidly", over_mi(**FAST | {"apnc": (2.0, 9.1)}), PARTLY),
    ("mi", "the gait forms rapidly", over_mi(**FAST | {"apnc": (9.1, 2.0)}), PARTLY),
    ("mi", "the gait forms rapidly", over_mi(**FAST | {"apnc": 9.1}), NO),
    ("mi", "the gait forms rapidly", over_mi(**FAST | {"apnc": never}), NO),
    ("mi", "APNC converges faster", over_mi(**FAST), YES),
    ("mi", "APNC converges faster", over_mi(**FAST | {"tegotae": never, "tegotae_best": 9.0}), YES),
    ("mi", "APNC converges faster", over_mi(**FAST | {"tegotae_best": 1.0}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": by("mi", 0.24, 2.0, 10.0)}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": by("mi", 0.24, 2.0, None)}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": (never, 2.0)}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": (10.0, 2.0)}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": (2.0, 10.0)}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**FAST | {"tegotae": (never, 9.0)}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**SLOW), NO),
    ("mi", "APNC converges faster", over_mi(**ALIKE), NO),
    ("mi", "APNC converges faster", over_mi(**ALIKE | {"tegotae": 5.001}), NO),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": never}), NO),
    ("mi", "APNC converges faster", over_mi(**FAST | {"tegotae": never, "tegotae_best": 1.0}), NO),
    ("mi", "APNC converges faster", over_mi(**FAST | {"tegotae": never}), FEW),
    ("mi", "APNC converges faster",
     over_mi(**FAST | {"tegotae": lambda c: 9.0 if c["mi"] == 0.2 and c["seed"] < 4 else None}),
     FEW),
    ("mi", "APNC converges faster",
     over_mi(**FAST | {"tegotae": lambda c: 9.0 if c["mi"] == 0.2 and c["seed"] < 5 else None}),
     YES),
    ("mi", "phase resetting converges faster", over_mi(**FAST), YES),
    ("mi", "phase resetting converges faster", over_mi(**FAST | {"tegotae_best": 0.5}), PARTLY),
    ("mi", "phase resetting converges faster", over_mi(**SLOW), NO),
    ("mi", "phase resetting converges faster", over_mi(**FAST | {"tegotae": never}), FEW),
    ("mi", "the duty factor grows", duty(0.5, 0.7), YES),
    ("mi", "the duty factor grows", duty(0.7, 0.5), NO),
    ("mi", "the duty factor grows", duty(None, 0.5), FEW),
    ("mi", "from MI 0.24 on", duty(0.5, 0.72), YES),
    ("mi", "from MI 0.24 on", duty(0.72, 0.76), YES),
    ("mi", "from MI 0.24 on", duty(0.72, 0.81), PARTLY),
    ("mi", "from MI 0.24 on", duty(0.72, 0.64), PARTLY),
    ("mi", "from MI 0.24 on", duty(0.72, 0.59), NO),
    ("mi", "from MI 0.24 on", duty(0.61, 0.51), NO),
    ("mi", "from MI 0.24 on", duty(None, 0.72), FEW),
    ("mi", "the stride frequency", stride(8.6, 0.5), YES),
    ("mi", "the stride frequency", stride(8.6 * 1.14, 0.5 * 1.14), YES),
    ("mi", "the stride frequency", stride(8.6 * 0.84, 0.5 * 0.84), PARTLY),
    ("mi", "the stride frequency", stride(-8.6, 4.0), NO),
    ("mi", "the stride frequency", duty(0.5, 0.7), FEW),
    ("rate", "a higher update rate converges", over_rate(**LATER), YES),
    ("rate", "a higher update rate converges", over_rate(**LATER | {"tegotae_best": 5.0}), PARTLY),
    ("rate", "a higher update rate converges", over_rate(**LATER | {"tegotae": never}), PARTLY),
    ("rate", "a higher update rate converges",
     over_rate(**dict.fromkeys(ALIKE, lambda c: c["rate"])), NO),
    ("rate", "a higher update rate converges", over_rate(**dict.fromkeys(ALIKE, never)), FEW),
    ("rate", "a higher update rate walks", speed_over_rate(0.01), YES),
    ("rate", "a higher update rate walks", speed_over_rate(-0.001), NO),
    ("rate", "a higher update rate walks", speed_over_rate(None), FEW),
    ("rate", "APNC succeeds in every trial", over_rate(**ALIKE), YES),
    ("rate", "APNC succeeds in every trial",
     over_rate(**ALIKE | {"apnc": lambda c: None if c["rate"] == 5 and c["seed"] < 3 else 3.0}),
     PARTLY),
    ("rate", "APNC succeeds in every trial", over_rate(**ALIKE | {"apnc": (never, 5.0)}), PARTLY),
    ("rate", "APNC succeeds in every trial",
     over_rate(**ALIKE | {"apnc": by("rate", 5.0, None, 3.0)}), NO),
    ("rate", "Tegotae and phase resetting",
     over_rate(**dict.fromkeys(ALIKE, ONLY_ABOVE)), YES),
    ("rate", "Tegotae and phase resetting", over_rate(**ALIKE | {"tegotae": ONLY_ABOVE}), PARTLY),
    ("rate", "Tegotae and phase resetting",
     over_rate(**dict.fromkeys(ALIKE, ONLY_ABOVE) | {"tegotae_best": 3.0}), PARTLY),
    ("rate", "Tegotae and phase resetting",
     over_rate(**dict.fromkeys(ALIKE, (ONLY_ABOVE, 3.0))), PARTLY),
    ("rate", "Tegotae and phase resetting", over_rate(**ALIKE), NO),
    ("rate", "Tegotae and phase resetting", over_rate(**dict.fromkeys(ALIKE, never)), NO),
    ("rate", "Tegotae and phase resetting",
     over_rate(**dict.fromkeys(ALIKE, by("rate", 30.0, None, 3.0))), NO),
    ("rate", "APNC converges faster", over_rate(**FAST), YES),
    ("rate", "APNC converges faster", over_rate(**FAST | {"tegotae_best": 1.0}), PARTLY),
    ("rate", "APNC converges faster", over_rate(**SLOW), NO),
    ("rate", "APNC converges faster", over_rate(**FAST | {"tegotae": never}), FEW),
    ("terrain", "rougher ground", over_r(**ROUGHER), YES),
    ("terrain", "rougher ground", over_r(**ALIKE | {"apnc": ROUGHER["apnc"]}), PARTLY),
    ("terrain", "rougher ground", over_r(**ROUGHER | {"phase_reset": never}), PARTLY),
    ("terrain", "rougher ground",
     over_r(**dict.fromkeys(ALIKE, (ROUGHER["apnc"], 3.0))), PARTLY),
    ("terrain", "rougher ground",
     over_r(**dict.fromkeys(ALIKE, lambda c: 3.0 - c["roughness"])), NO),
    ("terrain", "rougher ground", over_r(**dict.fromkeys(ALIKE, never)), FEW),
    ("terrain", "the spread", scatter(dict.fromkeys(ALIKE, 1.0), dict.fromkeys(ALIKE, 3.0)), YES),
    ("terrain", "the spread", scatter(ALIKE, ALIKE | {"apnc": 15.0}), PARTLY),
    ("terrain", "the spread",
     scatter(dict.fromkeys(ALIKE, 1.0), dict.fromkeys(ALIKE, 3.0) | {"tegotae": None}), PARTLY),
    ("terrain", "the spread", scatter(dict.fromkeys(ALIKE, 3.0), dict.fromkeys(ALIKE, 1.0)), NO),
    ("terrain", "the spread", scatter(dict.fromkeys(ALIKE, 1.0), dict.fromkeys(ALIKE, 1.1)), NO),
    ("terrain", "the spread", scatter(ALIKE, dict.fromkeys(ALIKE)), FEW),
    ("terrain", "above R = 80 %",
     over_r(**ALIKE | {"tegotae": lambda c: None if c["roughness"] == 1.0 else 3.0}), YES),
    ("terrain", "above R = 80 %",
     over_r(**ALIKE | {"tegotae": by("roughness", 0.8, 3.0, None), "tegotae_best": 3.0}), PARTLY),
    ("terrain", "above R = 80 %",
     over_r(**ALIKE | {"tegotae": (by("roughness", 0.8, 3.0, None), 3.0)}), PARTLY),
    ("terrain", "above R = 80 %",
     over_r(**ALIKE | {"tegotae": lambda c: None if c["roughness"] > 0.8 else seldom(c)}), PARTLY),
    ("terrain", "above R = 80 %", over_r(**ALIKE), NO),
    ("terrain", "above R = 80 %", over_r(**ALIKE | {"tegotae": seldom}), NO),
    ("terrain", "above R = 80 %",
     over_r(**ALIKE | {"tegotae": barely}), NO),
    ("terrain", "above R = 80 %",
     over_r(**ALIKE | {"tegotae": lambda c: None if c["roughness"] == 0.8 else 3.0}), NO),
    ("terrain", "above R = 80 %", over_r(**ALIKE | {"tegotae": never}), FEW),
    ("terrain", "APNC forms the gait", over_r(**ALIKE), YES),
    ("terrain", "APNC forms the gait", over_r(**ALIKE | {"apnc": (5.0, never)}), PARTLY),
    ("terrain", "APNC forms the gait", over_r(**ALIKE | {"apnc": never}), NO),
    ("terrain", "APNC converges faster than Tegotae", over_r(**FAST), YES),
    ("terrain", "APNC converges faster than Tegotae",
     over_r(**FAST | {"tegotae_best": 1.0}), PARTLY),
    ("terrain", "APNC converges faster than Tegotae", over_r(**SLOW), NO),
    ("terrain", "APNC converges faster than Tegotae", over_r(**FAST | {"tegotae": never}), FEW),
    ("terrain", "APNC converges faster than phase", over_r(**SLOW), YES),
    ("terrain", "APNC converges faster than phase",
     over_r(**SLOW | {"phase_reset_best": 1.0}), PARTLY),
    ("terrain", "APNC converges faster than phase", over_r(**FAST), NO),
    ("terrain", "APNC converges faster than phase", over_r(**SLOW | {"phase_reset": never}), FEW),
    ("conditions", "in C1", metrics(C2=1.0), YES),
    ("conditions", "in C1", worse_balance("C2"), PARTLY),
    ("conditions", "in C1", without(metrics(), 4, "balance"), PARTLY),
    ("conditions", "in C1", metrics(C1=1.0), NO),
    ("conditions", "in C1", standing(4), FEW),
    ("conditions", "with noise (C2)", metrics(C2=1.0), YES),
    ("conditions", "with noise (C2)", standing(5), YES),
    ("conditions", "with noise (C2)", worse_balance("C2"), PARTLY),
    ("conditions", "with noise (C2)", without(metrics(C2=1.0), 4, "balance"), PARTLY),
    ("conditions", "with noise (C2)", metrics(C3=1.0), NO),
    ("conditions", "with noise (C2)", metrics(C2=-1.0), NO),
    ("conditions", "with noise (C2)", standing(4), FEW),
    ("conditions", "with a damaged leg (C3)", metrics(C3=1.0), YES),
    ("conditions", "with a damaged leg (C3)", worse_balance("C3"), PARTLY),
    ("conditions", "with a damaged leg (C3)", metrics(C2=1.0), NO),
    ("conditions", "with a damaged leg (C3)", standing(4), FEW),
    ("conditions", "with a payload (C4)", metrics(C4=1.0), YES),
    ("conditions", "with a payload (C4)", worse_balance("C4"), PARTLY),
    ("conditions", "with a payload (C4)", metrics(C2=1.0), NO),
    ("conditions", "with a payload (C4)", standing(4), FEW),
    ("damage", "with a damaged leg", speeds(apnc=0.3, tegotae=0.2, phase_reset=0.1), YES),
    ("damage", "with a damaged leg", speeds(apnc=0.3, tegotae=None, phase_reset=0.1), YES),
    ("damage", "with a damaged leg", speeds(apnc=0.2, tegotae=0.3, phase_reset=0.1), PARTLY),
    ("damage", "with a damaged leg",
     speeds(apnc=0.2, tegotae=0.1, phase_reset=0.1, phase_reset_best=0.3), PARTLY),
    ("damage", "with a damaged leg", speeds(apnc=0.2, tegotae=0.2, phase_reset=0.1), PARTLY),
    ("damage", "with a damaged leg", speeds(apnc=0.1, tegotae=0.3, phase_reset=0.1), NO),
    ("damage", "with a damaged leg", speeds(apnc=0.1, tegotae=None, phase_reset=None), FEW),
    ("damage", "with a damaged leg", speeds(apnc=None, tegotae=0.1, phase_reset=0.1), FEW),
    ("states", "with broken feedback", kept("S2", tegotae=0, phase_reset=0), YES),
    ("states", "with broken feedback", kept("S2", tegotae=0, phase_reset=4), PARTLY),
    ("states", "with broken feedback",
     kept("S2", tegotae=0, phase_reset=0, phase_reset_best=9), PARTLY),
    ("states", "with broken feedback", kept("S2", tegotae=5, phase_reset=9), NO),
    ("states", "with broken feedback", kept("S2", formed=4, tegotae=0, phase_reset=0), FEW),
    ("states", "Tegotae and phase resetting store", kept("S3", tegotae=0, phase_reset=0), YES),
    ("states", "Tegotae and phase resetting store",
     kept("S3", formed=0, tegotae=0, phase_reset=0), YES),
    ("states", "Tegotae and phase resetting store", kept("S3", tegotae=4, phase_reset=0), PARTLY),
    ("states", "Tegotae and phase resetting store", kept("S3", tegotae=5, phase_reset=5), NO),
    ("states", "once the couplings", gammas(0.5), YES),
    ("states", "once the couplings", gammas(0.7), PARTLY),
    ("states", "once the couplings", gammas(0.95), NO),
    ("states", "once the couplings", gammas(None), FEW),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.16, 0.08), YES),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.12, 0.08), PARTLY),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.21, 0.08), PARTLY),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.16, 0.1), PARTLY),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.07, 0.08), NO),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.16, None), FEW),
    ("steering", "steeper slopes on one side", sections("yaw_rate", 0.0, -0.2, 0.2, 0.0), YES),
    ("steering", "steeper slopes on one side", sections("yaw_rate", 0.0, 0.1, 0.2, 0.0), PARTLY),
    ("steering", "steeper slopes on one side", sections("yaw_rate", 0.0, -0.2, -0.1, 0.0), PARTLY),
    ("steering", "steeper slopes on one side", sections("yaw_rate", 0.0, 0.2, -0.2, 0.0), NO),
    ("steering", "steeper slopes on one side", sections("yaw_rate", 0.0, None, None, 0.0), FEW),
    ("steering", "steeper slopes of the", on_slopes(0.06, 0.08, 0.1, 0.12, 0.14), YES),
    ("steering", "steeper slopes of the", on_slopes(0.06, 0.08, 0.1, 0.06, 0.02), PARTLY),
    ("steering", "steeper slopes of the", on_slopes(0.14, 0.12, 0.1, 0.08, 0.06), NO),
    ("steering", "steeper slopes of the", on_slopes(None, None, None, None, None), FEW),
    ("gains", "too strong an inhibition", over_gain(), YES),
    ("gains", "too strong an inhibition",
     over_gain(stopped=(0, 0, lambda c: int(c["seed"] < 2))), PARTLY),
    ("gains", "too strong an inhibition",
     over_gain(stopped=(0, 0, lambda c: 4 if c["controller"] == "apnc" else 0)), PARTLY),
    ("gains", "too strong an inhibition", over_gain(stopped=(0, 0, 0)), NO),
    ("gains", "too strong an inhibition", over_gain(stopped=(0, 1, 4)), NO),
    ("gains", "too strong an inhibition", over_gain(stopped=(None, None, None)), FEW),
    ("gains", "with too weak an inhibition", over_gain(), YES),
    ("gains", "with too weak an inhibition", over_gain(weak=None), YES),
    ("gains", "with too weak an inhibition", over_gain(weak=(20.0, 2.0)), PARTLY),
    ("gains", "with too weak an inhibition", over_gain(weak=2.0, good=1.99), NO),
    ("gains", "with too weak an inhibition",
     [r for r in over_gain() if r["gain"] != 4.0 and (r["seed"] < 4 or r["gain"] == 1.0)], FEW),
]  # fmt: skip
for _text, _state, _method in (
    ("S1: set down", "S1", "apnc"),
    ("S2: with ANC", "S2", "apnc"),
    ("S2: without ANC", "S2", "apc"),
    ("S3: with ANC", "S3", "apnc"),
    ("S3: without ANC", "S3", "apc"),
):
    for _hits, _verdict in ((10, YES), (5, PARTLY), (4, NO), (0, NO)):
        CASES.append(("states", _text, in_states(_state, _method, _hits), _verdict))

NEVER_PARTLY = ("the duty factor grows", "a higher update rate walks")
"""What is said of one controller by one criterion, and holds or does not."""

ALWAYS_TOLD = (
    "the gait forms rapidly", "APNC succeeds in every trial", "APNC forms the gait",
    "Tegotae and phase resetting", "S1", "S2", "S3",
)  # fmt: skip
"""Shares of runs: every run counts, so only the number of seeds may be too small."""


@pytest.mark.parametrize(
    ("study", "text", "results", "expected"), CASES, ids=[f"{c[0]}-{c[1]}-{c[3]}" for c in CASES]
)
def test_verdict(study: str, text: str, results: list[Result], expected: str) -> None:
    assert verdict(claim_of(study, text), results) == expected


# what the robot is built for is in test_gait
@pytest.mark.parametrize("name", sorted(set(STUDIES) - {"gait"}))
def test_every_claim_has_a_case_for_each_of_its_verdicts(name: str) -> None:
    for claim in claims_of(name):
        own = {case[3] for case in CASES if case[0] == name and claim.text.startswith(case[1])}
        missing = {YES, PARTLY, NO, FEW} - own
        missing -= {PARTLY} if claim.text.startswith(NEVER_PARTLY) else set()
        missing -= {FEW} if claim.text.startswith(ALWAYS_TOLD) else set()
        assert not missing, claim.text


def test_every_experiment_of_the_paper_has_claims() -> None:
    assert all(claims_of(name) for name, entry in STUDIES.items() if entry.section)


@pytest.mark.parametrize("name", [name for name, entry in STUDIES.items() if entry.section])
def test_few_seeds_and_methods_that_were_not_run_give_no_verdict(name: str) -> None:
    for claim in claims_of(name):
        results = next(c[2] for c in CASES if c[0] == name and claim.text.startswith(c[1]))
        for controller in claim.controllers:
            missing = [result for result in results if result["controller"] != controller]
            assert judgements(missing, [claim])[0][1] == (f"not run: {controller}", NOT_RUN)
            few = [
                result
                for result in results
                if result["controller"] != controller or result["seed"] < claim.seeds - 1
            ]
            if claim.seeds > 1:
                assert judgements(few, [claim])[0][1] == (claim.rule(few).measured, FEW)


def test_five_seeds_are_enough() -> None:
    results = [result for result in over_mi(**FAST) if result["seed"] < 5]
    assert verdict(claim_of("mi", "the gait forms"), results) == YES


@pytest.mark.parametrize(
    ("verdicts", "all_of_them", "those_told"),
    [
        ((YES, YES), YES, YES),
        ((YES, NO), PARTLY, PARTLY),
        ((PARTLY, PARTLY), PARTLY, PARTLY),
        ((PARTLY, NO), PARTLY, PARTLY),
        ((NO, NO), NO, NO),
        ((FEW, YES), PARTLY, YES),
        ((FEW, NO), NO, NO),
        ((FEW, FEW), FEW, FEW),
        ((), FEW, FEW),
    ],
)
def test_verdicts_on_several(verdicts: tuple[str, ...], all_of_them: str, those_told: str) -> None:
    assert (of_all(verdicts), of_decided(verdicts)) == (all_of_them, those_told)


@pytest.mark.parametrize(
    ("strict", "authors", "both"),
    [
        (YES, YES, YES), (YES, PARTLY, PARTLY), (YES, NO, PARTLY), (YES, FEW, YES),
        (PARTLY, YES, PARTLY), (PARTLY, PARTLY, PARTLY), (PARTLY, NO, PARTLY),
        (PARTLY, FEW, PARTLY), (NO, YES, PARTLY), (NO, PARTLY, PARTLY), (NO, NO, NO),
        (NO, FEW, NO), (FEW, YES, PARTLY), (FEW, PARTLY, PARTLY), (FEW, NO, NO), (FEW, FEW, FEW),
    ],
)  # fmt: skip
def test_a_difference_between_the_criteria_is_partly(strict: str, authors: str, both: str) -> None:
    assert of_criteria(strict, authors) == both


def measured(rule: Callable[[Sequence[Result]], Any], results: Sequence[Result]) -> str:
    return rule(results).measured


def test_the_figures_are_told() -> None:
    results = over_mi(apnc=(2.0, 1.0), tegotae=(9.0, 8.0), phase_reset=never)
    assert measured(mi.within(9.0), results) == (
        "strict: 2.0 (2.0 ... 2.0) s, success 30/30 (88 ... 100 %); "
        "authors': 1.0 (1.0 ... 1.0) s, success 30/30 (88 ... 100 %)"
    )
    text = measured(faster([("apnc", "tegotae")], "mi"), results)
    assert re.fullmatch(
        r"strict: APNC 2\.0 \(2\.0 \.\.\. 2\.0\) s, n = 30 against Tegotae "
        r"9\.0 \(9\.0 \.\.\. 9\.0\) s, n = 30, faster in 5 of 5 cells, p < 0\.001, "
        r"r = -1\.00; authors': APNC 1\.0 \(1\.0 \.\.\. 1\.0\) s, n = 30 against .*",
        text,
    )
    text = measured(faster([("apnc", "phase_reset"), ("apnc", "phase_reset_best")], "mi"), results)
    assert text.count("against phase resetting -, n = 0 of 30, faster in 5 of 5") == 2
    assert text.count("against phase resetting (best) -, n = 0 of 30, faster in 5 of 5") == 2
    assert measured(mi.duty_at_high_mi, duty(0.5, 0.72)) == "0.70 (0.69 ... 0.72), n = 12"
    assert measured(mi.stride_line, stride(8.6, 0.5)) == (
        "S_f = 8.6 MI + 0.50; the median stride is 0 % off the paper's line"
    )
    assert measured(mi.stride_line, duty(0.5, 0.6)) == "too few"
    assert measured(mi.stride_line, stride(8.6 * 0.84, 0.5 * 0.84)).endswith(
        "16 % off the paper's line"
    )
    others = [r | {"mi": 0.28, mi.DUTY: 9.0, "controller": "tegotae"} for r in duty(0.5, 0.6)]
    text = measured(mi.duty_at_high_mi, [*duty(0.6, 0.6), *others])
    assert text == "0.60 (0.60 ... 0.60), n = 12"
    others = [r | {"stride_frequency_hz": 9.0, "controller": "tegotae"} for r in stride(8.6, 0.5)]
    apnc = [r for r in stride(8.6, 0.5) if r["controller"] == "apnc" and r["mi"] in MIS[:3]]
    assert measured(mi.stride_line, [*apnc, *others]).startswith("S_f = 8.6 MI + 0.50;")
    assert measured(mi.stride_line, [r for r in apnc if r["mi"] in MIS[:2]]) == "too few"
    assert measured(always("apnc"), over_rate(**ALIKE | {"apnc": (never, 5.0)})) == (
        "strict: 0/30 (0 ... 12 %); authors': 30/30 (88 ... 100 %)"
    )
    text = measured(
        rate.only_above(25.0, ("tegotae",)), over_rate(**ALIKE | {"tegotae": (never, 5.0)})
    )
    assert text == (
        "strict: Tegotae: 0/18 (0 ... 19 %) up to 25 Hz, 0/12 (0 ... 26 %) above; "
        "authors': Tegotae: 18/18 (81 ... 100 %) up to 25 Hz, 12/12 (74 ... 100 %) above"
    )
    text = measured(trend(STRICT, "rate", -1, ("apc", "apnc")), over_rate(**LATER))
    assert text.startswith("APC alone: too few, n = 0; APNC: rho = -0.98 (p < 0.001)")
    results = [r | {STRICT: None} if r["seed"] else r for r in over_rate(**LATER)]
    text = measured(trend(STRICT, "rate", -1, ("apnc",)), results)
    assert text.endswith(", n = 5 of 30") and "rho = -1.00" in text


def test_cells_that_only_one_walked_are_no_contest() -> None:
    """A baseline walks at fewer values than APNC."""
    results = [r for r in over_mi(**FAST) if r["controller"] == "apnc" or r["mi"] == 0.2]
    text = measured(faster([("apnc", "tegotae")], "mi"), results)
    assert "APNC 2.0 (2.0 ... 2.0) s, n = 6 against" in text and "in 1 of 1 cells" in text


def test_the_figures_of_terrain_are_told() -> None:
    results = without(scatter(dict.fromkeys(ALIKE, 1.0), dict.fromkeys(ALIKE, 2.0)), 0, STRICT)
    text = terrain.spread_grows(results, STRICT).measured
    assert re.match(
        r"APNC: 1\.7 s up to R = 0\.5, 3\.4 s above, p = 0\.0018; "
        r"Tegotae: too few, n = 0 and 0; Tegotae \(best\): 1\.7 s",
        text,
    )
    level = [result for result in results if result["roughness"] <= 0.5]
    assert terrain.spread_grows(level, STRICT).measured.count("too few") == 5
    text = terrain.fails_above(over_r(**ALIKE | {"tegotae": (never, 5.0)}), STRICT).measured
    assert text.startswith(
        "Tegotae: 0/24 (0 ... 14 %) up to R = 0.8, 0/12 (0 ... 26 %) above, p = 1; "
    )


def test_the_figures_of_conditions_are_told() -> None:
    text = measured(conditions.better_in("C2"), without(worse_balance("C2"), 7, "coordination"))
    assert text.startswith("balance against Tegotae: p = 0.00")
    assert ", r = -1.00, n = 10 and 10; balance against Tegotae (best)" in text
    assert "coordination against Tegotae: p = 0.0" in text
    assert "r = 1.00, n = 10 and 7 of 10; " in text
    text = measured(conditions.better_in("C2"), without(metrics(), 4, "balance"))
    assert text.startswith("balance against Tegotae: too few, n = 10 and 4 of 10; ")
    text = measured(conditions.alike_in("C1"), metrics(C1=1.0))
    assert [part.split(":")[0] for part in text.split("; ")] == [
        f"{metric} against {named_controller(label).name}"
        for metric in ("balance", "coordination", "cost_of_transport")
        for label in BASELINES
    ]


def test_the_other_figures_are_told() -> None:
    results = speeds(apnc=0.3, tegotae=0.2, phase_reset=None)
    assert re.fullmatch(
        r"APNC: 0\.300 \(.*\) m/s, n = 6; Tegotae: 0\.200 \(.*\) m/s, n = 6, "
        r"p = 0\.0022; phase resetting: -, n = 0 of 6; "
        r"phase resetting \(best\): -, n = 0 of 6",
        measured(damage.fastest, results),
    )
    results = [
        result | {"state_speed_s1": 0.1, "state_formation_time_s": 1.8 if result["seed"] else None}
        for result in in_states("S1", "apnc", 10)
    ]
    assert measured(states.state("S1", "apnc", states.FORMED), results) == (
        "10/10 (69 ... 100 %), speed 0.100 (0.100 ... 0.100) m/s, n = 10, "
        "formed after 1.8 (1.8 ... 1.8) s, n = 9 of 10"
    )
    assert measured(states.state("S3", "apc"), results) == "0/10 (0 ... 31 %), speed -, n = 0 of 10"
    text = measured(states.without_gait("S2"), kept("S2", formed=8, tegotae=2, phase_reset=0))
    assert text.startswith("Tegotae: gait in 2/8 (3 ... 65 %), speed -, n = 0 of 8; ")
    text = measured(states.without_gait("S2"), kept("S2", formed=0, tegotae=0, phase_reset=0))
    assert text.startswith("Tegotae: no run had the gait before; ")
    assert measured(states.gamma_by_itself, gammas(0.95)) == (
        "imposed in APNC by feedback_kept; APNC: 0.300 to 0.060, n = 6; "
        "APNC, feedback kept: 0.300 to 0.285, n = 6, ratio 0.95 (0.95 ... 0.95)"
    )
    results = [r for r in sections("speed", 0.08, 0.16, 0.08) if r["seed"] == 0]
    assert measured(steering.speed_steps, results) == (
        "0.080 (0.080 ... 0.080) m/s, n = 1, 0.160 (0.160 ... 0.160) m/s, n = 1, "
        "0.080 (0.080 ... 0.080) m/s, n = 1"
    )
    results = [r for r in sections("yaw_rate", 0.0, -0.2, 0.2) if r["seed"] == 0]
    assert measured(steering.turns, results) == (
        "right -0.20 (-0.20 ... -0.20) rad/s, n = 1, left 0.20 (0.20 ... 0.20) rad/s, n = 1"
    )
    text = measured(steering.slopes_speed, on_slopes(0.06, 0.08, 0.1, 0.12, 0.14))
    assert text.startswith("APNC: rho = 0.98 (p < 0.001)") and "0.060) m/s at 0.6, 0.080" in text
    text = measured(gains.too_strong, over_gain())
    assert text.startswith(
        "Tegotae: stopped in 6/6 (54 ... 100 %) at 4, in 0/6 (0 ... 46 %) at 1; APNC: "
    )
    text = gains.too_weak(over_gain(weak=never), STRICT).measured
    assert text.startswith("Tegotae: -, n = 0 of 6 at 0.01, 2.0 (2.0 ... 2.0) s, n = 6 at 1")


def test_holm_corrects_over_all_tests_of_all_metrics() -> None:
    """Among 48 tests the least p counts 48 times, and 40 if eight cannot be made."""
    results = [
        result
        | (
            {"balance": 13.0}
            if result["controller"] == "apnc" and result["condition"] == "C1"
            else {}
        )
        for result in metrics()
    ]
    for known, count in ((results, 48), (without(results, 4, "balance", "coordination"), 40)):
        tests = conditions.comparisons(known)
        assert len(tests) == 48
        p, least = min((test.test.p, test) for test in tests if test.test is not None)
        own, other = (
            values(results, least.metric, controller=controller, condition=least.condition)
            for controller in ("apnc", least.controller)
        )
        assert p == pytest.approx(count * stats.mannwhitneyu(own, other).pvalue)


def test_a_robot_that_fell_has_not_succeeded() -> None:
    results = [result | {"fell": result["seed"] == 0} for result in over_rate(**ALIKE)]
    assert verdict(claim_of("rate", "APNC succeeds"), results) == NO

"""Every rule on rows that must give each verdict."""

from __future__ import annotations

import importlib
import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import pytest
from made_up_rows import Row, made_up
from scipy import stats

from apnc.studies import conditions, damage, forward_model, mi, rate, states, steering, terrain
from apnc.studies.claims import (
    FEW,
    NO,
    NOT_RUN,
    PARTLY,
    YES,
    Claim,
    always,
    faster,
    findings,
    trend,
)
from apnc.studies.registry import STUDIES
from apnc.studies.rows import AUTHORS, STRICT, values

Number = Callable[[Row], float | None]
MIS = (0.04, 0.12, 0.2, 0.24, 0.28)
RATES = (5.0, 15.0, 25.0, 30.0, 60.0)
ROUGH = (0.0, 0.3, 0.5, 0.8, 0.9, 1.0)


def when(**by_method: Any) -> Callable[[Row], Row]:
    """Strict and authors' times: a number, a function of the cell, or both of them in a tuple."""

    def figures(cell: Row) -> Row:
        given = by_method[cell["method"]]
        strict, authors = given if isinstance(given, tuple) else (given, given)
        jitter = 0.01 * cell["seed"]

        def time(value: Any) -> float | None:
            value = value(cell) if callable(value) else value
            return None if value is None else value + jitter

        return {STRICT: time(strict), AUTHORS: time(authors)}

    return figures


def verdict(claim: Claim, rows: Sequence[Row]) -> str:
    return findings(rows, [claim])[0][1].verdict


def claims_of(study: str) -> tuple[Claim, ...]:
    # made anew: a mutation run switches a mutant on after modules were imported
    module = importlib.reload(importlib.import_module(f"apnc.studies.{study}"))
    claims: tuple[Claim, ...] = module.STUDY.claims
    return claims


def claim_of(study: str, text: str) -> Claim:
    (found,) = [claim for claim in claims_of(study) if claim.text.startswith(text)]
    return found


def never(cell: Row) -> None:
    return None


def by(axis: str, limit: float, low: float | None, high: float | None) -> Number:
    """One value up to a limit of an axis, another above it."""
    return lambda cell: high if cell[axis] > limit else low


def over_mi(**times: Any) -> list[Row]:
    return made_up({"mi": MIS}, when(**times))


def over_rate(**times: Any) -> list[Row]:
    return made_up({"rate": RATES}, when(**times), study="rate")


def over_r(**times: Any) -> list[Row]:
    return made_up({"roughness": ROUGH}, when(**times), study="terrain")


def duty(low: float, high: float) -> list[Row]:
    return made_up({"mi": MIS}, lambda c: {"duty_factor_mean": low + (high - low) * c["mi"] / 0.28})


def stride(slope: float, offset: float) -> list[Row]:
    return made_up({"mi": MIS}, lambda c: {"stride_frequency_hz": slope * c["mi"] + offset})


def scatter(smooth: Mapping[str, float], rough: Mapping[str, float]) -> list[Row]:
    def figures(cell: Row) -> Row:
        wide = (rough if cell["roughness"] > 0.5 else smooth)[cell["method"]]
        return {STRICT: 10.0 + wide * (-1) ** cell["seed"]}

    return made_up({"roughness": ROUGH}, figures, study="terrain")


def metrics(**edge: float) -> list[Row]:
    """APNC is better by ``edge`` in a condition: steadier, better coordinated, cheaper."""

    def figures(cell: Row) -> Row:
        better = edge.get(cell["condition"], 0.0) if cell["method"] == "apnc" else 0.0
        noise = 0.01 * ((cell["seed"] * 7 + len(cell["method"])) % 10)
        return {
            "balance": 10.0 + noise + better,
            "coordination": 5.0 + noise + better,
            "cost_of_transport": 3.0 + noise - better,
        }

    cells = {"condition": ("C1", "C2", "C3", "C4")}
    return made_up(cells, figures, seeds=10, study="conditions")


def worse_balance(condition: str) -> list[Row]:
    rows = metrics(**{condition: 1.0})
    return [r | {"balance": r["balance"] - 2.0 * (r["method"] == "apnc")} for r in rows]


def speeds(**by_method: float | None) -> list[Row]:
    def figures(cell: Row) -> Row:
        speed = by_method[cell["method"]]
        return {"path_speed_m_per_s": None if speed is None else speed + 1e-4 * cell["seed"]}

    return made_up({"condition": ("C3",)}, figures, study="damage")


def in_states(name: str, method: str, hits: int) -> list[Row]:
    """So many of ten runs of a method went as the paper says, all of the other did or none."""

    def figures(cell: Row) -> Row:
        good = cell["seed"] < hits if cell["method"] == method else hits == 0
        others = {f"state_{s}": hits == 0 for s in ("S1", "S2", "S3")}
        return others | {f"state_{name}": good}

    return made_up({}, figures, methods=("apnc", "apc"), seeds=10, study="states")


def sections(column: str, *means: float | None) -> list[Row]:
    def figures(cell: Row) -> Row:
        wobble = 1e-3 * cell["seed"]
        return {
            f"{column}_section_{i}": None if mean is None else mean + wobble
            for i, mean in enumerate(means, start=1)
        }

    return made_up({"course": ("any",)}, figures, methods=("apnc",), study="steering")


FAST = {"apnc": 2.0, "tegotae": 9.0, "phase_reset": 1.0}
ALIKE = dict.fromkeys(("apnc", "tegotae", "phase_reset"), 5.0)
SLOW = {"apnc": 9.0, "tegotae": 2.0, "phase_reset": 9.5}
LATER = dict.fromkeys(ALIKE, lambda c: 20.0 - c.get("rate", 0) / 10)

CASES: list[tuple[str, str, list[Row], str]] = [
    ("mi", "the gait forms rapidly", over_mi(**FAST), YES),
    ("mi", "the gait forms rapidly", over_mi(**FAST | {"apnc": by("mi", 0.04, None, 2.0)}), PARTLY),
    ("mi", "the gait forms rapidly", over_mi(**FAST | {"apnc": 9.1}), NO),
    ("mi", "the gait forms rapidly", over_mi(**FAST | {"apnc": never}), NO),
    ("mi", "APNC converges faster", over_mi(**FAST), YES),
    ("mi", "APNC converges faster", over_mi(**FAST | {"tegotae": never}), YES),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": by("mi", 0.24, 2.0, 10.0)}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": by("mi", 0.24, 2.0, None)}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": (never, 2.0)}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": (10.0, 2.0)}), PARTLY),
    ("mi", "APNC converges faster", over_mi(**FAST | {"apnc": (2.0, 10.0)}), YES),
    ("mi", "APNC converges faster", over_mi(**SLOW), NO),
    ("mi", "APNC converges faster", over_mi(**ALIKE), NO),
    ("mi", "phase resetting converges faster", over_mi(**FAST), YES),
    ("mi", "phase resetting converges faster", over_mi(**SLOW), NO),
    ("mi", "the duty factor grows", duty(0.5, 0.7), YES),
    ("mi", "the duty factor grows", duty(0.7, 0.5), NO),
    ("mi", "from MI 0.24 on", duty(0.5, 0.72), YES),
    ("mi", "from MI 0.24 on", duty(0.72, 0.76), YES),
    ("mi", "from MI 0.24 on", duty(0.72, 0.8), PARTLY),
    ("mi", "from MI 0.24 on", duty(0.72, 0.55), PARTLY),
    ("mi", "from MI 0.24 on", duty(0.72, 0.45), NO),
    ("mi", "the stride frequency", stride(8.6, 0.5), YES),
    ("mi", "the stride frequency", stride(8.6 * 1.14, 0.5 * 1.14), YES),
    ("mi", "the stride frequency", stride(8.6 * 0.84, 0.5 * 0.84), PARTLY),
    ("mi", "the stride frequency", stride(-8.6, 4.0), NO),
    ("mi", "the stride frequency", duty(0.5, 0.7), NO),
    ("rate", "a higher update rate", over_rate(**LATER), YES),
    ("rate", "a higher update rate", over_rate(**LATER | {"tegotae": 5.0}), PARTLY),
    ("rate", "a higher update rate", over_rate(**dict.fromkeys(ALIKE, lambda c: c["rate"])), NO),
    ("rate", "APNC succeeds in every trial", over_rate(**ALIKE), YES),
    ("rate", "APNC succeeds in every trial",
     over_rate(**ALIKE | {"apnc": lambda c: None if c["rate"] == 5 and c["seed"] < 3 else 3.0}),
     PARTLY),
    ("rate", "APNC succeeds in every trial", over_rate(**ALIKE | {"apnc": (never, 5.0)}), PARTLY),
    ("rate", "APNC succeeds in every trial",
     over_rate(**ALIKE | {"apnc": by("rate", 5.0, None, 3.0)}), NO),
    ("rate", "Tegotae and phase resetting",
     over_rate(**dict.fromkeys(ALIKE, by("rate", 25.0, None, 3.0))), YES),
    ("rate", "Tegotae and phase resetting",
     over_rate(**ALIKE | {"tegotae": by("rate", 25.0, None, 3.0)}), PARTLY),
    ("rate", "Tegotae and phase resetting", over_rate(**ALIKE), NO),
    ("rate", "Tegotae and phase resetting",
     over_rate(**dict.fromkeys(ALIKE, by("rate", 30.0, None, 3.0))), NO),
    ("rate", "APNC converges faster", over_rate(**FAST), YES),
    ("rate", "APNC converges faster", over_rate(**SLOW), NO),
    ("terrain", "rougher ground",
     over_r(**dict.fromkeys(ALIKE, lambda c: 3.0 + c["roughness"])), YES),
    ("terrain", "rougher ground",
     over_r(**ALIKE | {"apnc": lambda c: 3.0 + c["roughness"]}), PARTLY),
    ("terrain", "rougher ground",
     over_r(**dict.fromkeys(ALIKE, lambda c: 3.0 - c["roughness"])), NO),
    ("terrain", "the spread", scatter(dict.fromkeys(ALIKE, 1.0), dict.fromkeys(ALIKE, 2.0)), YES),
    ("terrain", "the spread", scatter(ALIKE, ALIKE | {"apnc": 6.0}), PARTLY),
    ("terrain", "the spread", scatter(dict.fromkeys(ALIKE, 2.0), dict.fromkeys(ALIKE, 1.0)), NO),
    ("terrain", "above R = 80 %",
     over_r(**ALIKE | {"tegotae": lambda c: None if c["roughness"] == 1.0 else 3.0}), YES),
    ("terrain", "above R = 80 %", over_r(**ALIKE), NO),
    ("terrain", "above R = 80 %", over_r(**ALIKE | {"tegotae": (3.0, never)}), NO),
    ("terrain", "above R = 80 %",
     over_r(**ALIKE | {"tegotae": lambda c: None if c["roughness"] == 0.8 else 3.0}), NO),
    ("terrain", "APNC forms the gait", over_r(**ALIKE), YES),
    ("terrain", "APNC forms the gait", over_r(**ALIKE | {"apnc": never}), NO),
    ("terrain", "APNC converges faster than Tegotae", over_r(**FAST), YES),
    ("terrain", "APNC converges faster than Tegotae", over_r(**SLOW), NO),
    ("terrain", "APNC converges faster than phase", over_r(**FAST), NO),
    ("terrain", "APNC converges faster than phase", over_r(**SLOW), YES),
    ("conditions", "in C1", metrics(C2=1.0), YES),
    ("conditions", "in C1", metrics(C1=1.0), NO),
    ("conditions", "in C1", worse_balance("C2"), PARTLY),
    ("conditions", "with noise (C2)", metrics(C2=1.0), YES),
    ("conditions", "with noise (C2)", worse_balance("C2"), PARTLY),
    ("conditions", "with noise (C2)", metrics(C3=1.0), NO),
    ("conditions", "with noise (C2)", metrics(C2=-1.0), NO),
    ("conditions", "with a damaged leg (C3)", metrics(C3=1.0), YES),
    ("conditions", "with a damaged leg (C3)", metrics(C2=1.0), NO),
    ("conditions", "with a payload (C4)", metrics(C4=1.0), YES),
    ("conditions", "with a payload (C4)", metrics(C2=1.0), NO),
    ("damage", "with a damaged leg", speeds(apnc=0.3, tegotae=0.2, phase_reset=0.1), YES),
    ("damage", "with a damaged leg", speeds(apnc=0.1, tegotae=None, phase_reset=None), YES),
    ("damage", "with a damaged leg", speeds(apnc=0.2, tegotae=0.3, phase_reset=0.1), PARTLY),
    ("damage", "with a damaged leg", speeds(apnc=0.1, tegotae=0.3, phase_reset=0.1), NO),
    ("damage", "with a damaged leg", speeds(apnc=None, tegotae=None, phase_reset=None), NO),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.16, 0.08), YES),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.12, 0.08), PARTLY),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.21, 0.08), PARTLY),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.16, 0.1), PARTLY),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.07, 0.08), NO),
    ("steering", "MI 0.15, 0.4, 0.15", sections("speed", 0.08, 0.16, None), NO),
    ("steering", "steeper slopes", sections("yaw_rate", 0.0, -0.2, 0.2, 0.0), YES),
    ("steering", "steeper slopes", sections("yaw_rate", 0.0, 0.1, 0.2, 0.0), PARTLY),
    ("steering", "steeper slopes", sections("yaw_rate", 0.0, -0.2, -0.1, 0.0), PARTLY),
    ("steering", "steeper slopes", sections("yaw_rate", 0.0, 0.2, -0.2, 0.0), NO),
    ("steering", "steeper slopes", sections("yaw_rate", 0.0, None, None, 0.0), NO),
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


@pytest.mark.parametrize(
    ("study", "text", "rows", "expected"), CASES, ids=[f"{c[0]}-{c[1]}-{c[3]}" for c in CASES]
)
def test_verdict(study: str, text: str, rows: list[Row], expected: str) -> None:
    assert verdict(claim_of(study, text), rows) == expected


def test_every_claim_has_a_case_for_yes_and_for_no() -> None:
    for name in STUDIES:
        for claim in claims_of(name):
            own = {case[3] for case in CASES if case[0] == name and claim.text.startswith(case[1])}
            assert {YES, NO} <= own, claim.text


def test_every_experiment_of_the_paper_has_claims() -> None:
    assert all(claims_of(name) for name, entry in STUDIES.items() if entry.place)


@pytest.mark.parametrize("name", [name for name, entry in STUDIES.items() if entry.place])
def test_few_seeds_and_methods_that_were_not_run_give_no_verdict(name: str) -> None:
    rows = next(case[2] for case in CASES if case[0] == name)
    few = [row for row in rows if row["seed"] < 4]
    for claim, finding in findings(few, claims_of(name)):
        assert finding == (claim.rule(few).measured, FEW)
    for claim in claims_of(name):
        for method in claim.methods:
            without = [row for row in rows if row["method"] != method]
            assert findings(without, [claim])[0][1] == (f"not run: {method}", NOT_RUN)


def test_five_seeds_are_enough() -> None:
    rows = [row for row in over_mi(**FAST) if row["seed"] < 5]
    assert verdict(claim_of("mi", "the gait forms"), rows) == YES


def measured(rule: Callable[[Sequence[Row]], Any], rows: Sequence[Row]) -> str:
    return rule(rows).measured


def test_the_figures_are_told() -> None:
    rows = over_mi(apnc=(2.0, 1.0), tegotae=(9.0, 8.0), phase_reset=never)
    assert measured(mi.within(9.0), rows) == (
        "strict: 2.0 (2.0 ... 2.0) s, success 30/30 (88 ... 100 %); authors': 1.0 (1.0 ... 1.0) s"
    )
    text = measured(faster("apnc", "tegotae", "mi"), rows)
    assert re.fullmatch(
        r"strict: median 2\.0 \(2\.0 \.\.\. 2\.0\) s against 9\.0 \(9\.0 \.\.\. 9\.0\) s, "
        r"faster in 5 of 5 cells, p = \d\.\de-11, r = -1\.00; authors': median 1\.0 "
        r"\(1\.0 \.\.\. 1\.0\) s against 8\.0 \(8\.0 \.\.\. 8\.0\) s, faster in 5 of 5 cells, "
        r"p = \d\.\de-11, r = -1\.00",
        text,
    )
    assert measured(mi.duty_at_high_mi, duty(0.5, 0.72)) == "0.70 (0.69 ... 0.72)"
    assert measured(mi.stride_line, stride(8.6, 0.5)) == (
        "S_f = 8.6 MI + 0.50; the median stride is 0 % off the paper's line"
    )
    assert measured(mi.stride_line, duty(0.5, 0.6)) == "too few"
    assert measured(mi.stride_line, stride(8.6 * 0.84, 0.5 * 0.84)).endswith(
        "16 % off the paper's line"
    )
    others = [
        r | {"mi": 0.28, "duty_factor_mean": 9.0, "method": "tegotae"} for r in duty(0.5, 0.6)
    ]
    assert measured(mi.duty_at_high_mi, [*duty(0.6, 0.6), *others]) == "0.60 (0.60 ... 0.60)"
    others = [r | {"stride_frequency_hz": 9.0, "method": "tegotae"} for r in stride(8.6, 0.5)]
    apnc = [r for r in stride(8.6, 0.5) if r["method"] == "apnc" and r["mi"] in MIS[:3]]
    assert measured(mi.stride_line, [*apnc, *others]).startswith("S_f = 8.6 MI + 0.50;")
    assert measured(mi.stride_line, [r for r in apnc if r["mi"] in MIS[:2]]) == "too few"
    assert measured(always("apnc"), over_rate(**ALIKE | {"apnc": (never, 5.0)})) == (
        "strict: 0/30 (0 ... 12 %); authors': 30/30 (88 ... 100 %)"
    )
    text = measured(
        rate.only_above(25.0, ("tegotae",)), over_rate(**ALIKE | {"tegotae": (never, 5.0)})
    )
    assert text == (
        "strict: tegotae: 0/18 (0 ... 19 %) up to 25 Hz, 0/12 (0 ... 26 %) above; "
        "authors': tegotae: 18/18 (81 ... 100 %) up to 25 Hz, 12/12 (74 ... 100 %) above"
    )
    text = measured(trend(STRICT, "rate", -1, ("apc", "apnc"), "time and rate"), over_rate(**LATER))
    assert text.startswith(
        "rank correlation of time and rate, apc: too few; apnc: rho = -0.98 (p = "
    )


def test_the_figures_of_terrain_are_told() -> None:
    rows = scatter(dict.fromkeys(ALIKE, 1.0), dict.fromkeys(ALIKE, 2.0))
    without = [row | ({STRICT: None} if row["method"] == "tegotae" else {}) for row in rows]
    assert measured(terrain.spread_grows, without) == (
        "standard deviation, apnc: 1.0 s up to R = 0.5, 2.0 s above; tegotae: too few; "
        "phase_reset: 1.0 s up to R = 0.5, 2.0 s above"
    )
    level = [row for row in rows if row["roughness"] <= 0.5]
    assert measured(terrain.spread_grows, level).count("too few") == 3
    text = measured(terrain.not_always_above_08, over_r(**ALIKE | {"tegotae": (never, 5.0)}))
    assert text == "strict: 0/12 (0 ... 26 %); authors': 12/12 (74 ... 100 %)"


def test_the_figures_of_conditions_are_told() -> None:
    text = measured(conditions.better_in("C2"), worse_balance("C2"))
    assert text.startswith("balance no better than tegotae (r = -1.00); balance no better than ")
    assert "coordination better than tegotae (r = 1.00)" in text
    assert text.endswith("cost_of_transport better than phase_reset (r = -1.00)")
    text = measured(conditions.alike_in("C1"), metrics(C1=1.0))
    assert text.startswith("balance against tegotae: p = 0.00")
    assert [part.split(":")[0] for part in text.split("; ")] == [
        f"{metric} against {method}"
        for metric in ("balance", "coordination", "cost_of_transport")
        for method in ("tegotae", "phase_reset")
    ]


def test_the_other_figures_are_told() -> None:
    rows = speeds(apnc=0.3, tegotae=0.2, phase_reset=None)
    assert measured(damage.fastest, rows) == (
        "apnc: 0.300 (0.300 ... 0.300) m/s; tegotae: 0.200 (0.200 ... 0.200) m/s; phase_reset: -"
    )
    rows = [
        row | {"state_speed_s1": 0.1, "state_formation_time_s": 1.8}
        for row in in_states("S1", "apnc", 10)
    ]
    assert measured(states.state("S1", "apnc", states.FORMED), rows) == (
        "10/10 (69 ... 100 %), speed 0.100 (0.100 ... 0.100) m/s, formed after 1.8 (1.8 ... 1.8) s"
    )
    assert measured(states.state("S3", "apc"), rows) == "0/10 (0 ... 31 %), speed -"
    rows = [r for r in sections("speed", 0.08, 0.16, 0.08) if r["seed"] == 0]
    assert measured(steering.speed_steps, rows) == (
        "0.080 (0.080 ... 0.080), 0.160 (0.160 ... 0.160), 0.080 (0.080 ... 0.080) m/s"
    )
    assert measured(steering.speed_steps, sections("speed", None, None, None)) == "-, -, -"
    rows = [r for r in sections("yaw_rate", 0.0, -0.2, 0.2) if r["seed"] == 0]
    assert measured(steering.turns, rows) == (
        "right -0.20 (-0.20 ... -0.20), left 0.20 (0.20 ... 0.20) rad/s"
    )


def of_models(**figures: Any) -> list[Row]:
    """Walks with every forward model; a figure is a number, or a function of the cell."""
    axes = {"model": tuple(forward_model.MODELS), "mi": (0.08, 0.15)}
    return made_up(
        axes,
        lambda cell: {k: v(cell) if callable(v) else v for k, v in figures.items()},
        ("apnc",),
        study="forward_model",
    )


@pytest.mark.parametrize("model", ["low_pass_knee", "radial_basis"])
@pytest.mark.parametrize(
    ("failing", "expected"), [(0, YES), (1, PARTLY), (6, NO)], ids=["none", "one", "half"]
)
def test_a_forward_model_forms_the_gait(model: str, failing: int, expected: str) -> None:
    def time(cell: Row) -> float | None:
        lost = cell["model"] == model and cell["mi"] == 0.15 and cell["seed"] < failing
        return None if lost else 2.0

    rows = of_models(**{STRICT: time, AUTHORS: time})
    assert forward_model.forms(model)(rows).verdict == expected
    other = "radial_basis" if model == "low_pass_knee" else "low_pass_knee"
    assert forward_model.forms(other)(rows).verdict == YES


@pytest.mark.parametrize(
    ("late", "expected"), [(0.02, YES), (0.08, PARTLY), (0.12, NO), (None, NO)]
)
def test_the_gain_falls_of_itself(late: float | None, expected: str) -> None:
    rows = of_models(
        gain_forming=0.1, gain_late=lambda c: late if c["model"] == "radial_basis" else 0.02
    )
    assert forward_model.gain_falls("radial_basis")(rows).verdict == expected
    assert forward_model.gain_falls("low_pass_hip")(rows).verdict == YES


def test_the_figures_of_the_forward_models_are_told() -> None:
    rows = of_models(gain_forming=0.1, gain_late=0.025)
    assert measured(forward_model.gain_falls("radial_basis"), rows) == (
        "0.100 (0.100 ... 0.100), late 0.025 (0.025 ... 0.025), ratio 0.25 (0.25 ... 0.25), n = 12"
    )
    rows = of_models(**{STRICT: 2.0, AUTHORS: None})
    assert measured(forward_model.forms("radial_basis"), rows) == (
        "strict: 12/12 (74 ... 100 %), 2.0 (2.0 ... 2.0) s, with the hip's 2.0 (2.0 ... 2.0) s; "
        "authors': 0/12 (0 ... 26 %), -, with the hip's -"
    )


def test_holm_corrects_over_all_tests_of_all_metrics() -> None:
    """Among 24 tests the least p counts 24 times."""
    rows = [
        row | ({"balance": 13.0} if row["method"] == "apnc" and row["condition"] == "C1" else {})
        for row in metrics()
    ]
    tests = conditions.comparisons(rows)
    assert len(tests) == 24
    least = min(tests, key=lambda test: test.p)
    own, other = (
        values(rows, least.metric, method=method, condition=least.condition)
        for method in ("apnc", least.method)
    )
    assert least.p == pytest.approx(24 * stats.mannwhitneyu(own, other).pvalue)


def test_a_robot_that_fell_has_not_succeeded() -> None:
    rows = [row | {"fell": row["seed"] == 0} for row in over_rate(**ALIKE)]
    assert verdict(claim_of("rate", "APNC succeeds"), rows) == NO

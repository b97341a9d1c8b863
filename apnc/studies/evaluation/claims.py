"""What section 3 of the paper says, what was measured, and whether that is the same conclusion."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from scipy import stats

from apnc.studies.evaluation.figures import METRICS, significance, values
from apnc.studies.evaluation.statistics import Median, compare, median, rate
from apnc.studies.evaluation.trial import Row, finite

STRICT: Final = "convergence_time_s"
AUTHORS: Final = "convergence_time_authors_s"
YES, PARTLY, NO, FEW = "reproduced", "partly", "not", "too few trials"

MIN_SEEDS: Final = 5
"""Fewer seeds than this give figures, but no verdict."""


@dataclass(frozen=True)
class Finding:
    """What a claim came to: the figures and the verdict."""

    measured: str
    verdict: str


Check = Callable[[Sequence[Row]], Finding]


@dataclass(frozen=True)
class Claim:
    """A claim of the paper and how it is checked on the rows of a study."""

    study: str
    place: str
    text: str
    check: Check


def _verdict(full: bool, part: bool) -> str:
    return YES if full else PARTLY if part else NO


def _success(rows: Sequence[Row], column: str = STRICT, **where: Any) -> list[bool]:
    inside = [r for r in rows if all(r.get(k) == v for k, v in where.items())]
    return [finite(r.get(column)) and not r.get("fell") for r in inside]


def _both(check: Callable[[str], tuple[str, bool, bool]]) -> Finding:
    """A check under both criteria; the strict one decides, a difference makes it 'partly'."""
    strict_text, strict_full, strict_part = check(STRICT)
    authors_text, authors_full, authors_part = check(AUTHORS)
    verdict = _verdict(strict_full, strict_part or authors_full or authors_part)
    return Finding(f"strict: {strict_text}; authors': {authors_text}", verdict)


def _faster(fast: str, slow: str, axis: str) -> Check:
    def check(rows: Sequence[Row]) -> Finding:
        def one(column: str) -> tuple[str, bool, bool]:
            cells = sorted({r[axis] for r in rows})
            won, told = 0, 0
            for cell in cells:
                a = values(rows, column, method=fast, **{axis: cell})
                b = values(rows, column, method=slow, **{axis: cell})
                if a and (b or not _success(rows, column, method=slow, **{axis: cell})):
                    told += 1
                    won += bool(b) and float(np.median(a)) < float(np.median(b))
                elif a:
                    told, won = told + 1, won + 1
            a, b = values(rows, column, method=fast), values(rows, column, method=slow)
            test = compare(a, b)
            text = (
                f"median {median(a).text(1, 's')} against {median(b).text(1, 's')}, faster in "
                f"{won} of {len(cells)} cells, p = {test.p:.1e}, r = {test.effect:.2f}"
            )
            return text, won == len(cells), won > len(cells) / 2

        return _both(one)

    return check


def _within(limit: float, column_limit: float | None = None) -> Check:
    def check(rows: Sequence[Row]) -> Finding:
        times = values(rows, STRICT, method="apnc")
        early = values(rows, AUTHORS, method="apnc")
        hits = rate(_success(rows, method="apnc"))
        middle, loose = median(times), median(early)
        full = middle.count > 0 and middle.value <= limit and hits.value == 1.0
        text = f"strict: {middle.text(1, 's')}, success {hits}; authors': {loose.text(1, 's')}"
        return Finding(text, _verdict(full, middle.count > 0 and middle.value <= limit))

    return check


def _trend(column: str, axis: str, sign: int, methods: Sequence[str], name: str) -> Check:
    def check(rows: Sequence[Row]) -> Finding:
        texts, agree = [], 0
        for method in methods:
            pairs = [
                (float(r[axis]), float(r[column]))
                for r in rows
                if r["method"] == method and finite(r.get(column))
            ]
            if len(pairs) < 3 or min(len(set(column)) for column in zip(*pairs, strict=True)) < 2:
                texts.append(f"{method}: too few")
                continue
            test = stats.spearmanr(*zip(*pairs, strict=True))
            agree += sign * test.statistic > 0 and test.pvalue <= 0.05
            texts.append(f"{method}: rho = {test.statistic:.2f} (p = {test.pvalue:.1e})")
        text = f"rank correlation of {name}, " + "; ".join(texts)
        return Finding(text, _verdict(agree == len(methods), agree > 0))

    return check


def _always(method: str, **where: Any) -> Check:
    def check(rows: Sequence[Row]) -> Finding:
        def one(column: str) -> tuple[str, bool, bool]:
            hits = rate(_success(rows, column, method=method, **where))
            return str(hits), hits.value == 1.0, hits.value >= 0.9

        return _both(one)

    return check


def _only_above(limit: float, methods: Sequence[str]) -> Check:
    def check(rows: Sequence[Row]) -> Finding:
        def one(column: str) -> tuple[str, bool, bool]:
            texts, good = [], 0
            for method in methods:
                low = [r for r in rows if r["method"] == method and r["rate"] <= limit]
                high = [r for r in rows if r["method"] == method and r["rate"] > limit]
                below, above = rate(_success(low, column)), rate(_success(high, column))
                good += above.value == 1.0 and below.value < 1.0
                texts.append(f"{method}: {below} up to {limit:g} Hz, {above} above")
            return "; ".join(texts), good == len(methods), good > 0

        return _both(one)

    return check


def _duty_at_high_mi(rows: Sequence[Row]) -> Finding:
    high = [r for r in rows if r["method"] == "apnc" and r["mi"] >= 0.24]
    middle = median(values(high, "duty_factor_mean"))
    near = middle.count > 0 and abs(middle.value - 0.72) <= 0.05
    return Finding(middle.text(2), _verdict(near, middle.count > 0 and middle.value > 0.5))


def _stride_line(rows: Sequence[Row]) -> Finding:
    pairs = [
        (float(r["mi"]), float(r["stride_frequency_hz"]))
        for r in rows
        if r["method"] == "apnc" and finite(r.get("stride_frequency_hz"))
    ]
    if len(pairs) < 3:
        return Finding("too few", NO)
    fit = stats.linregress(*zip(*pairs, strict=True))
    off = [abs(f / (8.6 * mi + 0.5) - 1.0) for mi, f in pairs]
    text = (
        f"S_f = {fit.slope:.1f} MI + {fit.intercept:.2f}; the median stride is "
        f"{100 * float(np.median(off)):.0f} % off the paper's line"
    )
    return Finding(text, _verdict(float(np.median(off)) <= 0.15, fit.slope > 0))


def _spread_grows(rows: Sequence[Row]) -> Finding:
    texts, agree = [], 0
    methods = ("apnc", "tegotae", "phase_reset")
    for method in methods:
        smooth = [r for r in rows if r["method"] == method and r["roughness"] <= 0.5]
        rough = [r for r in rows if r["method"] == method and r["roughness"] > 0.5]
        a, b = values(smooth, STRICT), values(rough, STRICT)
        if len(a) < 2 or len(b) < 2:
            texts.append(f"{method}: too few")
            continue
        agree += bool(np.std(b) > np.std(a))
        texts.append(f"{method}: {np.std(a):.1f} s up to R = 0.5, {np.std(b):.1f} s above")
    return Finding("standard deviation, " + "; ".join(texts), _verdict(agree == 3, agree > 0))


def _rough_success(rows: Sequence[Row]) -> Finding:
    high = [r for r in rows if r["method"] == "tegotae" and r["roughness"] > 0.8]
    strict, loose = rate(_success(high, STRICT)), rate(_success(high, AUTHORS))
    full = strict.trials > 0 and strict.value < 1.0
    return Finding(f"strict: {strict}; authors': {loose}", _verdict(full, False))


def _alike_in_c1(rows: Sequence[Row]) -> Finding:
    texts, alike = [], 0
    for metric in METRICS:
        for condition, method, test in significance(rows, metric):
            if condition == "C1":
                alike += test.p > 0.05
                texts.append(f"{metric} against {method}: p = {test.p:.2g}, r = {test.effect:.2f}")
    return Finding("; ".join(texts), _verdict(alike == len(texts) > 0, alike > 0))


def _better_in(condition: str) -> Check:
    def check(rows: Sequence[Row]) -> Finding:
        texts, better, tests = [], 0, 0
        for metric in METRICS:
            sign = -1.0 if metric == "cost_of_transport" else 1.0
            for where, method, test in significance(rows, metric):
                if where == condition:
                    tests += 1
                    won = test.p <= 0.05 and sign * test.effect > 0
                    better += won
                    word = "better" if won else "no better"
                    texts.append(f"{metric} {word} than {method} (r = {test.effect:.2f})")
        return Finding("; ".join(texts), _verdict(better == tests > 0, better > tests / 2))

    return check


def _fastest_damaged(rows: Sequence[Row]) -> Finding:
    speeds: dict[str, Median] = {
        m: median(values(rows, "path_speed_m_per_s", method=m))
        for m in ("apnc", "tegotae", "phase_reset")
    }
    text = "; ".join(f"{m}: {s.text(3, 'm/s')}" for m, s in speeds.items())
    best = max(speeds, key=lambda m: speeds[m].value if speeds[m].count else -1.0)
    beaten = sum(speeds["apnc"].value > s.value for m, s in speeds.items() if m != "apnc")
    return Finding(text, _verdict(best == "apnc", beaten > 0))


def _state(name: str, method: str) -> Check:
    def check(rows: Sequence[Row]) -> Finding:
        hits = rate([bool(r.get(f"state_{name}")) for r in rows if r["method"] == method])
        speed = median(values(rows, f"state_speed_{name.lower()}", method=method))
        text = f"{hits}, speed {speed.text(3, 'm/s')}"
        if name == "S1":
            when = median(values(rows, "state_formation_time_s", method=method))
            text += f", formed after {when.text(1, 's')}"
        if name == "S3" and method == "apnc":
            when = median(values(rows, "state_recovery_time_s", method=method))
            text += f", back after {when.text(1, 's')}"
        return Finding(text, _verdict(hits.value == 1.0, hits.value >= 0.5))

    return check


def _speed_steps(rows: Sequence[Row]) -> Finding:
    low, high, again = (median(values(rows, f"speed_leg_{i}")) for i in (1, 2, 3))
    text = f"{low.text(3)}, {high.text(3)}, {again.text(3, 'm/s')}"
    if not (low.count and high.count and again.count):
        return Finding(text, NO)
    doubled = 1.6 <= high.value / low.value <= 2.4
    back = abs(again.value / low.value - 1.0) <= 0.15
    return Finding(text, _verdict(doubled and back, high.value > low.value))


def _turns(rows: Sequence[Row]) -> Finding:
    right, left = median(values(rows, "yaw_rate_leg_2")), median(values(rows, "yaw_rate_leg_3"))
    text = f"right {right.text(2)}, left {left.text(2, 'rad/s')}"
    good = right.count > 0 and right.high < 0.0 < left.low
    return Finding(text, _verdict(good, right.count > 0 and right.value < left.value))


_ALL: Final = ("apnc", "tegotae", "phase_reset")

CLAIMS: Final[tuple[Claim, ...]] = (
    Claim("mi", "abstract, 3.1.1", "the gait forms rapidly, within a few seconds", _within(9.0)),
    Claim("mi", "3.1.1, Fig. 4", "APNC converges faster than Tegotae",
          _faster("apnc", "tegotae", "mi")),
    Claim("mi", "3.1.1, Fig. 4", "phase resetting converges faster than Tegotae",
          _faster("phase_reset", "tegotae", "mi")),
    Claim("mi", "3.1.1, Fig. S4", "the duty factor grows with MI",
          _trend("duty_factor_mean", "mi", 1, ("apnc",), "duty factor and MI")),
    Claim("mi", "3.1.1", "from MI 0.24 on the duty factor settles at about 0.72",
          _duty_at_high_mi),
    Claim("mi", "3.1.1", "the stride frequency is about 8.6 MI + 0.5 Hz", _stride_line),
    Claim("rate", "3.1.2, Fig. 5", "a higher update rate converges sooner, in all methods",
          _trend(STRICT, "rate", -1, _ALL, "strict time and rate")),
    Claim("rate", "3.1.2, Fig. 5", "APNC succeeds in every trial at every rate", _always("apnc")),
    Claim("rate", "3.1.2, Fig. 5", "Tegotae and phase resetting always succeed only above 25 Hz",
          _only_above(25.0, ("tegotae", "phase_reset"))),
    Claim("rate", "3.1.2, Fig. 5", "APNC converges faster than Tegotae at every rate",
          _faster("apnc", "tegotae", "rate")),
    Claim("terrain", "3.1.3, Fig. 6", "rougher ground takes longer, in all methods",
          _trend(STRICT, "roughness", 1, _ALL, "strict time and R")),
    Claim("terrain", "3.1.3, Fig. 6", "the spread of the time grows with the roughness",
          _spread_grows),
    Claim("terrain", "3.1.3, Fig. 6", "above R = 80 % Tegotae does not always form a gait",
          _rough_success),
    Claim("terrain", "3.1.3, Fig. 6", "APNC forms the gait at every roughness", _always("apnc")),
    Claim("terrain", "3.1.3, Fig. 6", "APNC converges faster than Tegotae",
          _faster("apnc", "tegotae", "roughness")),
    Claim("terrain", "3.1.3, Fig. 6", "APNC converges faster than phase resetting",
          _faster("apnc", "phase_reset", "roughness")),
    Claim("conditions", "3.1.4, Fig. 7", "in C1 all methods do about equally well", _alike_in_c1),
    Claim("conditions", "3.1.4, Fig. 7", "with noise (C2) APNC is better in all metrics",
          _better_in("C2")),
    Claim("conditions", "3.1.4, Fig. 7", "with a damaged leg (C3) APNC is better in all metrics",
          _better_in("C3")),
    Claim("conditions", "3.1.4, Fig. 7", "with a payload (C4) APNC is better in all metrics",
          _better_in("C4")),
    Claim("damage", "3.1.4, Fig. 8", "with a damaged leg APNC walks fastest", _fastest_damaged),
    Claim("memory", "3.2.1, Fig. 10", "S1: set down at 1.7 s, the trot forms",
          _state("S1", "apnc")),
    Claim("memory", "3.2.2, Fig. 11B", "S2: with ANC it trots on with both front sensors stuck",
          _state("S2", "apnc")),
    Claim("memory", "3.2.2, Fig. 11A", "S2: without ANC the front oscillators stop",
          _state("S2", "apc")),
    Claim("memory", "3.2.3, Fig. 12B", "S3: with ANC the gait comes back without feedback",
          _state("S3", "apnc")),
    Claim("memory", "3.2.3, Fig. 12A", "S3: without ANC the robot stays on the spot, legs in phase",
          _state("S3", "apc")),
    Claim("steering", "3.3, Fig. 13", "MI 0.15, 0.4, 0.15: from about 0.08 to 0.16 m/s and back",
          _speed_steps),
    Claim("steering", "3.3, Fig. 14", "steeper slopes on one side turn the robot to the other",
          _turns),
)  # fmt: skip


def findings(rows: Sequence[Row], study: str) -> list[tuple[Claim, Finding]]:
    """Every claim of a study and what it came to on these rows."""
    found = [(claim, claim.check(rows)) for claim in CLAIMS if claim.study == study]
    if len({row["seed"] for row in rows}) >= MIN_SEEDS:
        return found
    return [(claim, Finding(finding.measured, FEW)) for claim, finding in found]

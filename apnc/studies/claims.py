"""What the paper says, and the rules by which rows of trials agree with it or not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

import numpy as np

from apnc.studies.rows import AUTHORS, STRICT, Row, is_number, matching, successes, values
from apnc.studies.statistics import compare, median, p_text, rank_correlation, rate

YES, PARTLY, NO = "reproduced", "partly", "not"
FEW, NOT_RUN = "too few trials", "not run"

MIN_SEEDS: Final = 5
"""Fewer seeds than this give figures, but no verdict."""

SIGNIFICANT: Final = 0.05
"""Largest p of a difference that counts."""


class Finding(NamedTuple):
    """What a claim came to: the figures and the verdict."""

    measured: str
    verdict: str


Rule = Callable[[Sequence[Row]], Finding]
Part = tuple[str, bool, bool]
"""Figures by one criterion, and whether the claim holds fully or partly."""


class Claim(NamedTuple):
    """A claim of the paper: where, what it says, its rule, and the controllers that it needs."""

    place: str
    text: str
    rule: Rule
    methods: tuple[str, ...] = ("apnc",)


def verdict(full: bool, part: bool) -> str:
    """Reproduced if it holds fully, else partly, else not."""
    return YES if full else PARTLY if part else NO


def both_criteria(check: Callable[[Sequence[Row], str], Part]) -> Rule:
    """A check by both criteria: the strict one decides, a difference makes it 'partly'."""

    def rule(rows: Sequence[Row]) -> Finding:
        (strict, full, part), (authors, *loosely) = check(rows, STRICT), check(rows, AUTHORS)
        text = f"strict: {strict}; authors': {authors}"
        return Finding(text, verdict(full, part or any(loosely)))

    return rule


def faster(fast: str, slow: str, axis: str) -> Rule:
    """In every cell along an axis the median time of one method is below that of the other.

    A cell in which only the first method forms the gait is won, one in which it does not is lost.
    """

    def won(rows: Sequence[Row], column: str) -> bool:
        a, b = values(rows, column, method=fast), values(rows, column, method=slow)
        return bool(a) and (not b or float(np.median(a)) < float(np.median(b)))

    def check(rows: Sequence[Row], column: str) -> Part:
        cells = sorted({row[axis] for row in rows})
        wins = sum(won(matching(rows, **{axis: cell}), column) for cell in cells)
        a, b = values(rows, column, method=fast), values(rows, column, method=slow)
        test = compare(a, b)
        text = (
            f"median {median(a).text(1, 's')} against {median(b).text(1, 's')}, faster in "
            f"{wins} of {len(cells)} cells, {p_text(test.p)}, r = {test.effect:.2f}"
        )
        return text, wins == len(cells), wins > len(cells) / 2

    return both_criteria(check)


def always(method: str) -> Rule:
    """Every trial of a method forms the gait; nine of ten are 'partly'."""

    def check(rows: Sequence[Row], column: str) -> Part:
        hits = rate(successes(rows, column, method=method))
        return str(hits), hits.value == 1.0, hits.value >= 0.9

    return both_criteria(check)


def trend(column: str, axis: str, sign: int, methods: Sequence[str], name: str) -> Rule:
    """A column grows (sign 1) or falls (-1) along an axis in every method, by rank correlation."""

    def rule(rows: Sequence[Row]) -> Finding:
        texts, agree = [], 0
        for method in methods:
            of_method = [r for r in matching(rows, method=method) if is_number(r.get(column))]
            test = rank_correlation([r[axis] for r in of_method], [r[column] for r in of_method])
            if test is None:
                texts.append(f"{method}: too few")
                continue
            agree += sign * test.effect > 0 and test.p <= SIGNIFICANT
            texts.append(f"{method}: rho = {test.effect:.2f} ({p_text(test.p)})")
        text = f"rank correlation of {name}, " + "; ".join(texts)
        return Finding(text, verdict(agree == len(methods), agree > 0))

    return rule


def findings(rows: Sequence[Row], claims: Sequence[Claim]) -> list[tuple[Claim, Finding]]:
    """Every claim and what it came to on these rows."""
    return [(claim, _finding(rows, claim)) for claim in claims]


def _finding(rows: Sequence[Row], claim: Claim) -> Finding:
    missing = [method for method in claim.methods if not matching(rows, method=method)]
    if missing:
        return Finding(f"not run: {', '.join(missing)}", NOT_RUN)
    found = claim.rule(rows)
    enough = len({row["seed"] for row in rows}) >= MIN_SEEDS
    return found if enough else Finding(found.measured, FEW)

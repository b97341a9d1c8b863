"""What the paper says, and the rules by which rows of trials agree with it or not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

from apnc.studies.contenders import contender
from apnc.studies.rows import (
    AUTHORS,
    STRICT,
    Row,
    gait_in,
    is_number,
    matching,
    successes,
    values,
)
from apnc.studies.statistics import (
    compare,
    median,
    of_runs,
    p_text,
    rank_correlation,
    rate,
)

YES, PARTLY, NO = "reproduced", "partly", "not"
FEW, NOT_RUN = "no verdict", "not run"

MIN_SEEDS: Final = 5
"""Fewer seeds, or numbers on a side of a comparison, give figures, but no verdict."""

SIGNIFICANT: Final = 0.05
"""Largest p of a difference that counts."""


class Finding(NamedTuple):
    """What a claim came to: the figures and the verdict."""

    measured: str
    verdict: str


Rule = Callable[[Sequence[Row]], Finding]
Pairs = Sequence[tuple[str, str]]
"""Labels of the contenders that are compared: the one that should win, and the other."""


class Claim(NamedTuple):
    """A claim of the paper: where, what it says, its rule, the methods and seeds that it needs.

    ``{gait}`` in its text stands for the name of the gait that is expected of the robot.
    """

    place: str
    text: str
    rule: Rule
    methods: tuple[str, ...] = ("apnc",)
    seeds: int = MIN_SEEDS


def verdict(full: bool, part: bool) -> str:
    """Reproduced if it holds fully, else partly, else not."""
    return YES if full else PARTLY if part else NO


def of_all(verdicts: Sequence[str]) -> str:
    """A verdict on what is said of several: reproduced if it is for each of them.

    Not reproduced if it is not for any, no verdict if there is none on any; else partly.
    """
    if YES not in verdicts and PARTLY not in verdicts:
        return NO if NO in verdicts else FEW
    return verdict(set(verdicts) == {YES}, True)


def of_told(verdicts: Sequence[str]) -> str:
    """The same of those that have a verdict: a rival that never came that far decides nothing."""
    return of_all([each for each in verdicts if each != FEW])


def of_criteria(strict: str, authors: str) -> str:
    """The verdict of the strict criterion, but 'partly' if the authors' one differs.

    Without a verdict by the strict one no claim is reproduced, and without one by the authors'
    there is no difference.
    """
    if authors in (strict, FEW):
        return strict
    return NO if (strict, authors) == (FEW, NO) else PARTLY


def both_criteria(check: Callable[[Sequence[Row], str], Finding]) -> Rule:
    """A check by both criteria: the strict one decides, a difference makes it 'partly'."""

    def rule(rows: Sequence[Row]) -> Finding:
        strict, authors = check(rows, STRICT), check(rows, AUTHORS)
        text = f"strict: {strict.measured}; authors': {authors.measured}"
        return Finding(text, of_criteria(strict.verdict, authors.verdict))

    return rule


def each_of(labels: Sequence[str], check: Callable[[str], Finding]) -> Finding:
    """A check of every contender alone; reproduced if it is for each."""
    found = [check(label) for label in labels]
    texts = (
        f"{contender(label).name}: {f.measured}" for label, f in zip(labels, found, strict=True)
    )
    return Finding("; ".join(texts), of_all([f.verdict for f in found]))


def faster(pairs: Pairs, axis: str) -> Rule:
    """Of each pair the first is faster, see ``sooner``; pairs without a verdict do not count."""

    def check(rows: Sequence[Row], column: str) -> Finding:
        found = [sooner(rows, column, *pair, axis) for pair in pairs]
        return Finding("; ".join(f.measured for f in found), of_told([f.verdict for f in found]))

    return both_criteria(check)


def sooner(rows: Sequence[Row], column: str, fast: str, slow: str, axis: str) -> Finding:
    """In every cell along an axis the median time of one contender is below that of the other.

    More than half of the cells are 'partly'. A cell in which only the first forms the gait is
    won, one in which it does not is lost. Over all cells the difference is significant, else it is
    'not'. No verdict if the other hardly ever forms it; 'not' if only the first does not.
    """
    own, other = matching(rows, method=fast), matching(rows, method=slow)
    cells = sorted({row[axis] for row in own} & {row[axis] for row in other})
    own, other = ([row for row in part if row[axis] in cells] for part in (own, other))
    a, b = values(own, column), values(other, column)
    test = compare(a, b)
    wins = sum(_won(own, other, column, {axis: cell}) for cell in cells)
    text = (
        f"{contender(fast).name} {median(a).text(1, 's', len(own))} against "
        f"{contender(slow).name} {median(b).text(1, 's', len(other))}, faster in "
        f"{wins} of {len(cells)} cells, {p_text(test.p)}, r = {test.effect:.2f}"
    )
    if len(b) < MIN_SEEDS:
        return Finding(text, FEW)
    clear = len(a) >= MIN_SEEDS and test.p <= SIGNIFICANT and test.effect < 0
    return Finding(text, verdict(clear and wins == len(cells), clear and wins > len(cells) / 2))


def _won(own: Sequence[Row], other: Sequence[Row], column: str, cell: Row) -> bool:
    a, b = (median(values(part, column, **cell)) for part in (own, other))
    return a.size > 0 and (b.size == 0 or a.value < b.value)


def always(method: str) -> Rule:
    """Every trial of a method forms the gait; nine of ten are 'partly'."""

    def check(rows: Sequence[Row], column: str) -> Finding:
        hits = rate(successes(rows, column, method=method))
        return Finding(str(hits), verdict(hits.value == 1.0, hits.value >= 0.9))

    return both_criteria(check)


def ranks(rows: Sequence[Row], column: str, axis: str, sign: int, labels: Sequence[str]) -> Finding:
    """A column grows (sign 1) or falls (-1) along an axis in each contender, by its ranks."""

    def check(label: str) -> Finding:
        own = matching(rows, method=label)
        known = [r for r in own if is_number(r.get(column))]
        test = rank_correlation([r[axis] for r in known], [r[column] for r in known])
        n = f"n = {of_runs(len(known), len(own))}"
        if test is None or len(known) < MIN_SEEDS:
            return Finding(f"too few, {n}", FEW)
        text = f"rho = {test.effect:.2f} ({p_text(test.p)}), {n}"
        return Finding(text, verdict(sign * test.effect > 0 and test.p <= SIGNIFICANT, False))

    return each_of(labels, check)


def trend(column: str, axis: str, sign: int, labels: Sequence[str] = ("apnc",)) -> Rule:
    """A column grows or falls along an axis, see ``ranks``."""
    return lambda rows: ranks(rows, column, axis, sign, labels)


def time_trend(axis: str, sign: int, labels: Sequence[str]) -> Rule:
    """The time to the gait grows or falls along an axis, by both criteria."""
    return both_criteria(lambda rows, column: ranks(rows, column, axis, sign, labels))


def findings(rows: Sequence[Row], claims: Sequence[Claim]) -> list[tuple[Claim, Finding]]:
    """Every claim and what it came to on these rows."""
    gait = gait_in(rows)
    return [(c._replace(text=c.text.format(gait=gait)), _finding(rows, c)) for c in claims]


def _finding(rows: Sequence[Row], claim: Claim) -> Finding:
    seeds = {m: len({r["seed"] for r in matching(rows, method=m)}) for m in claim.methods}
    if missing := [method for method, n in seeds.items() if n == 0]:
        return Finding(f"not run: {', '.join(missing)}", NOT_RUN)
    found = claim.rule(rows)
    return found if min(seeds.values()) >= claim.seeds else Finding(found.measured, FEW)

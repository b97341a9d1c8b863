"""What the paper says, and the rules by which results of trials agree with it or not."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

from apnc.controllers import named_controller
from apnc.studies.results import (
    AUTHORS,
    STRICT,
    Result,
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


Rule = Callable[[Sequence[Result]], Finding]
Pairs = Sequence[tuple[str, str]]
"""Labels of the controllers that are compared: the one that should win, and the other."""


class Claim(NamedTuple):
    """A claim of the paper: where, what it says, its rule, the controllers and seeds that it needs.

    ``{gait}`` in its text stands for the name of the gait that is expected of the robot.
    """

    section: str
    text: str
    rule: Rule
    controllers: tuple[str, ...] = ("apnc",)
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


def of_decided(verdicts: Sequence[str]) -> str:
    """As ``of_all``, ignoring baselines without a verdict."""
    return of_all([each for each in verdicts if each != FEW])


def of_criteria(strict: str, authors: str) -> str:
    """The verdict of the strict criterion, but 'partly' if the authors' one differs.

    Without a verdict by the strict one no claim is reproduced, and without one by the authors'
    there is no difference.
    """
    if authors in (strict, FEW):
        return strict
    return NO if (strict, authors) == (FEW, NO) else PARTLY


def both_criteria(check: Callable[[Sequence[Result], str], Finding]) -> Rule:
    """A check by both criteria: the strict one decides, a difference makes it 'partly'."""

    def rule(results: Sequence[Result]) -> Finding:
        strict, authors = check(results, STRICT), check(results, AUTHORS)
        text = f"strict: {strict.measured}; authors': {authors.measured}"
        return Finding(text, of_criteria(strict.verdict, authors.verdict))

    return rule


def each_of(labels: Sequence[str], check: Callable[[str], Finding]) -> Finding:
    """A check of every controller alone; reproduced if it is for each."""
    found = [check(label) for label in labels]
    texts = (
        f"{named_controller(label).name}: {f.measured}"
        for label, f in zip(labels, found, strict=True)
    )
    return Finding("; ".join(texts), of_all([f.verdict for f in found]))


def faster(pairs: Pairs, axis: str) -> Rule:
    """The first of each pair is faster, see ``compare_times``.

    Pairs without a verdict are ignored.
    """

    def check(results: Sequence[Result], column: str) -> Finding:
        found = [compare_times(results, column, *pair, axis) for pair in pairs]
        return Finding("; ".join(f.measured for f in found), of_decided([f.verdict for f in found]))

    return both_criteria(check)


def compare_times(
    results: Sequence[Result], column: str, fast: str, slow: str, axis: str
) -> Finding:
    """In every cell along an axis the median time of one controller is below that of the other.

    More than half of the cells are 'partly'. A cell in which only the first forms the gait is
    won, one in which it does not is lost. Over all cells the difference is significant, else it is
    'not'. No verdict if the other hardly ever forms it; 'not' if only the first does not.
    """
    own, other = matching(results, controller=fast), matching(results, controller=slow)
    cells = sorted({result[axis] for result in own} & {result[axis] for result in other})
    own, other = ([result for result in part if result[axis] in cells] for part in (own, other))
    a, b = values(own, column), values(other, column)
    test = compare(a, b)
    wins = sum(_won(own, other, column, {axis: cell}) for cell in cells)
    text = (
        f"{named_controller(fast).name} {median(a).text(1, 's', len(own))} against "
        f"{named_controller(slow).name} {median(b).text(1, 's', len(other))}, faster in "
        f"{wins} of {len(cells)} cells, {p_text(test.p)}, r = {test.effect:.2f}"
    )
    if len(b) < MIN_SEEDS:
        return Finding(text, FEW)
    clear = len(a) >= MIN_SEEDS and test.p <= SIGNIFICANT and test.effect < 0
    return Finding(text, verdict(clear and wins == len(cells), clear and wins > len(cells) / 2))


def _won(own: Sequence[Result], other: Sequence[Result], column: str, cell: Result) -> bool:
    a, b = (median(values(part, column, **cell)) for part in (own, other))
    return a.size > 0 and (b.size == 0 or a.value < b.value)


def always(controller: str) -> Rule:
    """Every trial of a controller forms the gait; nine of ten are 'partly'."""

    def check(results: Sequence[Result], column: str) -> Finding:
        hits = rate(successes(results, column, controller=controller))
        return Finding(str(hits), verdict(hits.value == 1.0, hits.value >= 0.9))

    return both_criteria(check)


def ranks(
    results: Sequence[Result], column: str, axis: str, sign: int, labels: Sequence[str]
) -> Finding:
    """A column grows (sign 1) or falls (-1) along an axis in each controller, by its ranks."""

    def check(label: str) -> Finding:
        own = matching(results, controller=label)
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
    return lambda results: ranks(results, column, axis, sign, labels)


def time_trend(axis: str, sign: int, labels: Sequence[str]) -> Rule:
    """The time to the gait grows or falls along an axis, by both criteria."""
    return both_criteria(lambda results, column: ranks(results, column, axis, sign, labels))


def findings(results: Sequence[Result], claims: Sequence[Claim]) -> list[tuple[Claim, Finding]]:
    """Every claim and what it came to on these results."""
    gait = gait_in(results)
    return [(c._replace(text=c.text.format(gait=gait)), _finding(results, c)) for c in claims]


def _finding(results: Sequence[Result], claim: Claim) -> Finding:
    seeds = {
        m: len({r["seed"] for r in matching(results, controller=m)}) for m in claim.controllers
    }
    if missing := [controller for controller, n in seeds.items() if n == 0]:
        return Finding(f"not run: {', '.join(missing)}", NOT_RUN)
    found = claim.rule(results)
    return found if min(seeds.values()) >= claim.seeds else Finding(found.measured, FEW)

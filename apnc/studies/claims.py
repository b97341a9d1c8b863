"""Claims of the paper, and the rules that turn results into a verdict on each."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Final, NamedTuple

from apnc.controllers import named_controller
from apnc.studies.registry import MIN_SEEDS
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

SIGNIFICANT: Final = 0.05
"""Largest p of a difference that is significant."""


class Judgement(NamedTuple):
    """What a claim was held against, as text, and the verdict."""

    measured: str
    verdict: str


Rule = Callable[[Sequence[Result]], Judgement]
Pairs = Sequence[tuple[str, str]]
"""Pairs of labels of controllers: the one that should be faster, and the other."""


class Claim(NamedTuple):
    """A claim of the paper.

    Args:
        section: section or figure of the paper.
        text: the claim. ``{gait}`` stands for the gait that is expected of the robot.
        rule: function from results to what was measured and the verdict.
        controllers: labels of the controllers that the rule needs.
        seeds: smallest number of seeds of each for a verdict.
    """

    section: str
    text: str
    rule: Rule
    controllers: tuple[str, ...] = ("apnc",)
    seeds: int = MIN_SEEDS


def verdict(full: bool, part: bool) -> str:
    """Reproduced if ``full``, otherwise partly if ``part``, otherwise not."""
    return YES if full else PARTLY if part else NO


def of_all(verdicts: Sequence[str]) -> str:
    """Verdict on a claim about several controllers, from the verdicts on each.

    Reproduced if all are. No verdict if none has one. Not reproduced if none is, even partly.
    Otherwise partly.
    """
    if YES not in verdicts and PARTLY not in verdicts:
        return NO if NO in verdicts else FEW
    return verdict(set(verdicts) == {YES}, True)


def of_decided(verdicts: Sequence[str]) -> str:
    """As ``of_all``, ignoring baselines without a verdict."""
    return of_all([each for each in verdicts if each != FEW])


def of_criteria(strict: str, authors: str) -> str:
    """Verdict from those by the strict and by the authors' criterion.

    It is the strict one, or partly if the authors' differs. A missing verdict by the authors'
    criterion counts as equal. Without a verdict by the strict criterion the claim is partly
    reproduced at most.
    """
    if authors in (strict, FEW):
        return strict
    return NO if (strict, authors) == (FEW, NO) else PARTLY


def both_criteria(check: Callable[[Sequence[Result], str], Judgement]) -> Rule:
    """Rule that checks by both criteria and combines the verdicts as ``of_criteria`` does."""

    def rule(results: Sequence[Result]) -> Judgement:
        strict, authors = check(results, STRICT), check(results, AUTHORS)
        text = f"strict: {strict.measured}; authors': {authors.measured}"
        return Judgement(text, of_criteria(strict.verdict, authors.verdict))

    return rule


def each_of(labels: Sequence[str], check: Callable[[str], Judgement]) -> Judgement:
    """Check every controller alone and combine the verdicts as ``of_all`` does."""
    found = [check(label) for label in labels]
    texts = (
        f"{named_controller(label).name}: {f.measured}"
        for label, f in zip(labels, found, strict=True)
    )
    return Judgement("; ".join(texts), of_all([f.verdict for f in found]))


def faster(pairs: Pairs, axis: str) -> Rule:
    """The first of each pair is faster, see ``compare_times``.

    Pairs without a verdict are ignored.
    """

    def check(results: Sequence[Result], column: str) -> Judgement:
        found = [compare_times(results, column, *pair, axis) for pair in pairs]
        return Judgement(
            "; ".join(f.measured for f in found), of_decided([f.verdict for f in found])
        )

    return both_criteria(check)


def compare_times(
    results: Sequence[Result], column: str, fast: str, slow: str, axis: str
) -> Judgement:
    """Whether one controller has a shorter median time than another in every cell along an axis.

    Reproduced if it is faster in every cell, partly if in more than half of them. Over all cells
    the difference must be significant, with ``MIN_SEEDS`` times and more of the first controller.
    Otherwise the claim is not reproduced. A cell in which only
    the first controller forms the gait counts as faster; one in which it does not form the gait
    counts as slower. No verdict if the other controller has fewer than ``MIN_SEEDS`` times.

    Args:
        results: of both controllers.
        column: time to the gait, by the criterion that decides.
        fast: label of the controller that should be faster.
        slow: label of the other.
        axis: of the grid.
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
        return Judgement(text, FEW)
    clear = len(a) >= MIN_SEEDS and test.p <= SIGNIFICANT and test.effect < 0
    return Judgement(text, verdict(clear and wins == len(cells), clear and wins > len(cells) / 2))


def _won(own: Sequence[Result], other: Sequence[Result], column: str, cell: Result) -> bool:
    a, b = (median(values(part, column, **cell)) for part in (own, other))
    return a.size > 0 and (b.size == 0 or a.value < b.value)


def always(controller: str) -> Rule:
    """Every trial of a controller forms the gait. Nine of ten is partly."""

    def check(results: Sequence[Result], column: str) -> Judgement:
        hits = rate(successes(results, column, controller=controller))
        return Judgement(str(hits), verdict(hits.value == 1.0, hits.value >= 0.9))

    return both_criteria(check)


def ranks(
    results: Sequence[Result], column: str, axis: str, sign: int, labels: Sequence[str]
) -> Judgement:
    """Whether a column rises (sign 1) or falls (-1) along an axis, by rank correlation.

    Args:
        results: of the controllers.
        column: the measure.
        axis: of the grid.
        sign: 1 or -1.
        labels: of the controllers, each checked alone.
    """

    def check(label: str) -> Judgement:
        own = matching(results, controller=label)
        known = [r for r in own if is_number(r.get(column))]
        test = rank_correlation([r[axis] for r in known], [r[column] for r in known])
        n = f"n = {of_runs(len(known), len(own))}"
        if test is None or len(known) < MIN_SEEDS:
            return Judgement(f"too few, {n}", FEW)
        text = f"rho = {test.effect:.2f} ({p_text(test.p)}), {n}"
        return Judgement(text, verdict(sign * test.effect > 0 and test.p <= SIGNIFICANT, False))

    return each_of(labels, check)


def trend(column: str, axis: str, sign: int, labels: Sequence[str] = ("apnc",)) -> Rule:
    """Rule for a column that rises or falls along an axis, see ``ranks``."""
    return lambda results: ranks(results, column, axis, sign, labels)


def time_trend(axis: str, sign: int, labels: Sequence[str]) -> Rule:
    """Rule for a time to the gait that rises or falls along an axis, by both criteria."""
    return both_criteria(lambda results, column: ranks(results, column, axis, sign, labels))


def judgements(results: Sequence[Result], claims: Sequence[Claim]) -> list[tuple[Claim, Judgement]]:
    """Every claim with its judgement on these results."""
    gait = gait_in(results)
    return [(c._replace(text=c.text.format(gait=gait)), _judgement(results, c)) for c in claims]


def _judgement(results: Sequence[Result], claim: Claim) -> Judgement:
    seeds = {
        m: len({r["seed"] for r in matching(results, controller=m)}) for m in claim.controllers
    }
    if missing := [controller for controller, n in seeds.items() if n == 0]:
        return Judgement(f"not run: {', '.join(missing)}", NOT_RUN)
    found = claim.rule(results)
    return found if min(seeds.values()) >= claim.seeds else Judgement(found.measured, FEW)

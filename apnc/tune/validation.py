"""What a tuned robot does with seeds and bodies that its search has not seen."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from statistics import median
from typing import Final, NamedTuple

from apnc import metrics
from apnc.tune.aims import AIM_ALONE, AIM_LIFT, AIM_SLIP
from apnc.tune.design import Candidate, Start
from apnc.tune.evaluate import Evaluator
from apnc.tune.measured import Measured
from apnc.tune.runs import MARGIN, of_validation
from apnc.tune.search import Best
from apnc_plant.robot.size import mean_leg_length

SEEDS: Final = 20
"""Seeds at each MI of a validation."""

AIMS: Final = 9
"""Number of aims of a validation."""


def with_article(gait: str) -> str:
    """The name of a gait with its article, as in "a trot" and "an alternating tetrapod"."""
    return f"{'an' if gait[:1] in 'aeiou' else 'a'} {gait}"


@dataclass(frozen=True)
class Cell:
    """Runs of one kind at one MI.

    Args:
        kind: what they test, see ``runs.Task``.
        mi: MI [1].
        runs: what was measured of them.
    """

    kind: str
    mi: float
    runs: tuple[Measured, ...]

    @property
    def good(self) -> int:
        """How many formed the gait, held it and walked."""
        return sum(run.good for run in self.runs)

    @property
    def strict(self) -> int:
        """How many formed the gait and held it."""
        return sum(run.strict for run in self.runs)

    @property
    def time(self) -> float:
        """Median time until the gait held [s], of runs in which it did; nan without."""
        times = [run.time for run in self.runs if run.strict]
        return median(times) if times else math.nan

    def middle(self, name: str) -> float:
        """Median of a measure over the runs."""
        return float(median(getattr(run, name) for run in self.runs))


class Missed(NamedTuple):
    """An aim that was not reached.

    Args:
        aim: which, in a few words.
        places: at how many MI.
        words: the aim, and what was found instead at these MI, in a line.
    """

    aim: str
    places: int
    words: str


@dataclass(frozen=True)
class Validation:
    """What a tuned robot does.

    Args:
        cells: its runs, by kind and MI.
        length: its leg length [m].
        speed: what a speed of 1 means, sqrt(g L) [m/s].
        time: its time scale [1].
        gait: name of the gait of its legs.
    """

    cells: tuple[Cell, ...]
    length: float
    speed: float
    time: float
    gait: str

    def of(self, kind: str) -> list[Cell]:
        """Cells of a kind, by growing MI."""
        return [cell for cell in self.cells if cell.kind == kind]

    def missed(self) -> list[Missed]:
        """Aims that were not reached; none if all were."""
        walks = self.of("walk")
        found = [
            missed
            for kind, what, share in (
                ("walk", "with ANC", 1.0),
                ("apc", "with APC alone", AIM_ALONE),
                ("varied", f"on bodies off by up to {percent(MARGIN)}", AIM_ALONE),
                ("payload", "with a payload of a fifth of its mass", AIM_ALONE),
                ("sensor", "with one foot sensor dead", AIM_ALONE),
                ("air", "let down from the air", AIM_ALONE),
            )
            if (missed := self._too_few(what, self.of(kind), share))
        ]
        lifts = [(cell, cell.middle("lift")) for cell in walks]
        low = [(cell, self._mm(lift)) for cell, lift in lifts if lift < AIM_LIFT]
        if low:
            aim = f"{self._mm(AIM_LIFT)} ({percent(AIM_LIFT)} of the leg)"
            found.append(_missed("lift of the lowest foot", aim, low))
        slips = [(cell, cell.middle("slip")) for cell in walks]
        far = [(cell, percent(slip)) for cell, slip in slips if slip > AIM_SLIP]
        if far:
            aim = f"at most {percent(AIM_SLIP)} of the stride"
            found.append(_missed("slip of a foot", aim, far))
        speeds = [cell.middle("speed") for cell in walks]
        if any(later <= before for before, later in pairwise(speeds)):
            told = [
                (cell, f"{speed * self.speed:.3f} m/s")
                for cell, speed in zip(walks, speeds, strict=True)
            ]
            found.append(_missed("speed", "growing with MI", told))
        return found

    def _too_few(self, what: str, cells: Sequence[Cell], share: float) -> Missed | None:
        bad = [(cell, str(cell.good)) for cell in cells if cell.good < share * len(cell.runs)]
        if not bad:
            return None
        runs = len(bad[0][0].runs)
        aim = f"{math.ceil(share * runs)} of {runs} in {with_article(self.gait)} that holds"
        return _missed(what, aim, bad)

    def _mm(self, lift: float) -> str:
        return f"{1e3 * lift * self.length:.1f} mm"


def _missed(what: str, aim: str, found: Sequence[tuple[Cell, str]]) -> Missed:
    told = ", ".join(f"{value} at MI {cell.mi:.3g}" for cell, value in found)
    return Missed(what, len(found), f"{what}, aimed at {aim}: {told}")


def validated(
    start: Start, candidate: Candidate, evaluator: Evaluator, seeds: int = SEEDS
) -> Validation:
    """Walk a candidate with seeds and bodies that its search has not seen."""
    tasks = list(of_validation(start, candidate, seeds))
    runs = evaluator(tasks)
    cells: dict[tuple[str, float], list[Measured]] = {}
    for run in runs:
        cells.setdefault((run.kind, run.share), []).append(run)
    return Validation(
        tuple(
            Cell(kind, candidate.mi(share), tuple(found))
            for (kind, share), found in sorted(cells.items())
        ),
        start.length,
        start.gravity_speed,
        start.time,
        metrics.gait_name(len(start.robot.legs)),
    )


def in_words(best: Best) -> str:
    """What the check of a candidate shows, e.g. ``trot at 9 of 11 MI, lowest lift 7.0 mm``."""
    robot = best.candidate.robot
    gait, length = metrics.gait_name(len(robot.legs)), mean_leg_length(robot)
    walks = [run for run in best.runs if run.kind == "walk"]
    good = [run for run in walks if run.good]
    words = f"{gait} at {len(good)} of {len(walks)} MI"
    if good:
        words += f", lowest lift {1e3 * length * min(run.lift for run in good):.1f} mm"
    return words


def percent(share: float, digits: int = 0) -> str:
    """A share as text, e.g. ``10 %``."""
    return f"{100.0 * share:.{digits}f} %"

"""What a tuned robot does with seeds and bodies that its search has not seen."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import pairwise
from statistics import median
from typing import Final, NamedTuple

from apnc import metrics
from apnc.tune.design import Candidate, Start
from apnc.tune.evaluate import Evaluator
from apnc.tune.measured import Measured
from apnc.tune.runs import MARGIN, of_validation
from apnc.tune.search import Best
from apnc.tune.stance import leg_length

SEEDS: Final = 20
"""Seeds at each MI of a validation."""

AIM_ALONE: Final = 0.9
"""Share of walks without couplings that are to form the gait [1]."""

AIM_LIFT: Final = 0.05
"""Lift of every foot that is aimed at [L]."""

AIM_SLIP: Final = 0.18
"""Slip of every foot that is aimed at, as a share of the stride [1]."""


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
        words: what was found instead, in a line.
    """

    aim: str
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
        found = []
        walks, alone = self.of("walk"), self.of("apc")
        for cells, what, aim in (
            (walks, "with ANC", 1.0),
            (alone, "with APC alone", AIM_ALONE),
            (self.of("varied"), f"on bodies off by up to {percent(MARGIN)}", AIM_ALONE),
            (self.of("payload"), "with a payload of a fifth of its mass", AIM_ALONE),
            (self.of("sensor"), "with one foot sensor dead", AIM_ALONE),
            (self.of("air"), "let down from the air", AIM_ALONE),
        ):
            for cell in cells:
                if cell.good < aim * len(cell.runs):
                    found.append(
                        Missed(
                            what,
                            f"{what}, MI {cell.mi:.3g}: {cell.good} of {len(cell.runs)} walk in a "
                            f"{self.gait} that holds; aimed at {math.ceil(aim * len(cell.runs))}",
                        )
                    )
        for cell in walks:
            lift, slip = cell.middle("lift"), cell.middle("slip")
            if lift < AIM_LIFT:
                words = (
                    f"MI {cell.mi:.3g}: the lowest foot lifts by {1e3 * lift * self.length:.1f}"
                    f" mm, {percent(lift, 1)} of the leg; aimed at {percent(AIM_LIFT)}"
                )
                found.append(Missed("lift of the feet", words))
            if slip > AIM_SLIP:
                words = (
                    f"MI {cell.mi:.3g}: a foot slips by {percent(slip)} of the stride; aimed at "
                    f"at most {percent(AIM_SLIP)}"
                )
                found.append(Missed("slip of the feet", words))
        speeds = [cell.middle("speed") for cell in walks]
        if any(later <= before for before, later in pairwise(speeds)):
            told = ", ".join(f"{speed * self.speed:.3f}" for speed in speeds)
            words = f"its speed does not grow with MI throughout: {told} m/s"
            found.append(Missed("speed", words))
        return found


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
    gait, length = metrics.gait_name(len(robot.legs)), leg_length(robot)
    walks = [run for run in best.runs if run.kind == "walk"]
    good = [run for run in walks if run.good]
    words = f"{gait} at {len(good)} of {len(walks)} MI"
    if good:
        words += f", lowest lift {1e3 * length * min(run.lift for run in good):.1f} mm"
    return words


def percent(share: float, digits: int = 0) -> str:
    """A share as text, e.g. ``10 %``."""
    return f"{100.0 * share:.{digits}f} %"

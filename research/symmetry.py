"""Section 4.1.1: do the legs stay in phase forever if every foot has the same load?

The paper's ideal case: all sensors acquire the same, so nothing can part the oscillators. Here
every sensor of the walking robot shows the mean load of all feet. A seed would change nothing, so
there is one run per MI. ``research.engines.limits`` walks a symmetric robot whose sensors show
their own loads.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import nan
from typing import Final

import numpy as np

from apnc import metrics
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.studies.claims import FEW, Claim, Judgement, verdict
from apnc.studies.results import STRICT, Result, values
from apnc.studies.study import WALK_S, Study
from apnc_core.types import Array
from apnc_plant.compiled import CompiledPlant
from apnc_plant.options import PlantOptions
from research.command import main
from research.registry import STUDIES

APART: Final = "largest_phase_rad"
STORED: Final = "kappa_largest"

MIN_RUNS: Final = 3
"""Smallest number of MI for a verdict."""


class EqualLoads(CompiledPlant):
    """The robot in C; every one of its foot sensors shows the mean of their loads."""

    def grf(self) -> Array:
        """Load that each foot sensor shows [N], shape (n_legs,), the same for all."""
        loads = super().grf()
        return np.full_like(loads, loads.mean())


def experiment(controller: str, seed: int, mi: float) -> Experiment:
    """A walk of the shipped robot, which is neither symmetric nor without noise."""
    return Experiment(controller=controller, seed=seed, mi=mi, duration=WALK_S)


def plant(experiment: Experiment) -> EqualLoads:
    """The robot of an experiment at its start."""
    options = PlantOptions(step=experiment.step)
    return EqualLoads(experiment.description, experiment.seed, options=options)


def measure(record: Record) -> Result:
    """Largest phase of any leg from that of leg 1 [rad], and largest kappa [1]."""
    o1, o2, kappa = (record.signals[name] for name in ("o1", "o2", "kappa"))
    error = metrics.phase_error(o1, o2, (0.0,) * (len(record.legs) - 1))
    return {APART: float(error.max()), STORED: float(kappa.max())}


def in_phase(results: Sequence[Result]) -> Judgement:
    """The legs stay in phase and no gait forms or is stored, at every MI. At some is partly."""
    apart, kappa = values(results, APART), values(results, STORED)
    together = sum(map(_together, results))
    count, trots = len(results), len(values(results, STRICT))
    text = (
        f"in phase in {together} of {count}; largest phase of a leg {max(apart, default=nan):.2g} "
        f"rad; largest kappa {max(kappa, default=nan):g}; a trot in {trots} of {count}"
    )
    found = verdict(together == count, together > 0) if count >= MIN_RUNS else FEW
    return Judgement(text, found)


def _together(result: Result) -> bool:
    apart = result.get(APART)
    in_phase = apart is not None and apart <= metrics.STRICT_TOLERANCE
    return in_phase and result[STORED] == 0.0 and result[STRICT] is None


CLAIM: Final = "if all loads are equal the legs stay in phase and no gait forms"

STUDY: Final = Study(
    STUDIES["symmetry"],
    experiment,
    {"mi": (0.08, 0.12, 0.16, 0.2, 0.24)},
    controllers=("apnc",),
    seeds=lambda cell, trials: 1,
    measure=measure,
    claims=(Claim("4.1.1", CLAIM, in_phase, seeds=1),),
    plant=plant,
)

if __name__ == "__main__":
    main(STUDY.name)

"""Times at which the robot enters the states S1 to S3."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import Any, Final

from apnc.loop.experiment import Experiment
from apnc.studies.study import SCHEDULE_MI


@dataclass(frozen=True)
class Timeline:
    """Times of the events in a run, from its start [s].

    Args:
        lowered: the robot, which was held in the air, is set down (S1). With 0 it stands from the
            start.
        broken: the sensors of the front legs stick at 0.9 (S2).
        stopped: MI is 0, the load feedback of all legs is removed (S3).
        restarted: MI returns to its value, the feedback stays removed.
        end: the run ends.

    Raises:
        ValueError: times that are not in this order.

    Source: section 3.2 and Fig. 9-12; 1.7 s and 20 ... 24 s are the paper's.
    """

    lowered: float = 1.7
    broken: float = 14.0
    stopped: float = 20.0
    restarted: float = 24.0
    end: float = 34.0

    def __post_init__(self) -> None:
        """Check the order."""
        times = (self.lowered, self.broken, self.stopped, self.restarted, self.end)
        if self.lowered < 0.0 or not all(a < b for a, b in pairwise(times)):
            raise ValueError(f"times {times} s do not follow each other")

    def experiment(self, controller: str, seed: int, **fields: Any) -> Experiment:
        """The experiment that passes through all states."""
        steps = {0.0: "S1", self.lowered: "C1", self.broken: "S2", self.stopped: "S3"}
        mi = ((0.0, SCHEDULE_MI), (self.stopped, 0.0), (self.restarted, SCHEDULE_MI))
        return Experiment(
            controller=controller,
            seed=seed,
            mi=mi,
            conditions=tuple(steps.items()),
            duration=self.end,
            **fields,
        )


TIMELINE: Final = Timeline()

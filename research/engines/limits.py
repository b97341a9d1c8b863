"""Robots that do not form the gait: one without any asymmetry, and one on feet that bounce.

``python -m research.engines.limits`` prints the table of docs/engines/walks.md.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import replace
from typing import Final

from apnc.features import WalkFeatures, walk_features
from apnc.loop.experiment import Experiment
from apnc.loop.simulate import simulate
from apnc.studies.robots import symmetric
from apnc.studies.study import WALK_S
from apnc.studies.table import markdown, middle
from apnc_plant.robot import RobotDescription, load_robot
from research.engines import installed
from research.engines.figures import STYLES

SEEDS: Final = 5

STIFFER, LESS_DAMPED = 5.0, 0.1


def bouncing(robot: RobotDescription) -> RobotDescription:
    """The robot on stiffer feet with less damping."""
    own = robot.contact
    stiffness, damping = STIFFER * own.stiffness, LESS_DAMPED * own.damping
    return replace(robot, contact=replace(own, stiffness=stiffness, damping=damping))


def cases() -> Iterator[tuple[str, list[Experiment]]]:
    """Name of each case, and its experiments, one per seed."""
    robot = load_robot("lilibot")
    for mi in (0.08, 0.15, 0.24):  # nothing is left that a seed could change
        alone = Experiment(robot=symmetric(robot), mi=mi, duration=WALK_S)
        yield f"no asymmetry, no noise, MI {mi:g}", [alone]
    for name, words in (("C1", ""), ("C4", ", payload 1.25 kg")):
        run = Experiment(robot=bouncing(robot), mi=0.28, conditions=name, duration=WALK_S)
        yield f"bouncing feet{words}, MI 0.28", [replace(run, seed=seed) for seed in range(SEEDS)]


def line(words: str, runs: list[Experiment]) -> dict[str, str]:
    """A line of the table: how often and when the trot forms in each engine, and other gaits."""
    cells = {"case": words}
    for engine in installed():
        found = [walk_features(simulate(replace(run, engine=engine))) for run in runs]
        cells[STYLES[engine][0]] = _cell(found)
    return cells


def _cell(found: list[WalkFeatures]) -> str:
    times = [each.convergence_time_s for each in found if each.convergence_time_s is not None]
    others = Counter(str(each.gait) for each in found if each.convergence_time_s is None)
    words = [f"{len(times)}/{len(found)}"]
    words += [f"after {middle(times, 1)} s"] if times else []
    return "; ".join([*words, *(f"{n} {gait}" for gait, n in others.items())])


if __name__ == "__main__":
    print(markdown(line(*case) for case in cases()))

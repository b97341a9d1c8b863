"""The runs by which a candidate is judged: a few in every generation of a search, many in a check.

All times are those of a robot of Lilibot's size; ``Start.time`` makes them those of the robot.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any, Final

import numpy as np

from apnc.loop.experiment import Experiment
from apnc.tune.design import FEW_LEGS, Candidate, Start
from apnc.varied import varied
from apnc_plant.conditions import Conditions
from apnc_plant.robot import RobotDescription
from apnc_plant.robot.size import mean_leg_length
from apnc_plant.step import longest_step, own_step

WALK_S: Final = 15.0
"""Length of a run of the search [s]."""

CHECK_S: Final = 30.0
"""Length of a run of a check [s]."""

MARGIN: Final = 0.1
"""How far every uncertain number of a body is off at most in a search [1]."""

PAYLOAD: Final = 0.2
"""Payload of a run, as a share of the robot's mass [1]."""

BREAKS_S: Final = 8.0
"""When the sensor of a foot dies [s]; the gait has formed by then."""

HELD_S: Final = 3.0
"""How long a robot hangs in the air before it is let down [s]: some strides."""

HELD_AT: Final = 0.06
"""Height at which it hangs above its start, in leg lengths: no foot reaches the ground."""

RANGE_SEEDS: Final = 20
"""Seeds at each MI of the runs that show the range: as many as a validation has, so that a range
which ends too late is seen here."""

MI_COUNT: Final = 5
"""Number of MI at which a candidate walks in a generation, and in a validation."""

AIR_COUNT: Final = 3
"""Number of MI at which robots with more than four legs are let down from the air in a generation:
in which pattern their legs start decides more of their gait."""

LEG_OFF: Final = 0.0033
"""How far the height of every leg by itself is off at most, in leg lengths, on a body that is off;
more than four legs only. Of three legs more than carry a robot, tenths of a millimetre decide
which ones bear its weight."""

BODIES: Final = 2
"""Number of bodies of a generation; runs share them, since one takes milliseconds to make."""

COARSE: Final = 0.7
"""Integration step of a search, as a share of the longest one that follows the motion [1].

Checks and validations walk with the step that a walk has.
"""

_STEPS: Final = 4
"""Integration steps of a tick are a multiple of this, so that candidates walk side by side."""

_SEEDS: Final = 2**31
"""First seed of checks; those of a search are below it."""

_LEAST, _MOST = 0.0, 1.0

GAIT_KINDS: Final = ("walk", "apc", "payload", "sensor", "air", "varied")
"""Kinds of runs whose gait is judged as a walk is."""


@dataclass(frozen=True)
class Task:
    """A run of a candidate.

    Args:
        kind: what it tests: ``walk``, ``apc``, ``payload``, ``sensor``, ``air`` or ``varied``.
        share: where its MI is in the range of the candidate, 0 to 1.
        experiment: the run.
    """

    kind: str
    share: float
    experiment: Experiment


Extra = Callable[[Start, Candidate, Sequence[RobotDescription], int], list[Task]]
"""Makes more runs of a candidate, from the bodies and the number of its generation."""


def of_generation(
    start: Start,
    candidates: Sequence[Candidate],
    seed: int,
    *,
    count: int = MI_COUNT,
    extra: Extra | None = None,
) -> list[list[Task]]:
    """Runs of the candidates of a generation: the same seeds, MI and chance for each of them.

    Every generation has bodies of its own that are off by ``MARGIN``, so that no set of gains is
    found that walks one body only. Where the paper's experiments are judged, the walks over MI are
    those of the robot itself: there are many other runs with such bodies.

    Args:
        start: what is tuned.
        candidates: the candidates.
        seed: of the generation.
        count: number of MI at which each walks.
        extra: makes more runs of each.
    """
    rng = np.random.default_rng(seed)
    cells = np.arange(count)
    shares = (cells + rng.uniform(size=count)) / count if seed % 2 else cells / cells[-1]
    few = count // 2
    alone = (np.arange(few) + rng.uniform(size=few)) / few
    legs = [leg.name for leg in start.robot.legs]
    dead = legs[int(rng.integers(len(legs)))]
    plan: list[tuple[str, float, Any]] = [
        *(("walk", float(share), Conditions()) for share in shares),
        *(("apc", float(share), Conditions()) for share in alone),
        ("payload", float(rng.uniform()), Conditions(payload=PAYLOAD * start.robot.mass)),
        ("sensor", float(rng.uniform()), _broken(start, dead)),
        *(("air", share, _let_down(start)) for share in _airs(start, rng)),
    ]
    seeds = rng.integers(_SEEDS, size=len(plan)).tolist()
    found = []
    for each in candidates:
        bodies = [_off(each.robot, seed) for seed in seeds[:BODIES]]
        step = shared_step(each.robot, start.rate, coarse=True)
        tasks = [
            _task(
                start, each, kind, share, WALK_S, conditions,
                seed=seeds[k], step=step,
                body=each.robot if start.paper and kind in ("walk", "apc") else bodies[k % BODIES],
            )
            for k, (kind, share, conditions) in enumerate(plan)
        ]  # fmt: skip
        found.append(tasks + (extra(start, each, bodies, seed) if extra else []))
    return found


def of_check(
    start: Start,
    each: Candidate,
    *,
    count: int = 11,
    seconds: float = 20.0,
    extra: Extra | None = None,
) -> list[Task]:
    """Runs of a check during a search: the whole MI range with and without couplings.

    More than four legs are let down from the air over the whole range as well.
    """
    shares = np.linspace(_LEAST, _MOST, count)
    seeds = range(_SEEDS, _SEEDS + 2 * count)
    plan = [(kind, float(share)) for kind in ("walk", "apc") for share in shares]
    tasks = [
        _task(start, each, kind, share, seconds, Conditions(), seed=seed)
        for (kind, share), seed in zip(plan, seeds, strict=True)
    ]
    if start.has_many_legs:
        tasks += [
            _task(start, each, "air", float(share), seconds, _let_down(start), seed=seed)
            for share, seed in zip(shares, seeds, strict=False)
        ]
    if extra is None:
        return tasks
    others = (extra(start, each, [each.robot], number) for number in range(3))
    return tasks + [task for more in others for task in more]


def of_range(start: Start, each: Candidate, *, count: int = 11) -> list[Task]:
    """Runs that show over which part of its MI range a robot walks, with seeds of their own."""
    seeds = range(_SEEDS + 2**16, _SEEDS + 2**16 + RANGE_SEEDS)
    return [
        _task(start, each, kind, float(share), CHECK_S, Conditions(), seed=seed)
        for kind in ("walk", "apc")
        for share in np.linspace(_LEAST, _MOST, count)
        for seed in seeds
    ]


def of_validation(start: Start, each: Candidate, seeds: int) -> Iterator[Task]:
    """Runs of a validation, with seeds and bodies that no search and no check has.

    Args:
        start: what is tuned.
        each: the candidate.
        seeds: number of seeds at each MI.
    """
    first = _SEEDS + 2**20
    shares = np.linspace(_LEAST, _MOST, MI_COUNT).tolist()
    legs = [leg.name for leg in start.robot.legs]
    for seed in range(first, first + seeds):
        body = _off(each.robot, seed)
        for share in shares:
            for kind in ("walk", "apc"):
                yield _task(start, each, kind, share, CHECK_S, Conditions(), seed=seed)
            yield _task(start, each, "varied", share, CHECK_S, Conditions(), seed=seed, body=body)
        middle = shares[MI_COUNT // 2]
        loaded = Conditions(payload=PAYLOAD * each.robot.mass)
        broken = _broken(start, legs[seed % len(legs)])
        for kind, conditions in (("payload", loaded), ("sensor", broken)):
            yield _task(start, each, kind, middle, CHECK_S, conditions, seed=seed)
        for share in shares if start.has_many_legs else [middle]:
            yield _task(start, each, "air", share, CHECK_S, _let_down(start), seed=seed)


def _airs(start: Start, rng: np.random.Generator) -> list[float]:
    """Where in the MI range the robots of a generation are let down from the air, 0 to 1."""
    count = AIR_COUNT if start.has_many_legs else 1
    return [float(x) for x in (np.arange(count) + rng.uniform(size=count)) / count]


def _broken(start: Start, leg: str) -> Any:
    return ((0.0, Conditions()), (BREAKS_S * start.time, Conditions(dropout=(leg,))))


def _let_down(start: Start) -> Any:
    held = Conditions(held_at=HELD_AT * start.length)
    return ((0.0, held), (HELD_S * start.time, Conditions()))


def _task(
    start: Start,
    each: Candidate,
    kind: str,
    share: float,
    seconds: float,
    conditions: Any,
    *,
    seed: int,
    body: RobotDescription | None = None,
    step: float | None = None,
) -> Task:
    experiment = Experiment(
        robot=body or each.robot,
        mi=each.mi(share),
        duration=seconds * start.time,
        seed=seed,
        controller="apc" if kind == "apc" else "apnc",
        # the controller knows the weight of the robot's file, whatever the body weighs
        settings={"robot_weight": each.robot.weight},
        conditions=conditions,
        rate=start.rate,
        step=step or shared_step(each.robot, start.rate),
        engine="compiled",
    )
    return Task(kind, share, experiment)


def _off(robot: RobotDescription, seed: int) -> RobotDescription:
    """The robot with every uncertain number off by chance, but for the delay of its sensors.

    Robots walk side by side only with one delay. Of more than four legs each has a height of its
    own, too.
    """
    rng = np.random.default_rng(seed)
    found = varied(robot, MARGIN, rng)
    legs = found.legs
    if len(legs) > FEW_LEGS:
        off = LEG_OFF * mean_leg_length(robot) * rng.uniform(-1.0, 1.0, size=len(legs))
        legs = tuple(
            replace(leg, mount=(leg.mount[0], leg.mount[1], leg.mount[2] + float(up)))
            for leg, up in zip(legs, off, strict=True)
        )
    return replace(
        found,
        legs=legs,
        sensor=replace(found.sensor, delay=robot.sensor.delay),
        servo=replace(found.servo, latency=robot.servo.latency),
    )


def shared_step(robot: RobotDescription, rate: float, *, coarse: bool = False) -> float:
    """An integration step for a robot and those that are nearly like it [s].

    Args:
        robot: the robot.
        rate: update rate of its controller [Hz].
        coarse: the step of a search; else that of a walk, or a little shorter.

    Raises:
        ValueError: the robot needs too short a step.
    """
    tick, own = 1.0 / rate, own_step(robot)
    step = max(own, COARSE * longest_step(robot)) if coarse else own
    return tick / (_STEPS * math.ceil(tick / step / _STEPS - 1e-9))

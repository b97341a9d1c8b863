"""From a robot file to a tuned one: search, file, and what the robot of the file does."""

from __future__ import annotations

import hashlib
import importlib.util
import shlex
import time
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Final

from apnc.extras import missing
from apnc.loop.batch import Stop
from apnc.tune.design import MI_AIMED, MI_OF_PAPER, Candidate, Start, variables_for
from apnc.tune.evaluate import Evaluator, Stopped, evaluator_of
from apnc.tune.log import Log
from apnc.tune.measured import target
from apnc.tune.runs import of_range
from apnc.tune.search import Best, Count, search
from apnc.tune.span import found_range
from apnc.tune.tuned_file import path_of, read_back, tuned_text
from apnc.tune.validation import SEEDS, Validation, validated
from apnc_core import __version__
from apnc_core.variables import variable_named
from apnc_plant.robot import RobotDescription, load_robot

MINUTES: Final = 10.0
"""How long a search takes if nothing else is asked for [min]."""


@dataclass(frozen=True)
class Allowed:
    """What a search may change besides stance and gains.

    Args:
        servo: stiffness and damping of the servos. Their torque and speed limits never change.
        body: centre of mass, mass split, rotors and feet, for a robot that was never weighed.
        kept: names of variables of stance and controller that stay as they are.
    """

    servo: bool = True
    body: bool = False
    kept: tuple[str, ...] = ()


@dataclass(frozen=True)
class Tuned:
    """A tuned robot.

    Args:
        text: its robot file.
        robot: the same as a robot.
        before: the robot of the file from which the search began.
        best: the best candidate, with its runs in the check of the search.
        begun_at: the point of the robot of the file.
        count: how much was tried.
        validation: what it does; None if it was interrupted before that was walked.
        command: what finds it again.
    """

    text: str
    robot: RobotDescription
    before: RobotDescription
    best: Best
    begun_at: tuple[float, ...]
    count: Count
    validation: Validation | None
    command: str


def tune(
    robot: str | Path,
    *,
    minutes: float | None = None,
    candidates: int | None = None,
    seed: int = 1,
    mi: tuple[float, float] | None = None,
    paper: bool = False,
    allowed: Allowed | None = None,
    near: bool = False,
    workers: int = 1,
    scheduler: str | None = None,
    log: Path | None = None,
    resume: bool = False,
    seeds: int = SEEDS,
    progress: Callable[[Best, Count, float], None] = lambda best, count, share: None,
    measuring: Callable[[], None] = lambda: None,
    stop: Stop = lambda: False,
) -> Tuned:
    """Find the gait of a robot.

    The same seed gives the same candidates, whatever the workers. How many are tried in a time
    depends on the machine; ``candidates`` gives the same result everywhere.

    Args:
        robot: a robot file, or the name of a shipped robot.
        minutes: how long to search [min]; ``MINUTES`` if neither this nor ``candidates`` is given.
        candidates: how many candidates to try; 0: the robot of the file alone.
        seed: of the optimiser and all runs, 1 to 2^20.
        mi: MI range that is aimed at. If omitted, it is ``MI_OF_PAPER`` for the paper, that of the
            file near it, if it has one, and else ``MI_AIMED``. The search may scale it, but not
            for the paper.
        paper: judge by the paper's other experiments as well: update rates, states S1 to S3,
            payload, a damaged leg, turns, and a speed that doubles from MI 0.15 to 0.40.
        allowed: what may be changed; the defaults of :class:`Allowed` if omitted.
        near: stay near the robot of the file, as one that was tuned before.
        workers: number of processes.
        scheduler: address of a Dask scheduler whose workers walk instead.
        log: CSV file of all candidates.
        resume: go on with the search of the log.
        seeds: number of seeds at each MI of the validation.
        progress: called after every generation, with the share of the search that is done.
        measuring: called when the search is over and what was found is walked.
        stop: asked a few times a second; True ends the search, and the best so far is kept.

    Raises:
        ValueError: a value that is not allowed, a robot without a known gait, or a log of another
            search.
        RuntimeError: a package of the extra ``tune`` is missing.
        Stopped: it was stopped before anything was found.
    """
    begun, description = time.perf_counter(), load_robot(robot)
    mi = mi or _usual_range(description, paper=paper, near=near)
    _check(minutes, candidates, seed, mi, workers, seeds)
    _check_packages()
    allowed = allowed or Allowed()
    target(len(description.legs))
    limit = None if candidates is not None and minutes is None else 60.0 * (minutes or MINUTES)
    start = Start(
        description,
        description.rate or 1.0 / float(variable_named("Ts").start or 0.0),
        mi,
        variables_for(
            description,
            servo=allowed.servo,
            body=allowed.body,
            scale=not paper,
            kept=allowed.kept,
        ),
        paper,
        near,
        reference={"b1", "b2"} <= set(allowed.kept),
    )
    lines = Log(log)
    lines.begin(
        [variable.name for variable in start.variables],
        {
            "robot": hashlib.sha256(path_of(robot).read_bytes()).hexdigest()[:16],
            "seed": seed, "mi": list(mi), "servo": allowed.servo, "body": allowed.body,
            "paper": paper, "near": near, "kept": list(allowed.kept), "version": __version__,
        },
        resume=resume,
    )  # fmt: skip

    found_any = False

    def over() -> bool:
        late = found_any and limit is not None and time.perf_counter() - begun > limit
        return stop() or late

    def told(best: Best, count: Count) -> None:
        nonlocal found_any
        found_any = True
        shares = [count.candidates / candidates] if candidates else []
        shares += [(time.perf_counter() - begun) / limit] if limit else []
        progress(best, count, min(1.0, max(shares, default=1.0)))

    with evaluator_of(start, workers, scheduler, over) as evaluator:
        best, count = search(
            start, evaluator, lines, seed=seed, candidates=candidates, progress=told
        )
        again = _command(robot, seed, count, start, allowed)
        measuring()
        last = replace(evaluator, stop=stop)
        found = best.candidate.robot if paper else _within(start, best.candidate, last)
        found = replace(found, mi=_usual(Candidate(found, best.candidate.values)))
        text = tuned_text(robot, found, [f"Tuned by {again}, version {__version__}."])
        tuned = read_back(text)
        candidate = Candidate(tuned, best.candidate.values)
        try:
            validation = validated(start, candidate, last, seeds)
        except Stopped:
            validation = None
    begun_at = tuple(map(float, start.first()))
    return Tuned(text, tuned, description, best, begun_at, count, validation, again)


def _within(start: Start, best: Candidate, evaluator: Evaluator) -> RobotDescription:
    """The robot with the part of its MI range in which it walks as it should.

    If it was stopped before that was walked, the range stays whole.
    """
    assert best.robot.mi_range is not None
    try:
        runs = evaluator(of_range(start, best))
    except Stopped:
        return best.robot
    return replace(best.robot, mi_range=found_range(best.robot.mi_range, runs))


def _usual_range(robot: RobotDescription, *, paper: bool, near: bool) -> tuple[float, float]:
    """MI range that is aimed at where none is asked for."""
    if paper:
        return MI_OF_PAPER
    return (robot.mi_range if near else None) or MI_AIMED


def _usual(candidate: Candidate) -> float:
    """MI to walk at where none is asked for: the middle of the range."""
    return float(f"{candidate.mi(0.5):.2g}")


def _check(
    minutes: float | None, candidates: int | None, seed: int, mi: tuple[float, float],
    workers: int, seeds: int,
) -> None:  # fmt: skip
    if minutes is not None and not 0.0 < minutes < 1e5:
        raise ValueError(f"minutes = {minutes}; allowed: above 0, below 100000")
    if candidates is not None and candidates < 0:
        raise ValueError(f"candidates = {candidates}; allowed: 0 and more")
    if not 1 <= seed <= 2**20:  # the optimiser takes 0 for the time of day
        raise ValueError(f"seed = {seed}; allowed: 1 to {2**20}")
    limits = variable_named("MI")
    low, high = mi
    if not (0.0 < low < high <= (limits.max or 1.0)):
        raise ValueError(f"mi = {low:g},{high:g}; allowed: 0 < low < high <= {limits.max:g}")
    if workers < 1:
        raise ValueError(f"workers = {workers}; allowed: 1 and more")
    if seeds < 1:
        raise ValueError(f"seeds = {seeds}; allowed: 1 and more")


def _check_packages() -> None:
    """Look for the packages of the extra before anything is computed."""
    for package in ("cma", "tomlkit"):
        if importlib.util.find_spec(package) is None:
            raise RuntimeError(missing(package, "tune"))


def _command(robot: str | Path, seed: int, count: Count, start: Start, allowed: Allowed) -> str:
    words: list[Any] = ["apnc", "tune", robot, "--candidates", count.checked, "--seed", seed]
    words += [
        flag
        for flag, on in (
            ("--paper", start.paper),
            ("--near", start.near),
            ("--keep-servo", not allowed.servo),
            ("--body", allowed.body),
        )
        if on
    ]
    words += ["--keep", ",".join(allowed.kept)] if allowed.kept else []
    if start.mi != _usual_range(start.robot, paper=start.paper, near=start.near):
        words += ["--mi", f"{start.mi[0]:g},{start.mi[1]:g}"]
    return shlex.join(map(str, words))

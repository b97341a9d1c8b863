"""A study: its grid of experiments, the measures it takes of a record, its claims and figures."""

from __future__ import annotations

import importlib
import itertools
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Final

from apnc.controllers import ALL, named_controller
from apnc.loop.code import hash_of_package
from apnc.loop.engines import COMPILED
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record
from apnc.loop.schedule import schedule_text
from apnc.report.figure import Figure
from apnc.studies.claims import Claim
from apnc.studies.registry import CONTROLLERS_OPTION, ROBOT, Entry
from apnc.studies.results import Result, TrialId
from apnc_core.in_python import in_python
from apnc_plant.plant import Plant
from apnc_plant.robot import RobotDescription

AxisValue = str | float | int
Axes = Mapping[str, Sequence[AxisValue]]
"""Values along the axes of a grid, by name of the axis."""

Robot = str | RobotDescription

Seeds = Callable[[Mapping[str, AxisValue], int], int]
"""Number of seeds to run in a cell, of the cell and the number of seeds that was asked for."""

WALK_MI: Final = 0.08
"""MI of the walks of sections 3.1.2 to 3.1.4."""

SCHEDULE_MI: Final = 0.15
"""MI of the walks with a damaged leg and through the states S1 to S3, and first MI of schedules."""

WALK_S: Final = 45.0
"""Length of a walk in section 3.1 [s]."""


def fewer_of_others(**at: Sequence[AxisValue]) -> Seeds:
    """All seeds for APNC. The other controllers run half of them, at these values only."""

    def seeds(cell: Mapping[str, AxisValue], trials: int) -> int:
        if cell["controller"] == "apnc":
            return trials
        there = all(cell[axis] in values for axis, values in at.items())
        return math.ceil(trials / 2) if there else 0

    return seeds


@dataclass(frozen=True)
class Trial:
    """One experiment of a study and its cell in the grid."""

    entry: Entry
    cell: Mapping[str, Any]
    experiment: Experiment

    @property
    def study(self) -> str:
        """Name of the study."""
        return self.entry.name

    @property
    def in_c(self) -> bool:
        """Whether it walks in C, side by side with others."""
        return self.experiment.engine == COMPILED and load(self.entry).plant is None

    @cached_property
    def id(self) -> TrialId:
        """Study, label of the controller, and key.

        The key is that of the experiment. For a study outside the product the hash of its package
        is appended, since the key of an experiment covers the product's code only.
        """
        own = hash_of_package(self.entry.package)
        key = self.experiment.key()
        return TrialId(self.study, self.cell["controller"], f"{key}-{own}" if own else key)


@dataclass(frozen=True)
class Study:
    """A study.

    Args:
        entry: its entry in the registry.
        experiment: function that makes the experiment of a cell. Its keyword arguments are
            ``controller`` (a label), ``seed``, one per axis, and ``robot`` if one was asked for.
            Settings that it makes override those that the controller has for this study.
        axes: values along each axis of the grid, by name.
        controllers: labels of the controllers to run.
        seeds: number of seeds to run in a cell; 0 skips it. Cells at values that the user chose
            run all seeds.
        measure: measures of a record that its summary does not have. None stands for undefined.
        claims: claims of the paper, or aims, that the results are held against.
        figures: function that draws the results. There is at least one result.
        scenes: function that runs a robot once or twice and draws these runs over time. It is
            called when all results are there.
        table: function that makes a Markdown table of the results. None makes no table.
        engine: engine of all trials. None leaves it to the experiments.
        plant: function that makes the robot of an experiment at its start. None takes that of the
            experiment's engine.
    """

    entry: Entry
    experiment: Callable[..., Experiment]
    axes: Axes = field(default_factory=dict)
    controllers: tuple[str, ...] = ALL
    seeds: Seeds = lambda cell, trials: trials
    measure: Callable[[Record], Result] = lambda record: {}
    claims: tuple[Claim, ...] = ()
    figures: Callable[[Sequence[Result]], list[Figure]] = lambda results: []
    scenes: Callable[[Robot], list[Figure]] = lambda robot: []
    table: Callable[[Sequence[Result]], str] | None = None
    engine: str | None = COMPILED
    plant: Callable[[Experiment], Plant] | None = None

    @property
    def name(self) -> str:
        """Name in the registry."""
        return self.entry.name

    def grid(
        self,
        trials: int,
        controllers: Sequence[str] | None = None,
        chosen: Axes | None = None,
        duration: float | None = None,
        robot: str | None = None,
    ) -> list[Trial]:
        """The trials: every value of every axis, with its seeds and controllers.

        Arguments and errors are those of ``run_study``.
        """
        trials, duration, robot = in_python(trials), in_python(duration), in_python(robot)
        controllers = in_python(controllers)
        chosen = {axis: in_python(values) for axis, values in (chosen or {}).items()}
        if not isinstance(trials, int):
            raise ValueError(f"trials = {trials!r} is not a whole number")
        if trials < 1:
            raise ValueError(f"trials = {trials} is not at least 1")
        if controllers is not None and CONTROLLERS_OPTION not in self.entry.options:
            raise ValueError(f"study '{self.name}' takes no controllers; it has its own")
        if robot is not None and ROBOT not in self.entry.options:
            raise ValueError(f"study '{self.name}' takes no robot; it has its own")
        if not (
            used := tuple(dict.fromkeys(self.controllers if controllers is None else controllers))
        ):
            raise ValueError("no controller is given")
        if unknown := set(chosen) - set(self.axes):
            allowed = ", ".join(self.axes) or "none"
            raise ValueError(f"{unknown.pop()} is no axis of '{self.name}'; allowed: {allowed}")
        values = (self._values(axis, chosen.get(axis)) for axis in self.axes)
        cells = [dict(zip(self.axes, at, strict=True)) for at in itertools.product(*values)]
        return [
            self._trial({"controller": controller, **cell, "seed": seed}, duration, robot)
            for cell in cells
            for seed in range(trials)
            for controller in used
            if chosen or seed < self.seeds({"controller": controller, **cell}, trials)
        ]

    def _values(self, axis: str, chosen: Sequence[AxisValue] | None) -> list[AxisValue]:
        known = self.axes[axis]
        if chosen is None:
            return list(known)
        if isinstance(chosen, str) or not isinstance(chosen, Iterable):
            raise ValueError(f"{axis} = {chosen!r} is not a list of values")
        if not (chosen := list(chosen)):
            raise ValueError(f"no {axis} is given")
        try:
            values = [type(known[0])(value) for value in chosen]
        except (TypeError, ValueError):
            raise ValueError(f"{axis} = {', '.join(map(str, chosen))}: not a number") from None
        for value in values:  # numbers with a unit are free, names and counts are not
            if not isinstance(value, float) and value not in known:
                raise ValueError(f"{axis} '{value}' is not one of {', '.join(map(str, known))}")
        return list(dict.fromkeys(values))

    def _trial(
        self, cell: dict[str, AxisValue], duration: float | None, robot: str | None
    ) -> Trial:
        used = named_controller(str(cell["controller"]))
        own = {} if robot is None else {"robot": robot}
        experiment = self.experiment(**cell | own)
        settings = {**used.in_study.get(self.name, {}), **experiment.settings}
        length = experiment.duration if duration is None else duration
        engine = self.engine or experiment.engine
        experiment = replace(experiment, settings=settings, duration=length, engine=engine)
        mi = (
            experiment.mi
            if isinstance(experiment.mi, int | float)
            else schedule_text(experiment.mi)
        )
        first = {"controller": cell["controller"], "mi": mi, "seed": cell["seed"]}
        whole = {**first, "duration": experiment.duration, **cell, **own}
        return Trial(self.entry, whole, experiment)


def load(entry: Entry) -> Study:
    """Import the study of an entry."""
    study: Study = importlib.import_module(f"{entry.package}.{entry.name}").STUDY
    return study

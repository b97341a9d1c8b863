"""Closed loops of controller and robot in C. Runs walk side by side in the lanes of one plant."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from apnc.loop.controller_library import ControllerLibrary, controller_library
from apnc.loop.experiment import Experiment, conditions_of
from apnc.loop.fmu_controller import FmuError
from apnc.loop.push import velocity_changes
from apnc.loop.record import End, Record, merged
from apnc.loop.schedule import first_tick, steps_of
from apnc_core.schema import Shape
from apnc_core.types import Array
from apnc_core.variables import variable_named
from apnc_plant.chance import side_offset
from apnc_plant.ground import GroundInC
from apnc_plant.library import aligned_memory, library
from apnc_plant.numbers import conditions_numbers, robot_numbers
from apnc_plant.options import PlantOptions
from apnc_plant.sample import record_signals, record_size, recorded_signals, signal_bits
from apnc_plant.signals import diverged
from apnc_plant.start import start_coordinates
from build_fmu.build import host_fmu

Stop = Callable[[], bool]
"""Asked now and then while robots walk; True ends the work."""


def fmu_of(experiment: Experiment) -> str:
    """Path of the FMU that controls an experiment.

    Raises:
        BuildError: the package brings no such FMU, and it cannot be built.
    """
    return experiment.fmu or _own_fmu(len(experiment.description.legs))


@cache
def _own_fmu(legs: int) -> str:
    """Path of the FMU with the defaults; cached, since the look-up takes milliseconds."""
    return str(host_fmu(legs))


class Run:
    """One run of an experiment in C, and its record.

    Args:
        experiment: what is run. It walks in C whatever its engine is.
        controller: the controller FMU.
        signals: names of the signals to record, those of the :class:`Batch`; None: all.
    """

    def __init__(
        self,
        experiment: Experiment,
        controller: ControllerLibrary,
        signals: frozenset[str] | None = None,
    ) -> None:
        ffi, _ = library()
        self.experiment, self._controller = experiment, controller
        self._sizes = controller.recording(signals).sizes
        self._of_plant = recorded_signals(signals)
        self._whole = signals is None
        robot, ground = experiment.description, experiment.ground
        steps = [(tick, conditions_of(c, robot)) for tick, c in _ticks(experiment, "conditions")]
        first = steps[0][1]
        names, n_legs = tuple(leg.name for leg in robot.legs), len(robot.legs)
        self.mass = robot.mass + first.payload
        numbers = robot_numbers(
            robot, side_offset=side_offset(robot, experiment.seed), payload=first.payload
        )
        surface = GroundInC(ground, max(robot.foot_radii))
        start = start_coordinates(numbers, surface, PlantOptions())
        conditions = [conditions_numbers(c, names, robot.weight) for _, c in steps]
        starts, kept = controller.starts(experiment.starts())
        ticks = experiment.ticks
        of_plant = ticks * record_size(self._of_plant, n_legs)
        size = of_plant + ticks * sum(self._sizes.values())
        try:
            table = np.empty(size)
        except MemoryError:
            raise ValueError(
                f"duration = {experiment.duration:g} s: a record of {8e-9 * size:.0f} GB does not "
                "fit into memory"
            ) from None
        self._samples, self._shown = table[:of_plant], table[of_plant:]
        self._parameters = np.empty(len(controller.parameters))
        changes = velocity_changes(experiment.pushes, self.mass, experiment.Ts, ticks)
        schedules = {name: _schedule(experiment, name) for name in ("mi", "turn", "reset")}
        fields = {
            "guid": controller.guid,
            "starts": starts,
            "robot": numbers.at,
            "ground": surface.at,
            "seed": experiment.seed,
            "coordinates": ffi.new("double[]", start.tolist()),
            "height": first.held_at or 0.0,
            "ticks": ticks,
            **{name: schedule for name, (schedule, _) in schedules.items()},
            "n_conditions": len(steps),
            "condition_tick": ffi.new("int32_t[]", [tick for tick, _ in steps]),
            "condition": ffi.new("plant_conditions[]", [c.at[0] for c in conditions]),
            "n_pushes": len(changes),
            "push_tick": ffi.new("int32_t[]", list(changes)),
            "push": ffi.new("double[]", [v for change in changes.values() for v in change]),
            "plant_signals": signal_bits(self._of_plant),
            "plant_record": ffi.from_buffer("double[]", self._samples),
            "controller_record": ffi.from_buffer("double[]", self._shown),
            "parameters": ffi.from_buffer("double[]", self._parameters),
        }
        self._surface = surface
        self._kept = (fields, numbers, conditions, kept, schedules)
        self.at = ffi.new("loop_run *", fields)
        self.wall_s = 0.0

    @property
    def phi(self) -> Array:
        """Relative phases at the last tick [rad], shape (n_legs - 1,)."""
        phi: Array = self._controller_signals(max(1, self.ticks))["phi"][-1]
        return phi

    @property
    def ticks(self) -> int:
        """Number of ticks taken so far."""
        return int(self.at.count)

    def _controller_signals(self, count: int) -> dict[str, Array]:
        """The first samples of every variable of the controller, by name."""
        signals, start, ticks = {}, 0, self.experiment.ticks
        for name, size in self._sizes.items():
            values = self._shown[start : start + ticks * size]
            scalar = variable_named(name).shape is Shape.scalar
            signals[name] = (values if scalar else values.reshape(ticks, size))[:count]
            start += ticks * size
        return signals

    def record(self, end: End | None = None) -> Record:
        """What was recorded.

        Args:
            end: how the run ended, if it was ended from outside.

        Raises:
            FmuError: the controller refused.
            ValueError: the touch function of a ground of one's own raised an error.
        """
        ffi, lib = library()
        self._surface.check()
        message = ffi.string(self.at.message).decode(errors="replace")
        refused = self.at.end == lib.LOOP_REFUSED
        if end is None and refused:
            raise FmuError(message)
        ends = {
            lib.LOOP_COMPLETE: End.complete,
            lib.LOOP_FELL: End.fell,
            lib.LOOP_DIVERGED: End.diverged,
        }
        found = end or ends[self.at.end]
        if found is End.diverged:
            message = diverged(self.ticks * self.experiment.Ts, self.experiment.step)
        robot, count = self.experiment.description, self.ticks
        return Record(
            legs=tuple(leg.name for leg in robot.legs),
            time=np.arange(count, dtype=np.float64) * self.experiment.Ts,
            signals=merged(
                plant=record_signals(
                    self._samples, self._of_plant, self.experiment.ticks, count, len(robot.legs)
                ),
                controller=self._controller_signals(count),
            ),
            mass=self.mass,
            experiment=self.experiment,
            robot=robot,
            parameters=self._controller.parameters_of(self._parameters.tolist())
            if self._whole and not refused
            else {},
            end=found,
            message=message,
            fmu_wall_s=float(self.at.controller_s),
            wall_s=self.wall_s,
        )


def _ticks(experiment: Experiment, name: str) -> list[tuple[int, Any]]:
    """Steps of a schedule, each with its first tick. Of several at one tick the last counts.

    Steps after the end of the run are left out, since C counts ticks in 32 bits.
    """
    found: dict[int, Any] = {}
    for start, value in steps_of(getattr(experiment, name)):
        if start < experiment.ticks * experiment.Ts:
            found[first_tick(start, experiment.Ts)] = value
    return sorted(found.items())


def _schedule(experiment: Experiment, name: str) -> tuple[dict[str, Any], tuple[Any, ...]]:
    ffi, _ = library()
    steps = _ticks(experiment, name)
    ticks = ffi.new("int32_t[]", [tick for tick, _ in steps])
    values = ffi.new("double[]", [float(value) for _, value in steps])
    return {"n": len(steps), "tick": ticks, "value": values}, (ticks, values)


@dataclass(frozen=True)
class Lanes:
    """Properties that runs must have in common to walk side by side.

    Args:
        fmu: path of the controller.
        n_legs: number of legs.
        rate: of the controller [Hz].
        step: longest integration step [s].
        latency: of the servos [s].
        delay: of the sensors [s].
        flat: whether the ground is a plane.
        usual_legs: whether all joints turn about the usual axes, see ``plant_place``.
    """

    fmu: str
    n_legs: int
    rate: float
    step: float
    latency: float
    delay: float
    flat: bool
    usual_legs: bool


def lanes_of(experiment: Experiment) -> Lanes:
    """Properties of an experiment that others must share to walk beside it."""
    robot = experiment.description
    return Lanes(
        fmu_of(experiment),
        len(robot.legs),
        experiment.rate,
        experiment.step,
        robot.servo.latency,
        robot.sensor.delay,
        experiment.ground.flat,
        robot.usual_legs,
    )


class Batch:
    """Closed loops that walk side by side.

    Args:
        lanes: properties that the runs have in common.
        contacts: largest number of contacts of a foot with any of their grounds.
        single: compute one run with its legs side by side, in place of several runs.
        level: instruction set, see ``plant.h``; the best of this machine if omitted. Every level
            gives the same bits.
        signals: names of the signals that are recorded; None: all.

    Attributes:
        size: number of lanes.
        controller: the FMU that walks the runs.

    Raises:
        ValueError: the controller has another number of legs, or this machine lacks the instruction
            set.
    """

    def __init__(
        self,
        lanes: Lanes,
        contacts: int,
        *,
        single: bool = False,
        level: int | None = None,
        signals: frozenset[str] | None = None,
    ) -> None:
        ffi, lib = library()
        self.controller = controller_library(lanes.fmu)
        if self.controller.n_legs != lanes.n_legs:
            raise ValueError(
                f"{lanes.fmu} is for {self.controller.n_legs} legs; the robot has {lanes.n_legs}"
            )
        kind = lib.PLANT_LEGS if single else lib.PLANT_ROBOTS
        best, Ts = lib.plant_best_level(), 1.0 / lanes.rate
        level = best if level is None else level
        if not 0 <= level <= best:
            raise ValueError(f"level is {level}; allowed on this machine: 0 to {best}")
        history = lib.plant_history(lanes.latency, lanes.delay, Ts)
        shape = (kind, level, lanes.n_legs, 0 if lanes.flat else contacts, history)
        self._memory, self._kept = aligned_memory(lib.loop_size(*shape))
        # kept here: another thread may have put an equal one of its own into the cache
        self._recording = self.controller.recording(signals)
        lib.loop_create(
            self._memory,
            *shape,
            self.controller.functions,
            self._recording.variables,
            Ts,
            lanes.step,
        )
        self.size = int(lib.loop_lanes(self._memory))
        self._stop = ffi.new("int32_t *", 0)
        self._runs: list[Run | None] = [None] * self.size

    @property
    def free(self) -> int:
        """Number of lanes without a run."""
        return self._runs.count(None)

    def begin(self, run: Run) -> None:
        """Put a run into a free lane."""
        _, lib = library()
        lane = self._runs.index(None)
        self._runs[lane] = run
        lib.loop_begin(self._memory, lane, run.at)

    def walk(self, ticks: int) -> list[Run]:
        """Walk for a number of ticks, or until a run has ended.

        Returns:
            The runs that have ended.
        """
        _, lib = library()
        begin, walking = time.perf_counter(), self.size - self.free
        lib.loop_walk(self._memory, ticks, self._stop)
        share = (time.perf_counter() - begin) / max(1, walking)
        ended = []
        for lane, run in enumerate(self._runs):
            if run is None:
                continue
            run.wall_s += share
            if run.at.end != lib.LOOP_RUNS:
                ended.append(run)
                self._runs[lane] = None
        return ended

    def stop(self) -> None:
        """Make :meth:`walk` return soon. It may be called from another thread."""
        self._stop[0] = 1

    def close(self) -> None:
        """Free the controllers of unfinished runs."""
        _, lib = library()
        lib.loop_free(self._memory)
        self._runs = [None] * self.size


def contacts_of(experiments: Sequence[Experiment]) -> int:
    """Largest number of contacts of a foot with any of the grounds."""
    grounds = {(e.ground, max(e.description.foot_radii)) for e in experiments}
    return max(ground.numbers(radius).contacts for ground, radius in grounds)

"""The closed loop as an environment of Gymnasium, for learners of Python.

Importing it registers ``apnc/Walk-v0``:

>>> import gymnasium, apnc.gym_env  # doctest: +SKIP
>>> env = gymnasium.make("apnc/Walk-v0", experiment=apnc.Experiment(duration=10))  # doctest: +SKIP
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, Final, Literal

import numpy as np
from numpy.typing import NDArray

from apnc.extras import missing
from apnc.loop.engines import COMPILED
from apnc.loop.experiment import Experiment, conditions_of
from apnc.loop.fmu_controller import FmuController
from apnc.loop.record import End, Record, merged
from apnc.loop.schedule import ScheduleLookup
from apnc.loop.simulate import plant_of
from apnc_core.types import Array
from apnc_core.variables import variable_named
from apnc_plant.plant import LivePlant, PlantError
from build_fmu.build import host_fmu

try:
    import gymnasium
except ModuleNotFoundError:
    raise ModuleNotFoundError(missing("gymnasium", "gym")) from None

ID: Final = "apnc/Walk-v0"
"""Name in the registry of Gymnasium."""

FALL: Final = 0.5
"""What a fall costs [m]."""

LOAD: Final = 4.0
"""Largest load that is observed, in halves of the weight [1]."""

SPEED: Final = 2.0
"""Largest speed that is observed [m/s]."""

YAW_RATE: Final = 6.0
"""Largest yaw rate that is observed [rad/s]."""

Floats = NDArray[np.float32]


class WalkEnv(gymnasium.Env[Floats, Floats]):
    """A robot under its controller, which an agent commands a few times a second.

    An action acts for ``period``. With ``acts="commands"`` it is MI, 0 ... 1 [1], and the steering
    ``turn``, -1 (right) ... 1 (left) [1]. With ``acts="loads"`` it has a factor for each leg,
    0 ... 2 [1], by which the controller sees the load of the foot; MI and turn are those of the
    experiment.

    An observation has, clipped to its bounds: for each leg the load that its sensor shows, in
    halves of the weight, 0 ... ``LOAD`` [1]; for each leg but the first sine and cosine of its
    phase relative to the first [1]; roll and pitch of the trunk, -pi ... pi [rad]; mean speed
    forward over the last action, within ``SPEED`` [m/s]; mean yaw rate over it, within ``YAW_RATE``
    [rad/s]. The entries are named in ``names``.

    The reward of an action is the way forward in it [m], along the heading of every tick, minus
    ``FALL`` where the robot falls or its motion diverges, which ends the episode as terminated. It
    is truncated at the duration of the experiment. ``info`` has ``time`` [s], ``forward``, the way
    forward since the start [m], ``fell``, and ``seed``, that of the robot.

    Every reset draws a seed of the robot (its asymmetry and noise) from that of the environment.

    Pitfall: a step lasts whole ticks of the controller; ``period`` is rounded to them.

    Args:
        experiment: robot, ground, conditions, duration and all else; 10 s in C if omitted. Its seed
            is not used.
        acts: what an action is.
        period: time of a step of the environment [s].
        render_mode: None only; :meth:`record` gives the walk for a report or film.

    Attributes:
        names: of the entries of an observation, with their units.

    Raises:
        ValueError: another ``acts`` or ``render_mode``, or a period that is not positive.
    """

    metadata: dict[str, Any] = {"render_modes": []}  # noqa: RUF012  # as Gymnasium has it

    def __init__(
        self,
        experiment: Experiment | None = None,
        acts: Literal["commands", "loads"] = "commands",
        period: float = 0.5,
        render_mode: str | None = None,
    ) -> None:
        if acts not in ("commands", "loads"):
            raise ValueError(f"acts is '{acts}'; allowed: commands, loads")
        if render_mode is not None:
            raise ValueError(f"render_mode is '{render_mode}'; allowed: None")
        if not (math.isfinite(period) and period > 0.0):
            raise ValueError(f"period is {period}; allowed: a finite number above 0 [s]")
        self._experiment = experiment or Experiment(duration=10.0, engine=COMPILED)
        self._acts, self.render_mode = acts, None
        self._ticks = max(1, round(period * self._experiment.rate))
        self._legs = tuple(leg.name for leg in self._experiment.description.legs)
        n, box = len(self._legs), gymnasium.spaces.Box
        lows, highs = zip(*map(_limits, ("MI", "turn")), strict=True)
        self.action_space = (
            box(_single(lows), _single(highs))
            if acts == "commands"
            else box(0.0, 2.0, (n,), np.float32)
        )
        high = [LOAD] * n + [1.0] * (2 * (n - 1)) + [math.pi, math.pi, SPEED, YAW_RATE]
        low = [0.0] * n + [-bound for bound in high[n:]]
        self.observation_space = box(_single(low), _single(high))
        relations = [f"phi1{k}" for k in range(2, n + 1)]
        self.names = (
            *(f"{leg}.load [1]" for leg in self._legs),
            *(f"sin {phi} [1]" for phi in relations),
            *(f"cos {phi} [1]" for phi in relations),
            *("roll [rad]", "pitch [rad]", "forward speed [m/s]", "yaw rate [rad/s]"),
        )
        self._controller: FmuController | None = None

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Floats, dict[str, Any]]:
        """Put the robot to its start, with a new seed drawn; see ``gymnasium.Env.reset``."""
        super().reset(seed=seed)
        self.close()
        self._run = replace(self._experiment, seed=int(self.np_random.integers(2**63)))
        plant = plant_of(self._run)
        assert isinstance(plant, LivePlant)
        self._plant = plant
        path = Path(self._run.fmu) if self._run.fmu else host_fmu(len(self._legs))
        self._controller = FmuController(path, self._run.starts())
        self._parameters = self._controller.parameters()
        self._body, self._brain = plant.trace(), self._controller.trace()
        self._lookups = {
            name: ScheduleLookup(getattr(self._run, name))
            for name in ("mi", "turn", "reset", "conditions")
        }
        self._condition = self._lookups["conditions"].at(0.0)
        self._n, self._forward, self._end, self._message = 0, 0.0, End.interrupted, ""
        self._commands: list[tuple[float, float, float]] = []
        self._seen = plant.sample()
        return self._observation(0.0, 0.0), self._info()

    def step(self, action: Floats) -> tuple[Floats, float, bool, bool, dict[str, Any]]:
        """Walk for a period; see ``gymnasium.Env.step`` and the class.

        Raises:
            ValueError: an action of another shape, or not finite.
            gymnasium.error.ResetNeeded: no episode has begun, or it is over.
        """
        if self._controller is None or self._end is not End.interrupted:
            raise gymnasium.error.ResetNeeded("call reset() before step()")
        asked = np.asarray(action, dtype=np.float64)
        if asked.shape != self.action_space.shape or not np.isfinite(asked).all():
            shape = self.action_space.shape
            raise ValueError(f"action is {action}; allowed: finite numbers of shape {shape}")
        space: Any = self.action_space
        asked = np.clip(asked, space.low.astype(np.float64), space.high.astype(np.float64))
        before, way, turned = self._n, 0.0, 0.0
        for _ in range(self._ticks):
            if self._end is not End.interrupted:
                break
            ahead, yaw = self._tick(self._controller, asked)
            way, turned = way + ahead, turned + yaw
        self._forward += way
        lasted = max(1, self._n - before) * self._run.Ts
        end: End = self._end
        fell = end in (End.fell, End.diverged)
        reward = way - (FALL if fell else 0.0)
        seen = self._observation(way / lasted, turned / lasted)
        return seen, reward, fell, end is End.complete, self._info()

    def _tick(self, controller: FmuController, asked: Array) -> tuple[float, float]:
        """One tick; the way forward [m] and the turn [rad] in it."""
        Ts, plant, seen = self._run.Ts, self._plant, self._seen
        t = self._n * Ts
        if (wanted := self._lookups["conditions"].at(t)) is not self._condition:
            plant.set_conditions(conditions_of(wanted, self._run.description))
            self._condition = wanted
        mi, turn, loads = self._lookups["mi"].at(t), self._lookups["turn"].at(t), plant.grf()
        if self._acts == "commands":
            mi, turn = float(asked[0]), float(asked[1])
        else:
            loads = loads * asked
        self._commands.append((t, mi, turn))
        controller.step(t, Ts, loads, mi, turn, self._lookups["reset"].at(t))
        self._body.take()
        self._brain.take()
        self._n += 1
        try:
            plant.advance(controller.theta_hip, controller.theta_knee, Ts)
        except PlantError as problem:
            self._end, self._message = End.diverged, str(problem)
            return 0.0, 0.0
        self._seen = plant.sample()
        if plant.fell:
            self._end = End.fell
        elif self._n == self._run.ticks:
            self._end = End.complete
        yaw = float(seen["rpy"][2])
        dx, dy, _ = self._seen["position"] - seen["position"]
        turned = math.remainder(float(self._seen["rpy"][2]) - yaw, 2.0 * math.pi)
        return float(dx * math.cos(yaw) + dy * math.sin(yaw)), turned

    def _observation(self, speed: float, yaw_rate: float) -> Floats:
        assert self._controller is not None
        weight = self._run.description.weight
        phi, rpy = self._controller.phi, self._seen["rpy"]
        values = np.concatenate([
            self._seen["grf"] / (0.5 * weight), np.sin(phi), np.cos(phi),
            [math.remainder(angle, 2.0 * math.pi) for angle in rpy[:2]], [speed, yaw_rate],
        ])  # fmt: skip
        space: Any = self.observation_space
        clipped: Floats = np.clip(values.astype(np.float32), space.low, space.high)
        return clipped

    def _info(self) -> dict[str, Any]:
        return {
            "time": self._n * self._run.Ts,
            "forward": self._forward,
            "fell": self._end in (End.fell, End.diverged),
            "seed": self._run.seed,
        }

    def record(self) -> Record:
        """The walk of this episode so far, as ``apnc.simulate`` gives it.

        With ``acts="commands"`` its experiment has the commands of the agent as MI and turn over
        time, and repeats the walk.

        Raises:
            ValueError: the agent acts on the loads, which no experiment describes.
            gymnasium.error.ResetNeeded: no episode has begun.
        """
        if self._acts == "loads":
            raise ValueError("an agent that acts on the loads leaves no experiment to repeat")
        if self._controller is None:
            raise gymnasium.error.ResetNeeded("call reset() before record()")
        commands = [(t, (mi, turn)) for t, mi, turn in self._commands] or [(0.0, (0.0, 0.0))]
        changes = [
            entry for k, entry in enumerate(commands) if not k or entry[1] != commands[k - 1][1]
        ]
        mi = tuple((t, values[0]) for t, values in changes)
        turn = tuple((t, values[1]) for t, values in changes)
        return Record(
            legs=self._legs,
            time=np.arange(len(self._body), dtype=np.float64) * self._run.Ts,
            signals=merged(plant=self._body.signals(), controller=self._brain.signals()),
            mass=self._plant.mass,
            experiment=replace(self._run, mi=mi, turn=turn),
            robot=self._run.description,
            parameters=self._parameters,
            end=self._end,
            message=self._message,
        )

    def close(self) -> None:
        """Free the controller."""
        if self._controller is not None:
            self._controller.close()
            self._controller = None


def _single(values: Sequence[float]) -> Floats:
    return np.asarray(values, dtype=np.float32)


def _limits(name: str) -> tuple[float, float]:
    variable = variable_named(name)
    assert variable.min is not None and variable.max is not None
    return variable.min, variable.max


if ID not in gymnasium.registry:
    gymnasium.register(id=ID, entry_point="apnc.gym_env:WalkEnv", disable_env_checker=True)

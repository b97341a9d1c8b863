"""What a run leaves behind: every signal, sampled once per control tick."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import Final

from apnc.loop.experiment import Experiment
from apnc_core.schema import Shape, Variable
from apnc_core.settings import Setting
from apnc_core.types import Array
from apnc_core.variables import TABLE
from apnc_plant.robot import RobotDescription
from apnc_plant.signals import PLANT_SIGNALS


class End(StrEnum):
    """How a run ended."""

    complete = "complete"
    fell = "fell"
    diverged = "diverged"
    interrupted = "interrupted"


@dataclass(frozen=True)
class Record:
    """A run, whether it came to its planned end or not.

    Args:
        legs: leg names in FMU order, e.g. ``("RF", "RH", "LF", "LH")``.
        time: sample times [s], shape (T,).
        signals: name -> array, first axis time. The signals of the robot have the shape
            (T, \\*signal.shape(n_legs)), see ``apnc_plant.signals.PLANT_SIGNALS``. Those of the
            controller are its inputs, outputs and local variables, see
            ``apnc_core.variables.TABLE``: shape (T,), (T, n_legs) for a variable of each leg or
            (T, n_legs - 1) for phase relations (phi12, phi13, ...).
        mass: total mass of the robot with its payload [kg].
        experiment: what was run.
        robot: what walked.
        parameters: of the controller at the start, by name, as read back from the FMU; those of
            the experiment if empty.
        end: how the run ended.
        message: what broke down, if anything did.
        fmu_wall_s: wall time spent inside the controller [s].
        wall_s: wall time of the whole loop [s].
    """

    legs: tuple[str, ...]
    time: Array
    signals: Mapping[str, Array]
    mass: float
    experiment: Experiment
    robot: RobotDescription
    parameters: Mapping[str, Setting] = field(default_factory=dict)
    end: End = End.complete
    message: str = ""
    fmu_wall_s: float = 0.0
    wall_s: float = 0.0

    def __len__(self) -> int:
        return len(self.time)

    def __getitem__(self, part: slice) -> Record:
        """The run with the samples of a part alone, e.g. ``record[60:]`` or ``record[:-1]``."""
        signals = {name: values[part] for name, values in self.signals.items()}
        return replace(self, time=self.time[part], signals=signals)

    @property
    def n_legs(self) -> int:
        """Number of legs."""
        return len(self.legs)

    def until(self, count: int) -> Record:
        """The first ``count`` samples of the run."""
        return self[:count]

    @property
    def complete(self) -> bool:
        """Whether the run came to its planned end."""
        return self.end is End.complete

    @property
    def ended_at(self) -> float:
        """Simulated time [s]; a sample stands for the whole tick that follows it."""
        return round(len(self) * self.experiment.Ts, 9)


def merged(plant: Mapping[str, Array], controller: Mapping[str, Array]) -> dict[str, Array]:
    """The signals of a record.

    The load ``grf`` is an output of the robot and an input of the controller. It is recorded once,
    as it reached the controller.
    """
    return {**plant, **controller}


@dataclass(frozen=True)
class Column:
    """One column of ``record.csv``: its name, unit, frame, meaning, and what positive means."""

    name: str
    unit: str
    frame: str
    description: str
    sign: str = ""


_TIME: Final = Column("time", "s", "", "start of the tick")


def column_names(record: Record) -> list[Column]:
    """The flat columns of a record, in order: ``time``, ``RF.o1``, ``phi12``, ``position.x``."""
    return [column for column, _ in _columns(record)]


def columns(record: Record) -> dict[str, Array]:
    """All signals as flat columns of shape (T,), by name.

    Vectors are named by component, signals per leg by leg, relations by the pair of legs.
    """
    return {column.name: values for column, values in _columns(record)}


def _columns(record: Record) -> Iterator[tuple[Column, Array]]:
    yield _TIME, record.time
    described = {variable.name: variable for variable in TABLE}
    of_plant = {signal.name for signal in PLANT_SIGNALS}
    for name, values in record.signals.items():
        if name in of_plant:
            continue
        variable = described[name]
        entries = values.reshape(len(record), values.shape[1] if values.ndim > 1 else 1)
        for entry, label in enumerate(_labels(variable, record.legs)):
            column = Column(label, variable.unit or "", "", variable.description)
            yield column, entries[:, entry]
    for signal in PLANT_SIGNALS:
        names = signal.columns(record.legs)
        entries = record.signals[signal.name].reshape(len(record), len(names))
        for entry, label in enumerate(names):
            column = Column(label, signal.unit, signal.frame, signal.description, signal.sign)
            yield column, entries[:, entry]


def _labels(variable: Variable, legs: tuple[str, ...]) -> list[str]:
    if variable.shape is Shape.scalar:
        return [variable.name]
    if variable.shape is Shape.leg:
        return [f"{leg}.{variable.name}" for leg in legs]
    return [f"{variable.name}1{k}" for k in range(2, len(legs) + 1)]

"""What a run leaves behind: every signal, sampled once per control tick."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from typing import TYPE_CHECKING

from apnc.loop.experiment import Experiment
from apnc_core.settings import Setting
from apnc_core.types import Array
from apnc_plant.robot import RobotDescription

if TYPE_CHECKING:
    import pandas
    import xarray


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

    def to_pandas(self) -> pandas.DataFrame:
        """The record as a table: a column for each of ``record.csv``, the time [s] as index.

        Raises:
            ValueError: pandas is not installed.
        """
        from apnc.loop.tables import data_frame  # noqa: PLC0415  # imports this module

        return data_frame(self)

    def to_xarray(self) -> xarray.Dataset:
        """The record as a dataset: a variable for each signal, with named dimensions.

        Dimensions are ``time`` [s], ``leg`` and ``relation`` (the two legs of a phase relation),
        and for vectors ``axis`` (x, y, z), ``joint`` or ``angle`` (roll, pitch, yaw). Each variable
        has its unit and its meaning as attributes.

        Raises:
            ValueError: xarray is not installed.
        """
        from apnc.loop.tables import dataset  # noqa: PLC0415  # imports this module

        return dataset(self)

    def _repr_html_(self) -> str:
        """A short table of the run, for notebooks."""
        from apnc.loop.tables import html  # noqa: PLC0415  # imports this module

        return html(self)

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

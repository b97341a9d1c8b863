"""Results of trials, and the entries that are picked from them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from html import escape
from typing import TYPE_CHECKING, Any, Final, NamedTuple

from apnc import metrics
from apnc.controllers import CONTROLLERS, named_controller
from apnc.extras import missing
from apnc.studies.statistics import median, rate

if TYPE_CHECKING:
    from pandas import DataFrame

Result = dict[str, Any]
"""What a study keeps of one trial: its cell of the grid and its measures, by name."""


class TrialId(NamedTuple):
    """What tells a trial from all others.

    Args:
        study: name of the study.
        controller: its label.
        key: of the experiment. Two studies, and two labels, may run the same experiment.
    """

    study: str
    controller: str
    key: str


def id_of(result: Result) -> TrialId:
    """The trial that a result is of.

    Raises:
        KeyError: an entry is missing.
    """
    return TrialId(result["study"], result["controller"], result["key"])


STRICT: Final = "convergence_time_s"
AUTHORS: Final = "convergence_time_authors_s"
SPEED: Final = "path_speed_m_per_s"
PHASE: Final = "phi_final_1"
"""Start of the names of the entries for the phases at the end. The number of the leg follows."""


class StudyResults(list[Result]):
    """Results of a study in the order of its grid: a list that can become a table."""

    def to_pandas(self) -> DataFrame:
        """A data frame with a line per trial and a column per entry that any result has.

        Figures that are not defined for a trial are NaN.

        Raises:
            ImportError: pandas is not installed.
        """
        try:
            import pandas as pd  # noqa: PLC0415  # an extra
        except ImportError:
            raise ImportError(missing("pandas", "study")) from None
        return pd.DataFrame.from_records(list(self), columns=columns_of(self))

    def _repr_html_(self) -> str:
        """A line per study and controller: trials, share that formed the gait, and the time."""
        groups = dict.fromkeys((result["study"], result["controller"]) for result in self)
        titles = ("study", "controller", "trials", "gait formed", "time to the gait [s]", "fell")
        lines = [self._line(*group) for group in groups]
        head = "".join(f"<th>{title}</th>" for title in titles)
        body = ("".join(f"<td>{escape(text)}</td>" for text in line) for line in lines)
        rest = "".join(f"<tr>{cells}</tr>" for cells in body)
        return f"<table><thead><tr>{head}</tr></thead><tbody>{rest}</tbody></table>"

    def _line(self, study: str, label: str) -> list[str]:
        own = matching(self, study=study, controller=label)
        time = median(values(own, STRICT)).text(1)
        formed, fell = rate(successes(own)), len(matching(own, fell=True))
        return [study, named_controller(label).name, str(len(own)), str(formed), time, str(fell)]


def columns_of(results: Sequence[Result]) -> list[str]:
    """Names of all entries that any of the results has, in the order of their first occurrence."""
    return list(dict.fromkeys(name for result in results for name in result))


def is_number(value: Any) -> bool:
    """Whether an entry of a result is a finite number."""
    return isinstance(value, int | float) and math.isfinite(value)


def matching(results: Sequence[Result], **where: Any) -> list[Result]:
    """The results whose entries have the values in ``where``."""
    return [
        result
        for result in results
        if all(result.get(name) == value for name, value in where.items())
    ]


def values(results: Sequence[Result], column: str, **where: Any) -> list[float]:
    """Finite numbers in a column of the results that match ``where``."""
    return [float(r[column]) for r in matching(results, **where) if is_number(r.get(column))]


def successes(results: Sequence[Result], column: str = STRICT, **where: Any) -> list[bool]:
    """For each result that matches ``where``: whether the gait formed and the robot did not fall.

    Args:
        results: of trials.
        column: time to the gait, by the criterion that decides.
        where: entries that a result must have.
    """
    return [is_number(r.get(column)) and not r.get("fell") for r in matching(results, **where)]


def phases_in(results: Sequence[Result]) -> list[str]:
    """Names of the entries for the relative phases at the end, in order of the legs."""
    found = {name for result in results for name in result if name.startswith(PHASE)}
    return sorted(found, key=lambda name: int(name.removeprefix(PHASE)))


def gait_in(results: Sequence[Result]) -> str:
    """Name of the gait that is expected of the robot that walked."""
    return metrics.gait_name(len(phases_in(results)) + 1)


def controllers_in(results: Sequence[Result]) -> list[str]:
    """Labels that occur, in the order of the controllers.

    Raises:
        ValueError: an unknown label.
    """
    found = {result["controller"]: named_controller(result["controller"]) for result in results}
    return [label for label in CONTROLLERS if label in found]


def cells_in(results: Sequence[Result], axis: str) -> list[Any]:
    """Values along an axis that occur, in ascending order."""
    return sorted({result[axis] for result in results})

"""The columns of ``record.csv``: every signal of a run, an entry at a time.

They follow from two tables: the variables of the controller in ``apnc_core/variables.py`` and the
signals of the robot in ``apnc_plant/signals.py``. A new entry there becomes a column by itself.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Final

from apnc.loop.record import Record
from apnc_core.schema import Shape, Variable
from apnc_core.types import Array
from apnc_core.variables import TABLE
from apnc_plant.signals import PLANT_SIGNALS


@dataclass(frozen=True)
class Column:
    """One column.

    Args:
        name: its name, e.g. ``RF.o1``.
        unit: its unit; empty for text and truth values.
        frame: frame of a vector; empty for a scalar.
        description: what it is.
        sign: what a positive value means; empty if the frame says it.
    """

    name: str
    unit: str
    frame: str
    description: str
    sign: str = ""


TIME: Final = Column("time", "s", "", "start of the tick")


def column_names(record: Record) -> list[Column]:
    """The columns of a record, in order: ``time``, ``RF.o1``, ``phi12``, ``position.x``, ..."""
    return [column for column, _ in _columns(record)]


def columns(record: Record) -> dict[str, Array]:
    """Values of every column of a record by name, each of shape (T,).

    A vector has a column for each component, a signal of each leg one for each leg, and phase
    relations one for each pair of legs.
    """
    return {column.name: values for column, values in _columns(record)}


def _columns(record: Record) -> Iterator[tuple[Column, Array]]:
    yield TIME, record.time
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

"""A record as a table of pandas, as a dataset of xarray, and as a short table in a notebook."""

from __future__ import annotations

from html import escape
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any, Final

from apnc import metrics
from apnc.extras import missing
from apnc.loop.columns import TIME, columns
from apnc.loop.record import Record
from apnc.loop.schedule import schedule_text
from apnc_core.schema import Shape
from apnc_core.variables import TABLE
from apnc_plant.signals import ANGLES, JOINTS, PLANT_SIGNALS, XYZ

if TYPE_CHECKING:
    import pandas
    import xarray

_DIMENSIONS: Final = {XYZ: "axis", JOINTS: "joint", ANGLES: "angle"}
"""Dimension along which the components of a vector lie."""


def data_frame(record: Record) -> pandas.DataFrame:
    """The columns of ``record.csv`` with the time [s] as index.

    Raises:
        ValueError: pandas is not installed.
    """
    _need("pandas")
    import pandas as pd  # noqa: PLC0415  # an extra

    values = columns(record)
    index = pd.Index(values.pop(TIME.name), name=TIME.name)
    return pd.DataFrame(values, index=index)


def dataset(record: Record) -> xarray.Dataset:
    """Every signal with named dimensions, its unit and its meaning.

    Raises:
        ValueError: xarray is not installed.
    """
    _need("xarray")
    import xarray as xr  # noqa: PLC0415  # an extra

    described = _described()
    variables = {
        name: (("time", *described[name][0]), values, described[name][1])
        for name, values in record.signals.items()
    }
    relations = [f"1{k}" for k in range(2, len(record.legs) + 1)]
    components = {name: list(entries) for entries, name in _DIMENSIONS.items()}
    seconds = ("time", record.time, {"units": TIME.unit})
    return xr.Dataset(
        variables,
        {"time": seconds, "leg": list(record.legs), "relation": relations, **components},
        _run(record),
    )


def html(record: Record) -> str:
    """What was run and what came of it, as a table of HTML."""
    lines = "".join(
        f"<tr><th style='text-align: left'>{escape(name)}</th><td>{escape(value)}</td></tr>"
        for name, value in _run(record).items()
    )
    return f"<table>{lines}</table>"


def _run(record: Record) -> dict[str, str]:
    """What was run, how it ended, and the gait at the end."""
    o1, o2 = record.signals["o1"], record.signals["o2"]
    final = metrics.final_phases(o1, o2, 1.0 / record.experiment.rate)
    ended = f"{record.end}, {record.message}" if record.message else str(record.end)
    return {
        "robot": record.robot.name,
        "controller": record.experiment.controller_name,
        "MI": schedule_text(record.experiment.mi),
        "seed": str(record.experiment.seed),
        "end": ended,
        "duration": f"{record.ended_at:g} s",
        "gait": metrics.nearest_gait(final, metrics.STRICT_TOLERANCE) or "none known",
    }


def _described() -> dict[str, tuple[tuple[str, ...], dict[str, str]]]:
    """Dimensions behind ``time`` and attributes of every signal, by name."""
    of_shape = {Shape.scalar: (), Shape.leg: ("leg",), Shape.relation: ("relation",)}
    found: dict[str, Any] = {
        v.name: (of_shape[v.shape], _attributes(v.unit or "", v.description)) for v in TABLE
    }
    for signal in PLANT_SIGNALS:
        leg = ("leg",) if signal.per_leg else ()
        vector = (_DIMENSIONS[signal.components],) if signal.components else ()
        attributes = _attributes(signal.unit, signal.description, signal.frame, signal.sign)
        found[signal.name] = ((*leg, *vector), attributes)
    return found


def _attributes(unit: str, description: str, frame: str = "", sign: str = "") -> dict[str, str]:
    named = {"units": unit, "long_name": description, "frame": frame, "positive": sign}
    return {name: value for name, value in named.items() if value}


def _need(package: str) -> None:
    if find_spec(package) is None:
        raise ValueError(missing(package, "study"))

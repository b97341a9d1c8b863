"""What a trace of a figure shows."""

from __future__ import annotations

from typing import Any

import numpy as np

from apnc.report.encoding import Signal
from apnc.report.figure import Figure
from apnc_core.types import Array


def numbers(drawn: Signal) -> Array:
    return np.asarray(drawn.values, dtype=np.float64)


def axis_of(figure: Figure, trace: dict[str, Any]) -> str:
    title: str = figure.layout[trace.get("yaxis", "y").replace("y", "yaxis")]["title"]["text"]
    return title

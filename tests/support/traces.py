"""What a trace of a figure shows."""

from __future__ import annotations

import base64
from typing import Any

import numpy as np

from apnc.report.figure import Figure
from apnc_core.types import Array


def numbers(packed: Any) -> Array:
    assert packed["dtype"] == "f4"
    return np.frombuffer(base64.b64decode(packed["bdata"]), dtype="<f4").astype(np.float64)


def axis_of(figure: Figure, trace: dict[str, Any]) -> str:
    title: str = figure.layout[trace.get("yaxis", "y").replace("y", "yaxis")]["title"]["text"]
    return title

"""Arrays as compact text: 32-bit floats in base64, in the form plotly.js reads directly."""

from __future__ import annotations

import base64
import json
from typing import Any

import numpy as np
from numpy.typing import ArrayLike


def float32(values: ArrayLike) -> dict[str, str]:
    """Typed-array notation of plotly.js for a 1-D signal; NaN leaves a gap in a line."""
    return {"dtype": "f4", "bdata": packed(values, "<f4")}


def packed(values: ArrayLike, dtype: str) -> str:
    """Flat little-endian base64 of an array in C order."""
    return base64.b64encode(np.ascontiguousarray(values, dtype=dtype).tobytes()).decode("ascii")


def script_json(value: Any) -> str:
    """JSON that cannot end the script element it stands in."""
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")

"""Arrays as compact text for the browser."""

from __future__ import annotations

import base64
import json
from typing import Any

import numpy as np
from numpy.typing import ArrayLike


def float32(values: ArrayLike) -> dict[str, str]:
    """A signal of shape (T,) as a typed array of plotly.js; NaN is a gap in a line."""
    return {"dtype": "f4", "bdata": packed(values, "<f4")}


def packed(values: ArrayLike, dtype: str) -> str:
    """Base64 of the entries of an array in C order.

    Args:
        values: of any shape.
        dtype: little-endian type of an entry, e.g. ``<f4``.
    """
    return base64.b64encode(np.ascontiguousarray(values, dtype=dtype).tobytes()).decode("ascii")


def script_json(value: Any) -> str:
    """JSON text for a script element, without characters that would end the element."""
    text = json.dumps(value, allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")

"""Arrays as compact text for the browser."""

from __future__ import annotations

import base64
import json
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

STEPS: Final = 65_534
"""Steps between the least and the largest value of an array in 16 bits; one more is a gap."""

FINEST: Final = 1e-3
"""Largest step of an array in 16 bits, as a share of the spread of its middle nine tenths."""


@dataclass(frozen=True, eq=False)
class Signal:
    """Values of a line, of any shape, that the page gets in few bytes; NaN is a gap.

    Args:
        values: as they are drawn.
        exact: keep 32-bit floats.
    """

    values: ArrayLike
    exact: bool = False

    def to_dict(self) -> dict[str, Any]:
        """What ``apnc.array`` of the page reads.

        16 bits for an entry, in equal steps from the least value to the largest. 32-bit floats if
        an outlier would make the steps coarse, see ``FINEST``.
        """
        values = np.asarray(self.values, dtype=np.float64)
        known = values[np.isfinite(values)]
        if known.size and not self.exact:
            least, low, high, largest = np.percentile(known, [0, 5, 95, 100])
            step = (largest - least) / STEPS
            if 0.0 < step <= FINEST * (high - low):
                rounded = np.rint((values - least) / step)
                whole = np.where(np.isfinite(values), rounded, STEPS + 1)
                return {"least": float(least), "step": float(step), "u2": packed(whole, "<u2")}
        return {"f4": packed(values, "<f4")}


def packed(values: ArrayLike, dtype: str) -> str:
    """Base64 of the entries of an array in C order.

    Args:
        values: of any shape.
        dtype: little-endian type of an entry, e.g. ``<f4``.
    """
    return base64.b64encode(np.ascontiguousarray(values, dtype=dtype).tobytes()).decode("ascii")


def plain(value: Any) -> Any:
    """The value with every :class:`Signal` in it as a plain dictionary."""
    if isinstance(value, Signal):
        return value.to_dict()
    if isinstance(value, dict):
        return {key: plain(entry) for key, entry in value.items()}
    return [plain(entry) for entry in value] if isinstance(value, list | tuple) else value


def script_json(value: Any) -> str:
    """JSON text for a script element, without characters that would end the element."""
    text = json.dumps(plain(value), allow_nan=False, separators=(",", ":"))
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")

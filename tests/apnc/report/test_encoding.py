"""Arrays reach the page within half a step, and gaps stay gaps."""

from __future__ import annotations

import base64
import json
from typing import Any

import numpy as np
import pytest

from apnc.report.encoding import FINEST, STEPS, Signal, script_json
from apnc_core.types import Array


def unpacked(entry: dict[str, Any]) -> Array:
    """What ``apnc.array`` of the page reads."""
    if "f4" in entry:
        return np.frombuffer(base64.b64decode(entry["f4"]), "<f4").astype(float)
    whole = np.frombuffer(base64.b64decode(entry["u2"]), "<u2").astype(float)
    return np.where(whole == STEPS + 1, np.nan, entry["least"] + entry["step"] * whole)


def test_an_array_keeps_its_values_within_half_a_step() -> None:
    values = np.random.default_rng(1).normal(3.0, 2.0, 1000)
    entry = Signal(values).to_dict()
    assert len(entry["u2"]) * 3 / 4 == pytest.approx(2 * 1000, abs=2)
    assert np.abs(unpacked(entry) - values).max() <= 0.501 * np.ptp(values) / STEPS
    assert (unpacked(entry).min(), unpacked(entry).max()) == pytest.approx(
        (values.min(), values.max())
    )


def test_gaps_stay_gaps() -> None:
    values = np.linspace(-1.0, 1.0, 50)
    values[[0, 10, 49]] = np.nan
    assert np.isnan(unpacked(Signal(values).to_dict())).tolist() == np.isnan(values).tolist()
    infinite = np.array([0.0, 1.0, np.inf, 2.0])
    assert np.isnan(unpacked(Signal(infinite).to_dict())[2])


@pytest.mark.parametrize(
    "values",
    [[], [2.5], [1.0, 1.0, 1.0], [np.nan], [*np.linspace(0.0, 1.0, 99), 100.0 / FINEST]],
)
def test_what_16_bits_cannot_hold_stays_in_floats(values: list[float]) -> None:
    entry = Signal(values).to_dict()
    assert set(entry) == {"f4"}
    assert unpacked(entry) == pytest.approx(np.array(values), rel=1e-6, nan_ok=True)


def test_signals_are_found_wherever_they_are() -> None:
    text = script_json({"data": [{"x": Signal([1.0, 2.0], exact=True)}], "name": "</script>"})
    assert "</" not in text
    (trace,) = json.loads(text)["data"]
    assert unpacked(trace["x"]).tolist() == [1.0, 2.0]

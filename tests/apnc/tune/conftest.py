"""Tests of the search walk as little as they can."""

from __future__ import annotations

import pytest


@pytest.fixture(autouse=True)
def one_seed_shows_the_range(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("apnc.tune.runs.RANGE_SEEDS", 1)

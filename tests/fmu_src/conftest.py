from __future__ import annotations

from collections.abc import Iterator

import pytest
from raw_fmu import Instance, Library
from raw_walk import walk


@pytest.fixture
def expected(library: Library) -> Iterator[list[list[float]]]:
    """Outputs of a short walk as FMPy would step it."""
    fmu = Instance(library)
    fmu.start()
    yield walk(fmu)
    fmu.free()

from __future__ import annotations

from pathlib import Path

import pytest

from build_fmu.build import host_fmu


@pytest.fixture(scope="session")
def fmu4() -> Path:
    return host_fmu(4)


@pytest.fixture(scope="session")
def fmu6() -> Path:
    return host_fmu(6)

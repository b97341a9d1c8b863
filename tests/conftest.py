from __future__ import annotations

import sys
import zipfile
from pathlib import Path

import pytest
from raw_fmu import Library

from build_fmu.build import host_fmu

# research/ and benchmarks/ are not installed; at the end, so that the installed product is tested
sys.path.append(str(Path(__file__).resolve().parents[1]))


@pytest.fixture(scope="session")
def fmu4() -> Path:
    return host_fmu(4)


@pytest.fixture(scope="session")
def fmu6() -> Path:
    return host_fmu(6)


@pytest.fixture(scope="session")
def library(fmu4: Path, tmp_path_factory: pytest.TempPathFactory) -> Library:
    """The library of the FMU for this machine, for calls that fmpy would not make."""
    folder = tmp_path_factory.mktemp("library")
    with zipfile.ZipFile(fmu4) as archive:
        archive.extractall(folder)
    return Library.load(folder)

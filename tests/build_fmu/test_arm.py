"""The FMU on an ARM machine: FMPy in an aarch64 Python, emulated."""

from __future__ import annotations

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from build_fmu.build import cached_fmu, host_fmu
from build_fmu.options import BuildOptions

ROOT = Path(__file__).resolve().parents[2]

STEP_IT = """
import json, platform, sys
from pathlib import Path
import fmpy
from fmpy.fmi2 import FMU2Slave
from build_fmu.platforms import library_of

path, ours = sys.argv[1], sys.argv[2] == "library_of"
description = fmpy.read_model_description(path, validate=False)
reference = {v.name: v.valueReference for v in description.modelVariables}
loads = [reference[f"leg[{i}].grf"] for i in range(1, 5)]
hips = [reference[f"leg[{i}].theta_hip"] for i in range(1, 5)]
folder = fmpy.extract(path)
chosen = {"libraryPath": str(library_of(Path(folder)))} if ours else {}
fmu = FMU2Slave(
    guid=description.guid, unzipDirectory=folder, modelIdentifier="Apnc", instanceName="x", **chosen
)
fmu.instantiate()
fmu.setupExperiment(startTime=0.0)
fmu.enterInitializationMode()
fmu.exitInitializationMode()
rows = []
for n in range(240):
    fmu.setReal(loads, [6.0, 5.0, 4.0, 0.1 * (n % 60)])
    fmu.doStep(n / 60, 1 / 60)
    rows.append(fmu.getReal(hips))
print(json.dumps([platform.machine(), rows]))
"""


class Machine:
    """A Python, here or emulated."""

    def __init__(self, command: list[str], packages: list[str]) -> None:
        self.command = command
        self.environment = os.environ | {"PYTHONPATH": os.pathsep.join([*packages, str(ROOT)])}

    def step(self, fmu: Path, how: str) -> subprocess.CompletedProcess[str]:
        return subprocess.run(
            [*self.command, "-c", STEP_IT, str(fmu), how],
            env=self.environment,
            capture_output=True,
            text=True,
            check=False,
        )

    def hips(self, fmu: Path, how: str) -> tuple[str, np.ndarray]:
        done = self.step(fmu, how)
        assert done.returncode == 0, done.stderr
        machine, rows = json.loads(done.stdout.splitlines()[-1])
        return machine, np.array(rows)


@pytest.fixture(scope="module")
def arm() -> Machine:
    root = os.environ.get("APNC_ARM_PYTHON", "")
    qemu = shutil.which("qemu-aarch64")
    if qemu is None:
        pytest.skip("qemu-aarch64 is missing (Debian package qemu-user)")
    if not Path(root, "usr/bin/python3").exists():
        pytest.skip("no aarch64 Python: .ci/arm_python FOLDER makes one, APNC_ARM_PYTHON names it")
    return Machine([qemu, "-L", root, f"{root}/usr/bin/python3"], [f"{root}/site"])


def assert_walks_as_here(machine: str, hips: np.ndarray) -> None:
    assert machine == "aarch64"
    _, expected = Machine([sys.executable], []).hips(host_fmu(), "library_of")
    np.testing.assert_allclose(hips, expected, rtol=0, atol=1e-12)
    assert np.ptp(hips) > 0.1


def test_fmpy_alone_runs_a_build_for_arm_linux(arm: Machine) -> None:
    fmu = cached_fmu(BuildOptions(platforms=("aarch64-linux",)))
    assert_walks_as_here(*arm.hips(fmu, "as fmpy does"))


def test_our_choice_of_library_runs_the_fmu_for_all_platforms(arm: Machine) -> None:
    assert_walks_as_here(*arm.hips(cached_fmu(BuildOptions()), "library_of"))


def test_without_it_fmpy_opens_the_library_for_intel(arm: Machine) -> None:
    """The day this fails, FMPy chooses by itself and library_of may go."""
    done = arm.step(cached_fmu(BuildOptions()), "as fmpy does")
    assert done.returncode != 0 and "linux64" in done.stderr

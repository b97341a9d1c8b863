"""The robot walks under the controller in other people's tools."""

from __future__ import annotations

import csv
import importlib.util
import os
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from apnc import Experiment, metrics
from apnc.system.build import build_system

SECONDS = 12.0
NEEDS = {
    "fmpy.ssp": "fmpy",
    "libcosim-osp": "libcosimpy",
    "libcosim-ssp": "libcosimpy",
    "ecos": "ecospy",
    "container": "fmu_manipulation_toolbox",
    "omsimulator": "OMSimulator",
}
HOSTS = Path(__file__).resolve().parents[2] / "support" / "system_hosts.py"


@pytest.fixture(scope="module", params=["structured", "flat"])
def folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    output = tmp_path_factory.mktemp(request.param) / "Lilibot.ssp"
    return build_system(output, Experiment(mi=0.15, seed=1), request.param)


@pytest.mark.parametrize("host", NEEDS)
def test_the_trot_forms(host: str, folder: Path, tmp_path: Path) -> None:
    # in a process of its own: a library that does not load must not take the tests with it
    found = subprocess.run(
        [sys.executable, "-c", f"import {NEEDS[host]}"], capture_output=True, text=True, check=False
    )
    if found.returncode != 0:
        pytest.skip(f"{NEEDS[host]} is missing: {found.stderr.strip().splitlines()[-1]}")
    if host == "ecos" and shutil.which("unzip") is None:
        pytest.skip("Ecos calls the program unzip, which is missing")
    out = tmp_path / "out.npz"
    done = subprocess.run(
        [sys.executable, str(HOSTS), host, str(folder), str(SECONDS), str(out)],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    with np.load(out) as walk:
        assert len(walk["o1"]) == SECONDS * 60
        phases = metrics.final_phases(walk["o1"], walk["o2"], 1 / 60)
        off = metrics.wrap(np.subtract(phases, metrics.default_target(4)))
        assert np.abs(off).max() < metrics.STRICT_TOLERANCE, phases
        # at MI 0.08, the default, it comes 0.9 m far: the parameter set acts
        assert metrics.path_length(walk["position"]) > 1.05


def test_it_walks_in_a_program_that_is_not_python(folder: Path, tmp_path: Path) -> None:
    spec = importlib.util.find_spec("ecospy")
    if spec is None or spec.origin is None or sys.platform != "linux":
        pytest.skip("ecospy is missing")
    if shutil.which("unzip") is None:
        pytest.skip("Ecos calls the program unzip, which is missing")
    program = shutil.copy(Path(spec.origin).parent / "binaries" / "ecos", tmp_path)
    Path(program).chmod(0o755)
    if subprocess.run([program, "--version"], capture_output=True, check=False).returncode != 0:
        pytest.skip("ecos does not start: Debian's libtbb12 is missing")
    words = ["simulate", "--path", f"{folder}.ssp", "--parameterSet", "Lilibot"]
    words += ["--stopTime", f"{SECONDS:g}", "--stepSize", repr(1 / 60)]
    done = subprocess.run(
        [program, *words],
        cwd=tmp_path,
        env={"PATH": os.environ["PATH"]},
        capture_output=True,
        text=True,
        check=False,
        timeout=200,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    with (tmp_path / "Lilibot.csv").open() as file:
        last = list(csv.DictReader(file, skipinitialspace=True))[-1]
    flat = "leg1_grf" in " ".join(last)
    phases = [float(last[f"controller::phi{k if flat else f'[{k}]'}[REAL]"]) for k in (1, 2, 3)]
    off = metrics.wrap(np.subtract(phases, metrics.default_target(4)))
    assert np.abs(off).max() < metrics.STRICT_TOLERANCE, phases
    assert float(last[f"plant::position{'_' if flat else '.'}x[REAL]"]) > 1.0

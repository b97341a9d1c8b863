"""The robot walks under the controller in other people's programs, as in the direct loop.

What a program gives is held bit for bit to a loop with the delays of that program; without delays
that is the direct loop.
"""

from __future__ import annotations

import csv
import importlib.util
import os
import shutil
import subprocess
import sys
import zipfile
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pytest
from compilers import STRICT, run, tool
from coupled_loop import walk
from native_driver import runner

from apnc import Experiment, metrics, simulate
from apnc.system.build import build_system
from apnc.system.structure import structure_of
from apnc_core.types import Array
from apnc_plant.conditions import Conditions
from apnc_plant.ground import Obstacles
from build_fmu.platforms import PLATFORMS, host_platform

SECONDS = 12.0
ROOT = Path(__file__).resolve().parents[3]
HOSTS = ROOT / "tests" / "support" / "system_hosts.py"
EXPERIMENT = Experiment(mi=0.4, seed=1, duration=SECONDS, engine="compiled")
LATE = {"commands": 1}
"""Both FMUs step side by side and exchange values afterwards."""


class Host(NamedTuple):
    """What a host needs, and how it differs from the direct loop; None: not known."""

    package: str
    delays: dict[str, Any] | None


HOST = {
    "fmpy.ssp": Host("fmpy", LATE | {"before": "zero"}),
    "libcosim-osp": Host("libcosimpy", LATE | {"nanoseconds": True}),
    "libcosim-ssp": Host("libcosimpy", LATE | {"nanoseconds": True}),
    "ecos": Host("ecospy", LATE),
    "container": Host("fmu_manipulation_toolbox", {}),
    "container-ssp": Host("fmu_manipulation_toolbox", LATE),
    "omsimulator": Host("OMSimulator", None),
}


@pytest.fixture(scope="module", params=["structured", "flat"])
def folder(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Path:
    output = tmp_path_factory.mktemp(request.param) / "Lilibot.ssp"
    return build_system(output, EXPERIMENT, request.param)


def looped(folder: Path, **delays: Any) -> dict[str, Array]:
    naming = "flat" if "flat" in str(folder) else "structured"
    return walk(folder, structure_of(EXPERIMENT, naming), SECONDS, **delays)


def assert_trots(phases: Array) -> None:
    off = metrics.wrap(np.subtract(phases, metrics.default_target(4)))
    assert np.abs(off).max() < metrics.STRICT_TOLERANCE, phases


def test_a_loop_in_order_is_the_direct_loop_bit_for_bit(folder: Path) -> None:
    record, seen = simulate(EXPERIMENT), looped(folder)
    for name in ("position", "grf"):
        np.testing.assert_array_equal(seen[name][:-1], record.signals[name][1:])
    for name in ("o1", "o2"):
        np.testing.assert_array_equal(seen[name], record.signals[name])


@pytest.mark.parametrize("name", HOST)
def test_it_walks_as_in_a_loop_with_the_delays_of_the_host(
    name: str, folder: Path, tmp_path: Path
) -> None:
    host = HOST[name]
    # in a process of its own: a library that does not load must not take the tests with it
    found = subprocess.run(
        [sys.executable, "-c", f"import {host.package}"],
        capture_output=True,
        text=True,
        check=False,
    )
    if found.returncode != 0:
        pytest.skip(f"{host.package} is missing: {found.stderr.strip().splitlines()[-1]}")
    if name == "ecos":
        tool("unzip", "unzip")  # Ecos calls it
    out = tmp_path / "out.npz"
    run(sys.executable, HOSTS, name, folder, str(SECONDS), out)
    with np.load(out) as data:
        seen = dict(data)
    assert len(seen["o1"]) == SECONDS * 60
    assert_trots(metrics.final_phases(seen["o1"], seen["o2"], 1 / 60))
    # the start values act: at MI 0.08, the default, it would come 0.66 m far
    assert metrics.path_length(seen["position"]) > 1.05
    if host.delays is not None:
        for signal, expected in looped(folder, **host.delays).items():
            np.testing.assert_array_equal(seen[signal], expected, err_msg=signal)


def test_it_walks_in_the_program_of_ecos(folder: Path, tmp_path: Path) -> None:
    spec = importlib.util.find_spec("ecospy")
    if spec is None or spec.origin is None or sys.platform != "linux":
        pytest.skip("ecospy is missing")
    tool("unzip", "unzip")
    program = shutil.copy(Path(spec.origin).parent / "binaries" / "ecos", tmp_path)
    Path(program).chmod(0o755)  # its wheel forgets to
    if subprocess.run([program, "--version"], capture_output=True, check=False).returncode != 0:
        pytest.skip("ecos does not start: Debian's libtbb12 is missing")
    words = ["simulate", "--path", f"{folder}.ssp", "--parameterSet", "Lilibot"]
    words += ["--stopTime", f"{SECONDS:g}", "--stepSize", repr(1 / 60)]
    # an environment without Python
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
        rows = list(csv.DictReader(file, skipinitialspace=True))
    flat = "plant::leg1_grf[REAL]" in rows[0]
    phases = [float(rows[-1][f"controller::phi{k if flat else f'[{k}]'}[REAL]"]) for k in (1, 2, 3)]
    assert_trots(np.array(phases))
    steps = len(rows) - 1  # the first row is the start
    assert SECONDS * 60 - steps in (0, 1)  # it adds up steps until the stop time
    expected = looped(folder, **LATE)
    for axis, values in zip("xyz", expected["position"].T, strict=True):
        column = f"plant::position{'_' if flat else '.'}{axis}[REAL]"
        assert [row[column] for row in rows[1:]] == [f"{x:.6f}" for x in values[:steps]]


def unpacked(folder: Path) -> Path:
    """A system whose FMUs are unpacked in their places, as examples/host wants it."""
    for file in (folder / "resources").glob("*.fmu"):
        with zipfile.ZipFile(file) as archive:
            archive.extractall(file.with_suffix(""))
    return folder


def hosted_in_c(folder: Path, platform: str, scratch: Path) -> list[list[str]]:
    """Lines that examples/host prints after its first, for a platform."""
    how = runner(platform, scratch)
    if platform == host_platform():
        compiler = [tool("gcc", "gcc")]
    else:
        compiler = [sys.executable, "-m", "ziglang", "cc"]
        compiler += ["-target", PLATFORMS[platform].zig_target]
    headers = [f"-I{folder}", f"-I{folder / 'resources' / 'Apnc' / 'sources'}"]
    program = scratch / f"host-{platform}.exe"
    libraries = [] if platform == "win64" else ["-ldl"]
    source = ROOT / "examples" / "host" / "host.c"
    run(*compiler, "-std=c11", *STRICT, *headers, source, "-o", program, *libraries)
    done = subprocess.run(
        [*how.command, program, folder, str(SECONDS)],
        env={"PATH": os.environ["PATH"], **dict(how.environment)},
        capture_output=True,
        text=True,
        check=False,
        timeout=200,
    )
    assert done.returncode == 0, done.stderr
    return [line.split() for line in done.stdout.splitlines()][1:]


def assert_walks_as(record: Any, lines: list[list[str]]) -> None:
    """Times, places bit for bit, and feet on the ground."""
    np.testing.assert_allclose([float(line[0]) for line in lines], record.time, atol=1e-4)
    assert [float(line[1]) for line in lines] == record.signals["position"][:, 0].tolist()
    feet = [[foot == "#" for foot in line[2:]] for line in lines]
    np.testing.assert_array_equal(feet, record.signals["grf"] > 1.0)


OTHERS = [pytest.param(name, marks=pytest.mark.thorough) for name in ("win64", "aarch64-linux")]


@pytest.mark.parametrize("platform", ["linux64", *OTHERS])
def test_it_walks_in_a_c_program_that_has_nothing_but_the_c_library(
    platform: str, tmp_path: Path
) -> None:
    folder = unpacked(build_system(tmp_path / "Lilibot.ssp", EXPERIMENT, platforms=(platform,)))
    record = simulate(EXPERIMENT)
    assert_walks_as(record, hosted_in_c(folder, platform, tmp_path))
    assert_trots(metrics.final_phases(record.signals["o1"], record.signals["o2"], 1 / 60))
    shutil.rmtree(folder / "resources" / "LilibotPlant")
    with pytest.raises(AssertionError, match=r"host: .*LilibotPlant\.\w+ failed"):
        hosted_in_c(folder, platform, tmp_path)


STORED = {"stored": True, "phi_stored": (3.1, 3.2, 0.1)}
OTHERS = {
    "everything": Experiment(
        mi=0.2, seed=5, turn=0.3, settings=STORED, step=1 / 1920, duration=SECONDS,
        ground=Obstacles(slope=0.05, roughness=0.5, seed=5), conditions=Conditions(payload=0.3),
    ),
    "enumeration": Experiment(
        mi=0.15, seed=2, controller="tegotae", conditions="C2", duration=SECONDS
    ),
    "six legs": Experiment(mi=0.15, robot="hexapod", seed=3, duration=SECONDS),
}  # fmt: skip


@pytest.mark.parametrize(
    ("name", "naming"), [*((name, "structured") for name in OTHERS), ("everything", "flat")]
)
def test_every_start_value_acts_as_in_the_direct_loop(
    name: str, naming: str, tmp_path: Path
) -> None:
    experiment = replace(OTHERS[name], engine="compiled")
    robot = experiment.description
    stiffness = 1.1 * robot.servo.stiffness
    numbers = {"servo.stiffness": stiffness, "contact.friction": 0.7, "sensor.delay": 0.02}
    own = replace(
        robot,
        servo=replace(robot.servo, stiffness=stiffness),
        contact=replace(robot.contact, friction=0.7),
        sensor=replace(robot.sensor, delay=0.02),
    )
    folder = build_system(tmp_path / "Own.ssp", experiment, naming, numbers=numbers)
    lines = hosted_in_c(unpacked(folder), host_platform(), tmp_path)
    record = simulate(replace(experiment, robot=own))
    assert_walks_as(record, lines)
    if importlib.util.find_spec("fmu_manipulation_toolbox"):
        out = tmp_path / "out.npz"
        run(sys.executable, HOSTS, "container", folder, str(SECONDS), out)
        with np.load(out) as seen:
            np.testing.assert_array_equal(seen["position"][:-1], record.signals["position"][1:])

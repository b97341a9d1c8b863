"""Importers that do not use fmpy's code, and the rules no single checker sees in full."""

from __future__ import annotations

import logging
import re
import shlex
import subprocess
import sys
import zipfile
from dataclasses import dataclass
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.util import create_plotly_figure
from fmu_slave import SCALARS, slave
from lxml import etree

from apnc_core.enumerations import Method
from apnc_core.interface import Parameters
from apnc_core.schema import Causality, Type
from build_fmu.build import cached_fmu, fmu_bytes
from build_fmu.options import BuildOptions, host_platform

OUTPUTS = [
    s.value_reference
    for s in SCALARS.values()
    if s.variable.causality is Causality.output and s.variable.type is Type.real
]
LOADS = [SCALARS[f"leg[{i}].grf"].value_reference for i in range(1, 5)]
STEP_NS = 16_666_666
"""libcosim counts in whole nanoseconds."""


def missing(package: str) -> str:
    return f"{package} is missing (PyPI package of that name)"


def test_libcosim_steps_it_to_the_outputs_of_fmpy(fmu4: Path) -> None:
    cosim = {
        part: pytest.importorskip(f"libcosimpy.Cosim{part}", reason=missing("libcosimpy"))
        for part in ("Enums", "Execution", "Logging", "Manipulator", "Observer", "Slave")
    }
    level = cosim["Logging"].CosimLogLevel.WARNING
    cosim["Logging"].log_output_level(level)
    execution = cosim["Execution"].CosimExecution.from_step_size(step_size=STEP_NS)
    local = cosim["Slave"].CosimLocalSlave(str(fmu4), "apnc")
    index = execution.add_local_slave(local)
    inputs = cosim["Manipulator"].CosimManipulator.create_override()
    watched = cosim["Observer"].CosimObserver.create_last_value()
    execution.add_manipulator(inputs)
    execution.add_observer(watched)
    rng = np.random.default_rng(3)
    with slave(fmu4) as fmu:
        fmu.start()
        for n in range(600):
            loads = rng.uniform(0, 20, 4).tolist()
            assert inputs.slave_real_values(index, LOADS, loads)
            assert execution.step()
            fmu.loads(loads)
            fmu.step(n * STEP_NS * 1e-9, STEP_NS * 1e-9)
            assert watched.last_real_values(index, OUTPUTS) == fmu.getReal(OUTPUTS)
            reference = [SCALARS["tick"].value_reference]
            assert watched.last_integer_values(index, reference) == [n + 1]
    assert execution.status().error_code == cosim["Enums"].CosimErrorCode.SUCCESS.value


def test_libcosim_sets_enumerations_that_were_built_as_integers(tmp_path: Path) -> None:
    execution_of = pytest.importorskip("libcosimpy.CosimExecution", reason=missing("libcosimpy"))
    local = pytest.importorskip("libcosimpy.CosimSlave").CosimLocalSlave
    observer = pytest.importorskip("libcosimpy.CosimObserver").CosimObserver.create_last_value()
    options = BuildOptions(platforms=(host_platform(),), enumerations="integer")
    execution = execution_of.CosimExecution.from_step_size(step_size=STEP_NS)
    index = execution.add_local_slave(local(str(cached_fmu(options)), "apnc"))
    execution.add_observer(observer)
    reference = {v.name.decode(): v.reference for v in execution.slave_variables(index)}
    execution.integer_initial_value(index, reference["method"], Method.tegotae.value)
    assert execution.step()
    gain = [Parameters().gamma_tegotae]
    assert observer.last_real_values(index, [reference["leg[1].gamma"]]) == gain


@dataclass(frozen=True)
class Block:
    """A block of code of docs/importing.md."""

    line: int
    language: str
    code: str


PAGE = Path(__file__).resolve().parents[2] / "docs" / "importing.md"
BLOCKS = [
    Block(PAGE.read_text()[: m.start()].count("\n") + 1, m[1], m[2])
    for m in re.finditer(r"^```(\w+)\n(.*?)^```", PAGE.read_text(), re.MULTILINE | re.DOTALL)
    if m[1] != "python"  # tests/docs runs those of every page
]


def run_block(command: list[str], folder: Path) -> str:
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    return done.stdout


@pytest.mark.parametrize(
    "block",
    BLOCKS,
    ids=lambda b: f"{b.language} in line {b.line}",
)
def test_block_of_the_page_on_importing_runs(block: Block, fmu4: Path, tmp_path: Path) -> None:
    (tmp_path / "Apnc.fmu").write_bytes(fmu4.read_bytes())
    if block.language == "py":
        if "libcosimpy" in block.code:
            pytest.importorskip("libcosimpy", reason=missing("libcosimpy"))
        assert "Error" not in run_block([sys.executable, "-c", block.code], tmp_path)
    elif block.language == "sh":
        for line in block.code.splitlines():
            tool, *words = shlex.split(line)
            if "--show-plot" in words:
                plots(words, tmp_path)
            else:
                run_block([sys.executable, "-m", tool, *words], tmp_path)
    else:
        assert block.language == "lua"
        pytest.skip("OMSimulator and a robot as an FMU are missing")


def plots(words: list[str], folder: Path) -> None:
    """As --show-plot does, without a browser."""
    others = [word for word in words if word != "--show-plot"]
    run_block([sys.executable, "-m", "fmpy", *others, "--output-file", "result.csv"], folder)
    figure = create_plotly_figure(fmpy.read_csv(str(folder / "result.csv")))
    assert len(figure.data) == 2


@pytest.mark.parametrize("naming", ["structured", "flat"])
@pytest.mark.parametrize("legs", [4, pytest.param(6, marks=pytest.mark.thorough)])
def test_fmu_manipulation_toolbox_finds_no_problem(
    legs: int, naming: str, tmp_path: Path, caplog: pytest.LogCaptureFixture
) -> None:
    name = "fmu_manipulation_toolbox"
    why = missing("fmu-manipulation-toolbox")
    checkers = pytest.importorskip(f"{name}.checker", reason=why).get_checkers()
    operations = pytest.importorskip(f"{name}.operations", reason=why)
    path = tmp_path / "Apnc.fmu"
    path.write_bytes(fmu_bytes(BuildOptions(legs, naming, ())))
    caplog.set_level(logging.INFO, name)
    logging.getLogger(name).addHandler(caplog.handler)
    for checker in checkers:
        operations.FMU(str(path)).apply_operation(checker())
    said = [record.getMessage() for record in caplog.records if record.name == name]
    assert any("seems to be compliant" in message for message in said)
    assert [r.getMessage() for r in caplog.records if r.levelno >= logging.WARNING] == []


def test_fmpy_simulates_it_from_its_defaults(fmu4: Path) -> None:
    result = fmpy.simulate_fmu(str(fmu4), stop_time=1.0, output=["tick", "leg[1].theta_hip"])
    assert result["tick"][-1] == 60
    assert np.ptp(result["leg[1].theta_hip"]) > 0


# names of FMI 2.0, section 2.2.9
B_NAME = r"(?:[A-Za-z_][A-Za-z0-9_]*|'(?:[^'\\]|\\.)+')"
INDICES = r"(?:\[[0-9]+(?:,[0-9]+)*\])?"
IDENTIFIER = rf"{B_NAME}{INDICES}(?:\.{B_NAME}{INDICES})*"
STRUCTURED = re.compile(rf"{IDENTIFIER}|der\({IDENTIFIER}(?:,[0-9]+)?\)")


def names(legs: int, naming: str, tmp_path: Path) -> list[str]:
    path = tmp_path / "Apnc.fmu"
    path.write_bytes(fmu_bytes(BuildOptions(legs, naming, ())))
    with zipfile.ZipFile(path) as archive:
        root = etree.fromstring(archive.read("modelDescription.xml"))
    assert root.get("variableNamingConvention") == naming
    return [v.get("name") for v in root.findall("ModelVariables/ScalarVariable")]


@pytest.mark.parametrize("legs", [2, 4, 64])
def test_structured_names_follow_the_grammar_of_the_standard(legs: int, tmp_path: Path) -> None:
    found = names(legs, "structured", tmp_path)
    assert len(set(found)) == len(found)
    assert [name for name in found if not STRUCTURED.fullmatch(name)] == []
    assert f"leg[{legs}].grf" in found


@pytest.mark.parametrize("name", ["leg[].grf", "leg[1]grf", "1leg.grf", "leg[1]..grf", "a b", ""])
def test_the_grammar_refuses_malformed_names(name: str) -> None:
    assert not STRUCTURED.fullmatch(name)


@pytest.mark.parametrize("legs", [2, 4, 64])
def test_flat_names_are_plain_identifiers_and_all_different(legs: int, tmp_path: Path) -> None:
    found = names(legs, "flat", tmp_path)
    assert len(set(found)) == len(found)
    assert [name for name in found if not re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII)] == []
    # tools that ignore case must not mix two of them up
    assert len({name.lower() for name in found}) == len(found)

"""Data flows one way: no package imports one that comes after it, the product no laboratory."""

from __future__ import annotations

import ast
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent

MAY_IMPORT: dict[str, set[str]] = {
    "apnc_core": set(),
    "build_fmu": {"apnc_core"},
    "apnc_plant": {"apnc_core", "build_fmu"},
    "exudyn_models": {"apnc_core", "apnc_plant"},
    "mujoco_models": {"apnc_core", "apnc_plant"},
    "apnc": {"apnc_core", "apnc_plant", "build_fmu", "exudyn_models", "mujoco_models"},
}
PRODUCT = set(MAY_IMPORT)
MAY_IMPORT |= {"research": PRODUCT, "benchmarks": PRODUCT | {"research"}, "play": PRODUCT}
OUTSIDE_OF_CORE = {"numpy"}


def imported(path: Path) -> set[str]:
    names: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name.split(".")[0] for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            names.add(node.module.split(".")[0])
    return names


@pytest.mark.parametrize("package", MAY_IMPORT)
def test_no_package_imports_upwards(package: str) -> None:
    files = list((ROOT / package).rglob("*.py"))
    assert files
    for path in files:
        ours = imported(path) & set(MAY_IMPORT) - {package}
        assert ours <= MAY_IMPORT[package], path


def test_the_wheel_holds_the_product_and_nothing_else() -> None:
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())
    packed = project["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
    assert set(packed) == PRODUCT | {"fmu_src"}


def test_the_reference_needs_numpy_only() -> None:
    for path in (ROOT / "apnc_core").glob("*.py"):
        outside = imported(path) - set(sys.stdlib_module_names) - {"apnc_core"}
        assert outside <= OUTSIDE_OF_CORE, path


def words_in(folder: str, *words: str) -> list[str]:
    files = (ROOT / "fmu_src" / folder).glob("*.[ch]")
    return [f"{path.name}: {word}" for path in files for word in words if word in path.read_text()]


def test_controller_and_robot_in_c_know_no_fmi_and_no_allocation() -> None:
    for folder in ("core", "plant"):
        assert words_in(folder, "fmi2", "fmi3", "malloc", "calloc", "stdio.h") == []


def test_controller_and_robot_in_c_do_not_know_each_other() -> None:
    assert words_in("core", "plant_") == []
    assert words_in("plant", "apnc_tick", "apnc_data", '"apnc.h"') == []

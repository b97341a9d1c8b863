"""Imports go one way: no package imports one that comes after it, and the product no laboratory."""

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

PARTS_OF_APNC = (
    ("controllers", "extras", "metrics", "varied"),
    ("loop",),
    ("feet",),
    ("features",),
    ("gym_env", "many", "walking"),
    ("importing", "report", "system"),
    ("film", "studies", "view"),
    ("tune",),
    ("cli",),
    ("__main__",),
)
"""Folders and modules of ``apnc``. One imports those of the lines before its own only."""


def modules_imported(path: Path) -> set[str]:
    names: set[str] = set()
    for node in ast.walk(ast.parse(path.read_text())):
        if isinstance(node, ast.Import):
            names |= {alias.name for alias in node.names}
        elif isinstance(node, ast.ImportFrom) and node.module and node.level == 0:
            names |= {f"{node.module}.{alias.name}" for alias in node.names}
    return names


def imported(path: Path) -> set[str]:
    return {name.split(".")[0] for name in modules_imported(path)}


@pytest.mark.parametrize("package", MAY_IMPORT)
def test_no_package_imports_upwards(package: str) -> None:
    files = list((ROOT / package).rglob("*.py"))
    assert files
    for path in files:
        ours = imported(path) & set(MAY_IMPORT) - {package}
        assert ours <= MAY_IMPORT[package], path


def test_the_parts_of_apnc_are_in_order() -> None:
    parts = {
        path.stem for path in (ROOT / "apnc").iterdir() if path.suffix == ".py" or path.is_dir()
    }
    named = [part for line in PARTS_OF_APNC for part in line]
    assert set(named) == parts - {"__init__", "__pycache__"}
    assert len(named) == len(set(named))


@pytest.mark.parametrize("line", range(len(PARTS_OF_APNC)))
def test_no_part_of_apnc_imports_a_later_one_or_a_neighbour(line: int) -> None:
    before = {part for parts in PARTS_OF_APNC[:line] for part in parts}
    for part in PARTS_OF_APNC[line]:
        module = ROOT / "apnc" / f"{part}.py"
        for path in [module] if module.exists() else (ROOT / "apnc" / part).rglob("*.py"):
            names = {name.split(".")[1] for name in modules_imported(path) if name[:5] == "apnc."}
            ours = names & {each for parts in PARTS_OF_APNC for each in parts} - {part}
            assert ours <= before, path


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

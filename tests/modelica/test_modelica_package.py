"""The Modelica package as a library: layout, a second reader, and nothing left without effect."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

import apnc_core
from apnc_core.schema import Causality
from apnc_core.variables import variables_of
from build_fmu import modelica as generator

parser = pytest.importorskip("pymoca.parser", reason="pymoca is not installed: nothing was parsed")

PACKAGE = Path(__file__).resolve().parents[2] / "modelica" / "Apnc"
FILES = sorted(PACKAGE.rglob("*.mo"))


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_a_second_reader_takes_every_file(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    assert parser.parse(text, bypass_cache=True) is not None
    with pytest.raises(parser.ModelicaSyntaxError):
        parser.parse(text.replace("end ", "end end ", 1), bypass_cache=True)


@pytest.mark.parametrize("folder", sorted(p.parent for p in PACKAGE.rglob("package.mo")))
def test_package_order_names_every_child(folder: Path) -> None:
    order = (folder / "package.order").read_text().split()
    text = (folder / "package.mo").read_text()
    inside = re.findall(
        r"^  (?:partial )?(?:package|class|model|block|function|connector|record) (\w+)", text, re.M
    )
    files = [p.stem for p in folder.glob("*.mo") if p.name != "package.mo"]
    folders = [p.parent.name for p in folder.glob("*/package.mo")]
    assert sorted(order) == sorted(inside + files + folders)


@pytest.mark.parametrize("path", FILES, ids=lambda p: str(p.relative_to(PACKAGE)))
def test_every_file_says_where_it_belongs_and_what_it_is(path: Path) -> None:
    lines = path.read_text().splitlines()
    parents = path.relative_to(PACKAGE.parent).parts[:-1]
    if path.name == "package.mo":
        parents = parents[:-1]
    if parents:
        assert lines[0] == f"within {'.'.join(parents)};"
    head = "\n".join(lines[:3])
    name = path.parent.name if path.name == "package.mo" else path.stem
    assert re.search(rf'\b{name}\s+"|\b{name}\n  "', head), head
    assert re.search(rf"^end {name};$", path.read_text(), re.M)


@pytest.mark.parametrize("path", sorted((PACKAGE / "Blocks").glob("*.mo")), ids=lambda p: p.stem)
def test_every_block_is_documented(path: Path) -> None:
    assert "Documentation(info=" in path.read_text()


def test_the_version_is_that_of_the_project() -> None:
    assert f'version="{apnc_core.__version__}"' in (PACKAGE / "package.mo").read_text()


def test_every_parameter_acts_in_a_block_written_by_hand() -> None:
    generated = {PACKAGE.parents[1] / path for path in generator.TARGETS.values()}
    by_hand = [p for p in FILES if p not in generated]
    text = "\n".join(re.sub(r'"(?:[^"\\]|\\.)*"', "", p.read_text()) for p in by_hand)
    # handing a parameter on (name=name) is no effect
    text = re.sub(r"\b(\w+)=\1\b", "", text)
    parameters = [v.name for v in variables_of(Causality.parameter)]
    assert [name for name in parameters if not re.search(rf"\b{name}\b", text)] == []


def test_a_group_with_an_unknown_parameter_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(generator.GROUPS, "Oscillator", ("w11", "no_such"))
    with pytest.raises(ValueError, match="no_such"):
        generator.groups()


def test_a_parameter_that_no_block_names_is_not_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(generator.GROUPS, "Oscillator", ("w11",))
    assert "w12_0" in [v.name for v in generator.groups()[generator.REST]]

"""The code blocks of the documentation run, and its links lead somewhere."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest

ROOT = Path(__file__).resolve().parents[2]
MADE = {ROOT / "docs" / "tutorial" / "tutorial.md": ROOT / "docs" / "tutorial" / "tutorial.ipynb"}
"""Pages that ``.ci/docs`` makes, and from what."""
PAGES = [ROOT / "README.md", *sorted(set((ROOT / "docs").rglob("*.md")) - set(MADE))]
_BLOCK = re.compile(r"^```(\w+)\n(.*?)^```", re.MULTILINE | re.DOTALL)


def blocks(language: str) -> list[tuple[str, str]]:
    return [
        (f"{page.relative_to(ROOT)}:{page.read_text()[: m.start()].count(chr(10)) + 1}", m[2])
        for page in PAGES
        for m in _BLOCK.finditer(page.read_text())
        if m[1] == language
    ]


def python_blocks() -> list[Any]:
    """Blocks of Python; one that searches takes longer than all others."""
    return [
        pytest.param(*block, marks=[pytest.mark.thorough] if "tune(" in block[1] else [])
        for block in blocks("python")
    ]


@pytest.mark.parametrize(("place", "code"), python_blocks(), ids=lambda x: x.split("\n")[0][:40])
def test_python_block_runs(
    place: str, code: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    # in this process, which has imported most of what the blocks import
    exec(compile(code, place, "exec"), {"__name__": "__main__"})


@pytest.mark.parametrize(("place", "code"), blocks("c"), ids=lambda x: x.split("\n")[0][:40])
def test_c_block_runs(place: str, code: str, tmp_path: Path) -> None:
    core = ROOT / "fmu_src" / "core"
    (tmp_path / "main.c").write_text(code)
    command = [sys.executable, "-m", "ziglang", "cc", "-std=c11", "-Wall", "-Werror"]
    command += [f"-I{core}", "main.c", *map(str, core.glob("*.c")), "-o", "main", "-lm"]
    for step in (command, [str(tmp_path / "main")]):
        done = subprocess.run(step, cwd=tmp_path, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{place}\n{done.stderr}"
    assert "rad" in done.stdout


@pytest.mark.parametrize("page", PAGES, ids=lambda p: p.name)
def test_links_between_pages_lead_somewhere(page: Path) -> None:
    for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text()):
        if not target.startswith(("http", "mailto:")):
            file = (page.parent / target).resolve()
            assert MADE.get(file, file).exists(), f"{page.name}: {target}"

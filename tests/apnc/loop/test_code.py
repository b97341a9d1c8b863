"""The hash of the code knows every file that a result depends on, and no other."""

from __future__ import annotations

from pathlib import Path

from apnc.loop.code import ROOT, code_hash

ONLY_SHOW = {"cli", "film", "report", "system", "tune", "view"}
"""Packages of ``apnc`` that show or export results, or search a robot."""


def counts(file: Path) -> bool:
    """Whether a result of a study can depend on a file of ``apnc``, named from there."""
    return not (file.parts[0] in ONLY_SHOW or file.name == "figures.py")


def test_an_edit_of_any_file_that_a_result_depends_on_is_other_code(tmp_path: Path) -> None:
    files = [file.relative_to(ROOT / "apnc") for file in (ROOT / "apnc").rglob("*.py")]
    assert {"metrics", "loop", "studies"} <= {file.parts[0] for file in files}
    copy = tmp_path / "apnc"
    for file in files:
        (copy / file).parent.mkdir(parents=True, exist_ok=True)
        (copy / file).write_text("x")
    before = code_hash.__wrapped__(tmp_path)
    seen = []
    for file in files:
        (copy / file).write_text("y")
        if code_hash.__wrapped__(tmp_path) != before:
            seen.append(file)
        (copy / file).write_text("x")
    assert seen == [file for file in files if counts(file)]

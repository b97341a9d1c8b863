"""``apnc walk --open`` hands the report to the browser, and says what to open without one."""

from __future__ import annotations

import shlex
import sys
import webbrowser
from pathlib import Path

import pytest
from command_line import run

from apnc.cli.browser import open_page

WALK = ("walk", "--engine", "compiled", "--duration", "1")


def test_the_report_is_opened(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    opened: list[str] = []
    monkeypatch.setattr(webbrowser, "open", lambda address: opened.append(address) or True)
    assert run(capsys, *WALK)[0] == 0
    assert opened == []
    code, out, _ = run(capsys, *WALK, "--open", "--output", "a folder")
    assert code == 0 and "no browser" not in out
    assert opened == [(tmp_path / "a folder" / "report.html").as_uri()]


def test_without_a_browser_the_address_is_said(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(webbrowser, "open", lambda address: False)
    open_page("file:///r.html")
    assert capsys.readouterr().out == "no browser found; open file:///r.html\n"


@pytest.mark.skipif(sys.platform == "win32", reason="BROWSER is a command of a shell")
def test_the_browser_that_the_user_names_gets_the_address(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    seen = tmp_path / "seen"
    code = f"import sys, pathlib; pathlib.Path({str(seen)!r}).write_text(sys.argv[1])"
    monkeypatch.setenv("BROWSER", shlex.join([sys.executable, "-c", code, "%s"]))
    monkeypatch.setattr(webbrowser, "_tryorder", None)
    monkeypatch.setattr(webbrowser, "_browsers", {})
    open_page("file:///r.html")
    assert seen.read_text() == "file:///r.html"

"""Tables, links and completion of the command line."""

from __future__ import annotations

from pathlib import Path

import pytest

from apnc.cli.console import say_file, show_table

LONG = "a text of many words, of which a window of few characters shows no more than a part"


def table(
    capsys: pytest.CaptureFixture[str], rows: list[tuple[str, ...]], *headings: str
) -> list[str]:
    """The lines of a table."""
    show_table(rows, *headings)
    return capsys.readouterr().out.splitlines()


def test_a_table_in_a_pipe_has_a_line_for_each_row(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("COLUMNS", raising=False)
    lines = table(capsys, [("leg[1].grf", "N", LONG), ("MI", "rad", "short")], "name", "unit", "is")
    assert lines == [
        "name        unit  is",
        f"leg[1].grf  N     {LONG}",
        "MI          rad   short",
    ]


def test_text_that_does_not_fit_is_wrapped_in_its_column(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    lines = table(capsys, [("name", LONG)])
    assert len(lines) == 2 and max(map(len, lines)) <= 60
    assert lines[1].startswith(" " * 6)
    assert " ".join(" ".join(lines).split()) == f"name {LONG}"


def test_text_is_below_its_row_where_its_column_is_narrow(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    name, other = "n" * 15, "o" * 15
    lines = table(capsys, [(name, other, LONG), (name, other, "fits")])
    assert lines[0] == f"{name}  {other}"
    assert all(line.startswith("    ") and len(line) <= 60 for line in lines[1:-1])
    assert " ".join(line.strip() for line in lines[1:-1]) == LONG
    assert lines[-1] == f"{name}  {other}  fits"


def test_few_long_cells_leave_the_text_its_column(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("COLUMNS", "60")
    text = "t" * 39
    rows = [("a", "1 m", text), ("b", "2 m", text), ("c", "3" * 40, text)]
    lines = table(capsys, rows)
    assert lines[0].index("t") == lines[1].index("t") == 60 - len(text)
    assert lines[2:] == [f"c  {'3' * 40}", f"    {text}"]


@pytest.mark.parametrize("terminal", [True, False])
def test_a_terminal_gets_a_link_and_a_pipe_the_path(
    terminal: bool,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("TERM", "xterm-256color")
    if terminal:
        monkeypatch.setenv("FORCE_COLOR", "1")
    say_file("report", Path("a folder", "report.html"))
    out = capsys.readouterr().out
    address = (tmp_path / "a folder" / "report.html").as_uri()
    if terminal:
        assert f";{address}\x1b\\a folder/report.html\x1b]8;;\x1b\\\n" in out
    else:
        assert out == f"report: {Path('a folder', 'report.html')}\n"

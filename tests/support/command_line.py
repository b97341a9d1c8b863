"""A command of ``apnc`` run in this process."""

from __future__ import annotations

import pytest

from apnc.cli import main as command_line


def run(capsys: pytest.CaptureFixture[str], *words: str) -> tuple[int, str, str]:
    """Exit code and what was printed, of a command run here: faster than in its own process."""
    with pytest.raises(SystemExit) as end:
        command_line.main(list(words))
    assert isinstance(end.value.code, int)
    return end.value.code, *capsys.readouterr()

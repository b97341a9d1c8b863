"""``apnc`` in a process of its own, with a terminal or a pipe at its standard error."""

from __future__ import annotations

import os
import pty
import re
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

APNC = [sys.executable, "-m", "apnc"]


def apnc(
    *arguments: str, cwd: Path, encoding: str = "utf-8", env: dict[str, str] | None = None
) -> subprocess.CompletedProcess[str]:
    """A finished command; ``env`` is added to the environment."""
    return subprocess.run(
        [*APNC, *arguments],
        cwd=cwd,
        capture_output=True,
        encoding=encoding,
        env=os.environ | (env or {}),
        check=False,
        timeout=600,
    )


def interrupted(
    *command: str,
    at: str,
    cwd: Path,
    env: dict[str, str] | None = None,
    by: signal.Signals = signal.SIGINT,
) -> tuple[int, str]:
    """Exit code and standard error of a command that gets a signal once ``at`` stands there.

    As Ctrl-C from a keyboard, its child processes get it too. ``at`` is a regular expression.
    """
    terminal, theirs = pty.openpty()
    process = subprocess.Popen(
        [*command],
        cwd=cwd,
        stderr=theirs,
        stdout=subprocess.DEVNULL,
        env=os.environ | (env or {}),
        process_group=0,
    )
    os.close(theirs)
    shown, sent, end = "", False, time.monotonic() + 300.0
    while time.monotonic() < end:
        ready, _, _ = select.select([terminal], [], [], 1.0)
        try:
            shown += os.read(terminal, 65536).decode(errors="replace") if ready else ""
        except OSError:  # the process has closed it
            break
        if not sent and re.search(at, shown):
            sent = True
            os.killpg(process.pid, by)
        if not ready and process.poll() is not None:
            break
    else:
        process.kill()
    os.close(terminal)
    assert sent, f"{at!r} was never shown: {shown}"
    return process.wait(timeout=60), shown

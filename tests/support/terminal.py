"""``apnc`` in a process of its own, with a terminal or a pipe at its standard error."""

from __future__ import annotations

import fcntl
import os
import pty
import re
import select
import signal
import struct
import subprocess
import sys
import termios
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


def typed(*shell: str, lines: dict[str, str], cwd: Path, wait_s: float = 60.0) -> list[str]:
    """What a shell shows after each of some unfinished lines, which are wiped out afterwards.

    Args:
        shell: command of an interactive shell.
        lines: what is typed, and a regular expression of the answer that is waited for.
        cwd: folder of the shell.
        wait_s: longest wait for an answer [s].
    """
    process, terminal = pty.fork()
    if process == 0:
        os.chdir(cwd)
        os.execvpe(shell[0], shell, os.environ | {"TERM": "xterm"})
    fcntl.ioctl(terminal, termios.TIOCSWINSZ, struct.pack("4H", 50, 200, 0, 0))

    def until(expected: str, seconds: float) -> str:
        shown, end = "", time.monotonic() + seconds
        while not re.search(expected, shown) and time.monotonic() < end:
            ready, _, _ = select.select([terminal], [], [], 0.2)
            shown += os.read(terminal, 65536).decode(errors="replace") if ready else ""
        return shown

    try:
        until(r"[$%#>] ", wait_s)
        seen = []
        for line, answer in lines.items():
            until(r"(?!)", 0.3)
            os.write(terminal, line.encode())
            seen.append(until(answer, wait_s))
            os.write(terminal, b"\x15")
        return seen
    finally:
        os.kill(process, signal.SIGKILL)
        os.waitpid(process, 0)
        os.close(terminal)

"""Ctrl-C: at once while there is nothing to lose, at the next tick while there is."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Final

INTERRUPTED: Final = 130
"""Exit code after Ctrl-C."""

NOTHING: Final = "interrupted, nothing recorded"


class Interrupted(BaseException):
    """Ctrl-C, with what to say about it. No KeyboardInterrupt, which libraries catch or replace."""


class StopRequest:
    """A request to stop: what ``simulate`` and ``run_study`` ask for.

    Until it is asked for the first time Ctrl-C raises Interrupted. After that the first Ctrl-C is
    noted, since a record grows, and the second raises.

    Attributes:
        asked: whether Ctrl-C was pressed; an import may swallow or change what was raised.
        running: whether a loop has begun.
    """

    def __init__(self) -> None:
        self.asked = self.running = False

    def __call__(self) -> bool:
        """Whether a stop was asked for."""
        self.running = True
        return self.asked

    def _note(self, _signal: int, _frame: FrameType | None) -> None:
        again, self.asked = self.asked, True
        if again or not self.running:
            raise Interrupted("interrupted" if self.running else NOTHING)

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Listen to Ctrl-C inside the with statement."""
        before = signal.signal(signal.SIGINT, self._note)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)


STOP = StopRequest()
"""Ctrl-C of this process."""

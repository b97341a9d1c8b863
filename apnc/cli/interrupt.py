"""Ctrl-C and SIGTERM: at once while there is nothing to lose, at the next tick while there is."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Final

STOPPED: Final = 128
"""Exit code after a signal that ended the command, less the number of the signal."""

NOTHING: Final = "interrupted, nothing recorded"


class Interrupted(BaseException):
    """A stop, with what to say about it. No KeyboardInterrupt, which libraries catch or replace."""


class StopRequest:
    """A request to stop: what ``simulate`` and ``run_study`` ask for.

    Until it is asked for the first time a signal raises Interrupted. After that the first one is
    noted, since a record grows, and a second Ctrl-C raises. A second SIGTERM does not: schedulers
    send it to a command and to what has started it, which passes it on.

    Attributes:
        asked: whether a signal came; an import may swallow or change what was raised.
        running: whether a loop has begun.
        code: exit code after the signal that came first.
    """

    def __init__(self) -> None:
        self.asked = self.running = False
        self.code = STOPPED + signal.SIGINT

    def __call__(self) -> bool:
        """Whether a stop was asked for."""
        self.running = True
        return self.asked

    def _note(self, number: int, _frame: FrameType | None) -> None:
        again, self.asked = self.asked, True
        if not again:
            self.code = STOPPED + number
        if not self.running:
            raise Interrupted(NOTHING)
        if again and number == signal.SIGINT:
            raise Interrupted("interrupted")

    @contextmanager
    def listening(self) -> Iterator[None]:
        """Listen to Ctrl-C and SIGTERM inside the with statement."""
        numbers = (signal.SIGINT, signal.SIGTERM)
        before = {number: signal.signal(number, self._note) for number in numbers}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)


STOP = StopRequest()
"""Ctrl-C and SIGTERM of this process."""

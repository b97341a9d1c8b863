"""Ctrl-C and SIGTERM end a command at once, or at the next tick if a record would be lost."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType
from typing import Final

STOPPED: Final = 128
"""Exit code after a signal minus the number of the signal."""

NOTHING: Final = "interrupted, nothing recorded"


class Interrupted(BaseException):
    """A stop with a message. It is no KeyboardInterrupt, since libraries catch or replace those."""


class StopRequest:
    """A request to stop, as the argument ``stop`` of ``simulate`` and ``run_study``.

    Before it is called for the first time, a signal raises Interrupted. Afterwards a record grows,
    so the first signal is only noted, and a second Ctrl-C raises. A second SIGTERM does not raise:
    schedulers send it to a command and to its parent process, which passes it on.

    Attributes:
        asked: whether a signal came. An import may swallow the exception, so this is kept as well.
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
        """Handle Ctrl-C and SIGTERM inside the with statement."""
        numbers = (signal.SIGINT, signal.SIGTERM)
        before = {number: signal.signal(number, self._note) for number in numbers}
        try:
            yield
        finally:
            for number, handler in before.items():
                signal.signal(number, handler)


STOP = StopRequest()
"""The request to stop of this process."""

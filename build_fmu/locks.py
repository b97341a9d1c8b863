"""Only one at a time: locks of the operating system, which end with the process that holds them."""

from __future__ import annotations

import os
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

if sys.platform != "win32":
    import fcntl


def locked(descriptor: int, *, wait: bool) -> bool:
    """Lock an open file or folder until its descriptor is closed.

    Args:
        descriptor: of the open file.
        wait: until who has it is done; else do not.

    Returns:
        Whether nobody else has it. Also True where the file system, or Windows, has no such locks.
    """
    if sys.platform == "win32":
        return True
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except BlockingIOError:
        return False
    except OSError:  # as on a folder of a network
        return True
    return True


@contextmanager
def one_at_a_time(folder: Path) -> Iterator[None]:
    """One writer at a time, of this process or another, is inside the with statement.

    Args:
        folder: which they write to; no file is made in it.

    Windows, which cannot lock a folder, refuses instead to rename a file onto another.
    """
    if sys.platform == "win32":
        yield
        return
    descriptor = os.open(folder, os.O_RDONLY)
    try:
        locked(descriptor, wait=True)
        yield
    finally:
        os.close(descriptor)

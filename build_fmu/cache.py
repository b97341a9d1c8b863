"""The folder of everything that is kept between runs: built FMUs and compiled code."""

from __future__ import annotations

import os
import stat
import tempfile
import threading
from functools import cache
from pathlib import Path

import platformdirs

VARIABLE = "APNC_CACHE"


def cache_folder() -> Path:
    """Folder of finished builds and compiled code.

    It is the value of the environment variable ``APNC_CACHE``, or else the user's cache folder. If
    that cannot be written, it is a folder of this user in the temporary folder.
    """
    chosen = os.environ.get(VARIABLE)
    return Path(chosen) if chosen else _usual()


@cache
def _usual() -> Path:
    folder = Path(platformdirs.user_cache_dir("apnc"))
    try:
        folder.mkdir(parents=True, exist_ok=True)
        tempfile.TemporaryFile(dir=folder).close()
    except OSError:
        return _temporary()
    return folder


def _temporary() -> Path:
    user = os.getuid() if hasattr(os, "getuid") else "user"
    folder = Path(tempfile.gettempdir()) / f"apnc-{user}"
    folder.mkdir(mode=0o700, exist_ok=True)
    found = folder.lstat()
    # another user may have made a folder of that name with libraries that would be loaded
    mine = not hasattr(os, "getuid") or (found.st_uid == user and not found.st_mode & 0o022)
    return (
        folder if mine and stat.S_ISDIR(found.st_mode) else Path(tempfile.mkdtemp(prefix="apnc-"))
    )


def write_atomically(path: Path, content: bytes) -> None:
    """Write a file at once: neither a reader nor a second writer ever sees a part of it."""
    path.parent.mkdir(parents=True, exist_ok=True)
    part = path.with_name(f"{path.name}.{os.getpid()}.{threading.get_ident()}.part")
    part.write_bytes(content)
    part.replace(path)

"""The folder of everything that is kept between runs: built FMUs and compiled code."""

from __future__ import annotations

import os
import stat
import tempfile
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


def temporary_folder() -> tempfile.TemporaryDirectory[str]:
    """New folder in this user's temporary folder, removed with what is in it when it is closed."""
    return tempfile.TemporaryDirectory(dir=_temporary(), ignore_cleanup_errors=True)


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
    """Temporary folder of this user; a new one if that of the usual name is not safe."""
    user = os.getuid() if hasattr(os, "getuid") else "user"
    folder = Path(tempfile.gettempdir()) / f"apnc-{user}"
    folder.mkdir(mode=0o700, exist_ok=True)
    found = folder.lstat()
    # another user may have made a folder of that name with libraries that would be loaded
    mine = not hasattr(os, "getuid") or (found.st_uid == user and not found.st_mode & 0o022)
    return (
        folder if mine and stat.S_ISDIR(found.st_mode) else Path(tempfile.mkdtemp(prefix="apnc-"))
    )

"""The robot in C, as its header declares it: the one copy of its laws, for every engine."""

from __future__ import annotations

import re
import threading
from typing import Any, Final

import cffi

from build_fmu.library import headers, library_path

_LOCK: Final = threading.Lock()
_loaded: list[tuple[Any, Any]] = []


def library() -> tuple[Any, Any]:
    """cffi's ``ffi``, which makes C data, and ``lib``, which has the functions and constants.

    Loaded at the first call; compiled before that where it did not come with the package. While a
    C function runs, other threads of Python run too.

    Raises:
        ValueError: no library for this machine came with the package, and none can be built.
        OSError: it cannot be loaded, or the cache folder cannot be written.
    """
    if not _loaded:
        with _LOCK:
            if not _loaded:
                _loaded.append(_load())
    return _loaded[0]


def _load() -> tuple[Any, Any]:
    ffi = cffi.FFI()
    for header in headers():
        ffi.cdef(declarations(header))
    return ffi, ffi.dlopen(str(library_path()))


def declarations(header: str) -> str:
    """Plain C of a header: without preprocessor lines and without what is for C++ alone."""
    plain = re.sub(r"(?ms)^#ifdef __cplusplus$.*?^#endif$", "", header)
    return re.sub(r"(?m)^#.*$", "", plain)


def aligned_memory(size: int) -> tuple[Any, Any]:
    """Zeroed bytes for a plant: where they begin, at a multiple of 64, and what owns them.

    Args:
        size: how many; 0 is what C answers where there is no such plant.

    Raises:
        ValueError: the size is 0.
    """
    ffi, _ = library()
    if not size:
        raise ValueError("the plant in C takes robots of 2 to 64 legs")
    block = ffi.new("unsigned char[]", size + 63)
    return block + -int(ffi.cast("uintptr_t", block)) % 64, block

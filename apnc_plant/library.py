"""The plant in C as a library of Python. It holds the only copy of its laws, for all engines."""

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

    The library is loaded at the first call. If the package has none for this machine, it is
    compiled first. Other threads of Python run while a C function runs.

    Raises:
        ValueError: the package has no library for this machine, and none can be built.
        OSError: the library cannot be loaded, or the cache folder cannot be written.
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
    """Declarations of a header, without preprocessor lines and without parts for C++ alone."""
    plain = re.sub(r"(?ms)^#ifdef __cplusplus$.*?^#endif$", "", header)
    return re.sub(r"(?m)^#.*$", "", plain)


def aligned_memory(size: int) -> tuple[Any, Any]:
    """Zeroed bytes for a plant: a pointer that is a multiple of 64, and the object that owns them.

    Args:
        size: number of bytes; C returns 0 if no such plant is possible.

    Raises:
        ValueError: the size is 0.
    """
    ffi, _ = library()
    if not size:
        raise ValueError("the plant in C takes robots of 2 to 64 legs")
    block = ffi.new("unsigned char[]", size + 63)
    return block + -int(ffi.cast("uintptr_t", block)) % 64, block

"""Controllers of the FMU whose oscillators begin apart.

The FMU has one start value for the oscillators of all legs. Its saved state holds the outputs of
each, so they are put there, after the controller was initialized and before its first tick.
"""

from __future__ import annotations

import ctypes
import struct
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import Any, Final

from apnc.loop.controller_library import ControllerLibrary
from apnc.loop.fmu_controller import FmuError
from apnc_core.types import Array
from apnc_plant.library import library

Pointer = ctypes.c_void_p

_CALL: Final = ctypes.CFUNCTYPE(ctypes.c_int, Pointer)
"""Functions that take an instance and return a status."""

_HEADER: Final = 64
"""Size of what lies before the block of a saved state, see ``saved_state.c`` [bytes]."""

_WARNING, _ERROR = 1, 3
"""Statuses of FMI 2.0."""


@contextmanager
def begun_at(controller: ControllerLibrary, o1: Array, o2: Array) -> Iterator[None]:
    """Controllers that are initialized in this block begin with these outputs.

    Args:
        controller: the FMU.
        o1, o2: outputs of every oscillator at the first tick, shape (n_legs,).

    Raises:
        FmuError: the FMU has not saved its state, or not taken it.

    Pitfall: it holds for all threads that start a controller of this FMU meanwhile.
    """
    ffi, _ = library()
    functions = controller.functions
    own = functions.exit_initialization
    initialized = ctypes.cast(controller.address("ExitInitializationMode"), _CALL)
    errors: list[Exception] = []

    def exit_initialization(instance: int) -> int:
        status = int(initialized(instance))
        if status <= _WARNING:
            try:
                _put(controller, instance, [*o1, *o2])
            except Exception as error:  # C cannot pass it on
                errors.append(error)
                return _ERROR
        return status

    callback = _CALL(exit_initialization)
    functions.exit_initialization = ffi.cast("void *", ctypes.cast(callback, Pointer).value)
    try:
        yield
    finally:
        functions.exit_initialization = own
    if errors:
        raise errors[0]


def _put(controller: ControllerLibrary, instance: int, outputs: Sequence[float]) -> None:
    """Put outputs of the oscillators into an instance, o1 of all legs and then o2 of all legs."""
    shown = controller.references("o1", "o2")
    values = (ctypes.c_double * len(shown))()

    def call(name: str, *arguments: Any) -> None:
        kinds = [ctypes.c_size_t if isinstance(each, int) else Pointer for each in arguments]
        function = ctypes.CFUNCTYPE(ctypes.c_int, Pointer, *kinds)(controller.address(name))
        if function(instance, *arguments) > _WARNING:
            raise FmuError(f"fmi2{name} failed")

    state, size = Pointer(), ctypes.c_size_t()
    call("GetFMUstate", ctypes.byref(state))
    try:
        call("SerializedFMUstateSize", state, ctypes.byref(size))
        saved = ctypes.create_string_buffer(size.value)
        call("SerializeFMUstate", state, saved, size.value)
        call("GetReal", (ctypes.c_uint32 * len(shown))(*shown), len(shown), values)
        saved.raw = _with_outputs(
            saved.raw, bytes(values), struct.pack(f"={len(shown)}d", *outputs)
        )
        call("DeSerializeFMUstate", saved, size.value, ctypes.byref(state))
        call("SetFMUstate", state)
    finally:
        call("FreeFMUstate", ctypes.byref(state))


def _with_outputs(saved: bytes, start: bytes, outputs: bytes) -> bytes:
    """A saved state with other outputs, and the checksum that belongs to it.

    Args:
        saved: the state of an initialized instance.
        start: the outputs in it.
        outputs: those to put there.
    """
    header, block = saved[:_HEADER], saved[_HEADER:]
    if start not in block:
        raise FmuError("the saved state does not hold the outputs of the oscillators")
    block = block.replace(start, outputs)
    checksum = 14695981039346656037  # FNV-1a
    for byte in block:
        checksum = (checksum ^ byte) * 1099511628211 % 2**64
    return header[:-8] + struct.pack("=Q", checksum) + block

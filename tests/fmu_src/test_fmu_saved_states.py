"""Saved states that are damaged, foreign or made by hand: an error, never a crash."""

from __future__ import annotations

import ctypes
import math
import random
import struct
import zipfile
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from raw_fmu import ERROR, OK, TS, Instance, Library, fmu_in

from apnc_core.interface import Parameters
from apnc_core.variables import N_WINDOW_MAX
from build_fmu.build import cached_fmu
from build_fmu.options import BuildOptions, host_platform

HEADER = 64
"""Bytes in front of the run; the first of the run are Ts."""


TICKS = 107


@pytest.fixture
def blob(library: Library) -> Iterator[bytes]:
    fmu = fmu_in(library, "stepping")
    for n in range(TICKS):
        fmu.step(n * TS)
    yield serialized(fmu)
    fmu.free()


def serialized(fmu: Instance) -> bytes:
    state, size = ctypes.c_void_p(), ctypes.c_size_t()
    assert fmu("fmi2GetFMUstate", ctypes.byref(state)) == OK
    assert fmu("fmi2SerializedFMUstateSize", state, ctypes.byref(size)) == OK
    buffer = ctypes.create_string_buffer(size.value)
    assert fmu("fmi2SerializeFMUstate", state, buffer, size.value - 1) == ERROR
    fmu.log.clear()
    assert fmu("fmi2SerializeFMUstate", state, buffer, size.value) == OK
    assert fmu("fmi2FreeFMUstate", ctypes.byref(state)) == OK
    return buffer.raw


def read_back(fmu: Instance, content: bytes) -> int:
    """Status of reading a blob; what it gives is put in place and stepped, then freed."""
    state = ctypes.c_void_p()
    status = fmu("fmi2DeSerializeFMUstate", content, len(content), ctypes.byref(state))
    assert (status == OK) == (state.value is not None)
    if status == OK:
        assert fmu("fmi2SetFMUstate", state) == OK
        assert fmu("fmi2FreeFMUstate", ctypes.byref(state)) == OK
    return status


@pytest.mark.parametrize(
    ("damage", "why"),
    [
        (lambda b: b"", "too short"),
        (lambda b: b[:8], "too short"),
        (lambda b: b[:-1], "bytes"),
        (lambda b: b + b"\0", "bytes"),
        (lambda b: b[:200], "bytes"),
        (lambda b: b"PK\3\4" + b[4:], "not a saved state"),
        (lambda b: bytes(len(b)), "not a saved state"),
        (lambda b: b[:9] + bytes([b[9] ^ 1]) + b[10:], "another build"),
        (lambda b: b[:48] + b"\0" + b[49:], "another build"),
        (lambda b: b[:-1] + bytes([b[-1] ^ 1]), "damaged"),
    ],
)
def test_foreign_and_truncated_blobs(
    library: Library, blob: bytes, damage: Callable[[bytes], bytes], why: str
) -> None:
    fmu = fmu_in(library, "stepping")
    assert read_back(fmu, damage(blob)) == ERROR
    assert len(fmu.messages) == 1 and why in fmu.messages[0]
    assert fmu.step(0.0) == OK
    assert read_back(fmu, blob) == OK
    fmu.free()


def test_any_flipped_bit_is_noticed(library: Library, blob: bytes) -> None:
    fmu = fmu_in(library, "stepping")
    rng = random.Random(1)
    header = range(8 * HEADER)
    places = [*header, *(rng.randrange(8 * len(blob)) for _ in range(3000))]
    for place in places:
        spoiled = bytearray(blob)
        spoiled[place // 8] ^= 1 << place % 8
        assert read_back(fmu, bytes(spoiled)) == ERROR, place
    fmu.free()


def test_a_state_of_another_build_is_refused_even_if_it_has_the_same_layout(
    library: Library, tmp_path: Path
) -> None:
    with zipfile.ZipFile(
        cached_fmu(BuildOptions(naming="flat", platforms=(host_platform(),)))
    ) as archive:
        archive.extractall(tmp_path)
    flat = fmu_in(Library.load(tmp_path), "stepping")
    own = fmu_in(library, "stepping")
    foreign = serialized(flat)
    assert len(foreign) == len(serialized(own))
    assert read_back(own, foreign) == ERROR
    assert f"another build of the FMU, not by {library.guid}" in own.messages[0]
    assert read_back(flat, foreign) == OK
    own.free()
    flat.free()


def with_checksum(content: bytearray) -> bytes:
    """The blob with the checksum of its header made right again (FNV-1a of what follows it)."""
    total = 14695981039346656037
    for byte in content[HEADER:]:
        total = (total ^ byte) * 1099511628211 % 2**64
    content[HEADER - 8 : HEADER] = total.to_bytes(8, "little")
    return bytes(content)


@pytest.mark.parametrize("Ts", [0.0, -TS, 5e-324, 1e9, math.nan, math.inf, -math.inf])
def test_a_blob_made_by_hand_cannot_bring_impossible_parameters(
    library: Library, blob: bytes, Ts: float
) -> None:
    assert struct.unpack_from("<d", blob, HEADER) == (TS,)
    assert with_checksum(bytearray(blob)) == blob
    forged = bytearray(blob)
    struct.pack_into("<d", forged, HEADER, Ts)
    fmu = fmu_in(library, "stepping")
    assert read_back(fmu, with_checksum(forged)) == ERROR
    assert "inconsistent" in fmu.messages[0]
    fmu.free()


NUMBERS = {
    "next_tick": ("<q", -24, TICKS),
    "ticks": ("<q", -32, TICKS),
    "oldest": ("<i", -160, TICKS % Parameters().N),
}
"""Whole numbers of the controller's state: format, place from the end, value after ``TICKS``."""


@pytest.mark.parametrize(
    ("name", "value"),
    [
        *[(name, value) for name in ("next_tick", "ticks") for value in (-1, 2**53 + 1, -(2**63))],
        *[("oldest", value) for value in (-1, Parameters().N, N_WINDOW_MAX, 2**31 - 1)],
    ],
)
def test_a_blob_made_by_hand_cannot_bring_impossible_counts(
    library: Library, blob: bytes, name: str, value: int
) -> None:
    kind, place, expected = NUMBERS[name]
    assert struct.unpack_from(kind, blob, len(blob) + place) == (expected,)
    forged = bytearray(blob)
    struct.pack_into(kind, forged, len(blob) + place, value)
    fmu = fmu_in(library, "stepping")
    assert read_back(fmu, with_checksum(forged)) == ERROR
    assert "inconsistent" in fmu.messages[0]
    fmu.free()


@pytest.mark.parametrize("oldest", [-1, N_WINDOW_MAX])
def test_a_terminated_state_cannot_bring_a_place_outside_the_window(
    library: Library, oldest: int
) -> None:
    fmu = fmu_in(library, "terminated")
    forged = bytearray(serialized(fmu))
    kind, place, _ = NUMBERS["oldest"]
    struct.pack_into(kind, forged, len(forged) + place, oldest)
    assert read_back(fmu, with_checksum(forged)) == ERROR
    fmu.free()

"""FMI 2.0 functions called directly, for tests that need arguments fmpy would not pass."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import fmpy
from fmpy import fmi2

from build_fmu.options import MODEL, PLATFORMS, host_platform

OK, WARNING, DISCARD, ERROR = fmi2.fmi2OK, fmi2.fmi2Warning, fmi2.fmi2Discard, fmi2.fmi2Error
TS = 1 / 60

_real, _int, _size, _pointer = ctypes.c_double, ctypes.c_int, ctypes.c_size_t, ctypes.c_void_p
_text = ctypes.c_char_p
_access = (_pointer, _pointer, _size, _pointer)
_blob = (_pointer, _pointer, _size)
_state = (_pointer, _pointer)
_status = (_pointer, _int, _pointer)

PROTOTYPES: dict[str, tuple[Any, ...]] = {
    "fmi2SetDebugLogging": (_pointer, _int, _size, _pointer),
    "fmi2SetupExperiment": (_pointer, _int, _real, _real, _int, _real),
    "fmi2EnterInitializationMode": (_pointer,),
    "fmi2ExitInitializationMode": (_pointer,),
    "fmi2Terminate": (_pointer,),
    "fmi2Reset": (_pointer,),
    **{f"fmi2{do}{kind}": _access for do in ("Get", "Set")
       for kind in ("Real", "Integer", "Boolean", "String")},
    "fmi2GetFMUstate": _state,
    "fmi2SetFMUstate": _state,
    "fmi2FreeFMUstate": _state,
    "fmi2SerializedFMUstateSize": (_pointer, _pointer, _pointer),
    "fmi2SerializeFMUstate": (_pointer, _pointer, _pointer, _size),
    "fmi2DeSerializeFMUstate": (_pointer, _pointer, _size, _pointer),
    "fmi2GetDirectionalDerivative": (_pointer, _pointer, _size, _pointer, _size, _pointer,
                                     _pointer),
    "fmi2SetRealInputDerivatives": (_pointer, _pointer, _size, _pointer, _pointer),
    "fmi2GetRealOutputDerivatives": (_pointer, _pointer, _size, _pointer, _pointer),
    "fmi2DoStep": (_pointer, _real, _real, _int),
    "fmi2CancelStep": (_pointer,),
    **{f"fmi2Get{kind}Status": _status for kind in ("", "Real", "Integer", "Boolean", "String")},
}  # fmt: skip


@dataclass
class Library:
    """The loaded library of an unpacked FMU."""

    folder: Path
    guid: str
    calls: ctypes.CDLL

    @classmethod
    def load(cls, folder: Path, model: str = MODEL) -> Library:
        platform = PLATFORMS[host_platform()]
        calls = ctypes.CDLL(str(folder / "binaries" / platform.folder / (model + platform.suffix)))
        for name, arguments in PROTOTYPES.items():
            getattr(calls, name).argtypes = arguments
        for name in ("fmi2GetVersion", "fmi2GetTypesPlatform"):
            getattr(calls, name).restype = _text
        calls.fmi2Instantiate.restype = _pointer
        calls.fmi2Instantiate.argtypes = (_text, _int, _text, _text, _pointer, _int, _int)
        calls.fmi2FreeInstance.restype = None
        calls.fmi2FreeInstance.argtypes = (_pointer,)
        guid = fmpy.read_model_description(str(folder), validate=False).guid
        return cls(folder, guid, calls)


@dataclass
class Memory:
    """Counts what is asked of the importer's memory."""

    allocated: int = 0
    freed: int = 0
    held: dict[int, Any] = field(default_factory=dict)

    def allocate(self, count: int, size: int) -> int:
        self.allocated += 1
        # dirty on purpose: an importer may hand out memory that is not cleared
        buffer = ctypes.create_string_buffer(count * size)
        address = ctypes.addressof(buffer)
        ctypes.memset(address, 0xA5, count * size)
        self.held[address] = buffer
        return address

    def free(self, address: int | None) -> None:
        self.freed += 1
        del self.held[address or 0]


class Instance:
    """One instance; a call is ``instance("fmi2DoStep", t, h, 1)`` and gives the status."""

    def __init__(
        self,
        library: Library,
        *,
        name: bytes | None = b"raw",
        kind: int = fmi2.fmi2CoSimulation,
        guid: str | None = "",
        resources: bytes | None = None,
        visible: bool = False,
        logging: bool = True,
        logger: bool = True,
        memory: Memory | None = None,
        callbacks: bool = True,
    ) -> None:
        self.library = library
        self.log: list[tuple[int, str, str]] = []
        own = fmi2.fmi2CallbackFunctions()
        if logger:
            own.logger = fmi2.fmi2CallbackLoggerTYPE(self._keep)
        if memory:
            own.allocateMemory = fmi2.fmi2CallbackAllocateMemoryTYPE(memory.allocate)
            own.freeMemory = fmi2.fmi2CallbackFreeMemoryTYPE(memory.free)
        self._own = own
        expected = library.guid if guid == "" else guid
        self.component: int | None = library.calls.fmi2Instantiate(
            name, kind, expected.encode() if expected is not None else None, resources,
            ctypes.addressof(own) if callbacks else None, visible, logging,
        )  # fmt: skip

    def _keep(self, _env: object, _name: bytes, status: int, kind: bytes, text: bytes) -> None:
        self.log.append((status, kind.decode(), text.decode()))

    def __call__(self, function: str, *arguments: Any) -> int:
        return int(getattr(self.library.calls, function)(self.component, *arguments))

    @property
    def messages(self) -> list[str]:
        return [text for status, _, text in self.log if status != OK]

    def get(self, references: Sequence[int], kind: str = "Real") -> list[float]:
        n = len(references)
        c_type = ctypes.c_double if kind == "Real" else ctypes.c_int
        values = (c_type * n)()
        status = self(f"fmi2Get{kind}", (ctypes.c_uint * n)(*references), n, values)
        assert status == OK, self.messages
        return list(values)

    def set(self, references: Sequence[int], values: Sequence[float], kind: str = "Real") -> int:
        n = len(references)
        c_type: Any = ctypes.c_double if kind == "Real" else ctypes.c_int
        return self(f"fmi2Set{kind}", (ctypes.c_uint * n)(*references), n, (c_type * n)(*values))

    def start(self, start_time: float = 0.0) -> None:
        assert self("fmi2SetupExperiment", 0, 0.0, start_time, 0, 0.0) == OK, self.messages
        assert self("fmi2EnterInitializationMode") == OK, self.messages
        assert self("fmi2ExitInitializationMode") == OK, self.messages

    def step(self, t: float, h: float = TS) -> int:
        return self("fmi2DoStep", t, h, 1)

    def free(self) -> None:
        self.library.calls.fmi2FreeInstance(self.component)
        self.component = None


def fmu_in(library: Library, state: str) -> Instance:
    """A fresh instance, brought to a state of the standard by name."""
    fmu = Instance(library)
    if state == "instantiated":
        return fmu
    assert fmu("fmi2SetupExperiment", 0, 0.0, 0.0, 0, 0.0) == OK
    assert fmu("fmi2EnterInitializationMode") == OK
    if state == "initialization":
        return fmu
    assert fmu("fmi2ExitInitializationMode") == OK
    if state == "terminated":
        assert fmu("fmi2Terminate") == OK
    return fmu

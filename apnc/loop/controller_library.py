"""The functions of the controller FMU, for closed loops in C."""

from __future__ import annotations

import contextlib
import ctypes
import threading
from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any, Final

from apnc.loop.fmu_controller import (
    FmuError,
    check_fmu,
    entries_of,
    members_by_name,
    names_in,
    parameter_of,
    unpack,
)
from apnc_core import settings
from apnc_core.frozen import Frozen
from apnc_core.schema import Causality, Type
from apnc_core.settings import SettingLike
from apnc_core.variables import Scalar, scalars, variable_named
from apnc_plant.library import library
from build_fmu.cache import temporary_folder
from build_fmu.platforms import BuildError, library_of, why_not_loaded

_FUNCTIONS: Final = {
    "instantiate": "Instantiate",
    "free_instance": "FreeInstance",
    "setup_experiment": "SetupExperiment",
    "enter_initialization": "EnterInitializationMode",
    "exit_initialization": "ExitInitializationMode",
    "set_real": "SetReal",
    "set_integer": "SetInteger",
    "set_boolean": "SetBoolean",
    "do_step": "DoStep",
    "get_real": "GetReal",
    "get_integer": "GetInteger",
    "get_boolean": "GetBoolean",
}
"""Functions of FMI 2.0 by their members in ``loop_functions``."""

_INPUTS: Final = ("grf", "MI", "turn")
"""Real inputs in the order in which ``loop.h`` has them."""

_COMMANDS: Final = ("theta_hip", "theta_knee")
"""Outputs in the order in which ``loop.h`` has them, before all others."""

_KINDS: Final = {Type.real: "real", Type.boolean: "boolean"}
"""Group of a type in ``loop_starts``. All other types are integers."""


@dataclass(frozen=True)
class Recording:
    """What C reads from a controller at every tick and records.

    Args:
        variables: ``loop_variables`` of C.
        sizes: number of entries of each recorded variable by name, in the order of the record.
        kept: arrays that ``variables`` points to.
    """

    variables: Any
    sizes: Mapping[str, int]
    kept: Mapping[str, Any]


class ControllerLibrary:
    """A controller FMU that is unpacked and loaded. Any number of instances can run at a time.

    Args:
        path: the FMU file.

    Attributes:
        n_legs: number of legs.
        guid: of the FMU, for C.
        functions: ``loop_functions`` of C.
        parameters: scalar parameters in the order in which C reads them back.

    Raises:
        FmuError: no FMU, not this controller, or no binary for this machine.
    """

    def __init__(self, path: Path) -> None:
        description = check_fmu(path)
        self.n_legs, self._naming = names_in(description)
        self._members = members_by_name(self.n_legs, self._naming)
        # the library stays loaded to the end of the process, and so does its folder
        self._folder = temporary_folder()
        folder = Path(self._folder.name)
        unpack(path, folder)
        try:
            with contextlib.chdir(folder):
                self._library = ctypes.CDLL(str(library_of(folder)))
        except BuildError as error:
            raise FmuError(f"{path}: {error}") from None
        except OSError as error:
            raise FmuError(f"{path}: {why_not_loaded(error, folder)}") from error
        ffi, _ = library()
        self.guid = ffi.new("char[]", description.guid.encode())
        addresses = {
            member: ffi.cast("void *", self.address(name)) for member, name in _FUNCTIONS.items()
        }
        self.functions = ffi.new("loop_functions *", addresses)
        self._scalars = list(scalars(self.n_legs, self._naming))
        self._read_back = self._parameters_of_c()
        self.recording = lru_cache(self._recording)
        self._starts = lru_cache(self._new_starts)

    def address(self, name: str) -> int:
        """Address of a function of FMI 2.0, such as ``DoStep``."""
        return ctypes.cast(self._library[f"fmi2{name}"], ctypes.c_void_p).value or 0

    def references(self, *names: str) -> list[int]:
        """Value references of variables, each with an entry per leg or of its own."""
        return [member.value_reference for name in names for member in self._members[name]]

    def _recording(self, signals: frozenset[str] | None) -> Recording:
        """How C reads and records the controller; one object for each choice of signals.

        Args:
            signals: names of the outputs and local variables to record; None: all. Inputs and
                commands always are.
        """
        ffi, _ = library()

        def named(*names: str) -> list[Scalar]:
            return [m for name in names for m in self._members[name]]

        def those(kind: Type) -> list[Scalar]:
            return [
                m
                for m in self._scalars
                if m.variable.type is kind
                and m.variable.causality in (Causality.output, Causality.local)
                and (signals is None or m.variable.name in signals)
            ]

        inputs, reset, commands = named(*_INPUTS), named("reset"), named(*_COMMANDS)
        outputs = commands + [m for m in those(Type.real) if m not in commands]
        whole, flags = those(Type.integer), those(Type.boolean)
        references = {
            name: ffi.new("uint32_t[]", [m.value_reference for m in group] or 1)
            for name, group in (
                ("inputs", inputs), ("reset", reset), ("reals", outputs), ("integers", whole),
                ("booleans", flags),
            )
        }  # fmt: skip
        counts = {"n_reals": len(outputs), "n_integers": len(whole), "n_booleans": len(flags)}
        recorded = [*inputs, *reset, *outputs, *whole, *flags]
        sizes = Counter(m.variable.name for m in recorded)
        fields = {
            "legs": self.n_legs,
            **references,
            **counts,
            "sizes": ffi.new("int32_t[]", list(sizes.values())),
            "n_sizes": len(sizes),
            **self._read_back,
        }
        return Recording(ffi.new("loop_variables *", fields), sizes, fields)

    def _parameters_of_c(self) -> dict[str, Any]:
        """Which parameters C reads back, and in what order."""
        ffi, _ = library()
        groups: dict[str, list[Scalar]] = {"real": [], "integer": [], "boolean": []}
        for member in self._scalars:
            if member.variable.causality is Causality.parameter:
                groups[_KINDS.get(member.variable.type, "integer")].append(member)
        self.parameters = [member for group in groups.values() for member in group]
        fields: dict[str, Any] = {}
        for kind, group in groups.items():
            references = ffi.new("uint32_t[]", [m.value_reference for m in group] or 1)
            fields |= {f"{kind}_parameters": references, f"n_{kind}_parameters": len(group)}
        return fields

    def parameters_of(self, values: Sequence[float]) -> dict[str, settings.Setting]:
        """Parameters by name from the values that C has read back.

        Args:
            values: one per scalar, in the order of :attr:`parameters`.
        """
        entries: dict[str, list[float]] = {}
        for member, value in zip(self.parameters, values, strict=True):
            entries.setdefault(member.variable.name, []).append(value)
        return {
            name: parameter_of(variable_named(name), several) for name, several in entries.items()
        }

    def starts(self, parameters: Mapping[str, SettingLike]) -> tuple[Any, tuple[Any, ...]]:
        """Start values as ``loop_starts``, and the arrays that it points to and that must be kept.

        Many runs share their start values, and C does not change them.

        Raises:
            FmuError: an unknown parameter, or a wrong number of values.
        """
        return self._starts(Frozen(parameters))

    def _new_starts(self, parameters: Mapping[str, SettingLike]) -> tuple[Any, tuple[Any, ...]]:
        ffi, _ = library()
        groups: dict[str, list[tuple[int, float]]] = {"real": [], "integer": [], "boolean": []}
        for name, value in parameters.items():
            scalars_set = entries_of(name, value, self._members)
            kind = _KINDS.get(scalars_set[0][0].variable.type, "integer")
            groups[kind] += [(member.value_reference, v) for member, v in scalars_set]
        kept: list[Any] = []
        fields: dict[str, Any] = {}
        for kind, entries in groups.items():
            reference = ffi.new("uint32_t[]", [vr for vr, _ in entries] or 1)
            c_type, convert = ("double[]", float) if kind == "real" else ("int32_t[]", int)
            values = ffi.new(c_type, [convert(value) for _, value in entries] or 1)
            kept += [reference, values]
            fields |= {kind: reference, f"{kind}s": values, f"n_{kind}s": len(entries)}
        return ffi.new("loop_starts *", fields), tuple(kept)


def controller_library(path: Path | str) -> ControllerLibrary:
    """The library of an FMU. It is loaded once, and again if the file has changed.

    Raises:
        FmuError: as :class:`ControllerLibrary`.
    """
    state = Path(path).stat() if Path(path).is_file() else None
    stamp = (state.st_mtime_ns, state.st_size) if state else (0, 0)
    # One thread at a time: if two begin to check XML schemas at once, libxml2 may refuse every
    # schema afterwards. Loading also changes the working directory for a moment.
    with _loading:
        return _loaded(Path(path).resolve(), stamp)


_loading: Final = threading.Lock()


@lru_cache(maxsize=16)
def _loaded(path: Path, stamp: tuple[int, int]) -> ControllerLibrary:
    return ControllerLibrary(path)

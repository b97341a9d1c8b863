"""The controller FMU, driven through fmpy: arrays in, arrays out, one call per control tick."""

from __future__ import annotations

import contextlib
import ctypes
import shutil
import tempfile
import time
import zipfile
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import TracebackType
from typing import Any, Final

import fmpy
import numpy as np
from fmpy import fmi2
from fmpy.fmi1 import FMICallException
from numpy.typing import NDArray

from apnc_core.schema import Causality, Shape, Type, Value, Variable
from apnc_core.variables import TABLE, Scalar, row, scalars
from build_fmu.platforms import BuildError, library_of, why_not_loaded
from exudyn_models.trace import Trace

Array = NDArray[np.float64]
Setting = Value | Sequence[float]


class FmuError(ValueError):
    """An FMU that cannot be used, or that refused a call, in one line."""


@dataclass(frozen=True)
class Block:
    """Variables of one FMI type that are read or written in one call."""

    names: tuple[tuple[Variable, int, int], ...]
    references: Any
    buffer: Any
    view: np.ndarray[Any, np.dtype[Any]]


def _block(members: Sequence[Scalar], real: bool) -> Block:
    names: list[tuple[Variable, int, int]] = []
    buffer: Any
    for at, member in enumerate(members):
        if not names or names[-1][0] is not member.variable:
            names.append((member.variable, at, 0))
        variable, first, count = names[-1]
        names[-1] = (variable, first, count + 1)
    references = (ctypes.c_uint * len(members))(*[m.value_reference for m in members])
    buffer = ((ctypes.c_double if real else ctypes.c_int) * len(members))()
    view = np.frombuffer(buffer, dtype=np.float64 if real else np.intc)
    return Block(tuple(names), references, buffer, view)


_SHOWN: Final = (Causality.output, Causality.local)


def _names_in(description: Any) -> tuple[int, str]:
    names = {v.name for v in description.modelVariables}
    load = row("grf")
    for naming in ("structured", "flat"):
        n_legs = 0
        while load.scalar_name(n_legs, naming) in names:
            n_legs += 1
        if n_legs >= 2 and {s.name for s in scalars(n_legs, naming)} <= names:
            return n_legs, naming
    raise FmuError(f"'{description.modelName}' is not an APNC controller: its variables differ")


class FmuController:
    """One instance of the controller FMU, initialised and ready to step.

    Args:
        path: the FMU file.
        parameters: values by row name of the table; sequences for rows with several entries.
        start_time: time of the first tick [s].

    Raises:
        FmuError: no FMU, not this controller, no binary for this machine, or a parameter that is
            unknown or out of range.
    """

    def __init__(
        self,
        path: Path | str,
        parameters: Mapping[str, Setting] | None = None,
        start_time: float = 0.0,
    ) -> None:
        self.messages: list[str] = []
        self.wall_s = 0.0
        description = check_fmu(path)
        self.n_legs, self.naming = _names_in(description)
        self._folder = tempfile.mkdtemp(prefix="apnc-")
        try:
            self._instantiate(path, description)
            self._initialise(parameters or {}, start_time)
        except BaseException:
            shutil.rmtree(self._folder, ignore_errors=True)
            raise
        self._prepare()

    def _instantiate(self, path: Path | str, description: Any) -> None:
        fmpy.extract(str(path), unzipdir=self._folder)
        folder = Path(self._folder)
        try:
            library = library_of(folder)
        except BuildError as error:
            raise FmuError(f"{path}: {error}") from None
        try:
            with contextlib.chdir(Path.cwd()):  # FMPy goes elsewhere to load, and stays if it fails
                self._fmu = fmi2.FMU2Slave(
                    guid=description.guid,
                    unzipDirectory=self._folder,
                    modelIdentifier=description.coSimulation.modelIdentifier,
                    instanceName="controller",
                    libraryPath=str(library),
                )
        except Exception as error:
            raise FmuError(f"{path}: {why_not_loaded(error, folder)}") from error
        self._callbacks = fmi2.fmi2CallbackFunctions()
        self._callbacks.logger = fmi2.fmi2CallbackLoggerTYPE(self._log)
        try:
            self._fmu.instantiate(callbacks=self._callbacks, loggingOn=True)
        except Exception as error:
            raise FmuError(f"{path}: {self._why(error)}") from error

    def _log(
        self, _environment: object, _name: bytes, status: int, _category: bytes, message: bytes
    ) -> None:
        if status != fmi2.fmi2OK:
            self.messages.append(message.decode())

    def _why(self, error: Exception) -> str:
        return self.messages[-1] if self.messages else str(error)

    def _initialise(self, parameters: Mapping[str, Setting], start_time: float) -> None:
        try:
            self._fmu.setupExperiment(startTime=start_time)
            self._fmu.enterInitializationMode()
            for name, value in parameters.items():
                self._write(name, value)
            self._fmu.exitInitializationMode()
        except FMICallException as error:
            raise FmuError(self._why(error)) from error

    def _members(self, name: str) -> list[Scalar]:
        members = [s for s in scalars(self.n_legs, self.naming) if s.variable.name == name]
        if not members:
            known = ", ".join(v.name for v in TABLE if v.causality is Causality.parameter)
            raise FmuError(f"parameter '{name}' is not one of {known}")
        return members

    def _write(self, name: str, value: Setting) -> None:
        members = self._members(name)
        values = list(value) if isinstance(value, Sequence) else [value] * len(members)
        if len(values) != len(members):
            raise FmuError(f"{name} takes {len(members)} values, not {len(values)}")
        references = [m.value_reference for m in members]
        kind = members[0].variable.type
        if kind is Type.real:
            self._fmu.setReal(references, [float(v) for v in values])
        elif kind is Type.boolean:
            self._fmu.setBoolean(references, [bool(v) for v in values])
        else:
            self._fmu.setInteger(references, [int(v) for v in values])

    def _prepare(self) -> None:
        members = list(scalars(self.n_legs, self.naming))
        shown = [m for m in members if m.variable.causality in _SHOWN]
        inputs = [m for m in members if m.variable.causality is Causality.input]
        self._real_in = _block([m for m in inputs if m.variable.type is Type.real], True)
        self._reset_in = _block([m for m in inputs if m.variable.type is Type.boolean], False)
        self._reals = _block([m for m in shown if m.variable.type is Type.real], True)
        self._integers = _block([m for m in shown if m.variable.type is Type.integer], False)
        self._booleans = _block([m for m in shown if m.variable.type is Type.boolean], False)
        places = {v.name: (first, count) for v, first, count in self._reals.names}
        self.phi = self._reals.view[slice(*_span(places["phi"]))]
        self.theta_hip = self._reals.view[slice(*_span(places["theta_hip"]))]
        self.theta_knee = self._reals.view[slice(*_span(places["theta_knee"]))]

    def set(self, name: str, value: Setting) -> None:
        """Set a tunable parameter between two steps.

        Raises:
            FmuError: unknown, fixed or out of range.
        """
        try:
            self._write(name, value)
        except FMICallException as error:
            raise FmuError(self._why(error)) from error

    def step(self, t: float, h: float, grf: Array, MI: float, turn: float, reset: bool) -> None:
        """Set the inputs, step from ``t`` by ``h`` [s] and read all outputs.

        Args:
            t, h: start and length of the step [s].
            grf: loads [N], shape (n_legs,).
            MI, turn, reset: commands.

        ``theta_hip`` and ``theta_knee`` [rad], shape (n_legs,), show the result.

        Raises:
            FmuError: the FMU refused.
        """
        fmu, c = self._fmu, self._fmu.component
        begin = time.perf_counter()
        n = self.n_legs
        self._real_in.view[:n] = grf
        self._real_in.view[n] = MI
        self._real_in.view[n + 1] = turn
        self._reset_in.view[0] = reset
        try:
            block = self._real_in
            fmu.fmi2SetReal(c, block.references, len(block.view), block.buffer)
            block = self._reset_in
            fmu.fmi2SetBoolean(c, block.references, len(block.view), block.buffer)
            fmu.fmi2DoStep(c, t, h, fmi2.fmi2True)
            block = self._reals
            fmu.fmi2GetReal(c, block.references, len(block.view), block.buffer)
            block = self._integers
            fmu.fmi2GetInteger(c, block.references, len(block.view), block.buffer)
            block = self._booleans
            fmu.fmi2GetBoolean(c, block.references, len(block.view), block.buffer)
        except FMICallException as error:
            raise FmuError(self._why(error)) from error
        self.wall_s += time.perf_counter() - begin

    def _blocks(self) -> tuple[Block, ...]:
        return (self._real_in, self._reset_in, self._reals, self._integers, self._booleans)

    def trace(self) -> Trace:
        """A recorder of all inputs, outputs and local variables, a row per tick."""
        return Trace([block.view for block in self._blocks()], self._channels)

    def sample(self) -> dict[str, Array]:
        """All inputs, outputs and local variables now, by row name; shape () or (entries,)."""
        trace = self.trace()
        trace.take()
        return {name: values[0] for name, values in trace.channels().items()}

    def _channels(self, rows: Array) -> dict[str, Array]:
        channels, start = {}, 0
        for block in self._blocks():
            for v, first, count in block.names:
                values = rows[:, start + first : start + first + count].copy()
                channels[v.name] = values[:, 0] if v.shape is Shape.scalar else values
            start += len(block.view)
        return channels

    def close(self) -> None:
        """Free the instance and its files."""
        self._fmu.terminate()
        self._fmu.freeInstance()
        shutil.rmtree(self._folder, ignore_errors=True)

    def __enter__(self) -> FmuController:
        """Use in a with statement."""
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        """Free the instance and its files."""
        self.close()


def _span(place: tuple[int, int]) -> tuple[int, int]:
    first, count = place
    return first, first + count


def check_fmu(path: Path | str) -> Any:
    """Model description of an FMI 2.0 co-simulation FMU.

    Raises:
        FmuError: there is no such file, or it is no such FMU.
    """
    description = describe_fmu(path)
    if description.fmiVersion != "2.0":
        raise FmuError(
            f"{path}: FMI {description.fmiVersion}; a walk takes FMI 2.0 (apnc build --fmi 2)"
        )
    return description


def describe_fmu(path: Path | str) -> Any:
    """Model description of a co-simulation FMU of any version of the standard.

    Raises:
        FmuError: there is no such file, or it is no such FMU.
    """
    if not Path(path).is_file():
        raise FmuError(f"{path}: no such file")
    if not zipfile.is_zipfile(path):
        raise FmuError(f"{path}: not an FMU (not a zip archive)")
    try:
        description = fmpy.read_model_description(str(path))
    except Exception as error:
        first = str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__
        raise FmuError(f"{path}: not a valid FMU: {first}") from error
    if description.coSimulation is None:
        raise FmuError(f"{path}: not a co-simulation FMU")
    return description

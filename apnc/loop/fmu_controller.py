"""The controller FMU, driven by fmpy with arrays as inputs and outputs, one call per tick."""

from __future__ import annotations

import contextlib
import ctypes
import time
import zipfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Final

import fmpy
import numpy as np
from fmpy import fmi2
from fmpy.fmi1 import FMICallException

from apnc_core import settings
from apnc_core.in_python import in_python
from apnc_core.schema import Causality, Shape, Type, Value, Variable
from apnc_core.settings import SettingLike
from apnc_core.types import Array
from apnc_core.variables import TABLE, Scalar, scalars, variable_named
from apnc_plant.trace import Trace
from build_fmu.cache import temporary_folder
from build_fmu.platforms import BuildError, library_of, why_not_loaded

_BOOLEANS: Final = {"false": "0", "true": "1"}


class FmuError(ValueError):
    """An FMU that cannot be used, or that refused a call, in one line."""


class Block:
    """Variables of one FMI type that are read or written in one call.

    Attributes:
        call: the FMI function.
        arguments: what it takes after the component.
        view: the values, as numpy sees them.
        places: slice of the entries of each variable in ``view``.
    """

    def __init__(self, call: Any, members: Sequence[Scalar]) -> None:
        real, n = members[0].variable.type is Type.real, len(members)
        references = (ctypes.c_uint * n)(*[m.value_reference for m in members])
        buffer: Any = ((ctypes.c_double if real else ctypes.c_int) * n)()
        self.call, self.arguments = call, (references, n, buffer)
        self.view: Any = np.frombuffer(buffer, dtype=np.float64 if real else np.intc)
        self.places = {m.variable: slice(at - m.element, at + 1) for at, m in enumerate(members)}

    def by_name(self) -> dict[str, Array]:
        """The entries of each variable, by its name, in the memory of the block."""
        return {variable.name: self.view[place] for variable, place in self.places.items()}


def names_in(description: Any) -> tuple[int, str]:
    """Number of legs of a controller FMU and the naming of its variables.

    Raises:
        FmuError: it is another FMU.
    """
    names = {v.name for v in description.modelVariables}
    load = variable_named("grf")
    for naming in ("structured", "flat"):
        n_legs = 0
        while load.scalar_name(n_legs, naming) in names:
            n_legs += 1
        if n_legs >= 2 and {s.name for s in scalars(n_legs, naming)} <= names:
            return n_legs, naming
    raise FmuError(f"'{description.modelName}' is not an APNC controller: its variables differ")


def members_by_name(n_legs: int, naming: str) -> dict[str, list[Scalar]]:
    """The scalars of every row of the table."""
    members: dict[str, list[Scalar]] = {}
    for scalar in scalars(n_legs, naming):
        members.setdefault(scalar.variable.name, []).append(scalar)
    return members


def entries_of(
    name: str, value: SettingLike, members: Mapping[str, list[Scalar]]
) -> list[tuple[Scalar, Value]]:
    """The scalars of a parameter, each with its value.

    Args:
        name: name of a variable.
        value: of all of them, or one for each.
        members: the scalars of every row.

    Raises:
        FmuError: an unknown parameter, or a wrong number of values.
    """
    if name not in members:
        known = ", ".join(v.name for v in TABLE if v.causality is Causality.parameter)
        raise FmuError(f"parameter '{name}' is not one of {known}")
    own, given = members[name], in_python(value)
    values = list(given) if isinstance(given, Sequence) else [given] * len(own)
    if len(values) != len(own):
        raise FmuError(f"{name} takes {len(own)} values, not {len(values)}")
    return list(zip(own, values, strict=True))


def parameter_of(variable: Variable, entries: Sequence[float]) -> settings.Setting:
    """Value of a parameter from the numbers that its scalars have in an FMU.

    Raises:
        ValueError: a number that the parameter cannot have.
    """
    if variable.shape is not Shape.scalar:
        return settings.checked(variable.name, entries if any(entries) else ())
    if variable.type is Type.boolean:
        return bool(entries[0])
    value = entries[0] if variable.type is Type.real else int(entries[0])
    return settings.checked(variable.name, value)


def own_starts(path: Path | str) -> tuple[int, dict[str, settings.Setting]]:
    """Number of legs of a controller FMU, and its own start values.

    Returns:
        Parameters by name whose start value in the FMU is not the default of the table.

    Raises:
        FmuError: no FMU, not this controller, or a start value that a parameter cannot have.
    """
    description = check_fmu(path)
    n_legs, naming = names_in(description)
    texts = {v.name: v.start for v in description.modelVariables}
    found: dict[str, settings.Setting] = {}
    for members in members_by_name(n_legs, naming).values():
        variable = members[0].variable
        starts = [texts[member.name] for member in members]
        if variable.causality is not Causality.parameter or None in starts:
            continue
        try:
            numbers = [float(_BOOLEANS.get(start, start)) for start in starts]
            if set(numbers) != {variable.start}:
                found[variable.name] = parameter_of(variable, numbers)
        except ValueError as error:
            raise FmuError(f"{path}: {error}") from None
    return n_legs, found


def unpack(path: Path | str, folder: Path) -> None:
    """Unpack an FMU.

    Raises:
        FmuError: the file is damaged.
    """
    try:
        fmpy.extract(str(path), unzipdir=str(folder))
    except OSError:
        raise
    except Exception as error:  # of any kind, after what is damaged
        raise FmuError(f"{path}: damaged: {error}") from error


class FmuController(contextlib.ExitStack):
    """One instance of the controller FMU, initialised and ready to step.

    Args:
        path: the FMU file.
        parameters: values by name; sequences for rows with several entries.
        start_time: time of the first tick [s].

    Raises:
        FmuError: no FMU, not this controller, no binary for this machine, or a parameter that is
            unknown or out of range.
    """

    def __init__(
        self,
        path: Path | str,
        parameters: Mapping[str, SettingLike] | None = None,
        start_time: float = 0.0,
    ) -> None:
        super().__init__()
        self.messages: list[str] = []
        self.wall_s = 0.0
        description = check_fmu(path)
        self.n_legs, self.naming = names_in(description)
        with contextlib.ExitStack() as start:
            folder = temporary_folder()
            self._instantiate(path, description, start.enter_context(folder))
            self._initialise(parameters or {}, start_time)
            self.push(start.pop_all())
        self.callback(self._fmu.freeInstance)
        self.callback(self._fmu.terminate)
        self._prepare()

    def _instantiate(self, path: Path | str, description: Any, unzipped: str) -> None:
        folder = Path(unzipped)
        unpack(path, folder)
        try:
            library = library_of(folder)
        except BuildError as error:
            raise FmuError(f"{path}: {error}") from None
        try:
            with contextlib.chdir(Path.cwd()):  # FMPy goes elsewhere to load, and stays if it fails
                self._fmu = fmi2.FMU2Slave(
                    guid=description.guid,
                    unzipDirectory=unzipped,
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

    def _initialise(self, parameters: Mapping[str, SettingLike], start_time: float) -> None:
        try:
            self._fmu.setupExperiment(startTime=start_time)
            self._fmu.enterInitializationMode()
            for name, value in parameters.items():
                self._write(name, value)
            self._fmu.exitInitializationMode()
        except FMICallException as error:
            raise FmuError(self._why(error)) from error

    def _write(self, name: str, value: SettingLike) -> None:
        entries = entries_of(name, value, members_by_name(self.n_legs, self.naming))
        put, convert = {
            Type.real: (self._fmu.setReal, float),
            Type.boolean: (self._fmu.setBoolean, bool),
        }.get(entries[0][0].variable.type, (self._fmu.setInteger, int))
        put([m.value_reference for m, _ in entries], [convert(v) for _, v in entries])

    def parameters(self) -> dict[str, settings.Setting]:
        """The parameters as the FMU has them now, by name."""
        found: dict[str, settings.Setting] = {}
        for members in members_by_name(self.n_legs, self.naming).values():
            variable = members[0].variable
            if variable.causality is not Causality.parameter:
                continue
            get = {Type.real: self._fmu.getReal, Type.boolean: self._fmu.getBoolean}.get(
                variable.type, self._fmu.getInteger
            )
            found[variable.name] = parameter_of(variable, get([m.value_reference for m in members]))
        return found

    def _prepare(self) -> None:
        def block(call: str, kind: Type, *shown: Causality) -> Block:
            members = scalars(self.n_legs, self.naming)
            own = [m for m in members if m.variable.type is kind and m.variable.causality in shown]
            return Block(getattr(self._fmu, f"fmi2{call}"), own)

        outputs = (Causality.output, Causality.local)
        self._written = (
            block("SetReal", Type.real, Causality.input),
            block("SetBoolean", Type.boolean, Causality.input),
        )
        self._read = (
            block("GetReal", Type.real, *outputs),
            block("GetInteger", Type.integer, *outputs),
            block("GetBoolean", Type.boolean, *outputs),
        )
        self._inputs = {n: view for each in self._written for n, view in each.by_name().items()}
        shown = self._read[0].by_name()
        self.phi, self.theta_hip = shown["phi"], shown["theta_hip"]
        self.theta_knee = shown["theta_knee"]

    def set(self, name: str, value: SettingLike) -> None:
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
        component, begin = self._fmu.component, time.perf_counter()
        for name, value in (("grf", grf), ("MI", MI), ("turn", turn), ("reset", reset)):
            self._inputs[name][:] = value
        try:
            for block in self._written:
                block.call(component, *block.arguments)
            self._fmu.fmi2DoStep(component, t, h, fmi2.fmi2True)
            for block in self._read:
                block.call(component, *block.arguments)
        except FMICallException as error:
            raise FmuError(self._why(error)) from error
        self.wall_s += time.perf_counter() - begin

    def trace(self) -> Trace:
        """A recorder of all inputs, outputs and local variables, a row per tick."""
        return Trace([block.view for block in self._written + self._read], self._signals)

    def sample(self) -> dict[str, Array]:
        """All inputs, outputs and local variables now, by name; shape () or (entries,)."""
        trace = self.trace()
        trace.take()
        return {name: values[0] for name, values in trace.signals().items()}

    def _signals(self, rows: Array) -> dict[str, Array]:
        signals, start = {}, 0
        for block in self._written + self._read:
            own = rows[:, start : start + len(block.view)]
            for v, place in block.places.items():
                values = own[:, place].copy()
                signals[v.name] = values[:, 0] if v.shape is Shape.scalar else values
            start += len(block.view)
        return signals


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
    if Path(path).is_dir():
        raise FmuError(f"{path}: a folder, not an FMU")
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

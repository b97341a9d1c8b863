"""A thin FMU2Slave with access by name, for tests that need every call under control."""

from __future__ import annotations

import ctypes
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import fmpy
from fmpy import fmi2

from apnc_core.schema import Type
from apnc_core.variables import scalars

SCALARS = {s.name: s for s in scalars(4)}
TS = 1 / 60


class FMU2Probe(fmi2.FMU2Slave):
    """Adds access by scalar name and keeps what was logged as (status, category, message).

    fmpy wants the name of the class to begin with FMU2.
    """

    def __init__(self, path: Path) -> None:
        description = fmpy.read_model_description(str(path))
        self.folder = tempfile.mkdtemp(prefix="apnc-test-")
        fmpy.extract(str(path), unzipdir=self.folder)
        super().__init__(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier="Apnc",
            instanceName="test",
        )
        self.log: list[tuple[int, str, str]] = []
        self.own = fmi2.fmi2CallbackFunctions()
        self.own.logger = fmi2.fmi2CallbackLoggerTYPE(self._keep)

    def _keep(self, _env: object, _name: bytes, status: int, kind: bytes, text: bytes) -> None:
        self.log.append((status, kind.decode(), text.decode()))

    @property
    def messages(self) -> list[str]:
        return [text for status, _, text in self.log if status != fmi2.fmi2OK]

    def put(self, name: str, value: float) -> None:
        scalar = SCALARS[name]
        reference = [scalar.value_reference]
        if scalar.variable.type is Type.real:
            self.setReal(reference, [value])
        elif scalar.variable.type is Type.boolean:
            self.setBoolean(reference, [value])
        else:
            self.setInteger(reference, [int(value)])

    def get(self, name: str) -> float:
        scalar = SCALARS[name]
        reference = [scalar.value_reference]
        if scalar.variable.type is Type.real:
            return self.getReal(reference)[0]
        if scalar.variable.type is Type.boolean:
            return self.getBoolean(reference)[0]
        return self.getInteger(reference)[0]

    def loads(self, values: list[float]) -> None:
        self.setReal([SCALARS[f"leg[{i}].grf"].value_reference for i in range(1, 5)], values)

    def all_outputs(self) -> list[float]:
        return [
            self.get(name)
            for name, s in SCALARS.items()
            if s.variable.causality.value in ("output", "local")
        ]

    def start(self, start_time: float = 0.0, **parameters: float) -> None:
        self.setupExperiment(startTime=start_time)
        self.enterInitializationMode()
        for name, value in parameters.items():
            self.put(name, value)
        self.exitInitializationMode()

    def step(self, t: float, h: float = TS) -> int:
        return int(self.fmi2DoStep(self.component, t, h, fmi2.fmi2True))


@contextmanager
def slave(path: Path, logging: bool = True) -> Iterator[FMU2Probe]:
    """A slave, instantiated; freed with its files afterwards."""
    fmu = FMU2Probe(path)
    try:
        fmu.instantiate(callbacks=fmu.own, loggingOn=logging)
        yield fmu
        fmu.freeInstance()
    finally:
        shutil.rmtree(fmu.folder, ignore_errors=True)


def double_array(values: list[float]) -> ctypes.Array[ctypes.c_double]:
    return (ctypes.c_double * len(values))(*values)

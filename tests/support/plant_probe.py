"""The plant FMU under control of a test, by name, with everything it logs."""

from __future__ import annotations

import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path

from fmpy import fmi2
from named_fmu import FMU2Named

TS = 1 / 60
LEGS = range(1, 5)
LOADS = [f"leg[{i}].grf" for i in LEGS]
COMMANDS = [f"leg[{i}].{x}" for x in ("theta_hip", "theta_knee") for i in LEGS]
POSITION = [f"position.{x}" for x in "xyz"]


class FMU2Plant(FMU2Named):
    """A plant that keeps its time and what it logs."""

    def __init__(self, path: Path) -> None:
        super().__init__(path)
        self.messages: list[str] = []
        self.own = fmi2.fmi2CallbackFunctions()
        self.own.logger = fmi2.fmi2CallbackLoggerTYPE(
            lambda _env, _name, _status, _kind, text: self.messages.append(text.decode())
        )
        self.time = 0.0

    def start(self, **parameters: float | str) -> None:
        self.time = 0.0
        self.setupExperiment(startTime=0.0)
        self.enterInitializationMode()
        for name, value in parameters.items():
            self.put(name, value)
        self.exitInitializationMode()

    def put(self, name: str, value: float | str) -> None:
        put = {int: self.setInteger, float: self.setReal, str: self.setString}[type(value)]
        put([self.reference[name]], [value])

    def command(self, angles: Sequence[float]) -> None:
        self.setReal([self.reference[name] for name in COMMANDS], list(angles))

    def step(self, h: float = TS) -> None:
        self.doStep(self.time, h)
        self.time += h

    @property
    def fell(self) -> bool:
        return bool(self.getBoolean([self.reference["fell"]])[0])


@contextmanager
def plant(path: Path) -> Iterator[FMU2Plant]:
    """An instance, freed with its files afterwards."""
    fmu = FMU2Plant(path)
    try:
        fmu.instantiate(callbacks=fmu.own, loggingOn=True)
        yield fmu
        fmu.terminate()
        fmu.freeInstance()
    finally:
        shutil.rmtree(fmu.folder, ignore_errors=True)

"""Tools that run a system of controller and plant, each in a process of its own.

``python system_hosts.py HOST FOLDER SECONDS OUT``: FOLDER is what ``apnc build-system`` unpacked,
beside its archive; OUT becomes an npz file.
"""

# ruff: noqa: PLC0415  # one tool at a time is there

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any, Final

import numpy as np

from apnc_core.types import Array

TICK: Final = 1.0 / 60.0
SYSTEM: Final = "Lilibot"
NANOSECONDS: Final = 16_666_666
STRUCTURED: Final = {
    "controller": [f"leg[{i}].{x}" for x in ("o1", "o2") for i in range(1, 5)],
    "plant": [f"leg[{i}].grf" for i in range(1, 5)] + [f"position.{x}" for x in "xyz"],
}
"""What is read every tick."""


def names(folder: Path) -> dict[str, list[str]]:
    """The names as this system has them, structured or flat."""
    if "leg[1].grf" in (folder / "SystemStructure.ssd").read_text():
        return STRUCTURED
    return {
        part: [n.replace("[", "").replace("].", "_").replace(".", "_") for n in each]
        for part, each in STRUCTURED.items()
    }


def parameters_of(folder: Path) -> Any:
    """Both parameter sets as one, by names ``controller.MI``, ``plant.seed``."""
    from fmpy.ssp.ssd import ParameterSet, read_ssv

    both = ParameterSet(name="system", parameters=[])
    for part in STRUCTURED:
        for parameter in read_ssv(str(folder / f"resources/{part}.ssv")).parameters:
            parameter.name = f"{part}.{parameter.name}"
            both.parameters.append(parameter)
    return both


def fmpy_ssp(folder: Path, seconds: float) -> tuple[Array, float]:
    from fmpy.ssp.simulation import simulate_ssp

    archive, parameters = f"{folder}.ssp", parameters_of(folder)
    begin = time.perf_counter()
    stop = seconds - TICK / 2
    result = simulate_ssp(archive, stop_time=stop, step_size=TICK, parameter_set=parameters)
    wall = time.perf_counter() - begin
    paths = {name.split(".", 1)[1]: name for name in result.dtype.names[1:]}
    return np.array([result[paths[n]] for each in names(folder).values() for n in each]).T, wall


def cosim(kind: str, folder: Path, seconds: float) -> tuple[Array, float]:
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from libcosimpy.CosimObserver import CosimObserver

    log_output_level(CosimLogLevel.WARNING)
    if kind == "osp":
        execution = CosimExecution.from_osp_config_file(str(folder))
    else:
        execution = CosimExecution.from_ssp_file(str(folder), step_size=NANOSECONDS)
    observer = CosimObserver.create_last_value()
    execution.add_observer(observer)
    wanted = []
    for part, each in names(folder).items():
        index = execution.slave_index_from_instance_name(part)
        known = {v.name.decode(): v.reference for v in execution.slave_variables(index)}
        wanted.append((index, [known[name] for name in each]))

    def read() -> list[float]:
        return [x for index, each in wanted for x in observer.last_real_values(index, each)]

    def step() -> None:
        if not execution.step():
            raise RuntimeError("libcosim: a step failed")

    return _loop(step, read, seconds)


def ecos(folder: Path, seconds: float) -> tuple[Array, float]:
    from ecospy import EcosSimulation

    sim = EcosSimulation(step_size=TICK, ssp_path=f"{folder}.ssp")
    sim.init(parameter_set=SYSTEM)
    wanted = [f"{part}::{name}" for part, each in names(folder).items() for name in each]
    return _loop(lambda: sim.step(), lambda: [sim.get_real(name) for name in wanted], seconds)


def omsimulator(folder: Path, seconds: float) -> tuple[Array, float]:
    from OMSimulator import SSP, CRef, Settings

    Settings.suppressPath = True
    model = SSP(f"{folder}.ssp").instantiate()
    model.setFixedStepSize(TICK)
    model.setStopTime(seconds)
    model.initialize()
    wanted = [CRef(SYSTEM, part, name) for part, each in names(folder).items() for name in each]
    return _loop(model.doStep, lambda: [model.getValue(name) for name in wanted], seconds)


def container(made: Callable[[Path], Path], folder: Path, seconds: float) -> tuple[Array, float]:
    import fmpy
    from fmpy import fmi2

    path = str(made(folder))
    description = fmpy.read_model_description(path)
    reference = {v.name: v.valueReference for v in description.modelVariables}
    fmu = fmi2.FMU2Slave(
        guid=description.guid,
        unzipDirectory=fmpy.extract(path),
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="system",
    )
    fmu.instantiate()
    fmu.setupExperiment(startTime=0.0)
    fmu.enterInitializationMode()
    fmu.exitInitializationMode()
    wanted = [reference[name] for each in names(folder).values() for name in each]
    ticks = iter(range(round(seconds / TICK)))
    return _loop(lambda: fmu.doStep(next(ticks) * TICK, TICK), lambda: fmu.getReal(wanted), seconds)


def described_container(folder: Path) -> Path:
    """The container of the system's own description."""
    from fmu_manipulation_toolbox.assembly import Assembly

    Assembly("container.json", fmu_directory=folder).make_fmu()
    (made,) = folder.glob("*System.fmu")
    return made


def ssp_container(folder: Path) -> Path:
    """The container of the SSP, with the start values that the tool leaves out."""
    from fmu_manipulation_toolbox.assembly import Assembly

    directory, archive = folder.parent, f"{folder.name}.ssp"
    assembly = Assembly(archive, default_step_size=TICK, fmu_directory=directory)
    fmus = dict(zip(("controller", "plant"), assembly.root.fmu_names_list, strict=True))
    for part, each in names(folder).items():
        for name in each:
            assembly.root.add_output(fmus[part], name, name)
    for parameter in parameters_of(folder).parameters:
        part, name = parameter.name.split(".", 1)
        assembly.root.add_start_value(fmus[part], name, parameter.value)
    assembly.make_fmu(filename=f"{folder.name}-container.fmu")
    return directory / f"{folder.name}-container.fmu"


def _loop(
    step: Callable[[], object], read: Callable[[], list[float]], seconds: float
) -> tuple[Array, float]:
    begin = time.perf_counter()
    rows = []
    for _ in range(round(seconds / TICK)):
        step()
        rows.append(read())
    return np.array(rows), time.perf_counter() - begin


HOSTS: Final[dict[str, Callable[[Path, float], tuple[Array, float]]]] = {
    "fmpy.ssp": fmpy_ssp,
    "libcosim-osp": lambda folder, seconds: cosim("osp", folder, seconds),
    "libcosim-ssp": lambda folder, seconds: cosim("ssp", folder, seconds),
    "ecos": ecos,
    "omsimulator": omsimulator,
    "container": partial(container, described_container),
    "container-ssp": partial(container, ssp_container),
}


def main(words: list[str]) -> None:
    host, folder, seconds, out = words
    rows, wall = HOSTS[host](Path(folder), float(seconds))
    columns = np.cumsum([4, 4, 4])
    o1, o2, grf, position = np.split(rows, columns, axis=1)
    np.savez(out, o1=o1, o2=o2, grf=grf, position=position, wall=wall)


if __name__ == "__main__":
    main(sys.argv[1:])

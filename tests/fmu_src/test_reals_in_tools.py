"""Tools that read every variable as a Real walk the robot with FMUs of `--reals`.

gemseo-fmu 3.1.1 and cofmupy 1.0.0 take minutes to install and want an FMPy of their own (0.3.19 and
0.3.20), so they are not in the extra `test`. Once installed they are tested as well.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import NamedTuple

import fmpy
import numpy as np
import pytest

from apnc.system.plant_fmu import PlantBuild, plant_fmu
from apnc_core.elementary import wrap
from build_fmu.build import cached_fmu
from build_fmu.options import BuildOptions, host_platform

TICKS, TS, MI = 1200, 1 / 60, 0.2
LOADS = [f"leg[{i}].grf" for i in range(1, 5)]
COMMANDS = [f"leg[{i}].theta_{joint}" for i in range(1, 5) for joint in ("hip", "knee")]
PHI = [f"phi[{k}]" for k in (1, 2, 3)]
TROT = (np.pi, np.pi, 0.0)


class Fmus(NamedTuple):
    controller: Path
    plant: Path


@pytest.fixture(scope="module")
def fmus() -> Fmus:
    here = (host_platform(),)
    return Fmus(
        cached_fmu(BuildOptions(platforms=here, reals=True)),
        plant_fmu(PlantBuild(platforms=here, reals=True)),
    )


def assert_trot(x: float, ticks: float, phi: list[float]) -> None:
    assert ticks in (TICKS, TICKS + 1)
    assert x > 1.5  # m; at MI 0.15 it would come 1.46 m far, at the default 1.2 m
    assert np.abs(wrap(np.array(phi) - TROT)).max() < 0.3


def missing(package: str) -> str:
    return f"{package} is not installed: pip install {package}"


def test_pathsim(fmus: Fmus) -> None:
    block = pytest.importorskip("pathsim_fmi.blocks", reason=missing("pathsim-fmi"))
    pathsim = pytest.importorskip("pathsim")
    # without dt it takes the step of the default experiment for a text and stops
    controller = block.CoSimulationFMU(str(fmus.controller), "controller", dt=TS)
    plant = block.CoSimulationFMU(str(fmus.plant), "plant", dt=TS)
    # an input without a source is 0, and MI = 0 would hold the controller
    mi = pytest.importorskip("pathsim.blocks").Constant(MI)
    links = [pathsim.Connection(mi, controller["MI"])]
    links += [pathsim.Connection(plant[load], controller[load]) for load in LOADS]
    links += [pathsim.Connection(controller[name], plant[name]) for name in COMMANDS]
    simulation = pathsim.Simulation([controller, plant, mi], links, dt=TS, log=False)
    simulation.run(TICKS * TS)
    out = controller.outputs
    assert_trot(plant.outputs["position.x"], out["tick"], [out[name] for name in PHI])


def test_gemseo_fmu(fmus: Fmus) -> None:
    module = pytest.importorskip(
        "gemseo_fmu.disciplines.do_step_fmu_discipline", reason=missing("gemseo-fmu")
    )
    run = {"initial_time": 0.0, "final_time": TICKS * TS, "time_step": TS}
    controller = module.DoStepFMUDiscipline(
        fmus.controller, [*LOADS, "MI"], [*COMMANDS, *PHI, "tick"], **run
    )
    plant = module.DoStepFMUDiscipline(fmus.plant, COMMANDS, [*LOADS, "position.x"], **run)
    loads = {name: np.array([6.0]) for name in LOADS}
    for _ in range(TICKS):
        said = controller.execute({**loads, "MI": np.array([MI])})
        done = plant.execute({name: np.atleast_1d(said[name]) for name in COMMANDS})
        loads = {name: np.atleast_1d(done[name]) for name in LOADS}
    phi = [float(said[name][0]) for name in PHI]
    assert_trot(float(done["position.x"][0]), float(said["tick"][0]), phi)


def test_cofmupy(fmus: Fmus, tmp_path: Path) -> None:
    experiment = fmpy.read_model_description(str(fmus.controller)).defaultExperiment
    if isinstance(experiment.stepSize, str):
        pytest.skip(f"FMPy {fmpy.__version__} gives the step as text, which cofmupy cannot read")
    coordinator_of = pytest.importorskip("cofmupy", reason=missing("cofmupy")).Coordinator

    def end(name: str, variable: str) -> dict[str, str]:
        return {"id": name, "variable": variable, "unit": "", "type": "fmu"}

    pairs = [(end("plant", name), end("controller", name)) for name in LOADS]
    pairs += [(end("controller", name), end("plant", name)) for name in COMMANDS]
    mi = {"type": "literal", "values": {"0": MI}}
    fmu = {"initialization": {}}
    config = {
        "root": "/",
        "cosim_method": "jacobi",
        "iterative": False,
        "edge_sep": " -> ",
        "fmus": [
            {"id": name, "name": name, "path": str(path), **fmu}
            for name, path in fmus._asdict().items()
        ],
        "connections": [
            *({"source": source, "target": target} for source, target in pairs),
            {"source": mi, "target": end("controller", "MI")},
        ],
        "data_storages": [],
    }
    (tmp_path / "loop.json").write_text(json.dumps(config))
    coordinator = coordinator_of()
    coordinator.start(str(tmp_path / "loop.json"))
    for _ in range(TICKS):
        coordinator.do_step(TS)
    found = coordinator.get_results()
    phi = [float(found["controller", name][-1]) for name in PHI]
    assert_trot(found["plant", "position.x"][-1], found["controller", "tick"][-1], phi)

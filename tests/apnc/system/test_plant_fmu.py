"""The plant FMU: its interface, its motion, its mistakes."""

from __future__ import annotations

import math
import re
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from plant_probe import LOADS, POSITION, TS, plant
from stiff import stiff_robot

pytest.importorskip("pythonfmu", reason="pythonfmu is missing (extra `system`)")

from apnc import Experiment, simulate
from apnc.loop.fmu_controller import FmuController
from apnc.system.plant_fmu import plant_fmu, plant_model
from apnc_core.schema import Causality
from apnc_core.variables import scalars
from build_fmu.package import zip_fmu

# legs that swing one after the other, so that the robot moves
WAVE = [0.1, -0.1, 0.2, -0.2, 0.0, 0.1, 0.0, 0.1]


@pytest.fixture(scope="module")
def path(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("plant") / "LilibotPlant.fmu"
    file.write_bytes(plant_fmu())
    return file


@pytest.mark.parametrize("naming", ["structured", "flat"])
@pytest.mark.parametrize("robot", ["lilibot", "hexapod"])
def test_its_names_and_units_are_those_of_the_controller(
    robot: str, naming: str, tmp_path: Path
) -> None:
    file = tmp_path / "Plant.fmu"
    file.write_bytes(plant_fmu(robot, naming))
    assert validate_fmu(str(file)) == []
    description = fmpy.read_model_description(str(file))
    assert description.modelName == plant_model(robot)
    shown = {v.name: v for v in description.modelVariables}
    legs = {"lilibot": 4, "hexapod": 6}[robot]
    for s in scalars(legs, naming):
        if s.variable.name == "grf":
            assert shown[s.name].causality == "output"
            assert shown[s.name].unit == s.variable.unit
        if s.variable.name in ("theta_hip", "theta_knee"):
            assert shown[s.name].causality == Causality.input
            assert shown[s.name].unit == s.variable.unit
            assert float(shown[s.name].start) == 0.0
    assert {"seed", "roughness", "slope", "payload", "condition", "fell"} <= set(shown)
    assert all(v.unit and v.description for v in shown.values() if v.type == "Real")
    if naming == "flat":
        assert all(re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) for name in shown)


def test_the_same_build_is_the_same_file(path: Path) -> None:
    assert plant_fmu() == path.read_bytes()


def test_a_plain_loop_is_the_direct_loop_bit_for_bit(path: Path, fmu4: Path) -> None:
    experiment = Experiment(mi=0.15, seed=3, duration=2.0)
    record = simulate(experiment)
    parameters = {k: v for k, v in experiment.parameters().items() if v != ()}
    places, loads = [], []
    with plant(path) as robot, FmuController(fmu4, parameters) as controller:
        robot.start(seed=3)
        for n in range(len(record)):
            places.append(robot.get(POSITION))
            loads.append(robot.get(LOADS))
            controller.step(n * TS, TS, np.array(loads[-1]), 0.15, 0.0, False)
            robot.command([*controller.theta_hip, *controller.theta_knee])
            robot.step()
    np.testing.assert_array_equal(places, record.plant["position"])
    np.testing.assert_array_equal(loads, record.plant["grf"])


def place_after(path: Path, steps: list[float], seed: int = 0, **parameters: float) -> list[float]:
    with plant(path) as robot:
        robot.start(seed=seed, **parameters)
        robot.command(WAVE)
        for h in steps:
            robot.step(h)
        return robot.get(POSITION)


def test_it_integrates_the_step_it_is_given(path: Path) -> None:
    ticks = place_after(path, [TS] * 30)
    assert place_after(path, [2 * TS] * 15) == ticks
    assert place_after(path, [TS] * 30 + [1.1e-15]) == ticks
    # other steps are cut into other parts, which the integration resolves to less than a millimetre
    np.testing.assert_allclose(place_after(path, [0.001] * 500), ticks, atol=1e-3)
    assert place_after(path, [TS] * 31) != ticks


def test_parameters_act(path: Path) -> None:
    plain = place_after(path, [TS] * 30)
    assert place_after(path, [TS] * 30, seed=1) != plain
    assert place_after(path, [TS] * 30, payload=1.0)[2] < plain[2]
    assert place_after(path, [TS] * 30, slope=0.1) != plain
    # with this seed feet stand on obstacles
    level, rough = (place_after(path, [TS] * 30, seed=7, roughness=r)[2] for r in (0.0, 1.0))
    assert rough > level + 1e-3


def test_a_condition_may_come_while_it_walks(path: Path) -> None:
    with plant(path) as robot:
        robot.start()
        for _ in range(30):
            robot.step()
        assert all(load > 1.0 for load in robot.get(LOADS))
        robot.put("condition", "S3")
        robot.step()
        assert robot.get(LOADS) == [0.0] * 4


def test_two_instances_do_not_share_a_thing(path: Path) -> None:
    alone = [place_after(path, [TS] * 20, seed=s) for s in (1, 2)]
    with plant(path) as one, plant(path) as other:
        for robot, seed in ((one, 1), (other, 2)):
            robot.start(seed=seed)
            robot.command(WAVE)
        for _ in range(20):
            one.step()
            other.step()
        assert [one.get(POSITION), other.get(POSITION)] == alone


def test_reset_starts_it_again(path: Path) -> None:
    with plant(path) as robot:
        robot.start(seed=5, payload=0.5)
        robot.command(WAVE)
        for _ in range(10):
            robot.step()
        robot.reset()
        robot.start()
        robot.command(WAVE)
        for _ in range(10):
            robot.step()
        assert robot.get(POSITION) == place_after(path, [TS] * 10)


def test_it_falls_and_says_so(path: Path) -> None:
    with plant(path) as robot:
        robot.start(slope=math.radians(60.0))
        assert not robot.fell
        for _ in range(240):
            robot.step()
        assert robot.fell
        lies = robot.get(POSITION)
        robot.step()
        assert robot.get(POSITION) == lies


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("condition", "C9", "'C9' are not one of C1"),
        ("payload", -1.0, "payload = -1.0 is not in 0 ... 100"),
        ("slope", math.nan, "slope = nan is not in"),
        ("seed", -1, "seed = -1 is not in 0"),
    ],
)
def test_a_wrong_parameter_is_a_message(
    name: str, value: float | str, words: str, path: Path
) -> None:
    with plant(path) as robot:
        with pytest.raises(FMICallException):
            robot.start(**{name: value})
        assert words in robot.messages[-1]


def test_a_fixed_parameter_is_fixed(path: Path) -> None:
    with plant(path) as robot:
        robot.start()
        with pytest.raises(FMICallException):
            robot.put("payload", 1.0)
        assert "payload is fixed" in robot.messages[-1]


def test_wrong_steps_are_messages_and_it_goes_on(path: Path) -> None:
    with plant(path) as robot:
        robot.start()
        robot.put("leg[2].theta_knee", math.nan)
        for _ in range(4):
            with pytest.raises(FMICallException, match="discard"):
                robot.step()
            assert robot.messages[-1] == "leg[2].theta_knee = nan; allowed: a finite angle"
        robot.put("leg[2].theta_knee", 0.0)
        robot.step()
        robot.time = 7.0
        with pytest.raises(FMICallException, match="discard"):
            robot.step()
        assert "step starts at 7.0 s, but the one before ended at" in robot.messages[-1]


def test_a_motion_that_diverges_is_a_message(tmp_path: Path) -> None:
    (tmp_path / "stiff.toml").write_text(stiff_robot())
    file = tmp_path / "Stiff.fmu"
    file.write_bytes(plant_fmu(str(tmp_path / "stiff.toml")))
    with plant(file) as robot:
        robot.start()
        with pytest.raises(FMICallException, match="discard"):
            for _ in range(60):
                robot.step()
        assert "the motion diverged before t =" in robot.messages[-1]


LOADED = "import sys; sys.path.insert(0, {support!r}); {before}; from plant_probe import FMU2Plant"
INSTANTIATED = """
from pathlib import Path
robot = FMU2Plant(Path({path!r}))
try:
    robot.instantiate(callbacks=robot.own, loggingOn=True)
except Exception:
    print(*robot.messages)
"""


def messages_of(path: Path, before: str = "pass") -> str:
    support = str(Path(__file__).resolve().parents[2] / "support")
    script = LOADED.format(support=support, before=before) + INSTANTIATED.format(path=str(path))
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=False
    )
    return done.stdout


def test_without_the_package_it_names_the_python_that_misses_it(path: Path) -> None:
    said = messages_of(path, "sys.modules['apnc'] = None")
    assert "LilibotPlant.fmu needs the package apnc" in said
    assert sys.executable in said


def test_another_version_of_the_package_is_refused(path: Path, tmp_path: Path) -> None:
    with zipfile.ZipFile(path) as archive:
        files = {name: archive.read(name) for name in archive.namelist()}
    (script,) = (name for name in files if re.fullmatch(r"resources/plant_\w+\.py", name))
    files[script] = re.sub(rb'BUILT_BY = ".*"', b'BUILT_BY = "0.0.1"', files[script])
    old = tmp_path / "Old.fmu"
    old.write_bytes(zip_fmu(files))
    assert "was built with apnc 0.0.1" in messages_of(old)

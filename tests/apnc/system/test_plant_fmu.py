"""The plant FMU: its interface, its motion, its mistakes."""

from __future__ import annotations

import math
import re
import shutil
import zipfile
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from pathlib import Path
from typing import Any

import fmpy
import numpy as np
import pytest
from fmpy import fmi3
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from full_robot import FULL, full_robot
from lxml import etree, html
from plant_probe import LOADS, POSITION, TS, FMU2Plant, plant
from stiff_robot import stiff_robot

from apnc import Experiment, simulate
from apnc.loop.fmu_controller import FmuController
from apnc.system.plant_fmu import PlantBuild, plant_fmu, plant_model
from apnc_core.schema import Causality, Type
from apnc_core.variables import scalars
from apnc_plant import generate
from apnc_plant.compiled import CompiledPlant
from apnc_plant.conditions import named_conditions
from apnc_plant.fmu_config import robot_config
from apnc_plant.ground import Obstacles, Plane
from apnc_plant.options import PlantOptions
from apnc_plant.robot import ROBOTS, RobotDescription, load_robot
from apnc_plant.signals import PLANT_SIGNALS
from apnc_plant.step import longest_step, own_step
from apnc_plant.variables import COMMANDS, TABLE, Condition
from build_fmu.platforms import host_platform

HOST = (host_platform(),)
FULL_BUILD = PlantBuild(str(FULL), platforms=HOST)
# legs that swing one after the other, so that the robot moves
WAVE = [0.1, -0.1, 0.2, -0.2, 0.0, 0.1, 0.0, 0.1]


@pytest.fixture(scope="module")
def path() -> Path:
    return plant_fmu(PlantBuild(platforms=HOST))


def description_of(file: Path) -> etree._Element:
    with zipfile.ZipFile(file) as archive:
        return etree.fromstring(archive.read("modelDescription.xml"))


def test_generated_files_are_those_of_the_table() -> None:
    assert generate.outdated(Path(__file__).resolve().parents[3]) == []


@pytest.mark.parametrize("naming", ["structured", "flat"])
@pytest.mark.parametrize("robot", ["lilibot", "hexapod", "octopod"])
def test_its_names_and_units_are_those_of_the_controller(robot: str, naming: str) -> None:
    file = plant_fmu(PlantBuild(robot, naming, platforms=()))
    assert validate_fmu(str(file)) == []
    description = fmpy.read_model_description(str(file))
    assert description.modelName == plant_model(robot)
    shown = {v.name: v for v in description.modelVariables}
    legs = len(load_robot(robot).legs)
    for s in scalars(legs, naming):
        if s.variable.name == "grf":
            assert shown[s.name].causality == "output"
            assert shown[s.name].unit == s.variable.unit
        if s.variable.name in COMMANDS:
            assert shown[s.name].causality == Causality.input
            assert shown[s.name].unit == s.variable.unit
            assert float(shown[s.name].start) == 0.0
    assert {"seed", "roughness", "slope", "payload", "condition", "fell"} <= set(shown)
    assert all(v.unit and v.description for v in shown.values() if v.type == "Real")
    if naming == "flat":
        assert all(re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) for name in shown)


def test_every_signal_of_the_plant_in_a_record_is_an_output() -> None:
    outputs = [v.name for v in TABLE if v.causality is Causality.output]
    columns = [column for signal in PLANT_SIGNALS for column in replace(
        signal, per_leg=False).columns(())]  # fmt: skip
    assert outputs == [*columns, "fell"]


@pytest.mark.parametrize("fmi", [2, 3])
def test_it_follows_the_schema_of_the_standard(fmi: int) -> None:
    file = plant_fmu(PlantBuild(fmi=fmi, platforms=()))
    assert validate_fmu(str(file)) == []
    schemas = Path(fmpy.__file__).parent / "schema" / f"fmi{fmi}"
    schema = etree.XMLSchema(etree.parse(str(schemas / f"fmi{fmi}ModelDescription.xsd")))
    schema.assertValid(description_of(file))


def test_start_values_are_those_of_the_robot_file() -> None:
    robot = load_robot("octopod")
    found = {
        v.name: v.start
        for v in fmpy.read_model_description(
            str(plant_fmu(PlantBuild("octopod", platforms=())))
        ).modelVariables
    }
    for part in ("servo", "contact", "sensor"):
        for name, value in vars(getattr(robot, part)).items():
            if f"{part}.{name}" not in found:  # of the joints themselves
                continue
            shown = found[f"{part}.{name}"]
            assert shown == "1" if name == "component" else float(shown) == value


def test_a_number_that_an_fmu_does_not_take_is_named(tmp_path: Path) -> None:
    file = tmp_path / "stiff.toml"
    file.write_text(stiff_robot())
    with pytest.raises(ValueError, match=r"contact\.stiffness is 1e\+300 in robot 'lilibot'"):
        PlantBuild(str(file))


def test_enumerations_can_be_integers() -> None:
    file = plant_fmu(PlantBuild(platforms=(), enumerations="integer"))
    condition = description_of(file).find(".//ScalarVariable[@name='condition']")
    assert condition.find("Integer").attrib == {"min": "1", "max": "7", "start": "1"}
    assert condition.get("description").endswith("1 C1, 2 C2, 3 C3, 4 C4, 5 S1, 6 S2, 7 S3")


def test_its_page_names_every_variable(path: Path) -> None:
    with zipfile.ZipFile(path) as archive:
        page = html.fromstring(archive.read("documentation/index.html"))
        names = set(archive.namelist())
    shown = {code.text for code in page.iter("code")}
    for v in TABLE:
        several = f"leg[1].{v.name} ... leg[4].{v.name}"
        assert (v.name if v.count(4) == 1 else several) in shown
    assert {"model.png", "documentation/licenses/license.txt"} <= names
    assert page.find(".//h1").text == "LilibotPlant"


@pytest.mark.thorough
def test_the_same_build_is_the_same_file(
    path: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = path.read_bytes()
    monkeypatch.setenv("APNC_CACHE", str(tmp_path))
    again = plant_fmu(PlantBuild(platforms=HOST))
    assert again.is_relative_to(tmp_path) and again.read_bytes() == first


def test_a_plain_loop_is_the_direct_loop_bit_for_bit(path: Path, fmu4: Path) -> None:
    experiment = Experiment(mi=0.15, seed=3, duration=5.0, engine="compiled")
    record = simulate(experiment)
    places, loads = [], []
    with plant(path) as robot, FmuController(fmu4, experiment.starts()) as controller:
        robot.start(seed=3)
        for n in range(len(record)):
            places.append(robot.get(POSITION))
            loads.append(robot.get(LOADS))
            controller.step(n * TS, TS, np.array(loads[-1]), 0.15, 0.0, False)
            robot.command([*controller.theta_hip, *controller.theta_knee])
            robot.step()
    np.testing.assert_array_equal(places, record.signals["position"])
    np.testing.assert_array_equal(loads, record.signals["grf"])


STATES = [
    ({"seed": 5, "roughness": 0.7, "slope": 0.05}, "C1"),
    ({"seed": 2**31 - 1, "roughness": 1.0, "slope": -0.1, "payload": 0.37}, "C4"),
    ({"seed": 1}, "C2"),
    ({"seed": 2}, "C3"),
    ({"seed": 3, "slope": 0.1}, "S1"),
    ({"seed": 4, "roughness": 0.4}, "S2"),
    ({"seed": 6, "payload": 1.1}, "S3"),
]


@pytest.mark.parametrize(("chosen", "condition"), STATES, ids=[name for _, name in STATES])
def test_every_output_is_that_of_the_plant_stepped_directly(
    path: Path, chosen: dict[str, float], condition: str
) -> None:
    walk_beside(path, load_robot("lilibot"), chosen, condition)


def test_a_robot_with_every_key_is_that_of_the_plant_stepped_directly() -> None:
    path = plant_fmu(FULL_BUILD)
    for chosen, condition in STATES[:2]:
        walk_beside(path, full_robot(), chosen, condition)


def walk_beside(
    path: Path, description: RobotDescription, chosen: dict[str, float], condition: str
) -> None:
    conditions = named_conditions(condition, description)
    payload = conditions.payload + chosen.get("payload", 0.0)
    slope, seed = chosen.get("slope", 0.0), int(chosen["seed"])
    rough = chosen.get("roughness", 0.0)
    direct = CompiledPlant(
        description,
        seed,
        ground=Obstacles(slope=slope, roughness=rough, seed=seed) if rough else Plane(slope=slope),
        conditions=replace(conditions, payload=payload),
    )
    names = [c for signal in PLANT_SIGNALS for c in signal.columns(
        tuple(f"leg[{i}]" for i in range(1, 5)))]  # fmt: skip
    commands = np.random.default_rng(seed).uniform(-0.2, 0.2, (60, 2, 4))
    with plant(path) as robot:
        robot.start(**chosen, condition=Condition[condition].value)
        for hip, knee in commands:
            expected = direct.sample()
            values = np.concatenate([expected[c.name].ravel() for c in PLANT_SIGNALS])
            np.testing.assert_array_equal(robot.get(names), values)
            robot.command([*hip, *knee])
            robot.step()
            direct.advance(hip, knee, TS)


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
    # a tick that was rounded up is still one
    direct = CompiledPlant(load_robot("lilibot"))
    for _ in range(30):
        direct.advance(np.array(WAVE[:4]), np.array(WAVE[4:]), 0.016666667)
    assert place_after(path, [0.016666667] * 30) == list(direct.sample()["position"])
    # other steps are cut into other parts, which the integration resolves to less than a millimetre
    np.testing.assert_allclose(place_after(path, [0.001] * 500), ticks, atol=1e-3)
    assert place_after(path, [TS] * 31) != ticks


def test_parameters_act(path: Path) -> None:
    plain = place_after(path, [TS] * 30)
    assert place_after(path, [TS] * 30, seed=1) != plain
    assert place_after(path, [TS] * 30, payload=1.0)[2] < plain[2]
    assert place_after(path, [TS] * 30, slope=0.1) != plain
    assert place_after(path, [TS] * 30, step=1 / 1920) != plain
    # with this seed feet stand on obstacles
    level, rough = (place_after(path, [TS] * 30, seed=3, roughness=r)[2] for r in (0.0, 1.0))
    assert rough > level + 1e-3


ROBOTS_OWN = [v for v in TABLE if v.name.split(".")[0] in ("servo", "contact", "sensor")]


@pytest.mark.parametrize("v", ROBOTS_OWN, ids=lambda v: v.name)
def test_a_number_of_the_robot_acts_as_in_its_file(path: Path, v: Any) -> None:
    part, name = v.name.split(".")
    robot = load_robot("lilibot")
    old = getattr(getattr(robot, part), name)
    new: Any = {"component": "norm", "latency": 0.011, "slew_rate": 2.0}.get(
        name, 1.3 * old if isinstance(old, float) else old
    )
    own = replace(robot, **{part: replace(getattr(robot, part), **{name: new})})
    direct = CompiledPlant(own, 1, options=PlantOptions(step=own_step(robot)))  # the FMU keeps it
    given = v.enumeration.items[new].value if v.enumeration else new
    starts = [{v.name: given}] if v.variability == "fixed" else [{v.name: given}, {}]
    for start in starts:
        with plant(path) as fmu:
            fmu.start(seed=1, **start)
            if not start:  # a tunable one may as well be set before the first step
                fmu.put(v.name, given)
            fmu.command(WAVE)
            for _ in range(30):
                fmu.step()
            seen = fmu.get([*POSITION, *LOADS])
        if start is starts[0]:
            for _ in range(30):
                direct.advance(np.array(WAVE[:4]), np.array(WAVE[4:]), TS)
        expected = [*direct.sample()["position"], *direct.sample()["grf"]]
        if start:
            assert seen == expected
        else:  # the feet were put down, and touched the ground by a rounding, before it was set
            np.testing.assert_allclose(seen, expected, rtol=0.0, atol=1e-12)


def test_tuning_while_it_walks_acts_from_the_next_step_on(path: Path) -> None:
    with plant(path) as tuned, plant(path) as other:
        for robot in (tuned, other):
            robot.start()
            robot.command(WAVE)
            for _ in range(20):
                robot.step()
        before = tuned.get(POSITION)
        tuned.put("contact.friction", 0.1)
        assert tuned.get(POSITION) == before
        tuned.step()
        other.step()
        assert tuned.get(POSITION) != other.get(POSITION)


def test_a_condition_may_come_and_go_while_it_walks(path: Path) -> None:
    with plant(path) as robot:
        robot.start()
        for _ in range(30):
            robot.step()
        assert all(load > 1.0 for load in robot.get(LOADS))
        robot.put("condition", Condition.S3.value)
        robot.step()
        assert robot.get(LOADS) == [0.0] * 4
        robot.put("condition", Condition.C1.value)
        robot.step()
        assert all(load > 1.0 for load in robot.get(LOADS))


def test_a_held_trunk_stays_where_it_is_when_something_else_is_tuned(path: Path) -> None:
    with plant(path) as one, plant(path) as other:
        for robot in (one, other):
            robot.start(condition=Condition.S1.value)
            robot.command(WAVE)
            for _ in range(20):
                robot.step()
        one.put("contact.friction", 0.8)  # as it is
        for _ in range(20):
            one.step()
            other.step()
        assert one.get(POSITION) == other.get(POSITION)


def test_two_instances_do_not_share_a_thing(path: Path) -> None:
    chosen = [{"seed": 1, "roughness": 0.5}, {"seed": 2, "roughness": 1.0}]
    alone = [place_after(path, [TS] * 20, **c) for c in chosen]
    with plant(path) as one, plant(path) as other:
        for robot, c in ((one, chosen[0]), (other, chosen[1])):
            robot.start(**c)
            robot.command(WAVE)
        for _ in range(20):
            one.step()
            other.step()
        assert [one.get(POSITION), other.get(POSITION)] == alone


def test_reset_starts_it_again(path: Path) -> None:
    with plant(path) as robot:
        robot.start(seed=5, payload=0.5, roughness=1.0)
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
        robot.start(slope=math.radians(60.0), payload=3.0)  # it tips over, with its load on top
        assert not robot.fell
        for _ in range(240):
            robot.step()
        assert robot.fell and robot.messages[-1].startswith("fell at ")
        lies = robot.get([*POSITION, *LOADS])
        robot.command([0.3] * 8)
        robot.step()
        assert robot.get([*POSITION, *LOADS]) == lies and robot.fell


@pytest.mark.parametrize(
    ("name", "value", "words"),
    [
        ("condition", 8, "condition = 8 is out of range: 1 ... 7 is allowed"),
        ("condition", 0, "condition = 0 is out of range"),
        ("payload", -1.0, "payload = -1 is out of range: 0 ... 100 is allowed"),
        ("slope", math.nan, "slope = nan is out of range"),
        ("seed", -1, "seed = -1 is out of range"),
        ("step", 0.0, "step = 0 is out of range"),
        ("servo.stiffness", math.inf, "servo.stiffness = inf is out of range"),
    ],
)
def test_a_wrong_parameter_is_an_error_with_a_message(
    name: str, value: float, words: str, path: Path
) -> None:
    with plant(path) as robot:
        robot.setupExperiment(startTime=0.0)
        robot.enterInitializationMode()
        robot.put(name, value)
        with pytest.raises(FMICallException, match="error"):
            robot.get(POSITION)
        with pytest.raises(FMICallException, match="error"):
            robot.exitInitializationMode()
        assert words in robot.messages[-1]
        start = next(v.start for v in TABLE if v.name == name) or 1
        robot.put(name, type(value)(start))
        robot.exitInitializationMode()
        robot.step()


def test_parameters_between_steps(path: Path) -> None:
    with plant(path) as robot:
        robot.start()
        for name, value, words in (
            ("payload", 1.0, "payload is fixed"),
            ("contact.friction", -1.0, "contact.friction = -1 is out of range"),
            ("condition", 9, "condition = 9 is out of range"),
            ("condition", Condition.C4.value, "condition = 4 has a payload of 1.25 kg, but the "
             "robot started with 0 kg"),
            ("position.x", 0.0, "position.x is an output"),
        ):  # fmt: skip
            with pytest.raises(FMICallException, match="error"):
                robot.put(name, value)
            assert words in robot.messages[-1]
        robot.step()


def test_conditions_are_of_legs_by_place_whatever_their_names_are(tmp_path: Path) -> None:
    file = tmp_path / "renamed.toml"
    names = {"RF": "FR", "RH": "RR", "LF": "FL", "LH": "front"}
    text = (ROBOTS / "lilibot.toml").read_text()
    for name, other in names.items():
        text = text.replace(f'"{name}"', f'"{other}"')
    file.write_text(text)
    own, renamed = robot_config(load_robot("lilibot")), robot_config(load_robot(file))
    assert renamed == own


def test_wrong_steps_are_errors_with_a_message_and_it_goes_on(path: Path) -> None:
    with plant(path) as robot:
        robot.start()
        robot.put("leg[2].theta_knee", math.nan)
        for _ in range(4):
            with pytest.raises(FMICallException, match="error"):
                robot.step()
            assert robot.messages[-1] == "leg[2].theta_knee = nan is not a finite angle"
        robot.put("leg[2].theta_knee", 0.0)
        robot.step()
        for t, h, words in (
            (7.0, TS, "step starts at 7 s, but the one before ended at"),
            (TS, -TS, "the step not negative"),
            (TS, math.inf, "must be finite"),
            (TS, 1e9, "has more than 1e+07 ticks of"),
        ):
            with pytest.raises(FMICallException, match="error"):
                robot.doStep(t, h)
            assert words in robot.messages[-1]
        robot.step()


def test_an_integration_step_that_is_too_long_is_refused_with_the_limit(path: Path) -> None:
    said = "is too long for the servos and feet of this robot: "
    with plant(path) as robot:
        with pytest.raises(FMICallException, match="error"):
            robot.start(step=0.0042)
        (told,) = (text for text in robot.messages if text.startswith(f"step = 0.0042 s {said}"))
        longest = longest_step(load_robot("lilibot"))
        allowed = float(told.split(said)[1].split()[0])
        assert 0.99 * longest < allowed <= longest
        robot.put("step", allowed)
        robot.exitInitializationMode()
        robot.step()


def test_parameters_between_steps_that_make_the_step_too_long_are_refused(path: Path) -> None:
    with plant(path) as robot:
        robot.start()
        robot.put("contact.damping", 1000.0)
        for _ in range(2):
            with pytest.raises(FMICallException, match="error"):
                robot.step()
            own = own_step(load_robot("lilibot"))
            assert robot.messages[-1].startswith(f"step = {own:.6g} s is too long")
        robot.put("contact.damping", 100.0)
        robot.step()


def test_a_robot_that_was_moved_to_another_file_is_not_built_again(tmp_path: Path) -> None:
    moved = tmp_path / "moved.toml"
    moved.write_bytes(FULL.read_bytes())
    there, here = (plant_fmu(PlantBuild(str(file), platforms=())) for file in (FULL, moved))
    assert there == here
    text = FULL.read_text().replace("[trunk]\nmass = ", "[trunk]\nmass = 1", 1)
    assert text != FULL.read_text()
    moved.write_text(text)
    assert plant_fmu(PlantBuild(str(moved), platforms=())) != here


def test_a_robot_brings_the_step_that_it_needs() -> None:
    with plant(plant_fmu(FULL_BUILD)) as robot:
        robot.start()
        assert robot.get(["step"])[0] == own_step(full_robot()) != own_step(load_robot("lilibot"))
        robot.step()


def test_a_step_beyond_the_stop_time_is_an_error(path: Path) -> None:
    with plant(path) as robot:
        robot.setupExperiment(startTime=0.0, stopTime=TS)
        robot.enterInitializationMode()
        robot.exitInitializationMode()
        robot.step()
        with pytest.raises(FMICallException, match="error"):
            robot.step()
        assert "beyond the stop time" in robot.messages[-1]


def test_a_motion_that_diverges_is_an_error_and_stays_one(path: Path) -> None:
    with plant(path) as robot:
        robot.start(**{"servo.no_load_speed": 1e6, "servo.stall_torque": 1e6})
        robot.put("leg[1].theta_hip", 1e9)
        with pytest.raises(FMICallException, match="error"):
            for _ in range(60):
                robot.step()
        assert "the motion diverged before t =" in robot.messages[-1]
        own = own_step(load_robot("lilibot"))
        assert robot.messages[-1].endswith(f"s with integration steps of {own:.4g} s")
        with pytest.raises(FMICallException, match="error"):
            robot.step()
        assert "the motion has diverged: a reset or a saved state" in robot.messages[-1]
        assert not robot.fell
        robot.reset()
        robot.start()
        robot.step()


def test_steps_too_short_for_what_is_under_way_are_warned_of_once(path: Path) -> None:
    with plant(path) as robot:
        robot.start(**{"servo.latency": 0.1})
        robot.step(0.1 / 200)
        assert robot.messages == ["started at 0 s: 4 legs, seed 0"]
        for _ in range(300):
            robot.step(1e-6)
        assert len(robot.messages) == 2
        assert robot.messages[-1].startswith("steps of 1e-06 s are short for a delay of 0.1 s")


WALKED = [{"seed": 7, "roughness": 1.0, "slope": 0.1}, {"seed": 1}]


def walk_some(robot: FMU2Plant, ticks: range) -> list[list[float]]:
    seen = []
    for n in ticks:
        robot.command(np.roll(WAVE, n // 7).tolist())
        robot.step()
        seen.append(robot.get([*POSITION, *LOADS]))
    return seen


@pytest.mark.parametrize("chosen", WALKED, ids=["obstacles", "plane"])
def test_a_saved_state_continues_bit_for_bit(path: Path, chosen: dict[str, float]) -> None:
    with plant(path) as robot, plant(path) as fresh, plant(path) as other:
        robot.start(**chosen, **{"servo.latency": 0.02})
        walk_some(robot, range(50))
        state = robot.getFMUstate()
        blob = robot.serializeFMUstate(state)
        rest = walk_some(robot, range(50, 100))
        robot.setFMUstate(state)
        robot.time = 50 * TS
        assert robot.serializeFMUstate(state) == blob
        assert walk_some(robot, range(50, 100)) == rest
        # into one that was never initialised, and one that stands on another ground
        other.start(**(chosen | {"seed": 99}))
        walk_some(other, range(5))
        for instance in (fresh, other):
            moved = instance.deSerializeFMUstate(blob)
            instance.setFMUstate(moved)
            instance.freeFMUstate(moved)
            instance.time = 50 * TS
            assert walk_some(instance, range(50, 100)) == rest
        robot.freeFMUstate(state)


def test_a_state_of_another_robot_is_refused(path: Path) -> None:
    with plant(path) as own, plant(plant_fmu(PlantBuild("hexapod", platforms=HOST))) as other:
        other.start()
        foreign = other.serializeFMUstate(other.getFMUstate())
        own.start()
        with pytest.raises(FMICallException, match="error"):
            own.deSerializeFMUstate(foreign)
        assert "another build of the FMU" in own.messages[-1]
        own.step()


@contextmanager
def plant3(path: Path) -> Iterator[Any]:
    description = fmpy.read_model_description(str(path))
    folder = fmpy.extract(str(path))
    fmu = fmi3.FMU3Slave(
        guid=description.instantiationToken,
        unzipDirectory=folder,
        modelIdentifier=description.coSimulation.modelIdentifier,
        instanceName="plant",
    )
    fmu.instantiate()
    try:
        yield fmu
        fmu.freeInstance()
    finally:
        shutil.rmtree(folder, ignore_errors=True)


def test_fmi_3_gives_the_bits_of_fmi_2_in_arrays(path: Path) -> None:
    file = plant_fmu(PlantBuild(fmi=3, platforms=HOST))
    reference = {v.name: v for v in fmpy.read_model_description(str(file)).modelVariables}
    vr = {name: v.valueReference for name, v in reference.items()}
    assert [d.start for d in reference["joint_angle.hip"].dimensions] == [4]
    with plant3(file) as three, plant(path) as two:
        two.start(seed=5, roughness=0.5, condition=Condition.C2.value)
        three.enterInitializationMode(startTime=0.0)
        three.setInt32([vr["seed"]], [5])
        three.setFloat64([vr["roughness"]], [0.5])
        three.setInt64([vr["condition"]], [Condition.C2.value])
        three.exitInitializationMode()
        two.command(WAVE)
        three.setFloat64([vr["theta_hip"], vr["theta_knee"]], WAVE)
        for n in range(60):
            two.step()
            three.doStep(n * TS, TS)
            for v in TABLE:
                if v.causality is not Causality.output or v.type is not Type.real:
                    continue
                names = [v.scalar_name(k) for k in range(v.count(4))]
                assert three.getFloat64([vr[v.name]], nValues=v.count(4)) == two.get(names)
        assert three.getBoolean([vr["fell"]]) == [False]


def test_it_needs_no_python(path: Path) -> None:
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
    folders = {name.split("/")[0] for name in names}
    assert folders == {"modelDescription.xml", "binaries", "sources", "documentation", "model.png"}
    assert not any(name.endswith((".py", ".toml")) for name in names)

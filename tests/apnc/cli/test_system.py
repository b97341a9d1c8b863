"""``apnc build-plant`` and ``apnc build-system``."""

from __future__ import annotations

import math
from pathlib import Path

import fmpy
import pytest
from lxml import etree

from apnc.cli import main as command_line
from apnc.cli.system import payload_hint
from apnc.loop.gait import Gait, write_gait

SSV = "{http://ssp-standard.org/SSP1/SystemStructureParameterValues}"


def values(file: Path) -> dict[str, str]:
    root = etree.parse(file).getroot()
    return {p.get("name"): p[0].get("value") for p in root.iter(f"{SSV}Parameter")}


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["build-system", "--output", "x.fmu"], "x.fmu does not end in .ssp"),
        (["build-system", "--naming", "cow"], "naming 'cow' is not one of structured"),
        (["build-system", "--gait", "no.json"], "no.json: cannot be read"),
        (["build-system", "--condition", "C9"], "conditions: 'C9' is not one of C1, C2"),
        (["build-system", "--payload", "-1"], "payload is -1.0; allowed:"),
        (["build-system", "--set", "servo.damping=x"], "servo.damping = 'x'; allowed: a number"),
        (["build-system", "--set", "servo.cow=1"], "parameter 'servo.cow' is not one of"),
        (["build-system", "--roughness", "2"], "roughness is 2.0; allowed: 0 ... 1"),
        (
            ["build-system", "--mi", "0:0.1,5:0.3"],
            "Invalid value for '--mi': '0:0.1,5:0.3'; allowed: a number",
        ),
        (
            ["build-system", "--seed", "1.5"],
            "Invalid value for '--seed': '1.5'; allowed: a whole number",
        ),
        (["build-plant", "--robot", "cow"], "robot 'cow'"),
        (["build-plant", "--naming", "cow"], "naming 'cow' is not one of"),
        (["build-plant", "--fmi", "1"], "fmi = 1 is not one of 2, 3"),
        (["build-plant", "--platform", "vax"], "platform 'vax' is not one of linux64, "),
    ],
)
def test_bad_use_is_one_line(
    arguments: list[str],
    words: str,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    capsys: pytest.CaptureFixture[str],
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as end:
        command_line.main(arguments)
    error = capsys.readouterr().err
    assert end.value.code == 2 and words in error and len(error.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_the_commands_write_what_they_say(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    write_gait(Gait(("RF", "RH", "LF", "LH"), (3.1, 3.2, 0.1)), Path("gait.json"))
    for words in (
        ["build-plant", "--platform", "host"],
        ["build-plant", "--platform", "host", "--fmi", "3", "--output", "Three.fmu"],
        [
            "build-system",
            "--platform",
            "host",
            "--gait",
            "gait.json",
            "--mi",
            "0.2",
            "--rate",
            "50",
            "--turn",
            "0.3",
            "--roughness",
            "0.5",
            "--slope",
            "3",
            "--seed",
            "4",
            "--payload",
            "0.5",
            "--condition",
            "S2",
            "--set",
            "servo.stiffness=20",
            "--set",
            "xi=0.05",
            "--set",
            "sensor.component=norm",
        ],
    ):
        with pytest.raises(SystemExit) as end:
            command_line.main(words)
        assert end.value.code == 0, capsys.readouterr().err
    assert fmpy.read_model_description("LilibotPlant.fmu").modelName == "LilibotPlant"
    assert fmpy.read_model_description("Three.fmu").fmiVersion == "3.0"
    controller = values(Path("Lilibot/resources/controller.ssv"))
    assert (controller["MI"], controller["stored"], controller["turn"]) == ("0.2", "true", "0.3")
    assert controller["xi"] == "0.05"
    plant = values(Path("Lilibot/resources/plant.ssv"))
    wanted = {"roughness": 0.5, "slope": math.radians(3.0), "seed": 4, "payload": 0.5,
              "condition": 6, "servo.stiffness": 20.0, "sensor.component": 2}  # fmt: skip
    assert {name: float(plant[name]) for name in wanted} == wanted
    assert "<BaseStepSize>0.02" in Path("Lilibot/OspSystemStructure.xml").read_text()


def test_a_payload_heavier_than_the_robot_has_a_hint() -> None:
    assert payload_hint(2.5, 2.5) == ""
    assert payload_hint(50.0, 2.5) == "--payload 50 is in kg: 20.0 times the robot's 2.50 kg"

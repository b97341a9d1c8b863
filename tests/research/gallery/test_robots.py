"""The gallery's list of robots, and its commands on what they lack."""

from __future__ import annotations

import subprocess
import sys
from importlib.metadata import PackageNotFoundError
from pathlib import Path

import pytest

from research.gallery import robots as listed
from research.gallery.robots import GalleryRobot, model_of, robots

ROOT = Path(__file__).resolve().parents[3]


def test_every_robot_says_where_it_comes_from_and_under_which_licence() -> None:
    names = [robot.name for robot in robots()]
    assert len(set(names)) == len(names) >= 8
    for robot in robots():
        assert robot.licence and robot.title and robot.kind in ("URDF", "MJCF")
        assert robot.file.endswith((".urdf", ".xml")) and not Path(robot.file).is_absolute()
        assert bool(robot.package) is not bool(robot.repository and robot.commit)
    assert [robot.name for robot in robots(["go1", "a1"])] == ["go1", "a1"]
    with pytest.raises(ValueError, match="robot is 'rex'; allowed: kraby, solo12, "):
        robots(["rex"])


def test_a_package_or_file_that_is_missing_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    dog = GalleryRobot("dog", "Dog", "numpy", "numpy/dog.urdf", "MIT")
    with pytest.raises(ValueError, match=r"numpy .* has no file numpy/dog.urdf"):
        model_of(dog)

    def missing(name: str) -> None:
        raise PackageNotFoundError(name)

    monkeypatch.setattr(listed, "distribution", missing)
    with pytest.raises(ValueError, match="numpy is not installed: pip install --group robots"):
        model_of(dog)


def test_a_robot_of_a_repository_is_read_from_the_checkout_that_a_variable_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    bug = GalleryRobot(
        "bug", "Bug", "", "a/bug.urdf", "MIT", repository="host/bugs", commit="0123456789abcdef"
    )
    monkeypatch.delenv("BUG_ROOT", raising=False)
    words = "of a checkout of host/bugs at commit 0123456789abcdef, with a/bug.urdf"
    with pytest.raises(ValueError, match=f"BUG_ROOT is ''; allowed: the folder {words}"):
        model_of(bug)
    monkeypatch.setenv("BUG_ROOT", str(tmp_path))
    with pytest.raises(ValueError, match=words):
        model_of(bug)
    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "bug.urdf").touch()
    assert model_of(bug) == (tmp_path / "a" / "bug.urdf", "0123456789ab")


def gallery(*words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "research.gallery", *words]
    return subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)


@pytest.mark.parametrize(
    ("only", "named"), [((), "robots of the gallery"), (("--only", "go1"), "go1")]
)
def test_a_folder_that_lacks_robots_gives_one_line(
    only: tuple[str, ...], named: str, tmp_path: Path
) -> None:
    done = gallery("measure", "--robots", str(tmp_path), *only)
    assert done.returncode == 2
    assert done.stderr.splitlines() == [f"python -m research.gallery: {tmp_path} lacks {named}"]

"""Which way is forward is told from the legs, or by name."""

from __future__ import annotations

import math
import re
from pathlib import Path

import numpy as np
import pytest
from command_line import run
from dog_urdf import Dog

from apnc.importing import ImportedRobot, ModelFileError, import_robot
from apnc.importing.forward import FORWARD, turned
from apnc.importing.limbs import limbs_of
from apnc.importing.urdf import read_urdf
from apnc.importing.xml_file import read_xml

SIDES = {
    "x": ((60.0, 100.0, 130.0), (-50.0, -100.0, -120.0)),
    "y": ((-40.0, 0.0, 50.0), (130.0, 180.0, 220.0)),
}
"""Directions in which legs point on two sides of x and of y [deg]; no two of a side are alike."""


def star(*directions: float, about: float = 0.0) -> str:
    """A robot whose legs stand out from a round trunk, with a coxa, a femur and a tibia each.

    Args:
        directions: of the legs, from x to y [deg].
        about: by how much the whole robot is turned in its file [deg].
    """
    lines = [
        '<robot name="star">',
        _link("trunk", 1.0, "0.02 0.01 0.2", '<collision><origin xyz="0 0 0.2"/><geometry>'
              '<box size="0.2 0.1 0.04"/></geometry></collision>'),
    ]  # fmt: skip
    for name, direction in enumerate(directions):
        yaw = math.radians(direction + about)
        place = f'xyz="{0.1 * math.cos(yaw)} {0.1 * math.sin(yaw)} 0.2" rpy="0 0 {yaw}"'
        for link, parent, origin, axis in (
            ("coxa", "trunk", place, "0 0 1"),
            ("femur", f"coxa_{name}", 'xyz="0.04 0 0" rpy="0 -0.6 0"', "0 1 0"),
            ("tibia", f"femur_{name}", 'xyz="0.06 0 0" rpy="0 1.9 0"', "0 1 0"),
        ):
            ball = '<collision><origin xyz="0.12 0 0"/><geometry><sphere radius="0.006"/>'
            foot = f"{ball}</geometry></collision>" if link == "tibia" else ""
            lines += [
                _link(f"{link}_{name}", 0.05, "0.03 0 0", foot),
                f'<joint name="j{name}_{link}" type="revolute"><origin {origin}/>'
                f'<parent link="{parent}"/><child link="{link}_{name}"/><axis xyz="{axis}"/>'
                '<limit lower="-1.5" upper="1.5" effort="2" velocity="6"/></joint>',
            ]
    return "\n".join([*lines, "</robot>"])


def _link(name: str, mass: float, com: str, inside: str = "") -> str:
    xx, yy, zz = (mass * share for share in (3e-4, 5e-4, 6e-4))
    return (
        f'<link name="{name}"><inertial><origin xyz="{com}"/><mass value="{mass}"/><inertia '
        f'ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}"/></inertial>{inside}</link>'
    )


def read(folder: Path, text: str, forward: str | None = None) -> ImportedRobot:
    path = folder / "star.urdf"
    path.write_text(text)
    return import_robot(path, forward=forward)


def feet(found: ImportedRobot) -> np.ndarray:
    """Feet as the robot stands, in the frame of its trunk [m], shape (legs, 3)."""
    poses = zip(found.legs, found.stance.poses, strict=True)
    return np.array([leg.foot_at(pose) for leg, pose in poses])


@pytest.mark.parametrize("forward", SIDES)
def test_legs_on_two_sides_tell_which_way_is_forward(forward: str, tmp_path: Path) -> None:
    one, other = SIDES[forward]
    found = read(tmp_path, star(*one, *other))
    assert found.forward == forward
    assert found.facing == f"half of the legs stand to each side of {forward}"
    assert (f"# x here is {forward} of that file" in found.toml) is (forward != "x")
    right = [leg for leg in found.legs if leg.right]
    assert len(right) == 3
    assert feet(found)[:3, 1].max() < -0.1
    # from front to hind along the direction of the file
    names = [int(leg.names[0][-1]) for leg in found.legs]
    angles = np.radians([(*one, *other)[name] for name in names])
    ahead = np.cos(angles) if forward == "x" else np.sin(angles)
    assert (np.diff(ahead[:3]) < 0.0).all()
    assert (np.diff(ahead[3:]) < 0.0).all()


def test_a_robot_turned_in_its_file_is_the_same_robot(tmp_path: Path) -> None:
    one, other = SIDES["x"]
    plain = read(tmp_path, star(*one, *other))
    text = star(*one, *other, about=90.0)
    # the trunk is turned with its legs
    text = text.replace('xyz="0.02 0.01 0.2"', 'xyz="-0.01 0.02 0.2"', 1)
    text = text.replace('ixx="0.0003"', 'ixx="A"', 1).replace('iyy="0.0005"', 'iyy="0.0003"', 1)
    text = text.replace('ixx="A"', 'ixx="0.0005"').replace("0.2 0.1 0.04", "0.1 0.2 0.04")
    found = read(tmp_path, text)
    assert found.forward == "y"
    np.testing.assert_allclose(feet(found), feet(plain), rtol=0.0, atol=1e-12)
    for a, b in zip(found.legs, plain.legs, strict=True):
        assert a.names == b.names
        np.testing.assert_allclose(a.mount, b.mount, rtol=0.0, atol=1e-12)
    for key in ("com", "size", "outline", "center"):
        trunks = (getattr(robot.trunk, key) for robot in (found.robot, plain.robot))
        assert next(trunks) == pytest.approx(next(trunks), abs=1e-12), key
    assert found.robot.joint_map == plain.robot.joint_map


@pytest.mark.parametrize("forward", FORWARD)
def test_any_direction_can_be_asked_for(forward: str, tmp_path: Path) -> None:
    found = read(tmp_path, star(30.0, 150.0, 210.0, 330.0), forward)
    assert found.forward == forward
    front = found.legs[0]
    x, y = FORWARD[forward]
    angle = math.radians((30.0, 150.0, 210.0, 330.0)[int(front.names[0][-1])])
    place = np.array([math.cos(angle), math.sin(angle)])
    assert place @ (x, y) > 0.0
    assert place @ (y, -x) > 0.0  # the first leg is on the right


def test_where_both_directions_are_plain_it_is_x(tmp_path: Path) -> None:
    found = read(tmp_path, star(40.0, 140.0, 220.0, 320.0))
    assert found.forward == "x"
    assert found.facing == "half of the legs stand to each side of x and of y"


def test_a_dog_that_looks_along_y_is_told_by_its_hips(tmp_path: Path) -> None:
    found = read(tmp_path, Dog(axes=("0 1 0", "1 0 0")).text())
    assert found.forward == "y"
    assert found.legs[0].chain == ("abduction", "hip", "knee")
    assert read(tmp_path, Dog().text()).forward == "x"


@pytest.mark.parametrize(
    "directions",
    [(0.0, 45.0, 90.0, 180.0, 225.0, 270.0), (80.0, 100.0, 110.0, 120.0, 250.0, 260.0)],
    ids=["legs on both middle lines", "four legs and two"],
)
def test_legs_on_two_sides_of_neither_are_refused(
    directions: tuple[float, ...], tmp_path: Path
) -> None:
    words = (
        r"^star\.urdf: which way is forward is not plain: its 6 legs stand in "
        r"equal numbers to both sides of neither x nor y; allowed: .* forward x, -x, y, -y$"
    )
    with pytest.raises(ModelFileError, match=words):
        read(tmp_path, star(*directions))


def test_an_unknown_direction_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ModelFileError, match=re.escape("forward is 'z'; allowed: x, -x, y, -y")):
        read(tmp_path, star(*SIDES["x"][0], *SIDES["x"][1]), "z")


def test_four_quarter_turns_are_none(tmp_path: Path) -> None:
    path = tmp_path / "star.urdf"
    path.write_text(star(*SIDES["x"][0], *SIDES["x"][1]))
    model = read_urdf(read_xml(path), path)
    again = model
    for _ in range(4):
        again = turned(again, "y")
    for a, b in zip(limbs_of(again, {}).legs, limbs_of(model, {}).legs, strict=True):
        np.testing.assert_allclose(a[0].frame.position, b[0].frame.position, rtol=0.0, atol=1e-15)
        np.testing.assert_allclose(a[0].frame.turn, b[0].frame.turn, rtol=0.0, atol=1e-15)


def test_the_command_says_and_takes_the_direction(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(tmp_path)
    Path("star.urdf").write_text(star(*SIDES["y"][0], *SIDES["y"][1]))
    code, out, _ = run(capsys, "import-robot", "star.urdf")
    assert code == 0
    assert "forward: y of the file; half of the legs stand to each side of y" in out
    code, out, _ = run(capsys, "import-robot", "star.urdf", "--forward", "-y")
    assert code == 0
    assert "forward: -y of the file; as asked for" in out
    code, _, err = run(capsys, "import-robot", "star.urdf", "--forward", "up")
    assert code == 2
    assert "forward is 'up'; allowed: x, -x, y, -y" in err

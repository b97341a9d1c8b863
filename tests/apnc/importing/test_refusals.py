"""What cannot be imported is refused in one line that says why."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from dog_urdf import Dog, fixed, hinge, link

from apnc.importing import ModelFileError, import_robot
from apnc.importing import xml_file as reader


def urdf(folder: Path, text: str, name: str = "dog.urdf") -> Path:
    path = folder / name
    path.write_text(text)
    return path


def edited(old: str, new: str, count: int = -1) -> str:
    text = Dog().text()
    assert old in text
    return text.replace(old, new, count)


def toes() -> str:
    parts = []
    for name in Dog().names:
        parts += [
            link(f"{name}_toe", 0.01, (0.0, 0.0, 0.01), (1e-6, 1e-6, 1e-6)),
            hinge(f"{name}_toe_joint", f"{name}_foot", f"{name}_toe", "0 0 0.02", "0 1 0", (-1, 1)),
        ]
    return Dog(extra="\n".join(parts)).text()


def forked() -> str:
    parts = []
    for toe in ("a", "b"):
        parts += [
            link(f"fl_{toe}", 0.01, (0.0, 0.0, 0.01), (1e-6, 1e-6, 1e-6)),
            hinge(f"fl_{toe}_joint", "fl_foot", f"fl_{toe}", "0 0 0.02", "0 1 0", (-1, 1)),
        ]
    for name in ("fr", "hl", "hr"):
        parts += [
            link(f"{name}_a", 0.01, (0.0, 0.0, 0.01), (1e-6, 1e-6, 1e-6)),
            hinge(f"{name}_a_joint", f"{name}_foot", f"{name}_a", "0 0 0.02", "0 1 0", (-1, 1)),
        ]
    return Dog(extra="\n".join(parts)).text()


REFUSED: dict[str, tuple[Callable[[], str], str]] = {
    "xacro": (
        lambda: edited('<robot name="dog">', '<robot name="dog"><link name="${x}"/>'),
        r"it is xacro, .* xacro dog\.urdf > robot\.urdf",
    ),
    "xacro element": (
        lambda: edited(
            '<robot name="dog">',
            '<robot name="dog" xmlns:xacro="http://www.ros.org/wiki/xacro"><xacro:leg/>',
        ),
        r"it is xacro",
    ),
    "entity": (
        lambda: '<!DOCTYPE r [<!ENTITY x "dog">]><robot name="&x;"/>',
        r"it has a document type; allowed: XML without <!DOCTYPE>",
    ),
    "file as entity": (
        lambda: '<!DOCTYPE r [<!ENTITY x SYSTEM "file:///etc/passwd">]><robot>&x;</robot>',
        r"it has a document type; allowed: XML without <!DOCTYPE>",
    ),
    "no XML": (lambda: "<robot", r"it is no XML: "),
    "SDF": (lambda: "<sdf/>", r"its root is <sdf>; allowed: <robot> \(URDF\) or <mujoco> \(MJCF\)"),
    "number": (
        lambda: edited('<mass value="8.0"/>', '<mass value="eight"/>'),
        r"link trunk, mass: value is 'eight'; allowed: a finite number",
    ),
    "infinite": (
        lambda: edited('<mass value="8.0"/>', '<mass value="inf"/>'),
        r"value is 'inf'; allowed: a finite number",
    ),
    "negative mass": (
        lambda: edited('<mass value="8.0"/>', '<mass value="-8"/>'),
        r"trunk: its mass is -8 kg; allowed: 0 or more",
    ),
    "unknown link": (
        lambda: edited('<parent link="trunk"/>', '<parent link="trunc"/>', 1),
        r"joint fl_haa: parent is 'trunc'; allowed: a link of the file",
    ),
    "two links of a name": (
        lambda: edited('<link name="fl_hip">', '<link name="fr_hip">'),
        r"a link is named 'fr_hip'; allowed: names that differ",
    ),
    "two roots": (
        lambda: Dog(extra=link("stray")).text(),
        r"links without a joint above them: base, stray; allowed: one, the root",
    ),
    "loop": (
        lambda: Dog(extra=fixed("loop", "fl_foot", "fr_foot", "0 0 0")).text(),
        r"link fr_foot hangs on two joints; allowed: a tree",
    ),
    "sliding knee": (
        lambda: edited('name="fl_kfe" type="revolute"', 'name="fl_kfe" type="prismatic"'),
        r"leg fl_hip: joint fl_kfe is slide; allowed: hinge",
    ),
    "tied knee": (
        lambda: edited('<child link="fl_calf"/>', '<child link="fl_calf"/><mimic joint="fl_hfe"/>'),
        r"leg fl_hip: joint fl_kfe is tied to fl_hfe; allowed: free joints",
    ),
    "four joints": (toes, r"leg \w+ has 4 joints: .*; allowed: two or three"),
    "fork": (forked, r"leg fl_hip branches into fl_a, fl_b; allowed: a chain"),
    "two vertical axes": (
        lambda: Dog(axes=("0 0 1", "0 0 1")).text(),
        r"second joint \w+_hfe turns about .*1\) of the trunk; allowed: a level femur axis",
    ),
    "three pitches": (
        lambda: Dog(axes=("0 1 0", "0 1 0")).text(),
        r"second joint \w+_hfe turns about .* of the trunk; allowed: an abduction at right angles",
    ),
    "oblique": (
        lambda: Dog(axes=("0.8 0.6 0", "0 1 0")).text(),
        r"turns about the oblique axis \(-?0\.8, -?0\.6, 0\) of the trunk; allowed: an abd",
    ),
    "range": (
        lambda: Dog(knee={"hl": (1.0, 1.2)}).text(),
        r"leg hl_hip: the gait would move hl_kfe from .* to .* rad; allowed: -1\.2 to -1 rad, its",
    ),
    "level hip out of range": (
        lambda: Dog(axes=("1 0 0", "0 0.5 0.8660254037844386")).text(),
        r"joint \w+_haa would stand at -?1\.05 rad, where the hip axis is level; allowed: in its",
    ),
    "millimetres": (
        lambda: re.sub(
            r'(?<=xyz=")([^"]*)',
            lambda found: " ".join(str(1000.0 * float(word)) for word in found[0].split()),
            Dog().text(),
        ),
        r"a femur or tibia is 2\d\d m long; allowed: up to 10 m, and lengths of the file are in m",
    ),
    "inertia of no body": (
        lambda: edited('ixx="0.0006" ixy="0" ixz="0" iyy="0.0008" iyz="0" izz="0.0007"',
                       'ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"')
        .replace('ixx="0.0001" ixy="0" ixz="0" iyy="0.0002" iyz="0" izz="0.0001"',
                 'ixx="-0.5" ixy="0" ixz="0" iyy="-0.5" iyz="0" izz="-0.5"'),
        r"\w+_hip: it has 0\.7 kg and the inertia .*; allowed: moments of 0 or more",
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_a_urdf_is_refused_in_one_line(case: str, tmp_path: Path) -> None:
    make, words = REFUSED[case]
    with pytest.raises(ModelFileError) as refusal:
        import_robot(urdf(tmp_path, make()))
    text = str(refusal.value)
    assert text.startswith("dog.urdf: ")
    assert "\n" not in text
    assert re.search(words, text), text


def test_two_legs_are_too_few(tmp_path: Path) -> None:
    biped = Dog(arm=False).text()
    for name in ("hl", "hr"):
        biped = re.sub(rf'name="{name}_(haa|hfe|kfe)" type="revolute"',
                       rf'name="{name}_\1" type="fixed"', biped)  # fmt: skip
    with pytest.raises(ModelFileError, match=r"2 legs were found; allowed: 4 or more .*fl_hip \(3"):
        import_robot(urdf(tmp_path, biped))


def test_a_knee_along_the_abduction_is_refused(tmp_path: Path) -> None:
    path = urdf(tmp_path, Dog(axes=("0 1 0", "1 0 0")).text())
    words = r"third joint \w+_kfe turns about .* allowed: at right angles to the abduction"
    with pytest.raises(ModelFileError, match=words):
        import_robot(path, forward="x")


def test_two_rolls_are_no_leg(tmp_path: Path) -> None:
    rolls = re.sub(r'(name="\w+_haa" type=)"revolute"', r'\1"fixed"', Dog().text())
    rolls = rolls.replace("0 1 0", "1 0 0").replace("-0.0 -1.0 -0.0", "-1 0 0")
    with pytest.raises(ModelFileError, match=r"about x of the trunk; allowed: a hip across x or"):
        import_robot(urdf(tmp_path, rolls), forward="x")


def test_a_pose_that_the_file_has_not_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ModelFileError, match=r"pose is 'sit'; allowed: zero"):
        import_robot(urdf(tmp_path, Dog().text()), "sit")


def test_a_pose_beyond_a_range_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ModelFileError, match="the gait would move"):
        import_robot(urdf(tmp_path, Dog().text()), "zero")


def test_a_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(ModelFileError, match=r"^no\.urdf: it cannot be read: "):
        import_robot(tmp_path / "no.urdf")


def test_a_large_file_is_not_read(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reader, "LARGEST", 1000)
    with pytest.raises(ModelFileError, match=r"it has \d+ bytes; allowed: up to 1000"):
        import_robot(urdf(tmp_path, Dog().text()))


def test_an_expanded_file_may_keep_the_namespace_of_xacro(tmp_path: Path) -> None:
    text = edited('<robot name="dog">',
                  '<robot name="dog" xmlns:xacro="http://www.ros.org/wiki/xacro">')  # fmt: skip
    assert import_robot(urdf(tmp_path, text)).robot.name == "dog"


def test_a_placeholder_is_not_taken_and_told(tmp_path: Path) -> None:
    found = import_robot(urdf(tmp_path, Dog(effort=1000.0, velocity=1000.0).text()))
    told = "\n".join(found.dropped)
    assert "effort 1000 N m of 12 joints" in told
    assert "velocity 1000 rad/s of 12 joints" in told
    estimated = {each.name: each.value for each in found.estimates}
    assert found.robot.servo.stall_torque == pytest.approx(estimated["servo.stall_torque"])
    assert found.robot.servo.stall_torque < 300.0


MJCF = '<mujoco><worldbody><body name="a"><freejoint/>{}</body></worldbody></mujoco>'


def mjcf(folder: Path, text: str) -> Path:
    pytest.importorskip("mujoco")
    return urdf(folder, text, "a.xml")


def test_an_include_outside_of_the_folder_is_refused(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "secret.xml").write_text("<mujoco/>")
    for name in ("../secret.xml", str(tmp_path / "secret.xml"), ""):
        text = f'<mujoco><include file="{name}"/></mujoco>'
        with pytest.raises(ModelFileError, match=r"include is .*; allowed: files in the folder"):
            import_robot(mjcf(tmp_path / "in", text))


def test_a_link_that_leaves_the_folder_is_refused(tmp_path: Path) -> None:
    (tmp_path / "in").mkdir()
    (tmp_path / "secret.xml").write_text("<mujoco/>")
    (tmp_path / "in" / "link.xml").symlink_to(tmp_path / "secret.xml")
    with pytest.raises(ModelFileError, match=r"allowed: files in the folder"):
        import_robot(mjcf(tmp_path / "in", '<mujoco><include file="link.xml"/></mujoco>'))


def test_a_file_that_includes_itself_is_refused(tmp_path: Path) -> None:
    with pytest.raises(ModelFileError, match=r"is nested; allowed: 8 levels"):
        import_robot(mjcf(tmp_path, '<mujoco><include file="a.xml"/></mujoco>'))


def test_an_include_is_read(tmp_path: Path) -> None:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "b.xml").write_text(f"<x>{MJCF.format('')[8:-9]}</x>")
    text = '<mujoco><include file="parts/b.xml"/></mujoco>'
    with pytest.raises(ModelFileError, match=r"0 legs were found; .* floating base a; chains"):
        import_robot(mjcf(tmp_path, text))


@pytest.mark.parametrize(
    ("inside", "words"),
    [
        (
            '<geom type="mesh" mesh="m"/>',
            r"body a: its mass is that of mesh 'm', which is not read",
        ),
        ('<geom type="cube"/>', r"MuJoCo refuses it: "),
        ('<geom size="nan"/>', r"geom: size is 'nan'; allowed: finite numbers"),
    ],
)
def test_a_mjcf_is_refused_in_one_line(inside: str, words: str, tmp_path: Path) -> None:
    asset = '<asset><mesh name="m" file="m.stl"/></asset>'
    text = MJCF.format(inside).replace("<worldbody>", f"{asset}<worldbody>")
    with pytest.raises(ModelFileError, match=words) as refusal:
        import_robot(mjcf(tmp_path, text))
    assert "\n" not in str(refusal.value)


def test_mjcf_needs_the_extra(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    path = urdf(tmp_path, MJCF.format(""), "a.xml")
    with pytest.raises(ValueError, match=r"'mujoco' is not installed"):
        import_robot(path)

"""Robot files: what is read, and what is refused."""

import math
import os
import pickle
import subprocess
import sys
from dataclasses import asdict, replace
from pathlib import Path

import numpy as np
import pytest
from plain_robot import plain_robot, plain_text

from apnc_plant.robot import Contact, RobotDescriptionError, Sensor, load_robot

TEXT = plain_text()


def test_lilibot_has_the_published_mass_and_leg_order() -> None:
    robot = load_robot("lilibot")
    assert robot.mass == pytest.approx(2.5, abs=1e-12)
    assert robot.weight == pytest.approx(24.525)
    assert [leg.name for leg in robot.legs] == ["RF", "RH", "LF", "LH"]
    assert [np.sign(leg.mount[:2]).tolist() for leg in robot.legs] == [
        [1, -1],
        [-1, -1],
        [1, 1],
        [-1, 1],
    ]


def test_a_sent_robot_is_found_by_its_hash_in_another_process() -> None:
    robot = load_robot("lilibot")
    found = {robot: "here"}
    code = (
        "import pickle, sys\nfrom apnc_plant.robot import load_robot\n"
        "sent = pickle.load(sys.stdin.buffer)\nprint({load_robot('lilibot'): 'there'}[sent])"
    )
    # texts have another hash in every process
    there = subprocess.run(
        [sys.executable, "-c", code],
        input=pickle.dumps(robot), capture_output=True, check=True,
        env={**os.environ, "PYTHONHASHSEED": "1"},
    )  # fmt: skip
    assert found[load_robot("lilibot")] == "here" and there.stdout.split() == [b"there"]


def test_box_inertia() -> None:
    trunk = plain_robot().trunk
    expected = 1.3 / 12 * np.array([0.16**2 + 0.06**2, 0.26**2 + 0.06**2, 0.26**2 + 0.16**2])
    np.testing.assert_allclose(trunk.inertia_tensor(), np.diag(expected))


def test_inertia_of_its_own_is_mirrored_with_its_leg(tmp_path: Path) -> None:
    own = "[leg.femur]\ninertia = [3e-4, 2e-4, 1.5e-4, 1e-5, 2e-5, 3e-5]"
    robot = load_robot(written(tmp_path, TEXT.replace("[leg.femur]", own)))
    right, left = (leg.mass_properties(leg.femur).inertia for leg in robot.legs[::2])
    np.testing.assert_array_equal(
        left, [[3e-4, 1e-5, 2e-5], [1e-5, 2e-4, 3e-5], [2e-5, 3e-5, 1.5e-4]]
    )
    np.testing.assert_array_equal(
        right, [[3e-4, -1e-5, 2e-5], [-1e-5, 2e-4, -3e-5], [2e-5, -3e-5, 1.5e-4]]
    )
    tibia = robot.legs[0].mass_properties(robot.legs[0].tibia).inertia
    assert np.count_nonzero(tibia) == 3


def test_an_outline_is_not_the_box_with_the_inertia(tmp_path: Path) -> None:
    own = "mass = 1.3\noutline = [0.3, 0.2, 0.1]"
    plain, robot = (
        load_robot(written(tmp_path, text)) for text in (TEXT, TEXT.replace("mass = 1.3", own))
    )
    np.testing.assert_array_equal(robot.trunk.inertia_tensor(), plain.trunk.inertia_tensor())
    np.testing.assert_allclose(np.ptp(robot.trunk.corners(), axis=0), [0.3, 0.2, 0.1])
    np.testing.assert_allclose(robot.trunk.corners().mean(axis=0), robot.trunk.center, atol=1e-15)
    heights = [each.trunk.loaded(0.0, 1.3).com[2] for each in (plain, robot)]
    assert heights[1] - heights[0] == pytest.approx((0.1 - 0.06) / 2.0 / 2.0)


def test_the_servo_of_a_joint_is_that_of_its_leg_its_kind_or_the_robot(tmp_path: Path) -> None:
    of_kind = "[servo.knee]\nstiffness = 20.0\ndry_friction = 0.1\n\n[contact]"
    of_leg = 'name = "LF"\nservo = { knee = { stiffness = 30.0 }, hip = { damping = 0.5 } }'
    text = TEXT.replace("[contact]", of_kind).replace('name = "LF"', of_leg)
    robot = load_robot(written(tmp_path, text))
    common, lf, lh = robot.servo, robot.legs[2], robot.legs[3]
    assert robot.servo_of(lh, "abduction") == plain_robot().servo
    assert robot.servo_of(lh, "hip") == plain_robot().servo
    knees = [robot.servo_of(leg, "knee") for leg in (lh, lf)]
    assert [(k.stiffness, k.dry_friction, k.damping) for k in knees] == [
        (20.0, 0.1, common.damping), (30.0, 0.1, common.damping)
    ]  # fmt: skip
    assert robot.servo_of(lf, "hip").damping == 0.5


def test_a_link_without_mass_needs_a_rotor_or_what_it_carries(tmp_path: Path) -> None:
    bare = TEXT.replace("reflected_inertia", "# reflected_inertia")
    hip, tibia = ("[leg.hip]\nmass = 0.095", "[leg.tibia]\nmass = 0.085")
    for text in (TEXT, bare):
        assert load_robot(written(tmp_path, text.replace(hip, "[leg.hip]\nmass = 0"))).mass < 2.5
    light = tibia.replace("0.085", "0.0")
    assert load_robot(written(tmp_path, TEXT.replace(tibia, light))).mass < 2.5
    with pytest.raises(RobotDescriptionError, match="the knee of leg RF turns neither mass nor"):
        load_robot(written(tmp_path, bare.replace(tibia, light)))
    own = f"{light}\ninertia = [1, 1, 1, 0, 0, 0]"
    with pytest.raises(RobotDescriptionError, match="tibia: mass is 0 and there is an inertia"):
        load_robot(written(tmp_path, TEXT.replace(tibia, own)))


def test_stops_are_angles_of_the_links(tmp_path: Path) -> None:
    own = "[leg]\nabduction_range = [-10, 20]\nfemur_range = [30, 60]\ntibia_range = [80, 100]"
    robot = load_robot(written(tmp_path, TEXT.replace("[leg]", own)))
    right, left = (np.degrees(leg.stops) for leg in robot.legs[::2])
    np.testing.assert_allclose(left, [[-10, 20], [43 - 60, 43 - 30], [80 - 92, 100 - 92]])
    np.testing.assert_allclose(right, [[-20, 10], *left[1:]])
    assert np.isinf(plain_robot().legs[0].stops).all()


def test_stops_of_a_coxa_are_angles_forward_of_straight_outward(tmp_path: Path) -> None:
    own = (
        '[leg]\nchain = ["coxa", "femur", "tibia"]\npointing = 30\ncoxa_range = [-20, 50]\n'
        "femur_range = [10, 100]"
    )
    robot = load_robot(written(tmp_path, TEXT.replace("[leg]", own)))
    for leg in robot.legs:
        np.testing.assert_allclose(np.degrees(leg.stops[1:]), [[-50, 20], [10 - 43, 100 - 43]])
    with pytest.raises(RobotDescriptionError, match="coxa_range is -20 to 25 deg; allowed: around"):
        load_robot(written(tmp_path, TEXT.replace("[leg]", own.replace("50]", "25]"))))


def test_the_stall_torque_bends_a_stop_by_one_degree_unless_the_file_says_more() -> None:
    servo = plain_robot().servo
    assert servo.stop == (pytest.approx(servo.stall_torque * 180.0 / math.pi), servo.damping)
    assert replace(servo, stop_stiffness=5.0, stop_damping=0.0).stop == (5.0, 0.0)


def test_a_file_elsewhere_can_be_loaded(tmp_path: Path) -> None:
    path = tmp_path / "heavy.toml"
    path.write_text(TEXT.replace("mass = 1.3", "mass = 2.55"), encoding="utf-8")
    assert load_robot(str(path)).mass == pytest.approx(3.75)


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ("mass = 1.3", "mass = -1.3", "trunk.mass is -1.3; allowed: a finite number above 0 [kg]"),
        ("mass = 1.3", "mass = 0.0", "trunk.mass is 0.0; allowed: a finite number above 0"),
        ("mass = 1.3", "mass = nan", "trunk.mass is nan"),
        ("mass = 1.3", 'mass = "1.3"', "trunk.mass is '1.3'"),
        ("mass = 1.3", "mass = true", "trunk.mass is True"),
        ("mass = 1.3", "", "trunk.mass is missing"),
        ("mass = 1.3", "mass = 1.3\nmas = 2.0", "trunk.mas is 2.0; allowed: only"),
        (
            "size = [0.26, 0.16, 0.06]",
            "size = [0.26, 0.16]",
            "trunk.size is [0.26, 0.16]; allowed: 3 finite",
        ),
        (
            "size = [0.26, 0.16, 0.06]",
            "size = [0.26, 0.0, 0.06]",
            "trunk.size[2] is 0.0; allowed: a",
        ),
        ("tibia_angle = 92.0", "tibia_angle = 920.0", "leg.tibia_angle is 920.0"),
        (
            "tibia_angle = 92.0",
            "tibia_angle = -92.0",
            "leg: knee is '<' and tibia_angle is -92 deg; allowed with it: 0 and more, or the line "
            'knee = ">"',
        ),
        (
            "femur_length = 0.070",
            "femur_length = 70.0",
            "leg.femur_length is 70.0; allowed: a finite number above 0 up to 10 [m]",
        ),
        (
            "hip_offset = [0.0, 0.0, -0.03]",
            "hip_offset = [0.0, 0.0, -30.0]",
            "leg.hip_offset[3] is -30.0; allowed: a finite number from -10 to 10 [m]",
        ),
        (
            "tibia_angle = 92.0",
            'tibia_angle = 92.0\nknee = ">"',
            "leg: knee is '>' and tibia_angle is 92 deg; allowed with it: 0 and less, or the line "
            'knee = "<"',
        ),
        (
            "tibia_angle = 92.0",
            'tibia_angle = 92.0\nknee = "v"',
            "leg.knee is 'v'; allowed: < or >",
        ),
        (
            "mass = 1.3",
            "mass = 1.3\ninertia = [1.0, 1.0]",
            "trunk.inertia is [1.0, 1.0]; allowed: 6 finite numbers [kg m^2]",
        ),
        (
            "mass = 1.3",
            'mass = 1.3\ninertia = [1, 1, 1, 0, "a", 0]',
            "trunk.inertia[5] is 'a'; allowed: a finite number [kg m^2]",
        ),
        (
            "mass = 1.3",
            "mass = 1.3\ninertia = [1, 1, 2.1, 0, 0, 0]",
            "trunk.inertia: principal moments are 1, 1, 2.1 kg m^2; allowed: above 0, none larger "
            "than the sum of the others",
        ),
        (
            "[leg.femur]",
            "[leg.femur]\ninertia = [1, 1, 1, 1, 0, 0]",
            "leg.femur.inertia: principal moments are 0, 1, 2 kg m^2; allowed: above 0, none",
        ),
        (
            "[leg]",
            "[leg]\nfemur_range = [50.0, 60.0]",
            "leg: femur_range is 50 to 60 deg; allowed: around the reference pose, at 43",
        ),
        (
            "[leg]",
            "[leg]\nfemur_range = [60.0, 20.0]",
            "leg: femur_range is 60 to 20 deg; allowed: the lower end, then the upper",
        ),
        (
            'name = "RH"',
            'name = "RH"\nfemur_range = [50.0, 60.0]',
            "legs[2]: femur_range is 50 to 60 deg; allowed: around",
        ),
        (
            "[leg]",
            "[leg]\ntibia_range = [50.0, 361.0]",
            "leg.tibia_range[2] is 361.0; allowed: a finite number from -360 to 360 [deg]",
        ),
        (
            "[contact]",
            "[servo.knee]\nlatency = 0.1\n[contact]",
            "servo.knee.latency is 0.1; allowed: only damping, dry_friction",
        ),
        (
            'name = "RH"',
            'name = "RH"\nservo = { knee = { dry_friction = -1 } }',
            "legs[2].servo.knee.dry_friction is -1; allowed: a finite number, 0 or more [N m]",
        ),
        (
            "mass = 1.3",
            "mass = 1.3\noutline = [0.2, 0.1, 0]",
            "trunk.outline[3] is 0; allowed: a finite number above 0 up to 10 [m]",
        ),
        (
            "tibia_angle = 92.0",
            'tibia_angle = 92.0\nchain = ["hip", "coxa"]',
            "chain is ['hip', 'coxa']; allowed: ['abduction', 'hip', 'knee'] or ",
        ),
        (
            "tibia_angle = 92.0",
            "tibia_angle = 92.0\npointing = 5.0",
            "pointing is 5 deg and chain is ['abduction', 'hip', 'knee']; allowed with it: 0",
        ),
        (
            "tibia_angle = 92.0",
            'tibia_angle = 92.0\nabduction_angle = 5.0\nchain = ["coxa", "femur"]',
            "abduction_angle is 5 deg and chain is ['coxa', 'femur']; allowed with it: 0",
        ),
        (
            "tibia_angle = 92.0",
            "tibia_angle = 92.0\ncoxa_range = [-30.0, 30.0]",
            "coxa_range is given and chain is ['abduction', 'hip', 'knee']; allowed with it: none",
        ),
        (
            'name = "RH"',
            'name = "RF"',
            "allowed: names that differ",
        ),
        ("[servo]", "[motor]", "motor is {"),
        ("[sensor]\ndelay = ", "[sensor]\ndelay = -0.05 # ", "sensor.delay is -0.05"),
    ],
)
def test_values_out_of_range_are_named(tmp_path: Path, old: str, new: str, expected: str) -> None:
    path = tmp_path / "broken.toml"
    assert old in TEXT
    path.write_text(TEXT.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(RobotDescriptionError) as caught:
        load_robot(str(path))
    assert expected in str(caught.value)
    assert "\n" not in str(caught.value)


def written(tmp_path: Path, text: str) -> str:
    path = tmp_path / "own.toml"
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("old", "new", "expected"),
    [
        ('[[legs]]\nname = "RF"', '[[legs]]\nname = ""', "legs[1].name is ''; allowed: a name"),
        ("mount = [-0.092, 0.066, 0.0]", "", "legs[4].mount is missing; allowed: 3 finite"),
        ("mount = [-0.092, 0.066, 0.0]", "mount = [0, 1]", "legs[4].mount is [0, 1]"),
        (
            "mount = [-0.092, 0.066, 0.0]",
            "mount = [-0.092, 0.066, 0.0]\nfemur = {mass = -1}",
            "legs[4].femur.mass is -1; allowed: a finite number, 0 or more [kg]",
        ),
        ("femur_length = 0.070\n", "", "leg.femur_length is missing; allowed: a finite number"),
        ("[leg.femur]\nmass = 0.12", "[leg.femur]", "leg.femur.mass is missing"),
        (
            "mount = [-0.092, 0.066, 0.0]",
            "mount = [-0.092, -0.066, 0.0]",
            "legs: 3 are right (RF, RH, LH); allowed: 2 of 4 legs with y < 0",
        ),
        (
            'component = "normal"',
            'component = "all"',
            "sensor.component is 'all'; allowed: normal or norm",
        ),
        ('name = "plain"', "", "name is missing; allowed: a name"),
        ("[servo]", "[controller]\nxj = 1\n[servo]", "parameter 'xj' is not one of Ts, robot_w"),
        ("[servo]", "[controller]\nxi = 7\n[servo]", "xi = 7; allowed: a number from 0 to 1"),
        ("[servo]", "[controller]\nTs = 0.1\n[servo]", "controller: Ts is 0.1; allowed: param"),
        ('name = "plain"', 'name = "a"\ncontroller = 3', "controller is 3; allowed: a table"),
        (
            'name = "plain"',
            'name = "a"\nheight = 3',
            "height is 3; allowed: only contact, controller, leg, legs, mi",
        ),
        ("[servo]", "[servo]\nforce = 3", "servo.force is 3; allowed: only abduction, damp"),
    ],
)
def test_what_is_wrong_is_named_with_its_place(
    tmp_path: Path, old: str, new: str, expected: str
) -> None:
    assert old in TEXT
    with pytest.raises(RobotDescriptionError) as caught:
        load_robot(written(tmp_path, TEXT.replace(old, new, 1)))
    assert str(caught.value).startswith("robot file own.toml: ")
    assert expected in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("legs", "line"),
    [
        ("", "legs is missing; allowed: a list of tables, at least 1"),
        ("legs = []", r"legs is \[\]; allowed: a list of tables, at least 1"),
        ("legs = 3", "legs is 3; allowed: a list of tables, at least 1"),
        ("legs = [1]", r"legs\[1\] is 1; allowed: a table"),
    ],
)
def test_a_robot_without_legs_is_refused(tmp_path: Path, legs: str, line: str) -> None:
    start, rest = TEXT.index("[[legs]]"), TEXT.index("[servo]")
    text = legs + "\n" + TEXT[:start] + TEXT[rest:]
    with pytest.raises(RobotDescriptionError, match=line):
        load_robot(written(tmp_path, text))


def test_what_is_left_out_has_its_default(tmp_path: Path) -> None:
    lines = TEXT[: TEXT.index("[sensor]")].splitlines()
    optional = (
        "center", "com_side_offset", "reflected_inertia", "latency", "slew_rate",
        "damping_depth", "friction", "friction_speed",
    )  # fmt: skip
    text = "\n".join(line for line in lines if line.split(" ")[0] not in optional)
    robot = load_robot(written(tmp_path, text))
    assert robot.sensor == Sensor(0.0, 0.0, 0.0, "normal")
    assert (robot.trunk.center, robot.trunk.com_side_offset) == ((0.0, 0.0, 0.0), 0.0)
    assert robot.servo.reflected_inertia == robot.servo.latency == robot.servo.slew_rate == 0.0
    assert replace(robot.contact, damping=1.0, stiffness=1.0) == Contact(
        0.012, 1.0, 1.0, 0.0002, 0.8, 0.03
    )
    assert robot.controller == {}


def test_legs_go_in_any_order_and_keep_their_parts(tmp_path: Path) -> None:
    head, tail = TEXT.split("[[legs]]", 1)[0], TEXT[TEXT.index("[servo]") :]
    blocks = TEXT[len(head) : TEXT.index("[servo]")].split("[[legs]]")[1:]
    shuffled = head + "".join("[[legs]]" + blocks[k] for k in (2, 3, 0, 1)) + tail
    assert shuffled.index('"LF"') < shuffled.index('"RF"')
    assert load_robot(written(tmp_path, shuffled)) == plain_robot()
    robot = load_robot("hexapod")
    assert [leg.name for leg in robot.legs] == ["RF", "RM", "RH", "LF", "LM", "LH"]
    assert replace(robot, legs=robot.legs[::-1]) == robot


def test_an_odd_leg_is_on_the_left(tmp_path: Path) -> None:
    tail = '[[legs]]\nname = "T"\nmount = [-0.15, 0.0, 0.0]\n\n[servo]'
    robot = load_robot(written(tmp_path, TEXT.replace("[servo]", tail)))
    assert [leg.name for leg in robot.legs] == ["RF", "RH", "LF", "LH", "T"]


def test_a_leg_can_differ_from_the_others(tmp_path: Path) -> None:
    own = "mount = [0.092, 0.066, 0.0]\ntibia_length = 0.09\nhip = {mass = 0.1}"
    robot = load_robot(written(tmp_path, TEXT.replace("mount = [0.092, 0.066, 0.0]", own)))
    common = plain_robot().legs[0]
    special = robot.legs[2]
    assert special.tibia_length == 0.09
    assert special.hip == replace(common.hip, mass=0.1)
    assert special.femur == common.femur
    assert robot.legs[0] == common


def test_files_that_call_the_mount_hip_are_still_read(tmp_path: Path) -> None:
    assert load_robot(written(tmp_path, TEXT.replace("mount =", "hip ="))) == plain_robot()


def test_a_robot_carries_its_own_gains(tmp_path: Path) -> None:
    table = '[controller]\nxi = 0.03\nN = 40\nkappa_rule = "printed"\nphi_frozen = false\n'
    robot = load_robot(written(tmp_path, TEXT + "\n" + table))
    assert robot.controller == {"xi": 0.03, "N": 40, "kappa_rule": 2, "phi_frozen": False}
    assert isinstance(robot.controller["phi_frozen"], bool)
    assert robot != plain_robot()
    assert hash(robot)
    assert pickle.loads(pickle.dumps(robot)) == robot
    assert asdict(robot)["controller"]["N"] == 40


def test_angles_are_in_degrees_in_a_file_and_in_radians_in_a_robot() -> None:
    leg = plain_robot().legs[0]
    assert leg.femur_angle == pytest.approx(43.0 * math.pi / 180.0, abs=1e-15)
    assert replace(leg, tibia_angle=math.pi).tibia_angle == math.pi
    with pytest.raises(RobotDescriptionError, match=r"tibia_angle is 183\..*to 180 \[deg"):
        replace(leg, tibia_angle=3.2)


def test_a_robot_made_in_code_is_checked_too() -> None:
    robot = plain_robot()
    with pytest.raises(RobotDescriptionError, match=r"friction is -0.1; allowed"):
        replace(robot.contact, friction=-0.1)
    with pytest.raises(
        RobotDescriptionError, match=r"legs: 2 are right .*allowed: 1 of 2 legs with y < 0"
    ):
        replace(robot, legs=robot.legs[:2])


def test_an_unknown_robot_lists_the_known_ones() -> None:
    with pytest.raises(RobotDescriptionError, match=r"'spot' is unknown; allowed: .*lilibot"):
        load_robot("spot")


def test_a_file_that_is_no_toml_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "noise.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(RobotDescriptionError, match="not readable as TOML"):
        load_robot(str(path))

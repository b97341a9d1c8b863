"""Robot files: what is read, and what is refused."""

from pathlib import Path

import numpy as np
import pytest

from exudyn_models.robot import ROBOTS, RobotDescriptionError, load_robot

LILIBOT = (ROBOTS / "lilibot.toml").read_text(encoding="utf-8")


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


def test_box_inertia() -> None:
    trunk = load_robot("lilibot").trunk.body
    expected = 1.3 / 12 * np.array([0.16**2 + 0.06**2, 0.26**2 + 0.06**2, 0.26**2 + 0.16**2])
    np.testing.assert_allclose(trunk.inertia(), np.diag(expected))


def test_a_file_elsewhere_can_be_loaded(tmp_path: Path) -> None:
    path = tmp_path / "heavy.toml"
    path.write_text(LILIBOT.replace("mass = 1.3", "mass = 2.55"), encoding="utf-8")
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
        ("size = [0.26, 0.16, 0.06]", "size = [0.26, 0.16]", "trunk.size is [0.26, 0.16]"),
        ("size = [0.26, 0.16, 0.06]", "size = [0.26, 0.0, 0.06]", "trunk.size"),
        ("tibia_angle = 92.0", "tibia_angle = 920.0", "leg.tibia_angle is 920.0"),
        (
            'name = "RH"',
            'name = "RF"',
            "legs is ['RF', 'RF', 'LF', 'LH']; allowed: names that differ",
        ),
        ("[servo]", "[motor]", "motor is {"),
        ("delay = 0.0374", "delay = -0.05", "sensor.delay is -0.05"),
    ],
)
def test_values_out_of_range_are_named(tmp_path: Path, old: str, new: str, expected: str) -> None:
    path = tmp_path / "broken.toml"
    assert old in LILIBOT
    path.write_text(LILIBOT.replace(old, new, 1), encoding="utf-8")
    with pytest.raises(RobotDescriptionError) as caught:
        load_robot(str(path))
    assert expected in str(caught.value)
    assert "\n" not in str(caught.value)


def test_an_unknown_robot_lists_the_known_ones() -> None:
    with pytest.raises(RobotDescriptionError, match=r"'spot' is unknown; allowed: .*lilibot"):
        load_robot("spot")


def test_a_file_that_is_no_toml_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "noise.toml"
    path.write_bytes(b"\xff\xfe\x00")
    with pytest.raises(RobotDescriptionError, match="not readable as TOML"):
        load_robot(str(path))

"""The joints of a robot's own model file: what a robot file says of them, and what is refused."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from apnc_plant.robot import ROBOTS, JointMap, RobotDescription, RobotDescriptionError, load_robot
from apnc_plant.robot.names import plainly_named

LILIBOT = (ROBOTS / "lilibot.toml").read_text(encoding="utf-8")
RF = 'name = "RF"\nmount = [0.092, -0.066, 0.0]\n'
HIP = 'hip = { name = "FR_thigh", sign = -1, offset = 76.4 }'


def robot_with(folder: Path, *joints: str) -> RobotDescription:
    path = folder / "own.toml"
    assert RF in LILIBOT
    lines = "\n".join(["[legs.joints]", *joints, ""])
    path.write_text(LILIBOT.replace(RF, f"{RF}\n{lines}"), encoding="utf-8")
    return load_robot(path)


def test_it_is_in_the_robot_in_rad_and_converts_angles(tmp_path: Path) -> None:
    robot = robot_with(tmp_path, HIP, 'abduction = { name = "FR_hip" }')
    first, hip = robot.joint_map
    assert first == JointMap("RF", "abduction", "FR_hip", 1, 0.0)
    assert (hip.leg, hip.joint, hip.name, hip.sign) == ("RF", "hip", "FR_thigh", -1)
    assert hip.in_file(0.0) == pytest.approx(math.radians(76.4))
    assert hip.in_file(0.1) == pytest.approx(math.radians(76.4) - 0.1)
    angles = np.linspace(-1.0, 1.0, 5)
    np.testing.assert_allclose(hip.here(hip.in_file(angles)), angles)
    assert hip.words() == "FR_thigh = 1.333 - q"


def test_shipped_robots_have_none(tmp_path: Path) -> None:
    assert load_robot("lilibot").joint_map == ()
    renamed = plainly_named(robot_with(tmp_path, HIP))
    assert len(renamed.joint_map) == 1  # it stays with its leg


@pytest.mark.parametrize(
    ("line", "words"),
    [
        (HIP.replace("-1", "2"), "legs[1].joints.hip.sign is 2; allowed: 1 or -1"),
        (HIP.replace("-1", "0.5"), "legs[1].joints.hip.sign is 0.5; allowed: 1 or -1"),
        (
            HIP.replace("76.4", "400"),
            "offset is 400; allowed: a finite number from -360 to 360 [deg]",
        ),
        (HIP.replace("76.4", "nan"), "offset is nan"),
        (HIP.replace('name = "FR_thigh", ', ""), "legs[1].joints.hip.name is missing"),
        (HIP.replace("hip =", "hips ="), "did you mean hip?"),
        (HIP.replace("offset", "offsett"), "did you mean offset?"),
        (
            f'{HIP}\nknee = {{ name = "FR_thigh" }}',
            "joint 'FR_thigh' is the hip of RF and the knee of RF; allowed: one of them",
        ),
    ],
)
def test_what_is_wrong_is_named_in_a_line(line: str, words: str, tmp_path: Path) -> None:
    with pytest.raises(RobotDescriptionError) as error:
        robot_with(tmp_path, line)
    assert words in str(error.value)
    assert "\n" not in str(error.value)

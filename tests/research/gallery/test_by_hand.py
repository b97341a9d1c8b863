"""A stance that is set by hand keeps the joints of the model file."""

from __future__ import annotations

import math
from pathlib import Path

import pytest
from made_up_robots import insect

from apnc.importing import import_robot
from apnc_plant.robot import load_robot
from apnc_plant.robot.urdf import robot_urdf
from research.gallery.by_hand import HEAD, ByHand, text_by_hand

STANCE = {"F": (30.0, 100.0, 95.0), "M": (-5.0, 90.0, 80.0), "H": (-40.0, 100.0, 95.0)}


def test_joints_of_the_file_count_from_the_stance_that_was_set(tmp_path: Path) -> None:
    pytest.importorskip("tomlkit")
    (tmp_path / "insect.urdf").write_text(robot_urdf(insect()))
    found = import_robot(tmp_path / "insect.urdf")
    file = tmp_path / "insect.toml"
    file.write_text(found.toml)
    given = ByHand(STANCE, {"stiffness": 33.0}, {"a1": 0.123}, (0.1, 0.2))
    file.write_text(text_by_hand(file, given))
    assert file.read_text().startswith(f"# {HEAD}\n")
    robot = load_robot(file)
    assert robot.servo.stiffness == 33.0
    assert robot.controller["a1"] == 0.123
    assert robot.mi_range == (0.1, 0.2)
    for leg, own in zip(robot.legs, found.legs, strict=True):
        angles = dict(
            zip(("pointing", "femur", "tibia"), map(math.radians, STANCE[leg.name[1]]), strict=True)
        )
        assert leg.pointing == pytest.approx(angles["pointing"])
        assert leg.femur_angle == pytest.approx(angles["femur"])
        assert leg.tibia_angle == pytest.approx(angles["tibia"])
        offsets = {each.name: each.offset for each in robot.joint_map if each.leg == leg.name}
        for name, angle in angles.items():
            turn = own.turns[name]
            assert offsets[turn.joint.name] == pytest.approx(turn.in_file(angle), abs=1e-4)

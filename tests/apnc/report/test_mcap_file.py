"""The MCAP log read back says what the record says, in the types of ROS 2."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import apnc
from apnc.cli.main import main
from apnc.report import ros_types
from apnc.report.mcap_file import write_mcap

mcap_reader = pytest.importorskip("mcap.reader")
pytest.importorskip("mcap_ros2.writer")
highlevel = pytest.importorskip("rosbags.highlevel")
typesys = pytest.importorskip("rosbags.typesys")

Heard = dict[str, list[tuple[int, Any]]]


@pytest.fixture(scope="module")
def record() -> apnc.Record:
    return apnc.simulate(apnc.Experiment(duration=2.0, mi=0.15))


@pytest.fixture(scope="module")
def log(record: apnc.Record, tmp_path_factory: pytest.TempPathFactory) -> Path:
    path: Path = tmp_path_factory.mktemp("mcap") / "walk.mcap"
    write_mcap(record, path)
    return path


@pytest.fixture(scope="module")
def heard(log: Path) -> Heard:
    """The messages of each topic with their times [ns], as a reader of bags decodes them."""
    found: Heard = defaultdict(list)
    with highlevel.AnyReader([log]) as reader:
        for connection, stamp, data in reader.messages():
            message = reader.deserialize(data, connection.msgtype)
            found[connection.topic].append((stamp, message))
    return found


def test_the_types_are_those_of_ros_2(log: Path) -> None:
    real = typesys.get_typestore(typesys.Stores.ROS2_JAZZY)
    with highlevel.AnyReader([log]) as reader:
        kinds = {connection.msgtype for connection in reader.connections}
        written = {kind: reader.typestore.hash_rihs01(kind) for kind in kinds}
    assert written == {kind: real.hash_rihs01(kind) for kind in kinds}
    assert kinds | {ros_types.LOG} == ros_types.DEFINITIONS.keys()
    own = typesys.get_types_from_msg(ros_types.DEFINITIONS[ros_types.LOG], ros_types.LOG)
    store = typesys.get_typestore(typesys.Stores.EMPTY)
    store.register(own)
    assert store.hash_rihs01(ros_types.LOG) == real.hash_rihs01(ros_types.LOG)


def test_trunk_joints_and_forces_come_back(record: apnc.Record, heard: Heard) -> None:
    times = [stamp for stamp, _ in heard["/trunk"]]
    np.testing.assert_allclose(np.array(times) / 1e9, record.time, atol=1e-9)
    places = [[m.pose.position.x, m.pose.position.z] for _, m in heard["/trunk"]]
    np.testing.assert_array_equal(places, record.signals["position"][:, [0, 2]])
    turned = [m.pose.orientation for _, m in heard["/trunk"]]
    turns = Rotation.from_quat([[q.x, q.y, q.z, q.w] for q in turned]).as_euler("ZYX")
    np.testing.assert_allclose(turns[:, ::-1], record.signals["rpy"], atol=1e-9)
    last = heard["/joint_states"][-1][1]
    at = list(last.name).index("LF_knee")
    assert last.position[at] == record.signals["joint_angle"][-1, 2, 2]
    assert last.effort[at] == record.signals["joint_torque"][-1, 2, 2]
    last = heard["/joint_commands"][-1][1]
    assert last.position[list(last.name).index("LF_knee")] == record.signals["theta_knee"][-1, 2]
    forces = [m.wrench.force.z for _, m in heard["/foot_force/LH"]]
    np.testing.assert_array_equal(forces, record.signals["foot_force"][:, 3, 2])
    stamp = heard["/foot_force/LH"][-1][1].header.stamp
    assert stamp.sec + stamp.nanosec / 1e9 == pytest.approx(119 / 60)


def test_the_robot_and_its_frames_have_the_same_names(record: apnc.Record, heard: Heard) -> None:
    ((at, text),) = heard["/robot_description"]
    links = {link.attrib["name"] for link in ElementTree.fromstring(text.data).iter("link")}
    assert at == 0 and "trunk" in links
    assert len(heard["/tf"]) == len(record)
    for stamp, message in heard["/tf"]:
        assert {frame.child_frame_id for frame in message.transforms} == links
        for frame in message.transforms:
            assert frame.header.frame_id in links | {"world"}
            assert frame.header.stamp.sec * 10**9 + frame.header.stamp.nanosec == stamp
    knee = [m.transforms[3].transform.rotation for _, m in heard["/tf"]]
    assert np.ptp([turn.y for turn in knee]) > 0.05


def test_signals_of_the_controller_are_numbers_named_as_in_the_record(
    record: apnc.Record, heard: Heard
) -> None:
    def numbers(topic: str) -> list[float]:
        assert {len(message.data) for _, message in heard[topic]} == {1}
        return [message.data[0] for _, message in heard[topic]]

    assert numbers("/apnc/phi13") == record.signals["phi"][:, 1].tolist()
    assert numbers("/apnc/kappa") == record.signals["kappa"].tolist()
    assert numbers("/apnc/grf/LF") == record.signals["grf"][:, 2].tolist()


def test_the_state_comes_once_a_second(heard: Heard) -> None:
    assert [stamp for stamp, _ in heard["/diagnostics"]] == [0, 10**9]
    names = [status.name for status in heard["/diagnostics"][0][1].status]
    assert names == ["controller", *(f"foot sensor {leg}" for leg in ("RF", "RH", "LF", "LH"))]


def test_a_fall_and_odd_names_are_in_the_log(record: apnc.Record, tmp_path: Path) -> None:
    fell = replace(record, end=apnc.End.fell, legs=("R F", "RH", "LF", "LH"))
    write_mcap(fell, tmp_path / "fall.mcap")
    with highlevel.AnyReader([tmp_path / "fall.mcap"]) as reader:
        assert "/foot_force/R_F" in reader.topics
        (place,) = [c for c in reader.connections if c.topic == "/rosout"]
        *_, (_, stamp, data) = reader.messages([place])
        message = reader.deserialize(data, place.msgtype)
    assert (message.msg, message.level) == ("fell", 40)
    assert stamp == round(record.time[-1] * 1e9)


def test_walk_writes_a_log(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as done:
        main(["walk", "--duration", "0.5", "--mcap", "logs/walk.mcap"])
    assert done.value.code == 0
    with (tmp_path / "logs" / "walk.mcap").open("rb") as file:
        assert mcap_reader.make_reader(file).get_summary().statistics.message_count > 300

"""The MCAP log read back says what the record says."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import apnc
from apnc.cli.main import main
from apnc.report.mcap_file import write_mcap

mcap_reader = pytest.importorskip("mcap.reader")
decoder = pytest.importorskip("mcap_ros2.decoder")


def test_a_walk_comes_back_from_its_log(tmp_path: Path) -> None:
    record = apnc.simulate(apnc.Experiment(duration=1.0, mi=0.15))
    write_mcap(record, tmp_path / "walk.mcap")
    heard: dict[str, list[tuple[int, object]]] = {}
    with (tmp_path / "walk.mcap").open("rb") as file:
        reader = mcap_reader.make_reader(file, decoder_factories=[decoder.DecoderFactory()])
        for _, channel, message, decoded in reader.iter_decoded_messages():
            heard.setdefault(channel.topic, []).append((message.log_time, decoded))
    assert {len(messages) for messages in heard.values()} == {60}
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
    assert stamp.sec + stamp.nanosec / 1e9 == pytest.approx(59 / 60)
    assert [m.data for _, m in heard["/apnc/phi13"]] == record.signals["phi"][:, 1].tolist()


def test_walk_writes_a_log(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as done:
        main(["walk", "--duration", "0.5", "--mcap", "logs/walk.mcap"])
    assert done.value.code == 0
    with (tmp_path / "logs" / "walk.mcap").open("rb") as file:
        assert mcap_reader.make_reader(file).get_summary().statistics.message_count > 300

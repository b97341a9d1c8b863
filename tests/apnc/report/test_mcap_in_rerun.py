"""Rerun makes a moving robot and curves of the log.

It is run by hand: rerun-sdk and pyarrow take 670 MB, so no extra has them. Passed with rerun-sdk
0.41.0 on 2026-12-01.
"""

from __future__ import annotations

from collections import defaultdict
from pathlib import Path

import numpy as np
import pytest

import apnc
from apnc.report.mcap_file import write_mcap

chunk = pytest.importorskip("rerun.chunk", reason="run by hand: rerun-sdk takes 670 MB")


def test_rerun_draws_the_robot_its_frames_and_the_numbers(tmp_path: Path) -> None:
    record = apnc.simulate(apnc.Experiment(duration=1.0, mi=0.15))
    write_mcap(record, tmp_path / "walk.mcap")
    rows: dict[str, list[dict[str, list]]] = defaultdict(list)
    for part in chunk.McapReader(tmp_path / "walk.mcap").stream():
        rows[part.entity_path] += part.to_record_batch().to_pylist()

    def column(entity: str, name: str) -> list:
        return [row[name][0] for row in rows[entity] if row.get(name)]

    assert column("/apnc/phi12", "Scalars:scalars") == record.signals["phi"][:, 0].tolist()
    knees = [row["Scalars:scalars"][2] for row in rows["/joint_states/position"]]
    assert knees == record.signals["joint_angle"][:, 0, 2].tolist()
    moved = [row for row in rows["/tf"] if row.get("Transform3D:child_frame") == ["trunk"]]
    place = [row["Transform3D:translation"][0] for row in moved]
    np.testing.assert_allclose(place, record.signals["position"], atol=1e-6)
    visible = [entity for entity in rows if "/visual_geometries/RF_" in entity]
    assert len(visible) == 4  # hip, femur, tibia and the ball of the foot
    frames = {frame for entity in visible for frame in column(entity, "CoordinateFrame:frame")}
    assert frames <= {row["Transform3D:child_frame"][0] for row in rows["/tf"][1:]}

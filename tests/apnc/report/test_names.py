"""Names of robots and legs that mean something elsewhere: in CSV, paths, HTML, topics."""

from __future__ import annotations

import csv
import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from apnc import Experiment, Gait, Record, gait_of_run, load_robot, simulate, write_report
from apnc.cli.main import main
from apnc.loop.columns import column_names
from apnc_plant.robot import ROBOTS, RobotDescriptionError

NAMES = ('front, "right"', "RH/../../x", "<b>L F</b>", "../LH")
"""In the order of the legs of Lilibot."""

PHI = (3.1, 3.2, 0.1)


@pytest.fixture(scope="module")
def record() -> Record:
    """A walk with a stored gait of a robot whose legs have such names."""
    lilibot = load_robot("lilibot")
    legs = (replace(leg, name=name) for leg, name in zip(lilibot.legs, NAMES, strict=True))
    robot = replace(lilibot, name="sub/../../x", legs=tuple(legs))
    settings = {"stored": True, "phi_stored": PHI}
    return simulate(
        Experiment(robot=robot, duration=1.0, settings=settings, engine="compiled", rate=60)
    )


def test_every_column_is_one_column(record: Record, tmp_path: Path) -> None:
    write_report(record, tmp_path)
    with (tmp_path / "record.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    names = [column.name for column in column_names(record)]
    assert list(rows[0]) == names == list(json.loads(
        (tmp_path / "summary.json").read_text())["columns"])  # fmt: skip
    assert all(None not in row and None not in row.values() for row in rows)
    for leg, name in enumerate(NAMES):
        angles = [float(row[f"{name}.theta_hip"]) for row in rows]
        assert np.allclose(angles, record.signals["theta_hip"][:, leg], atol=1e-8)


def test_the_gait_of_such_a_run_is_found(record: Record, tmp_path: Path) -> None:
    write_report(record, tmp_path)
    assert gait_of_run(tmp_path) == Gait(NAMES, PHI)


def test_the_report_shows_them_as_text(record: Record, tmp_path: Path) -> None:
    write_report(record, tmp_path)
    page = (tmp_path / "report.html").read_text()
    assert "&lt;b&gt;L F&lt;/b&gt;" in page and "<b>L F</b>" not in page.split("<script")[0]


def test_topics_are_plain_and_one_per_leg(record: Record, tmp_path: Path) -> None:
    reader = pytest.importorskip("mcap.reader")
    pytest.importorskip("mcap_ros2")
    from apnc.report.mcap_file import write_mcap  # noqa: PLC0415

    write_mcap(record, tmp_path / "walk.mcap")
    with (tmp_path / "walk.mcap").open("rb") as file:
        channels = reader.make_reader(file).get_summary().channels.values()
    topics = [c.topic for c in channels if c.topic.startswith("/foot_force")]
    assert len(set(topics)) == 4
    assert all(t.removeprefix("/foot_force/").isidentifier() for t in topics)


def own_robot(folder: Path, name: str) -> str:
    path = folder / "own.toml"
    text = (ROBOTS / "lilibot.toml").read_text().replace('name = "lilibot"', f"name = {name}")
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize("form", ["urdf", "mjcf"])
def test_a_robot_is_exported_into_the_folder_one_is_in(
    form: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if form == "mjcf":
        pytest.importorskip("mujoco")
    robot = own_robot(tmp_path, "'sub/../../x y'")
    (tmp_path / "here").mkdir()
    monkeypatch.chdir(tmp_path / "here")
    with pytest.raises(SystemExit) as end:
        main(["export-robot", "--robot", robot, "--format", form])
    assert end.value.code == 0
    (written,) = (tmp_path / "here").iterdir()
    assert written.is_file() and written.stem.isidentifier()
    assert {path.name for path in tmp_path.iterdir()} == {"here", "own.toml"}


@pytest.mark.parametrize("name", ['"a\\nb"', '"a\\u0007"', '"a\\u2028b"', '"  "', '"a\\uFFFF"'])
def test_control_characters_are_refused(name: str, tmp_path: Path) -> None:
    with pytest.raises(RobotDescriptionError, match="a name without control characters"):
        load_robot(own_robot(tmp_path, name))

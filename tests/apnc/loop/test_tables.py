"""A record in pandas, in xarray and in a notebook."""

from __future__ import annotations

import builtins
import importlib.util
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from records import synthetic_record

from apnc.extras import missing
from apnc.loop.csv_file import write_csv
from apnc.loop.experiment import Experiment
from apnc.loop.record import End, Record
from apnc.loop.simulate import simulate
from apnc_core.schema import Causality
from apnc_core.variables import TABLE
from apnc_plant.signals import PLANT_SIGNALS

RECORD = synthetic_record(3.0, (0.5, 1.5, 2.5))


def test_data_frame_is_the_table_of_record_csv_with_the_time_as_index(tmp_path: Path) -> None:
    pandas = pytest.importorskip("pandas")
    write_csv(RECORD, tmp_path / "record.csv")
    read = pandas.read_csv(tmp_path / "record.csv", index_col="time")
    pandas.testing.assert_frame_equal(RECORD.to_pandas(), read, check_dtype=False, rtol=1e-8)


def test_dataset_names_the_dimensions_of_every_signal() -> None:
    pytest.importorskip("xarray")
    data = RECORD.to_xarray()
    assert set(data) == set(RECORD.signals)
    for name, values in RECORD.signals.items():
        np.testing.assert_array_equal(data[name], values)
    np.testing.assert_array_equal(data["time"], RECORD.time)
    legs, signals = ("RF", "RH", "LF", "LH"), RECORD.signals
    for k, leg in enumerate(legs):
        here = data.sel(leg=leg)
        np.testing.assert_array_equal(here["o1"], signals["o1"][:, k])
        np.testing.assert_array_equal(
            here["foot_force"].sel(axis="z"), signals["foot_force"][:, k, 2]
        )
        np.testing.assert_array_equal(
            here["joint_angle"].sel(joint="hip"), signals["joint_angle"][:, k, 1]
        )
    np.testing.assert_array_equal(data["phi"].sel(relation="13"), signals["phi"][:, 1])
    np.testing.assert_array_equal(data["rpy"].sel(angle="yaw"), signals["rpy"][:, 2])
    assert data["foot_force"].attrs["units"] == "N" and data["time"].attrs["units"] == "s"
    assert data["joint_angle"].attrs["positive"].startswith("0 in the reference pose")
    assert data.attrs["robot"] == "lilibot"


@pytest.mark.parametrize("robot", ["lilibot", "hexapod"])
def test_dataset_holds_every_signal_of_a_walk(robot: str) -> None:
    pytest.importorskip("xarray")
    record = simulate(Experiment(robot=robot, duration=0.5, engine="compiled"))
    data = record.to_xarray()
    shown = {v.name for v in TABLE if v.causality is not Causality.parameter}
    assert set(data) == shown | {signal.name for signal in PLANT_SIGNALS}
    assert data.sizes["leg"] == len(record.legs) and data["phi"].dims == ("time", "relation")


@pytest.mark.parametrize(("package", "convert"), [("pandas", "to_pandas"), ("xarray", "to_xarray")])
def test_a_missing_package_is_named_in_one_line(
    package: str, convert: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    find_spec = importlib.util.find_spec
    monkeypatch.setattr(
        "apnc.loop.tables.find_spec", lambda name: None if name == package else find_spec(name)
    )
    with pytest.raises(ValueError) as error:
        getattr(RECORD, convert)()
    assert str(error.value) == missing(package, "study")


def test_no_import_of_a_record_needs_pandas(monkeypatch: pytest.MonkeyPatch) -> None:
    real = builtins.__import__

    def without(name: str, *more: Any, **how: Any) -> Any:
        assert name.partition(".")[0] not in ("pandas", "xarray")
        return real(name, *more, **how)

    monkeypatch.setattr(builtins, "__import__", without)
    assert "<table>" in RECORD._repr_html_()


def shown(record: Record) -> str:
    return record._repr_html_().replace(" style='text-align: left'", "")


def test_html_shows_what_was_run_and_what_came_of_it() -> None:
    walk = synthetic_record(3.0)
    steps = ((0.0, 0.08), (2.0, 0.2))
    text = shown(replace(walk, experiment=replace(walk.experiment, mi=steps)))
    for name, value in {
        "robot": "lilibot",
        "controller": "apnc",
        "MI": "0:0.08,2:0.2",
        "end": "complete",
        "duration": "3 s",
        "gait": "trot",
    }.items():
        assert f"<tr><th>{name}</th><td>{value}</td></tr>" in text
    robot = replace(walk.robot, name="<b>")
    broken = replace(walk, robot=robot, end=End.diverged, message="faster than 100 m/s")
    assert "<td>&lt;b&gt;</td>" in shown(broken)
    assert "<td>diverged, faster than 100 m/s</td>" in shown(broken)
    assert "<th>gait</th><td>none known</td>" in shown(walk[:0])

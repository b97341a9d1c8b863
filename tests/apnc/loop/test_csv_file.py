"""``record.csv`` read back."""

from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path

import numpy as np
from records import synthetic_record

from apnc.loop.csv_file import write_csv


def test_every_column_holds_what_its_name_says(tmp_path: Path) -> None:
    made_up, random = synthetic_record(0.5), np.random.default_rng(1)
    signals = {name: random.random(values.shape) for name, values in made_up.signals.items()}
    write_csv(replace(made_up, signals=signals), tmp_path / "record.csv")
    with (tmp_path / "record.csv").open(newline="") as file:
        header, *rows = csv.reader(file)
    found = dict(zip(header, np.array(rows, float).T, strict=True))
    expected = {"time": made_up.time, "d": signals["d"], "MI": signals["MI"]}
    for k, relation in enumerate(("12", "13", "14")):
        expected[f"phi{relation}"] = signals["phi"][:, k]
        expected[f"phi_memory{relation}"] = signals["phi_memory"][:, k]
    for k, leg in enumerate(("RF", "RH", "LF", "LH")):
        expected[f"{leg}.o1"] = signals["o1"][:, k]
        expected[f"{leg}.grf"] = signals["grf"][:, k]
        for j, joint in enumerate(("abduction", "hip", "knee")):
            expected[f"{leg}.joint_angle.{joint}"] = signals["joint_angle"][:, k, j]
        for j, axis in enumerate("xyz"):
            expected[f"{leg}.foot_force.{axis}"] = signals["foot_force"][:, k, j]
    for j, (axis, turn) in enumerate(zip("xyz", ("roll", "pitch", "yaw"), strict=True)):
        expected[f"position.{axis}"] = signals["position"][:, j]
        expected[f"rpy.{turn}"] = signals["rpy"][:, j]
    for name, values in expected.items():
        assert np.allclose(found[name], values, rtol=1e-8, atol=0.0), name


def test_a_record_without_samples_is_the_line_of_names(tmp_path: Path) -> None:
    write_csv(synthetic_record(0.0), tmp_path / "record.csv")
    (names,) = (tmp_path / "record.csv").read_text().splitlines()
    assert names.startswith("time,")

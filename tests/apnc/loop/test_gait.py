"""Learned gaits as files, and that they bring a gait back without load feedback."""

from __future__ import annotations

import json
import math
import re
from pathlib import Path

import numpy as np
import pytest

from apnc import Experiment, simulate, write_report
from apnc.loop import gait
from apnc.loop.gait import Gait, GaitError, gait_of_run, read_gait, write_gait

GAIT = Gait(("RF", "RH", "LF", "LH"), (3.37, 3.2, 0.18))


SETTINGS = GAIT.settings(GAIT.legs)


def walked(experiment: Experiment) -> tuple[np.ndarray, float]:
    """Relative phases over the last second [rad] and distance [m]."""
    record = simulate(experiment)
    start, end = record.signals["position"][[0, -1], :2]
    return record.signals["phi"][-60:], float(np.linalg.norm(end - start))


def test_a_stored_gait_comes_back_without_feedback_and_walks() -> None:
    phi, distance = walked(Experiment(mi=0.15, duration=12, conditions="S3", settings=SETTINGS))
    assert np.abs(phi - np.array([math.pi, math.pi, 0.0])).max() < 0.3
    blank_phi, blank_distance = walked(Experiment(mi=0.15, duration=12, conditions="S3"))
    assert np.abs(blank_phi).max() < 0.3  # all legs in phase: it rocks in place
    assert distance > 10 * blank_distance


def test_a_gait_of_other_legs_is_refused() -> None:
    with pytest.raises(GaitError, match="of legs RF, RH, LF, LH; the robot has RF, LF, RH, LH"):
        GAIT.settings(("RF", "LF", "RH", "LH"))


def test_round_trip(tmp_path: Path) -> None:
    write_gait(GAIT, tmp_path / "gait.json")
    assert read_gait(tmp_path / "gait.json") == GAIT


def test_gait_of_a_run_is_what_the_couplings_hold(tmp_path: Path) -> None:
    write_report(simulate(Experiment(duration=2, settings=SETTINGS)), tmp_path)
    assert gait_of_run(tmp_path) == GAIT


def test_a_run_without_a_stored_gait_is_refused(tmp_path: Path) -> None:
    write_report(simulate(Experiment(duration=1)), tmp_path)
    with pytest.raises(GaitError, match="no gait was stored in this run"):
        gait_of_run(tmp_path)


HEAD = "RF.o1,LF.o1,phi_memory12,kappa\n"


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (f"{HEAD}0,0,3.1,1\n0,0,3.1\n", "record.csv, line 3: 3 values, where the first line has 4"),
        (f"{HEAD}0,0,3.1,1,7\n0,0,3.1,1\n", "record.csv, line 2: 5 values, where the first"),
        (f"{HEAD}0,0,3.1,1\n0,0,3.1,1e\n", "record.csv, line 3: could not convert string to float"),
        (f"{HEAD}0,0,3.1,\n", "record.csv, line 2: could not convert string to float: ''"),
        (f'{HEAD}0,0,3.1,"1\n', "record.csv, line 2: unexpected end of data"),
        (f"{HEAD}0,0,3.1,1\n".encode() + b"0,\xff,3.1,1\n", "record.csv, line 3: no text"),
        (f"{HEAD}0,0,3.1,1\n".encode("utf-16"), "record.csv, line 1: no text"),
        (HEAD, "record.csv is not the record of a walk"),
        ("", "record.csv is not the record of a walk"),
        ("a,b\n1,2\n", "record.csv is not the record of a walk"),
        ("RF.o1,LF.o1,phi_memory13,kappa\n0,0,3.1,1\n", "record.csv is not the record of a walk"),
        (f"{HEAD}0,0,99,1\n", "phi[1] is 99.0; allowed: a finite number from -7 to 7 [rad]"),
    ],
)
def test_a_damaged_or_foreign_record_is_named_with_its_line(
    content: str | bytes, words: str, tmp_path: Path
) -> None:
    path = tmp_path / "record.csv"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(GaitError, match=re.escape(words)) as caught:
        gait_of_run(tmp_path)
    assert "\n" not in str(caught.value)


def test_a_small_record_gives_its_gait(tmp_path: Path) -> None:
    (tmp_path / "record.csv").write_text(f"{HEAD}0,0,0,0\n0,0,3.1,1\n\n")
    assert gait_of_run(tmp_path) == Gait(("RF", "LF"), (3.1,))


def changed(**changes: object) -> str:
    content = {"format": "apnc-gait", "version": 1, "unit": "rad", "legs": ["RF"], "phi": []}
    return json.dumps(content | changes)


def signed(**changes: object) -> str:
    content = json.loads(changed(**changes))
    return json.dumps(content | {"sha256": gait._checksum(content)})


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{", "not readable as JSON"),
        ("[1, 2]", "gait file .*: not a table"),
        ('{"format": "other"}', "format is 'other'; allowed: apnc-gait"),
        (changed(version=2), "version is 2; allowed: 1"),
        (changed(), "sha256 is missing"),
        (changed(sha256="0" * 64), "checksum does not fit"),
        ("[" * 100_000, "not readable as JSON"),
        (signed(legs=["RF", 5], phi=[1.0]), r"gait\.json: legs\[2\] is 5; allowed: a text"),
        (
            signed(legs=["RF", "LF"], phi=["x"]),
            r"gait\.json: phi\[1\] is 'x'; allowed: a finite number from -7 to 7 \[rad\]",
        ),
        (
            signed(legs=["RF", "LF"], phi=1.0),
            r"gait\.json: phi is 1\.0; allowed: a list of finite numbers",
        ),
        (signed(legs="RF"), r"gait\.json: legs is 'RF'; allowed: a list of texts"),
    ],
)
def test_foreign_and_damaged_files_are_refused(text: str, words: str, tmp_path: Path) -> None:
    path = tmp_path / "gait.json"
    path.write_text(text)
    with pytest.raises(GaitError, match=words):
        read_gait(path)


def test_one_changed_digit_is_noticed(tmp_path: Path) -> None:
    path = tmp_path / "gait.json"
    write_gait(GAIT, path)
    path.write_text(path.read_text().replace("3.37", "3.38"))
    with pytest.raises(GaitError, match="damaged"):
        read_gait(path)


def test_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(GaitError, match=r"no\.json: cannot be read"):
        read_gait(tmp_path / "no.json")


@pytest.mark.parametrize(
    ("phi", "words"),
    [((1.0,), "1 relations do not fit 4 legs"), ((1.0, math.nan, 0.0), r"phi\[2\] is nan"),
     ((1.0, 2.0, 99.0), r"phi\[3\] is 99\.0")],
)  # fmt: skip
def test_unusable_relations_are_refused(phi: tuple[float, ...], words: str) -> None:
    with pytest.raises(GaitError, match=words):
        Gait(GAIT.legs, phi)


def test_the_folder_of_a_walk_is_told_how_to_become_a_gait_file(tmp_path: Path) -> None:
    with pytest.raises(GaitError, match=r"is a folder; apnc gait save .* gait\.json makes"):
        read_gait(tmp_path)

"""The step-size study: what it measures, and what it writes."""

import csv
import math
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest
from apnc.studies.contact_study import chatter, run

from apnc.studies import contact_study


def test_chatter_is_the_share_of_loaded_steps_that_turn_round() -> None:
    forces = np.zeros((102, 1, 3))
    forces[:, 0, 2] = 5.0
    assert chatter(forces) == 0.0
    forces[::2, 0, 0] = 1.0
    assert chatter(forces) == 1.0
    forces[51:, 0, 2] = 0.0
    forces[:51, 0, 0] = 0.0
    assert chatter(forces) == 0.0


def test_the_study_writes_a_table_and_a_picture(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(contact_study, "STEPS_PER_TICK", (16, 32, 64))
    monkeypatch.setattr(contact_study, "CLOSED_LOOP", 10.0)
    shares: list[float] = []
    run(tmp_path, shares.append)
    with (tmp_path / "contact.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 6
    assert shares == pytest.approx([k / 6 for k in range(1, 7)])
    gradual = rows[:3]
    assert [float(row["step_ms"]) for row in gradual] == pytest.approx(
        [1e3 / 60 / n for n in (16, 32, 64)], rel=1e-4
    )
    errors = [float(row["force_error"]) for row in gradual]
    assert errors[0] > errors[1] > errors[2] == 0.0
    assert float(gradual[0]["chatter"]) > 10 * float(gradual[1]["chatter"])
    assert float(gradual[1]["chatter"]) < 0.01
    assert all(math.isfinite(float(row["cost_of_transport"])) for row in gradual)
    svg = ElementTree.parse(tmp_path / "contact.svg").getroot()
    lines = svg.findall("{http://www.w3.org/2000/svg}polyline")
    assert len(lines) == 8

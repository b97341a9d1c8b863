"""Regression values: how Exudyn moves Lilibot, of one version of it and not of theory.

The robot is the one of the tests, which stays as it is when the shipped one changes.
"""

from __future__ import annotations

from importlib.metadata import version

import numpy as np
import pytest
from full_robot import full_robot

from exudyn_models.plant import ExudynPlant

MEASURED_WITH = "1.13.6"
"""Version of Exudyn that gave the values."""

POSITION = (0.048058858455750, 0.008464384429955, 0.147940683789351)
HIPS = (0.149673060000052, -0.125519362054488, -0.112314322628183, 0.128139829028665)


def test_half_a_second_is_as_it_was_to_twelve_digits() -> None:
    """Other processors differ in the last bits only. Look into what changed before new values."""
    plant = ExudynPlant(full_robot(), seed=1)
    for tick in range(30):
        hip = 0.2 * np.sin(0.3 * tick + np.array([0.0, np.pi, np.pi, 0.0]))
        knee = 0.1 * np.cos(0.3 * tick + np.array([0.0, np.pi, np.pi, 0.0]))
        plant.advance(hip, knee, 1 / 60)
    sample = plant.sample()
    words = f"measured with Exudyn {MEASURED_WITH}, this is {version('exudyn')}"
    assert sample["position"].tolist() == pytest.approx(POSITION, rel=0.0, abs=1e-12), words
    assert sample["joint_angle"][:, 1].tolist() == pytest.approx(HIPS, rel=0.0, abs=1e-12), words

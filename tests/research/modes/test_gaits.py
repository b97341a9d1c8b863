"""Names of gaits and of their mirror images."""

from __future__ import annotations

import numpy as np
import pytest

from apnc import metrics
from research.modes.gaits import CANDIDATES, gait_of, mirrored


@pytest.mark.parametrize(("n", "name"), [(n, name) for n in (4, 6, 8) for name in CANDIDATES[n]])
def test_a_gait_and_its_mirror_image_have_one_name(n: int, name: str) -> None:
    gait = np.array(CANDIDATES[n][name]) + 0.2
    assert gait_of(gait) == gait_of(mirrored(gait)) == name
    np.testing.assert_allclose(metrics.wrap(mirrored(mirrored(gait)) - gait), 0.0, atol=1e-12)


def test_a_gait_without_a_name() -> None:
    assert gait_of([0.5 * np.pi, 0.0, 0.5 * np.pi]) == "other"

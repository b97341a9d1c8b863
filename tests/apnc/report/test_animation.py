"""The ground of the animation lies where the robot walks, however large robot and path are."""

from __future__ import annotations

import numpy as np
import pytest

from apnc.report.animation import AREA, ground_lines
from apnc_core.types import Array
from apnc_plant.ground import Ground, Obstacles, Plane

PATH = np.column_stack([np.linspace(0.0, 9.5, 400), np.linspace(0.0, 1.0, 400), np.full(400, 0.5)])


def corners(ground: Ground, path: Array, reach: float) -> tuple[Array, Array]:
    lines = np.concatenate(list(ground_lines(ground, path, reach).values()))
    return np.nanmin(lines[:, :2], axis=0), np.nanmax(lines[:, :2], axis=0)


@pytest.mark.parametrize("reach", [1.5, 5.4])
def test_a_plane_lies_under_all_of_a_path(reach: float) -> None:
    low, high = corners(Plane(), PATH, reach)
    assert (low <= PATH[:, :2].min(axis=0) - 0.9 * reach).all()
    assert (high >= PATH[:, :2].max(axis=0) + 0.9 * reach).all()


def test_uneven_ground_reaches_less_far_before_it_leaves_the_path() -> None:
    low, high = corners(Obstacles(roughness=0.5), PATH, 5.4)
    assert (low <= PATH[:, :2].min(axis=0)).all() and (high >= PATH[:, :2].max(axis=0)).all()
    assert np.prod(high - low) <= 1.1 * AREA


def test_uneven_ground_of_a_very_long_path_lies_around_its_end() -> None:
    path = PATH * [30.0, 1.0, 1.0]
    low, high = corners(Obstacles(roughness=0.5), path, 1.5)
    assert (low <= path[-1, :2]).all() and (high >= path[-1, :2]).all()
    assert np.prod(high - low) <= 1.1 * AREA

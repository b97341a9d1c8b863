"""Loads and patterns of a rigid trunk on compliant legs, in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from research.modes.stance import Stance, patterns

K = 3000.0
WEIGHT = 36.0


def stance(widths: tuple[float, ...], k: tuple[float, ...] | None = None) -> Stance:
    """Pairs of legs 0.1 m apart, each pair as far from the middle as its width [m]."""
    along = 0.1 * (np.arange(len(widths))[::-1] - (len(widths) - 1) / 2)
    x, y = np.tile(along, 2), np.concatenate([-np.array(widths), widths])
    stiffness = np.tile(k if k else (K,) * len(widths), 2)
    return Stance(x, y, stiffness, lag=0.05, weight=WEIGHT)


@pytest.mark.parametrize("n_legs", [4, 6, 8])
def test_patterns_are_orthonormal(n_legs: int) -> None:
    basis = np.array(list(patterns(n_legs).values()))
    np.testing.assert_allclose(basis @ basis.T, np.eye(n_legs), atol=1e-12)


def test_the_trunk_follows_heave_pitch_and_roll_and_nothing_else() -> None:
    found = stance((0.07, 0.07, 0.07, 0.07)).loads()
    np.testing.assert_allclose(np.linalg.eigvalsh(found), [0, 0, 0, K, K, K, K, K], atol=1e-9)
    for name in ("heave", "pitch", "roll"):
        np.testing.assert_allclose(found @ patterns(8)[name], 0.0, atol=1e-9)


def test_of_four_legs_the_trunk_cannot_follow_the_warp_alone() -> None:
    warp = patterns(4)["warp"]
    np.testing.assert_allclose(warp, [0.5, -0.5, -0.5, 0.5])
    np.testing.assert_allclose(stance((0.07, 0.07)).loads(), K * np.outer(warp, warp), atol=1e-9)


@pytest.mark.parametrize("ratio", [1.0, 2.0, 3.0])
def test_a_tripod_is_a_pure_load_pattern_if_the_middle_stands_twice_as_wide(ratio: float) -> None:
    tripod = np.array([1.0, -1.0, 1.0, -1.0, 1.0, -1.0])
    loaded = stance((0.05, 0.05 * ratio, 0.05)).loads() @ tripod
    # the part of the pattern that is roll, (2 - r)^2 / (2 + r^2) of 6, the trunk follows
    followed = (2.0 - ratio) ** 2 / (2.0 + ratio**2) / 3.0
    np.testing.assert_allclose(tripod @ loaded / 6.0, K * (1.0 - followed), rtol=1e-12)
    if ratio == 2.0:
        np.testing.assert_allclose(loaded, K * tripod, rtol=1e-12)


def test_bend_of_legs_of_unequal_stiffness() -> None:
    bend = np.array([1.0, -2.0, 1.0, 1.0, -2.0, 1.0])
    found = stance((0.06, 0.06, 0.06), (K, 3 * K, K)).loads() @ bend
    # in series: 1, -2, 1 loads three springs per side, f = 6 / (1/k + 4/(3k) + 1/k) (1, -2, 1)
    np.testing.assert_allclose(found, 6.0 / (2.0 / K + 4.0 / (3.0 * K)) * bend, rtol=1e-12)


def test_a_tripod_carries_a_third_each_if_the_middle_stands_twice_as_wide() -> None:
    np.testing.assert_allclose(
        stance((0.05, 0.10, 0.05)).carried([0, 2, 4]), [12, 0, 12, 0, 12, 0], atol=1e-9
    )
    np.testing.assert_allclose(
        stance((0.05, 0.05, 0.05)).carried([0, 2, 4]), [9, 0, 9, 0, 18, 0], atol=1e-9
    )


def test_legs_that_cannot_carry_are_refused() -> None:
    with pytest.raises(ValueError, match="2 legs do not carry a trunk"):
        stance((0.05, 0.05)).carried([0, 3])
    with pytest.raises(ValueError, match="not over these feet"):
        stance((0.05, 0.05, 0.05)).carried([0, 1, 3])

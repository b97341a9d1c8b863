"""Numbers by chance: their distribution and independence, and what is made of them.

That the generator gives the published answers is tested beside the C sources.
"""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from plants import Kind, in_both
from scipy.stats import kstest

from apnc_plant.chance import LARGEST_SEED, checked_seed, side_offset
from apnc_plant.compiled import CompiledPlant
from apnc_plant.library import library
from apnc_plant.robot import load_robot

N = 20000
ROBOT = load_robot("lilibot")


def uniform(seed: int, purpose: int, count: int = N) -> np.ndarray:
    _, lib = library()
    return np.array([lib.plant_uniform(seed, purpose, index) for index in range(count)])


def normal(seed: int, purpose: int, count: int = N) -> np.ndarray:
    _, lib = library()
    return np.array([lib.plant_normal(seed, purpose, index) for index in range(count)])


def test_uniform_numbers_are_uniform() -> None:
    numbers = uniform(1, 2)
    assert 0.0 <= numbers.min() < 1e-3
    assert 1.0 - 1e-3 < numbers.max() < 1.0
    assert kstest(numbers, "uniform").pvalue > 0.01
    assert numbers.mean() == pytest.approx(0.5, abs=4 * math.sqrt(1 / 12 / N))


def test_normal_numbers_are_normal() -> None:
    numbers = normal(1, 2)
    assert kstest(numbers, "norm").pvalue > 0.01
    assert numbers.mean() == pytest.approx(0.0, abs=4 / math.sqrt(N))
    assert numbers.var() == pytest.approx(1.0, abs=4 * math.sqrt(2 / N))
    assert (numbers**4).mean() == pytest.approx(3.0, abs=4 * math.sqrt(96 / N))
    assert 3.5 < np.abs(numbers).max() < 6.0


@pytest.mark.parametrize("draw", [uniform, normal])
def test_seeds_purposes_and_neighbours_are_independent(draw: Any) -> None:
    _, lib = library()
    purposes = (lib.PLANT_RANDOM_BODY, lib.PLANT_RANDOM_SENSOR, lib.PLANT_RANDOM_GROUND)
    seeds = (0, 1, 2**32, LARGEST_SEED)
    rows = [draw(seed, purpose) for seed in seeds for purpose in purposes]
    rows += [np.roll(rows[0], shift) for shift in (1, 2, 3, 4)]
    rows += [row**2 for row in rows]
    size = len(rows) // 2
    correlation = np.corrcoef(rows)
    own = np.eye(size, dtype=bool)
    for block in (correlation[:size, :size], correlation[size:, size:], correlation[:size, size:]):
        assert np.abs(block[~own]).max() < 5 / math.sqrt(N)


def test_a_body_leans_to_either_side_by_about_the_stated_amount() -> None:
    offsets = np.array([side_offset(ROBOT, seed) for seed in range(2000)])
    sizes = np.abs(offsets) / ROBOT.trunk.com_side_offset
    assert 0.75 <= sizes.min() < 0.76
    assert 1.24 < sizes.max() <= 1.25
    assert np.sum(offsets > 0.0) == pytest.approx(1000, abs=4 * math.sqrt(500))
    assert abs(np.corrcoef(sizes, offsets > 0.0)[0, 1]) < 0.09


@pytest.mark.parametrize("seed", [-1, 2**64, 0.5, True, "1", None])
def test_other_seeds_are_refused_in_one_line(seed: object) -> None:
    words = r"allowed: a whole number from 0 to 2\^64 - 1$"
    with pytest.raises(ValueError, match=words):
        checked_seed(seed)
    with pytest.raises(ValueError, match=words):
        CompiledPlant(ROBOT, seed)  # type: ignore[arg-type]


def test_any_whole_number_is_a_seed() -> None:
    assert checked_seed(np.int64(3)) == 3
    last = CompiledPlant(ROBOT, LARGEST_SEED)
    last.advance(np.zeros(4), np.zeros(4), 1 / 60)
    assert (last.grf() != CompiledPlant(ROBOT, 0).grf()).any()


@in_both
def test_the_centre_of_mass_is_off_to_either_side_by_the_stated_amount(kind: Kind) -> None:
    # Moments about the x axis: the trunk's offset is all that makes left and right differ.
    quiet = replace(ROBOT, trunk=replace(ROBOT.trunk, com_side_offset=0.004))
    offsets = []
    for seed in range(8):
        plant = kind(quiet, seed)
        for _ in range(90):
            plant.advance(np.zeros(4), np.zeros(4), 1 / 60)
        sample = plant.sample()
        force, foot = sample["foot_force"], sample["foot_position"] - sample["position"]
        ground = foot - [0.0, 0.0, ROBOT.contact.foot_radius]
        moment = (ground[:, 1] * force[:, 2] - ground[:, 2] * force[:, 1]).sum()
        offsets.append(moment / (ROBOT.trunk.mass * 9.81))
    sizes = np.abs(offsets) / 0.004
    assert 0.7 < sizes.min() < sizes.max() < 1.3
    assert 2 <= np.sum(np.array(offsets) > 0.0) <= 6
    assert np.ptp(sizes) > 0.1

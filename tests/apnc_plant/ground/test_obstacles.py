"""The paper's obstacles: height, size, place and share of the ground."""

import math

import numpy as np
import pytest

from apnc_plant.ground import Obstacles
from apnc_plant.ground.obstacles import STEP_HEIGHT, TILE


@pytest.mark.parametrize("roughness", [0.2, 1.0])
def test_obstacles_have_the_height_and_density_asked_for(roughness: float) -> None:
    ground = Obstacles(roughness=roughness, seed=3)
    balls = ground.obstacles()
    np.testing.assert_allclose(balls[:, 2] + balls[:, 3], roughness * STEP_HEIGHT, atol=1e-15)
    assert len(balls) == 960
    diameters = 2.0 * balls[:, 3]
    assert 0.03 <= diameters.min() < 0.031
    assert 0.099 < diameters.max() <= 0.1
    # Uniform: the mean of 960 diameters is within 4 standard errors of 65 mm.
    assert diameters.mean() == pytest.approx(0.065, abs=4 * 0.07 / math.sqrt(12 * 960))


def test_obstacles_cover_the_share_of_ground_that_chance_gives() -> None:
    # Caps of base radius a thrown at random leave free a share of exp(-density pi E[a^2]).
    ground = Obstacles(roughness=1.0, seed=7)
    balls = ground.obstacles()
    base = balls[:, 3] ** 2 - balls[:, 2] ** 2
    free = math.exp(-ground.density * math.pi * base.mean())
    points = np.random.default_rng(0).uniform(0.0, TILE, (4000, 1, 2))
    offset = points - balls[None, :, :2]
    offset -= TILE * np.round(offset / TILE)
    covered = ((offset**2).sum(axis=2) < base).any(axis=1).mean()
    assert covered == pytest.approx(1.0 - free, abs=0.03)


def test_obstacles_are_seeded() -> None:
    same, other = Obstacles(roughness=1.0, seed=1), Obstacles(roughness=1.0, seed=2)
    np.testing.assert_array_equal(same.obstacles(), Obstacles(roughness=1.0, seed=1).obstacles())
    assert not np.array_equal(same.obstacles(), other.obstacles())


def test_contacts_are_those_with_every_ball_one_by_one() -> None:
    ground, radius = Obstacles(roughness=1.0, seed=2, density=200.0), 0.012
    random = np.random.default_rng(0)
    several = 0
    for _ in range(200):
        place = np.append(random.uniform(-9.0, 9.0, 2), random.uniform(0.010, 0.025))
        away = place - ground.obstacles()[:, :3]
        away[:, :2] -= TILE * np.round(away[:, :2] / TILE)
        distance = np.linalg.norm(away, axis=1)
        depth = radius + ground.obstacles()[:, 3] - distance
        touched = depth > 0.0
        expected = np.column_stack([away / distance[:, None], depth])[touched]
        if place[2] < radius:
            expected = np.vstack([[0.0, 0.0, 1.0, radius - place[2]], expected])
        found = ground.contacts(place, radius)
        np.testing.assert_allclose(found, expected, atol=1e-12)
        several += len(found) > 1
    assert several > 10


def test_rough_ground_is_rough() -> None:
    # A walk's length meets obstacles that are as high as the roughness says, and no higher.
    x = np.linspace(0.0, 4.0, 400)
    for roughness in (0.2, 1.0):
        ground = Obstacles(roughness=roughness, seed=1)
        heights = np.array([ground.elevation(x, np.array(y)) for y in np.arange(0.0, 4.0, 0.25)])
        assert heights.max() == pytest.approx(roughness * STEP_HEIGHT, rel=0.05)
        base = ground.obstacles()[:, 3] ** 2 - ground.obstacles()[:, 2] ** 2
        share = 1.0 - math.exp(-ground.density * math.pi * base.mean())
        assert (heights > 0.0).mean() == pytest.approx(share, rel=0.25)
        assert heights.max() <= ground.top
    assert Obstacles(roughness=0.0).elevation(x, np.array(0.0)).max() == 0.0


def test_a_ball_comes_to_rest_on_the_highest_obstacle_below_it() -> None:
    ground, radius = Obstacles(roughness=1.0, seed=1), 0.012
    x, y, z, ball = ground.obstacles()[7]
    assert ground.rest_height(x + TILE, y, radius) >= z + ball + radius - 1e-12
    near = Obstacles(roughness=1.0, seed=1, density=0.1)
    x, y, z, ball = near.obstacles()[0]
    beside = math.sqrt((ball + radius) ** 2 - 0.01**2) + z
    assert near.rest_height(x + 0.006, y - 0.008, radius) == pytest.approx(max(beside, radius))


def test_the_drawing_shows_every_obstacle_that_is_there() -> None:
    ground = Obstacles(roughness=1.0, seed=1)
    lines = ground.lines(3.0, 5.0, -1.0, 1.0)
    points = np.vstack([line for line in lines if len(line) in (9, 17)])
    x, y, z = points.T
    assert z.max() == pytest.approx(ground.top)
    over = ground.elevation(x, y) - z
    assert over.min() > -1e-9
    # Nothing but overlapping caps hides a point of a drawn cap.
    assert np.median(np.abs(over)) < 1e-9
    shown = {tuple(np.round(line[:16].mean(axis=0)[:2], 9)) for line in lines if len(line) == 17}
    places = ground.obstacles()[:, :2]
    wrapped = [places + TILE * np.array([i, j]) for i in (0, 1) for j in (-1, 0)]
    inside = [p for p in np.vstack(wrapped) if 3.0 <= p[0] <= 5.0 and -1.0 <= p[1] <= 1.0]
    assert shown == {tuple(np.round(p, 9)) for p in inside}


@pytest.mark.parametrize(
    ("values", "message"),
    [
        ({"slope": 1.6}, "slope is 1.6"),
        ({"slope": math.nan}, "slope is nan"),
        ({"roughness": -0.1}, "roughness is -0.1"),
        ({"roughness": 1.1}, "roughness is 1.1"),
        ({"seed": -1}, "seed is -1"),
        ({"density": 0.0}, "density is 0"),
        ({"diameters": (0.02, 0.1)}, r"diameters is \(0.02"),
        ({"diameters": (0.1, 0.05)}, r"diameters is \(0.1"),
    ],
)
def test_ground_out_of_range_is_refused(values: dict[str, object], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        Obstacles(**values)  # type: ignore[arg-type]


def test_a_scale_is_of_every_length() -> None:
    small, large = (Obstacles(roughness=0.6, seed=4, scale=scale) for scale in (1.0, 2.0))
    assert large.top == pytest.approx(2.0 * 0.6 * STEP_HEIGHT)
    radii, larger = (np.sort(ground.obstacles()[:, 3]) for ground in (small, large))
    assert len(radii) == pytest.approx(4 * len(larger), abs=2)  # as much of the ground is covered
    for share in (0.0, 0.5, 1.0):
        assert np.quantile(larger, share) == pytest.approx(2.0 * np.quantile(radii, share), rel=0.1)
    assert larger.min() >= 0.03 and larger.max() <= 0.1
    x = np.linspace(0.0, 4.0, 400)
    assert np.max(large.elevation(x, x)) == pytest.approx(large.top, rel=0.2)


@pytest.mark.parametrize("scale", [0.0, -1.0, 10.1])
def test_a_scale_that_no_field_has_is_refused(scale: float) -> None:
    with pytest.raises(ValueError, match=r"scale.* above 0, up to 10"):
        Obstacles(scale=scale)

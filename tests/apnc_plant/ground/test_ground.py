"""What holds for every ground, and how grounds are written and read."""

import json
import math

import numpy as np
import pytest
from grounds import TOUCHED, WALKED

from apnc_plant.ground import (
    GROUNDS,
    Ground,
    Kerb,
    Obstacles,
    Plane,
    Waves,
    from_dict,
    parse_ground,
)

RADIUS = 0.012
every_ground = pytest.mark.parametrize("ground", TOUCHED, ids=repr)


@pytest.mark.parametrize("tested", [TOUCHED, WALKED], ids=["touched", "walked"])
def test_every_kind_of_ground_is_tested(tested: tuple[Ground, ...]) -> None:
    assert {ground.kind for ground in tested} == set(GROUNDS)


def places(count: int, seed: int = 0) -> np.ndarray:
    return np.random.default_rng(seed).uniform(-0.3, 0.3, (count, 2))


@every_ground
def test_nothing_is_higher_than_the_bound(ground: Ground) -> None:
    x, y = places(2000).T
    height = ground.elevation(x, y)
    assert height.shape == (2000,)
    assert height.max() <= ground.top
    for x, y in places(200):
        assert len(ground.contacts((x, y, RADIUS + ground.top), RADIUS)) == 0


@every_ground
def test_a_point_touches_below_the_surface_and_not_above(ground: Ground) -> None:
    for x, y in places(300):
        height = float(ground.elevation(np.array(x), np.array(y)))
        assert len(ground.contacts((x, y, height - 1e-6), 0.0)) > 0
        assert len(ground.contacts((x, y, height + 1e-6), 0.0)) == 0


@every_ground
def test_a_ball_at_its_rest_height_just_touches(ground: Ground) -> None:
    for x, y in places(100):
        rest = ground.rest_height(x, y, RADIUS)
        above = ground.contacts((x, y, rest + 1e-9), RADIUS)
        below = ground.contacts((x, y, rest - 1e-6), RADIUS)
        assert len(above) == 0
        assert 0.0 < below[:, 3].max() <= 1e-6 + 1e-12
        np.testing.assert_allclose(np.linalg.norm(below[:, :3], axis=1), 1.0)


@every_ground
def test_lines_lie_in_the_corners_and_on_the_ground(ground: Ground) -> None:
    lines = ground.lines(-0.3, 0.3, -0.2, 0.2)
    if isinstance(ground, Obstacles):
        lines = [line for line in lines if len(line) == 2]
    points = np.vstack(lines)
    assert all(line.ndim == 2 and line.shape[1] == 3 and len(line) >= 2 for line in lines)
    np.testing.assert_allclose(points[:, :2].min(axis=0), [-0.3, -0.2])
    np.testing.assert_allclose(points[:, :2].max(axis=0), [0.3, 0.2])
    if not isinstance(ground, Kerb | Obstacles):
        np.testing.assert_allclose(points[:, 2], ground.elevation(*points[:, :2].T))


def test_the_normal_of_a_slope_leans_back() -> None:
    rotation = Plane(slope=0.3).rotation()
    np.testing.assert_allclose(rotation[:, 2], [-math.sin(0.3), 0.0, math.cos(0.3)])
    np.testing.assert_allclose(rotation[:, 0], [math.cos(0.3), 0.0, math.sin(0.3)])
    np.testing.assert_allclose(rotation @ rotation.T, np.eye(3), atol=1e-15)


def test_grounds_are_known_by_kind() -> None:
    assert {"plane": Plane, "obstacles": Obstacles, "kerb": Kerb, "waves": Waves} == GROUNDS
    assert [Plane().flat, Obstacles().flat, Obstacles(roughness=0.1).flat] == [True, True, False]
    assert not Kerb().flat
    assert not Waves().flat


@every_ground
def test_a_ground_is_the_same_after_writing_and_reading(ground: Ground) -> None:
    assert from_dict(json.loads(json.dumps(ground.to_dict()))) == ground
    assert parse_ground(ground.text()) == ground


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("plane", Plane()),
        ("kerb:at=0.5,height=0.006", Kerb(at=0.5, height=0.006)),
        (" waves : amplitude = 0.002 , wavelength=1", Waves(amplitude=0.002, wavelength=1.0)),
        (
            "obstacles:roughness=0.5,seed=2,diameters=0.03:0.05",
            Obstacles(roughness=0.5, seed=2, diameters=(0.03, 0.05)),
        ),
        ("obstacles:seed=2.0", Obstacles(seed=2)),
    ],
)
def test_a_ground_in_words(text: str, expected: Ground) -> None:
    assert parse_ground(text) == expected


def test_words_leave_out_what_is_the_default() -> None:
    assert Plane().text() == "plane"
    assert Kerb(height=0.008).text() == "kerb:height=0.008"
    assert Obstacles(diameters=(0.03, 0.05)).text() == "obstacles:diameters=0.03:0.05"


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("sand", "ground 'sand' is not one of plane, obstacles, kerb, waves"),
        ("kerb:hight=0.1", "ground 'kerb' has no 'hight'; it has slope, at, height, length"),
        ("kerb:at=near", "ground 'kerb': at is 'near'; allowed: a finite number"),
        ("kerb:at=", "at is ''"),
        ("kerb:at=true", "at is True"),
        ("kerb:at=NaN", "at is nan"),
        ("kerb:height=-0.1", r"ground 'kerb': height is -0.1; allowed: above 0, up to 1 \[m\]"),
        ("obstacles:seed=1.5", "seed is 1.5; allowed: a whole number"),
        ("obstacles:diameters=0.05", "diameters is 0.05; allowed: 2 numbers"),
        ("obstacles:diameters=0.05:x", "diameters is 'x'"),
    ],
)
def test_words_that_say_no_ground_are_refused_in_one_line(text: str, message: str) -> None:
    with pytest.raises(ValueError, match=message) as caught:
        parse_ground(text)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("kind", "values", "message"),
    [
        (Plane, {"slope": 1.6}, "slope is 1.6; allowed: less than a right angle"),
        (Kerb, {"at": math.inf}, "at is inf"),
        (Kerb, {"height": 0.0}, "height is 0.0"),
        (Kerb, {"height": 1.1}, "height is 1.1"),
        (Kerb, {"length": -0.1}, "length is -0.1"),
        (Waves, {"wavelength": 0.0}, "wavelength is 0.0"),
        (Waves, {"amplitude": -0.001}, "amplitude is -0.001"),
        (Waves, {"amplitude": 0.07, "wavelength": 0.2}, "amplitude is 0.07; allowed: from 0 to 0"),
    ],
)
def test_values_out_of_range_are_refused(
    kind: type[Ground], values: dict[str, float], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        kind(**values)

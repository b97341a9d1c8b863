"""Contacts with a kerb against plane geometry, and robots on it."""

import math

import numpy as np
import pytest
from plain_robot import plain_robot
from plants import Kind, commands, in_both, settled

from apnc_plant.ground import Kerb

H, R = 0.006, 0.012
ROBOT = plain_robot()
STEP = Kerb(at=0.5, height=H)
SILL = Kerb(at=0.5, height=H, length=0.1)


@pytest.mark.parametrize(
    ("x", "z", "expected"),
    [
        (0.3, R - 0.001, [[0, 0, 1, 0.001]]),
        (0.3, R, []),
        (0.7, R + H - 0.001, [[0, 0, 1, 0.001]]),
        (0.7, R + H, []),
        # at the face, its centre below the top: pushed back, and up by the plane
        (0.5 - 0.010, 0.005, [[0, 0, 1, R - 0.005], [-1, 0, 0, 0.002]]),
        # over the edge, 3-4-5: the edge pushes along the line to the centre
        (0.5 - 0.006, H + 0.008, [[-0.6, 0, 0.8, R - 0.010]]),
        (0.5 - 0.0096, H + 0.0072 + 1e-9, []),
        # with its centre in the kerb: out through the nearest face
        (0.5 + 0.001, 0.004, [[-1, 0, 0, R + 0.001]]),
        (0.5 + 0.003, 0.004, [[0, 0, 1, R + 0.002]]),
    ],
)
def test_a_ball_touches_plane_top_face_and_edge(
    x: float, z: float, expected: list[list[float]]
) -> None:
    found = STEP.contacts((x, -0.3, z), R)
    assert len(found) == len(expected)
    if expected:
        np.testing.assert_allclose(found, expected, atol=1e-15)


def test_a_sill_is_the_same_from_behind() -> None:
    for x, z in ((0.3, 0.011), (0.49, 0.005), (0.494, 0.014), (0.501, 0.004), (0.55, 0.016)):
        ahead, behind = SILL.contacts((x, 0.0, z), R), SILL.contacts((1.1 - x, 0.0, z), R)
        assert len(ahead) > 0
        np.testing.assert_allclose(behind, ahead * [-1, 1, 1, 1], atol=1e-15)


@pytest.mark.parametrize(
    ("x", "expected"),
    [
        (0.3, R),
        (0.5 - 0.011, H + math.sqrt(R**2 - 0.011**2)),
        (0.5 - 0.0072, H + 0.0096),
        (0.5, H + R),
        (0.55, H + R),
        (0.6 + 0.0072, H + 0.0096),
        (0.7, R),
    ],
)
def test_rest_height_over_a_sill(x: float, expected: float) -> None:
    # Where the ball would fit between face and plane it still meets the edge from above.
    assert SILL.rest_height(x, 0.2, R) == pytest.approx(max(R, expected), abs=1e-12)


def test_elevation_goes_up_and_down_again() -> None:
    x = np.array([0.4, 0.499, 0.5, 0.55, 0.6, 0.601])
    np.testing.assert_array_equal(SILL.elevation(x, np.zeros(6)), [0, 0, H, H, H, 0])
    np.testing.assert_array_equal(STEP.elevation(x, np.zeros(6)), [0, 0, H, H, H, H])


def test_lines_over_a_sill_have_square_corners() -> None:
    line = SILL.lines(0.4, 0.7, 0.1, 0.15)[0]
    np.testing.assert_array_equal(line[:, 1], 0.1)
    assert (np.diff(line[:, 0]) >= 0.0).all()
    corners = line[np.isin(line[:, 0], [SILL.at, SILL.end])]
    assert [0.5, 0.1, 0.0] in corners.tolist()
    assert [0.5, 0.1, H] in corners.tolist()
    # Flat pieces and faces only: no line cuts a corner.
    step = np.diff(line, axis=0)
    assert (np.minimum(np.abs(step[:, 0]), np.abs(step[:, 2])) == 0.0).all()


@in_both
def test_front_feet_stand_on_a_kerb_and_hind_feet_below_it(kind: Kind) -> None:
    plant = settled(kind, Kerb(at=0.0, height=0.006), ROBOT)
    sample = plant.sample()
    foot, force = sample["foot_position"], sample["foot_force"]
    assert force[:, 2].sum() == pytest.approx(ROBOT.weight, rel=1e-3)
    assert force[:, 2].min() > 1.0
    step = np.array([0.006, 0.0, 0.006, 0.0])
    sunk = step + ROBOT.contact.foot_radius - foot[:, 2]
    np.testing.assert_allclose(sunk, force[:, 2] / ROBOT.contact.stiffness, rtol=0.01)
    assert not plant.fell


@in_both
def test_a_walk_goes_over_a_kerb(kind: Kind) -> None:
    plant = kind(ROBOT, ground=Kerb(at=0.14, height=0.004))
    for tick in range(480):
        plant.advance(*commands(tick, knee=0.12), 1 / 60)
    for _ in range(60):
        plant.advance(np.full(4, -0.111), np.full(4, -0.039), 1 / 60)
    foot = plant.sample()["foot_position"]
    assert (foot[:, 0] > 0.16).all()
    assert (foot[:, 2] > 0.004 + ROBOT.contact.foot_radius - 0.002).all()
    assert not plant.fell

"""The plant in C does what its equations say, against Pinocchio and plain numpy."""

from __future__ import annotations

import numpy as np
import pytest
from c_plant import CPlant, lib, plane, random_robot
from c_plant_checks import CHECKS, accelerations, normals, philox, random_motion, uniforms
from rigid_body import BASE, RigidBody


@pytest.mark.parametrize("name", CHECKS)
def test_it_does_what_the_equations_say(name: str) -> None:
    CHECKS[name](lib())


@pytest.mark.parametrize("legs", [2, 4, 6, 8, 64])
def test_accelerations_are_those_of_pinocchio(legs: int) -> None:
    accelerations(lib(), legs, seeds=range(4 if legs > 8 else 20))


@pytest.mark.parametrize("rotor", [0.0, 0.5])
def test_without_and_with_large_rotors_too(rotor: float) -> None:
    accelerations(lib(), 4, servo={"reflected_inertia": rotor})


def test_in_the_air_only_gravity_changes_the_momentum() -> None:
    free = {"stiffness": 0.0, "damping": 0.0, "reflected_inertia": 1e-4}
    robot = random_robot(61, 6, servo=free)
    plant, body = CPlant(6), RigidBody(robot.at)
    plant.place(robot, plane())
    q, v = random_motion(np.random.default_rng(61), 6)
    before = body.momentum(q, v)
    step = 2.0**-26
    plant.put(q, v)
    plant.advance(step, step)
    rate = plant.accelerations()
    mass = body.mass_matrix(q)[0, 0]
    # by a central difference along the motion that our accelerations give
    h = 1e-5
    ends = [body.momentum(q + s * v + 0.5 * s * s * rate, v + s * rate) for s in (-h, h)]
    linear, angular = (np.subtract(b, a) / (2 * h) for a, b in zip(*ends, strict=True))
    np.testing.assert_allclose(linear, [0.0, 0.0, -mass * robot.at.gravity], atol=1e-6)
    np.testing.assert_allclose(angular, 0.0, atol=1e-6)
    assert np.abs(rate[BASE:]).max() > 10.0 and np.abs(before[1]).max() > 0.01


@pytest.mark.parametrize(
    ("counter", "key", "words"),
    [
        ((0,) * 4, (0,) * 2, "6627e8d5 e169c58d bc57ac4c 9b00dbd8"),
        ((2**32 - 1,) * 4, (2**32 - 1,) * 2, "408f276d 41c83b0e a20bc7c6 6d5451fd"),
        (
            (0x243F6A88, 0x85A308D3, 0x13198A2E, 0x03707344),
            (0xA4093822, 0x299F31D0),
            "d16cfe09 94fdcceb 5001e420 24126ea1",
        ),
    ],
)
def test_the_generator_here_gives_the_published_answers(
    counter: tuple[int, ...], key: tuple[int, int], words: str
) -> None:
    assert " ".join(f"{word:08x}" for word in philox(counter, key)) == words


@pytest.mark.parametrize("purpose", [1, 2, 3])
def test_numbers_by_chance_are_those_of_the_generator(purpose: int) -> None:
    for seed in (0, 7, 2**64 - 1):
        for index in (0, 1, 10, 2**33, 2**40 + 1):
            of = (seed, purpose, index)
            pair = (seed, purpose, index // 2)
            assert lib().plant_uniform(*of) == uniforms(*pair)[index % 2]
            assert lib().plant_normal(*of) == pytest.approx(normals(*pair)[index % 2], abs=1e-14)

"""What a plant in C must do, each a function of a loaded build: so faulty builds can be tried too.

All of them compare with Pinocchio and with the laws in plain numpy, see ``rigid_body``.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable
from typing import Any, Final

import numpy as np
from c_plant import (
    TICK,
    CPlant,
    Numbers,
    by_angle,
    changed,
    ffi,
    in_tree,
    kerb,
    mixed_robot,
    obstacles,
    plane,
    random_fields,
    random_robot,
    robot_of,
    same_bits,
    trot,
    waves,
    with_chains,
    with_joints,
)
from rigid_body import BASE, Expected, Joints, RigidBody

EXACT: Final = 1e-12
"""Greatest relative difference of two double computations of the same."""

QUIET: Final = {"delay": 0.0, "time_constant": 0.0, "noise": 0.0, "norm": 0}
Check = Callable[[Any], None]


def close(found: np.ndarray, expected: np.ndarray, bound: float = EXACT) -> None:
    """Equal but for a part of each value, and of the unit where that is less."""
    np.testing.assert_allclose(found, expected, rtol=bound, atol=bound)


def expected(
    lib: Any,
    body: RigidBody,
    ground: Numbers,
    q: np.ndarray,
    v: np.ndarray,
    *rest: Any,
    **more: Any,
) -> Expected:
    return Expected(body, lib, ffi(), ground.at, q, v, *rest, **more)


def random_motion(random: np.random.Generator, legs: int) -> tuple[np.ndarray, np.ndarray]:
    """Coordinates high up, the trunk turned at random, and speeds."""
    place = random.uniform([-1.0, -1.0, 9.0], [1.0, 1.0, 11.0])
    turns = random.uniform([-3.0, -1.2, -3.0], [3.0, 1.2, 3.0])
    q = np.concatenate([place, turns, random.uniform(-1.0, 1.0, 3 * legs)])
    return q, random.uniform(-3.0, 3.0, q.size)


def _robot(seed: int, legs: int, mixed: bool, **sections: Any) -> Numbers:
    """A random robot, for every other seed one whose joints have numbers of their own."""
    fields = changed(random_fields(np.random.default_rng(seed), legs), **sections)
    fields = with_joints(fields, seed) if seed % 2 else fields
    return robot_of(with_chains(fields, seed) if mixed else fields)


def accelerations(lib: Any, legs: int = 3, seeds: range = range(4), **sections: Any) -> None:
    """In the air, at any speeds: bodies, rotors, gravity, servos and what the joints have."""
    for mixed, seed in itertools.product((False, True), seeds):
        random = np.random.default_rng(seed)
        robot = _robot(seed, legs, mixed, **sections)
        plant, body = CPlant(legs, library=lib), RigidBody(robot.at)
        plant.place(robot, plane())
        q, v = random_motion(random, legs)
        if seed % 2:  # at some stops: moving in, and out faster than the spring pushes
            high = Joints(robot.at).high
            q[BASE::2] = high[::2] + random.uniform(-0.001, 0.007, high[::2].size)
        plant.put(q, v)
        step = 2.0**-20
        plant.advance(step, step)
        then = q + step * v
        acting = expected(lib, body, plane(), then, v, np.zeros(3 * legs))
        close(plant.accelerations(), body.accelerations(then, v, acting.force))


def grounds() -> dict[str, Numbers]:
    """One of every kind, some of them rising."""
    return {
        "plane": plane(),
        "slope": plane(0.2),
        "kerb": kerb(0.01, 0.01, slope=-0.1),
        "waves": waves(slope=0.1),
        "obstacles": obstacles(3),
    }


def _on_ground(lib: Any, ground: Numbers, seed: int, held: bool, norm: int, mixed: bool) -> int:
    """One step of a robot that moves on a ground; the feet that touched it."""
    legs, step, random = 5, 1 / 500, np.random.default_rng(seed)
    sensor = QUIET | {"norm": norm}
    robot = _robot(seed, legs, mixed, sensor=sensor)
    body = RigidBody(robot.at)
    plant = CPlant(legs, library=lib, contacts=ground.at.contacts if ground.at.kind else 0)
    plant.place(robot, ground, clearance=-0.03)
    stopping = step / foot_mass_of(body, plant, ground)
    np.testing.assert_allclose(lib.plant_foot_mass(plant.memory, 0), step / stopping, rtol=1e-10)
    q, v = plant.get()
    plant.conditions(held=held, held_at=0.015)
    pose = q[:BASE].copy()
    pose[2] += 0.015
    q[3:] += random.uniform(-0.05, 0.05, q.size - 3)
    v[:] = random.uniform(-0.5, 0.5, q.size)
    before = plant.sample()["work"].ravel()
    target = np.zeros(3 * legs)
    plant.put(q, v)
    plant.command(np.zeros(legs), np.zeros(legs))
    plant.advance(step, step)
    there = {"stopping": stopping, "held_at": pose if held else None}
    then = q + step * v
    acting = expected(lib, body, ground, then, v, target, **there)
    a = body.accelerations(then, v, acting.force)
    close(plant.accelerations(), a, 1e-11)
    work = plant.sample()["work"].ravel() - before
    done = np.abs(acting.torque * v[BASE:]) * step
    close(work, by_angle(robot.at, done, signed=False).ravel())
    v = v + 0.5 * step * a
    shown(plant, expected(lib, body, ground, then, v, target, **there), then, v, norm)
    return int((acting.load > 0.0).sum())


def shown(plant: CPlant, acting: Expected, q: np.ndarray, v: np.ndarray, norm: int) -> None:
    """Every signal of a sample is what its name says."""
    sample, robot = plant.sample(), acting.robot
    close(sample["position"], q[:3])
    close(sample["rpy"], q[[5, 4, 3]])
    close(sample["velocity"], v[:3])
    close(sample["angle"], by_angle(robot, q[BASE:]))
    close(sample["speed"], by_angle(robot, v[BASE:]))
    close(sample["torque"], by_angle(robot, acting.torque))
    close(sample["foot"], acting.foot)
    close(sample["force"], acting.push, 1e-11)
    load = np.linalg.norm(acting.push, axis=1) if norm else acting.load
    close(sample["grf"], load, 1e-11)


def foot_mass_of(body: RigidBody, plant: CPlant, ground: Numbers) -> float:
    """Least apparent mass of a foot along the ground at the start [kg]."""
    return foot_mass_at(body, plant.get()[0], ground.at.slope)


def foot_mass_at(body: RigidBody, q: np.ndarray, slope: float) -> float:
    """Least apparent mass of a foot along a ground, of a robot at coordinates [kg]."""
    body.move(q, np.zeros_like(q))
    along = np.array([[math.cos(slope), 0.0, math.sin(slope)], [0.0, 1.0, 0.0]])
    mass, least = body.mass_matrix(q), math.inf
    for k in range(body.robot.legs):
        jacobian = along @ body.foot_jacobian(k)[:3]
        mobility = jacobian @ np.linalg.solve(mass, jacobian.T)
        least = min(least, 1.0 / float(np.linalg.eigvalsh(mobility)[-1]))
    return least


def forces(lib: Any) -> None:
    """On every ground, held and free: contact, friction, suspension, work, every signal."""
    for ground in grounds().values():
        for mixed in (False, True):
            touching = 0
            for seed in range(10, 16):
                held, norm = bool(seed % 2), int(seed % 3 == 0)
                touching += _on_ground(lib, ground, seed, held, norm, mixed)
            assert touching >= 8


def motion(lib: Any) -> None:
    """Ticks of trot with late, slow commands and a damaged leg, against Velocity Verlet here."""
    legs, damaged, steps = 4, 2, 7
    latency, slew = 0.02, 3.0
    of = {"sensor": QUIET, "servo": {"latency": latency, "slew_rate": slew}}
    for robot in (random_robot(21, legs, **of), mixed_robot(21, legs, **of)):
        _motion(lib, robot, damaged, latency, slew, steps)


def _motion(
    lib: Any, robot: Numbers, damaged: int, latency: float, slew: float, steps: int
) -> None:
    legs, step = robot.at.legs, TICK / steps
    body, ground = RigidBody(robot.at), plane()
    plant = CPlant(legs, library=lib, delay=latency)
    plant.place(robot, ground, clearance=0.002, angles=(0.0, 0.1, -0.1))
    plant.conditions(damaged=(damaged,))
    q, v = plant.get()
    stopping = 1.0 / foot_mass_of(body, plant, ground)
    target, sent, coming, time = q[BASE:].copy(), q[BASE:].copy(), [], 0.0

    def at(h: float) -> np.ndarray:
        acting = expected(lib, body, ground, q, v, target, stopping=stopping * h)
        return body.accelerations(q, v, acting.force)

    a = at(0.0)
    for tick in range(6):
        hip, knee = trot(legs, tick)
        wanted = in_tree(robot.at, np.column_stack([np.zeros(legs), hip, knee]))
        wanted[damaged] = 0.0
        sent = np.clip(wanted.ravel(), sent - slew * TICK, sent + slew * TICK)
        coming.append((tick * TICK + latency, sent))
        end = (tick + 1) * TICK
        for until in [*(t for t, _ in coming if t < end - 1e-12), end]:
            count = math.ceil((until - time) / step - 1e-9)
            h = (until - time) / count
            for _ in range(count):
                v = v + 0.5 * h * a
                q = q + h * v
                a = at(h)
                v = v + 0.5 * h * a
            time = until
            if until < end:
                target = coming.pop(0)[1]
        plant.tick(hip, knee, step)
        shown(plant, expected(lib, body, ground, q, v, target, stopping=stopping * h), q, v, 0)
        q, v = plant.get()  # rounding does not add up


def sensors(lib: Any) -> None:
    """Delay, low-pass and what a broken sensor delivers, at ticks of several lengths."""
    legs, delay, constant = 3, 0.04, 0.03
    sensor = {"delay": delay, "time_constant": constant, "noise": 0.0, "norm": 1}
    robot = random_robot(31, legs, sensor=sensor)
    plant = CPlant(legs, library=lib, delay=delay, Ts=TICK / 2)
    plant.place(robot, plane())
    plant.conditions(stuck={1: 7.5})
    times, loads, filtered = [0.0], [np.zeros(legs)], np.zeros(legs)
    for tick in range(40):
        duration = TICK * (1.0, 0.5, 1.3)[tick % 3]
        plant.command(*trot(legs, tick))
        plant.advance(duration)
        sample = plant.sample()
        times.append(times[-1] + duration)
        loads.append(np.linalg.norm(sample["force"], axis=1))
        late = [np.interp(times[-1] - delay, times, np.array(loads)[:, k]) for k in range(legs)]
        filtered = filtered + (1.0 - math.exp(-duration / constant)) * (late - filtered)
        read = filtered.copy()
        read[1] = 7.5
        close(sample["grf"], read, 1e-11)
    assert np.array(loads).max() > 5.0


def philox(counter: tuple[int, ...], key: tuple[int, int]) -> tuple[int, ...]:
    """Philox 4x32-10 of Salmon et al. (2011)."""
    (a, b, c, d), (k, m) = counter, key
    for _ in range(10):
        p, r = 0xD2511F53 * a, 0xCD9E8D57 * c
        a, b, c, d = (r >> 32) ^ b ^ k, r % 2**32, (p >> 32) ^ d ^ m, p % 2**32
        k, m = (k + 0x9E3779B9) % 2**32, (m + 0xBB67AE85) % 2**32
    return a, b, c, d


def uniforms(seed: int, purpose: int, index: int) -> tuple[float, float]:
    """Two numbers in [0, 1)."""
    words = philox((index % 2**32, index >> 32, purpose, 0), (seed % 2**32, seed >> 32))
    low, high = words[0] | words[1] << 32, words[2] | words[3] << 32
    return (low >> 11) / 2**53, (high >> 11) / 2**53


def normals(seed: int, purpose: int, index: int) -> tuple[float, float]:
    """Two numbers of the standard normal distribution, by Box and Muller."""
    first, second = uniforms(seed, purpose, index)
    length = math.sqrt(-2.0 * math.log(1.0 - first))
    return length * math.cos(2 * math.pi * second), length * math.sin(2 * math.pi * second)


def noise(lib: Any) -> None:
    """A number of its own for every leg and reading, as large as sensor and conditions say."""
    legs, seed = 5, 2**40 + 9
    robot = random_robot(41, legs, sensor=QUIET | {"noise": 0.03})
    plant = CPlant(legs, library=lib)
    plant.place(robot, plane(), clearance=1.0, seed=seed)
    plant.conditions(grf_noise=0.04)
    spread = 0.05 * robot.at.weight / 2.0
    for reading in range(6):
        plant.advance()
        pairs = [normals(seed, 2, 32 * reading + k) for k in range((legs + 1) // 2)]
        drawn = np.ravel(pairs)[:legs]
        close(plant.sample()["grf"], np.maximum(0.0, spread * drawn))


def fall(lib: Any) -> None:
    """Tipped by more than 60 degrees from the normal, or a corner of the trunk in the ground."""
    legs, slope = 2, 0.1
    robot = random_robot(51, legs)
    for turned, fell in ((59.0, 0), (61.0, 1)):
        for axis, lean in ((4, -slope), (5, 0.0)):
            plant = CPlant(legs, library=lib)
            plant.place(robot, plane(slope), clearance=2.0)
            q, v = plant.get()
            q[axis] = lean + math.radians(turned)
            plant.put(q, v)
            plant.advance(1e-6)
            assert plant.state() == fell
    body = RigidBody(robot.at)
    half, center = np.array(list(robot.at.trunk_size)) / 2.0, np.array(list(robot.at.trunk_center))
    corners = [center + half * signs for signs in itertools.product((-1, 1), repeat=3)]
    step_up = kerb(-1.0, 0.01)
    for ground, (pitch, roll) in itertools.product(
        (plane(), step_up), itertools.product((-0.3, 0.2), repeat=2)
    ):
        for above, fell in ((1e-4, 0), (-1e-4, 1)):
            plant = CPlant(legs, library=lib, contacts=ground.at.contacts if ground.at.kind else 0)
            plant.place(robot, ground, clearance=1.0)
            q, v = plant.get()
            q[4], q[5] = pitch, roll
            body.move(q, v)
            lowest = min(float((body.rotation() @ corner)[2]) for corner in corners)
            q[2] = ground.at.top + above - lowest
            plant.put(q, v)
            plant.advance(1e-9, 1e-9)
            assert plant.state() == fell


def tuning(lib: Any) -> None:
    """Other gains, contact and sensor from the start on are those of a robot built with them."""
    legs, late = 3, {"latency": 0.02}
    fields = changed(random_fields(np.random.default_rng(71), legs), servo=late)
    other = random_fields(np.random.default_rng(72), legs)
    for name in ("servo", "contact", "sensor"):
        other[name] = fields[name] | other[name]
    kept = {"reflected_inertia": fields["servo"]["reflected_inertia"], "slew_rate": 2.0}
    ball = {"foot_radius": fields["contact"]["foot_radius"]}  # which the start depends on
    other = changed(other, servo=kept, contact=ball, sensor={"delay": 0.03, "norm": 1})
    # the accelerations at the start depend on the rotors, its height on the feet
    legs_of = [
        {**leg, "joint": [{**j, "reflected_inertia": math.nan} for j in new["joint"]]}
        for leg, new in zip(fields["leg"], with_joints(fields, 7)["leg"], strict=True)
    ]
    parts = {name: other[name] for name in ("servo", "contact", "sensor")} | {"leg": legs_of}
    plants = [CPlant(legs, library=lib, delay=0.03) for _ in range(2)]
    for plant, robot in zip(plants, (robot_of(fields), robot_of(fields | parts)), strict=True):
        plant.place(robot, plane(), seed=3, clearance=0.001)
        plant.conditions(grf_noise=0.1)
    tuned = robot_of(fields | parts)  # its arrays must live during the call
    lib.plant_tune(plants[0].memory, 0, tuned.at)
    for tick in range(20):
        assert same_bits(*(plant.tick(*trot(legs, tick)) for plant in plants))


def again(lib: Any) -> None:
    """A robot put where another one walked is the one that it is in a new plant."""
    legs = 5
    for kind, level in ((lib.PLANT_SCALAR, lib.PLANT_BASELINE), *kinds(lib)):
        used = CPlant(legs, library=lib, kind=kind, level=level, delay=0.03)
        new = CPlant(legs, library=lib, delay=0.03)
        last = used.lanes - 1
        for lane in range(used.lanes):
            used.place(odd_lane(lane, legs), plane(), lane, seed=lane)
            used.conditions(lane, damaged=(1,), stuck={2: 3.0})
        for tick in range(20):
            for lane in range(used.lanes):
                used.command(*trot(legs, tick), lane)
            used.advance()
        for plant, lane in ((used, last), (new, 0)):
            plant.place(odd_lane(90, legs), plane(), lane, seed=7)
        for tick in range(20):
            for plant, lane in ((used, last), (new, 0)):
                plant.command(*trot(legs, tick, 2.0), lane)
                plant.advance()
            assert same_bits(used.row(last), new.row()), f"kind {kind}, level {level}"


def lanes(lib: Any) -> None:
    """Different robots side by side, on different grounds, are those that they are alone."""
    for (kind, level), robot in itertools.product(kinds(lib), (odd_lane, mixed_lane)):
        for lane in side_by_side(lib, kind, level, 5, list(grounds().values()), 12, robot):
            assert lane.same, f"kind {kind}, {lib.plant_level_name(level)}"


def kinds(lib: Any) -> list[tuple[int, int]]:
    """Kinds with several lanes and levels that this machine has."""
    best = lib.plant_best_level()
    levels = range(lib.PLANT_BASELINE, best + 1)
    return [(kind, level) for kind in (lib.PLANT_LEGS, lib.PLANT_ROBOTS) for level in levels]


class Lane:
    """A robot in a lane of a plant, and the same robot alone.

    Attributes:
        together, alone: samples in numbers as they are, shape (ticks, 9 + 19 legs).
        states: of both at the end.
    """

    def __init__(self) -> None:
        self.rows: tuple[list[np.ndarray], list[np.ndarray]] = ([], [])
        self.states = (0, 0)

    @property
    def together(self) -> np.ndarray:
        return np.array(self.rows[0])

    @property
    def alone(self) -> np.ndarray:
        return np.array(self.rows[1])

    @property
    def same(self) -> bool:
        """Whether both are equal to the last bit."""
        return self.states[0] == self.states[1] and same_bits(self.together, self.alone)


LATE: Final = {"servo": {"latency": 0.02}, "sensor": {"delay": 0.03}}
"""Latency and delay, which all robots of a plant share [s]."""


def odd_lane(lane: int, legs: int) -> Numbers:
    """A robot like no other."""
    fields = changed(random_fields(np.random.default_rng(lane), legs), **LATE)
    return robot_of(with_joints(fields, lane) if lane % 2 else fields)


def mixed_lane(lane: int, legs: int) -> Numbers:
    """A robot like no other, with legs of every kind."""
    return _robot(lane, legs, True, **LATE)


def side_by_side(
    lib: Any,
    kind: int,
    level: int,
    legs: int,
    grounds: list[Numbers],
    ticks: int,
    robot: Callable[[int, int], Numbers] = odd_lane,
    size: float = 1.0,
) -> list[Lane]:
    """Robots side by side, each on the next ground and put there at a tick of its own."""
    contacts = max(ground.at.contacts if ground.at.kind else 0 for ground in grounds)
    room = {"library": lib, "contacts": contacts, "delay": 0.03}
    plant = CPlant(legs, kind=kind, level=level, **room)
    single = [CPlant(legs, **room) for _ in range(plant.lanes)]
    found = [Lane() for _ in single]
    for tick in range(ticks):
        for lane, alone in enumerate(single):
            both = ((plant, lane), (alone, 0))
            begins, ground = 2 * (lane % 3), grounds[lane % len(grounds)]
            for each, at in both:
                if tick == begins:
                    each.place(robot(lane, legs), ground, at, seed=lane, clearance=0.001)
                    broken = {"damaged": (lane % legs,), "stuck": {(lane + 1) % legs: 2.0}}
                    each.conditions(at, grf_noise=0.1, **(broken if lane % 2 else {}))
                each.command(*trot(legs, tick + lane, size), at)
            if tick >= begins:
                alone.advance()
        plant.advance()
        for lane, alone in enumerate(single):
            if tick >= 2 * (lane % 3):
                found[lane].states = (plant.state(lane), alone.state())
                found[lane].rows[0].append(plant.row(lane))
                found[lane].rows[1].append(alone.row())
    return found


def longest_step(robot: Any) -> tuple[float, float]:
    """Longest step of springs and dampers, and of friction, of a ``plant_robot`` [s].

    4 M - 2 h D - h^2 K is positive definite up to the step h that is found here by bisection.
    """
    body, size = RigidBody(robot), BASE + 3 * robot.legs
    servo, contact, q = Joints(robot), robot.contact, np.zeros(size)
    body.move(q, q)
    mass = body.mass_matrix(q)
    up = np.array([body.foot_jacobian(k)[2] for k in range(robot.legs)])
    stopped = np.isfinite(servo.low) | np.isfinite(servo.high)
    stiffness = servo.stiffness + np.where(stopped, servo.stop_stiffness, 0.0)
    brake = np.maximum(servo.damping, servo.stall_torque / servo.no_load_speed)
    brake += servo.joint_damping + servo.dry_friction / servo.friction_speed
    brake += np.where(stopped, servo.stop_damping, 0.0)
    in_air = np.zeros(BASE)
    springs = contact.stiffness * up.T @ up + np.diag([*in_air, *stiffness])
    dampers = contact.damping * up.T @ up + np.diag([*in_air, *brake])
    low, high = 1e-9, 1.0
    while high > low * (1.0 + 1e-6):
        h = math.sqrt(low * high)
        stable = np.linalg.eigvalsh(4.0 * mass - 2.0 * h * dampers - h * h * springs)[0] > 0.0
        low, high = (h, high) if stable else (low, h)
    load = 2.0 * robot.weight / robot.legs
    friction = contact.friction * load / contact.friction_speed
    return low, foot_mass_at(body, q, 0.0) / friction


def steps(lib: Any) -> None:
    """The longest step, and that a robot that came to lie with a longer one has not fallen."""
    limited_by = set()
    for seed, grip in itertools.product(range(40, 46), (0.01, 10.0)):
        random, legs = np.random.default_rng(seed), 2 + seed % 5
        fields = changed(random_fields(random, legs), contact={"friction": grip})
        robot = robot_of(with_joints(fields, seed) if seed % 2 else fields)
        springs, friction = longest_step(robot.at)
        expected = min(springs, 1.4 * friction)
        found = lib.plant_longest_step(robot.at)
        assert expected * (1.0 - 1e-5) < found < 1.005 * expected
        own = lib.plant_own_step(robot.at)
        assert own == 1.0 / (480.0 * max(2, math.ceil(1.4 / (480.0 * found))))
        limited_by.add(springs < 1.4 * friction)
    assert limited_by == {True, False}
    robot = random_robot(40, 4)
    stable = lib.plant_stable_step(robot.at)
    for step, state in ((0.99 * stable, lib.PLANT_FELL), (1.01 * stable, lib.PLANT_DIVERGED)):
        plant = CPlant(4, library=lib)
        plant.place(robot, plane(), angles=(1.5, 0.0, 0.0))
        while plant.state() == lib.PLANT_WALKS:
            plant.command(np.zeros(4), np.zeros(4))
            plant.advance(step, step)
        assert plant.state() == state


CHECKS: Final[dict[str, Check]] = {
    check.__name__: check
    for check in (
        accelerations,
        forces,
        motion,
        sensors,
        noise,
        fall,
        tuning,
        again,
        lanes,
        steps,
    )
}
"""Every check by its name."""

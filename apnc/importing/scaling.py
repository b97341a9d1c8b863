"""What a model file does not say, taken from Lilibot and scaled to the size of the robot.

Two robots move alike if times go with the square root of length and forces with weight (equal
Froude numbers). In the rules m is the mass and L the length of a leg, as shares of Lilibot's.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any, Final

import numpy as np

from apnc.importing.legs import LegGeometry
from apnc.importing.model import Motor
from apnc_core.interface import Parameters
from apnc_plant.robot import GRAVITY, RobotDescription, load_robot

LARGEST_EFFORT: Final = 2.5
"""Torque limit above which it is a placeholder, in weights times leg length."""

LARGEST_VELOCITY: Final = 200.0
"""Speed limit from which on it is a placeholder [rad/s]."""

USUAL_VELOCITY: Final = 20.0
"""No-load speed of a joint with a torque limit but no speed limit [rad/s]."""


@dataclass(frozen=True)
class Size:
    """What is scaled with.

    Args:
        mass: of the robot [kg].
        length: of a leg, femur and tibia [m].
        legs: number of legs.
    """

    mass: float
    length: float
    legs: int


@dataclass(frozen=True)
class Estimate:
    """A number that the file does not say.

    Args:
        name: key of the robot file.
        value: the number.
        unit: its unit; empty if it has none.
        why: where it comes from.
    """

    name: str
    value: float
    unit: str
    why: str


@dataclass(frozen=True)
class Guessed:
    """Parts of a robot file that are not in a model file as they are.

    Args:
        servo, contact, sensor, controller: tables of the robot file.
        com_side_offset: sideways error of the trunk's centre of mass [m].
        rate: update rate at which the robot moves as Lilibot does at its own [Hz].
        estimates: which of these numbers are not the file's.
        dropped: what of the file was not taken, in words.
    """

    servo: dict[str, float]
    contact: dict[str, float]
    sensor: dict[str, Any]
    controller: dict[str, float]
    com_side_offset: float
    rate: float
    estimates: tuple[Estimate, ...]
    dropped: tuple[str, ...]


@cache
def lilibot() -> tuple[RobotDescription, Size]:
    """The robot that is scaled, and its size."""
    robot = load_robot("lilibot")
    leg = robot.legs[0]
    return robot, Size(robot.mass, leg.femur_length + leg.tibia_length, len(robot.legs))


def guess(legs: Sequence[LegGeometry], size: Size, rate: float) -> Guessed:
    """Servo, contact, sensor and gains of a robot.

    Args:
        legs: its legs.
        size: its size.
        rate: update rate of Lilibot [Hz].
    """
    like, of = lilibot()
    m, L = size.mass / of.mass, size.length / of.length
    time = math.sqrt(L)
    found = _Found(size, m, L)
    servo = found.servo(legs)
    radius = found.radius(legs)
    contact = {
        "foot_radius": radius,
        "stiffness": found.scaled("contact.stiffness", like.contact.stiffness, m / L, "N/m", "m/L"),
        "damping": found.scaled(
            "contact.damping", like.contact.damping, m / time, "N s/m", "m/sqrt(L)"
        ),
        "damping_depth": found.scaled(
            "contact.damping_depth", like.contact.damping_depth, L, "m", "L"
        ),
        "friction": found.scaled("contact.friction", like.contact.friction, 1.0, "", ""),
        "friction_speed": found.scaled(
            "contact.friction_speed", like.contact.friction_speed, time, "m/s", "sqrt(L)"
        ),
    }
    sensor = {
        "delay": found.scaled("sensor.delay", like.sensor.delay, time, "s", "sqrt(L)"),
        "time_constant": found.scaled(
            "sensor.time_constant", like.sensor.time_constant, time, "s", "sqrt(L)"
        ),
        "noise": found.scaled("sensor.noise", like.sensor.noise, 1.0, "", ""),
        "component": like.sensor.component,
    }
    offset = found.scaled("trunk.com_side_offset", like.trunk.com_side_offset, L, "m", "L")
    return Guessed(
        servo, contact, sensor, _gains(size.legs, of.legs), offset, rate / time,
        tuple(found.estimates), tuple(found.dropped),
    )  # fmt: skip


def _gains(legs: int, of: int) -> dict[str, float]:
    """Parameters of the controller that depend on the number of legs (docs/legs.md)."""
    default, n = Parameters(), legs / of
    # the reference pose is that about which the robot walks
    gains = {"b1": 0.0, "b2": 0.0}
    if legs != of:
        gains |= {
            "B_f": min(1.0, default.B_f * n**2),
            "B_s": min(1.0, default.B_s * n**2),
            "alpha": default.alpha / n,
            "F_max": default.F_max / n,
            "sigma": default.sigma * math.sqrt((legs - 1) / (of - 1)),
        }
    return gains


class _Found:
    """What the file says of the joints, and what is estimated in its place."""

    def __init__(self, size: Size, m: float, L: float) -> None:
        self._size, self._m, self._length = size, m, L
        self.estimates: list[Estimate] = []
        self.dropped: list[str] = []

    def scaled(self, name: str, value: float, factor: float, unit: str, rule: str) -> float:
        """A number of Lilibot times a factor."""
        why = f"Lilibot's {value:g}" + (f" times {rule}" if rule else "")
        self.estimates.append(Estimate(name, value * factor, unit, why))
        return value * factor

    def radius(self, legs: Sequence[LegGeometry]) -> float:
        """Radius of the feet."""
        known = [leg.foot.radius for leg in legs if leg.foot.radius is not None]
        if not known:
            like, _ = lilibot()
            return self.scaled(
                "contact.foot_radius", like.contact.foot_radius, self._length, "m", "L"
            )
        self._spread("radii of the feet", known, float(np.mean(known)), "m")
        return float(np.mean(known))

    def servo(self, legs: Sequence[LegGeometry]) -> dict[str, float]:
        """The servo that stands for all joints."""
        like, _ = lilibot()
        own, m, L = like.servo, self._m, self._length
        motors = {turn.joint.name: turn.joint.motor for leg in legs for turn in leg.turns}
        most = LARGEST_EFFORT * self._size.mass * GRAVITY * self._size.length
        efforts = self._said(motors, "effort", most, "N m")
        velocities = self._said(motors, "velocity", LARGEST_VELOCITY, "rad/s")
        if efforts:
            stall = float(np.mean(efforts))
            self._spread("torque limits of the joints", efforts, stall, "N m")
        else:
            stall = self.scaled("servo.stall_torque", own.stall_torque, m * L, "N m", "m L")
        if velocities:
            speed = float(np.mean(velocities))
            self._spread("speed limits of the joints", velocities, speed, "rad/s")
        elif efforts:
            speed = USUAL_VELOCITY
            self._estimate("servo.no_load_speed", speed, "rad/s", "usual of geared motors")
        else:
            speed = self.scaled(
                "servo.no_load_speed", own.no_load_speed, L**-0.5, "rad/s", "1/sqrt(L)"
            )
        stiffness = self._mean(motors, "stiffness", "stiffness of the joints", "N m/rad")
        damping = None
        if stiffness:
            damping = self._mean(motors, "damping", "damping of the joints", "N m s/rad")
        else:
            stiffness = self.scaled("servo.stiffness", own.stiffness, m * L, "N m/rad", "m L")
            if passive := [motor.damping for motor in motors.values() if motor.damping]:
                self.dropped.append(f"damping of the joints, up to {max(passive):.3g} N m s/rad")
        if damping is None:
            lag = own.damping / own.stiffness
            damping = stiffness * lag
            why = f"stiffness times Lilibot's lag of {lag:.3g} s"
            self._estimate("servo.damping", damping, "N m s/rad", why)
        armature = self._mean(motors, "armature", "armature of the joints", "kg m^2")
        if not armature:
            armature = self.scaled(
                "servo.reflected_inertia", own.reflected_inertia, m * L**2, "kg m^2", "m L^2"
            )
        friction = [each.friction for each in motors.values() if each.friction]
        if friction:
            self.dropped.append(f"dry friction of the joints, up to {max(friction):.3g} N m")
        return {
            "stiffness": stiffness,
            "damping": damping,
            "stall_torque": stall,
            "no_load_speed": speed,
            "reflected_inertia": armature,
        }

    def _said(self, motors: dict[str, Motor], key: str, most: float, unit: str) -> list[float]:
        """Limits that the file gives, without placeholders; joints that have none are reported."""
        values = {name: getattr(motor, key) for name, motor in motors.items()}
        known = {name: value for name, value in values.items() if value is not None and value > 0.0}
        placeholders = {name: value for name, value in known.items() if value >= most}
        if placeholders:
            name, value = next(iter(placeholders.items()))
            self.dropped.append(
                f"{key} {value:g} {unit} of {len(placeholders)} joints ({name} and so on): a "
                f"placeholder, above {most:.3g} {unit}"
            )
        real = [value for name, value in known.items() if name not in placeholders]
        if real and len(real) < len(motors):
            self.dropped.append(f"{len(motors) - len(real)} joints have no {key}")
        return real

    def _mean(self, motors: dict[str, Motor], key: str, words: str, unit: str) -> float | None:
        """The mean of what the file says of all joints; None if it says nothing."""
        values = [getattr(motor, key) for motor in motors.values()]
        known = [value for value in values if value is not None]
        if not known:
            return None
        mean = float(np.mean(known))
        self._spread(words, known, mean, unit)
        return mean

    def _spread(self, words: str, values: Sequence[float], taken: float, unit: str) -> None:
        low, high = min(values), max(values)
        if high - low > 1e-9 * abs(high):
            self.dropped.append(
                f"{words}, {low:.4g} to {high:.4g} {unit}: all have the mean, {taken:.4g}"
            )

    def _estimate(self, name: str, value: float, unit: str, why: str) -> None:
        self.estimates.append(Estimate(name, value, unit, why))

"""What a model file does not say, taken from a reference robot and scaled to the size.

The reference robot is ``reference.toml``.

Two robots move alike if times go with the square root of length and forces with weight (equal
Froude numbers). In the rules m is the mass and L the length of a leg, as shares of its own.

A file that limits the torque of a joint says how large its motor is. With s, the share that this
limit is of its scaled stall torque, at most 1, the rotor is as much smaller, and so is half
of the stiffness. The other half stays, because it carries the weight.
"""

from __future__ import annotations

import math
from collections.abc import Container, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Any, Final

import numpy as np

from apnc.importing.legs import LegGeometry
from apnc.importing.model import Motor
from apnc.importing.servos import Servos, most_frequent, servos_of
from apnc_core.interface import Parameters
from apnc_plant.robot import GRAVITY, MassProperties, RobotDescription, load_robot
from apnc_plant.signals import JOINTS

LARGEST_EFFORT: Final = 2.5
"""Torque limit above which it is a placeholder, in weights times leg length."""

LARGEST_VELOCITY: Final = 200.0
"""Speed limit from which on it is a placeholder [rad/s]."""

USUAL_VELOCITY: Final = 20.0
"""No-load speed of a joint with a torque limit but no speed limit [rad/s]."""

SHORTEST_RUN_UP: Final = 0.25
"""Time in which the torque limit brings a rotor alone to the no-load speed, as a share of
the reference robot's, below which the rotor is a placeholder. Gears do not change this time;
rotors of most files have 0.3 to 0.9."""

Place = tuple[int, str]
"""Number of a leg, and name of its joint."""

Motors = Mapping[Place, tuple[str, Motor]]
"""Joint in the file, and its drive."""


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
        servos: servos of all joints.
        radii: of the feet, leg by leg [m].
        contact, sensor, controller: tables of the robot file.
        com_side_offset: sideways error of the trunk's centre of mass [m].
        rate: update rate at which the robot moves as the reference robot does at its own [Hz].
        estimates: which of these numbers are not the file's.
        dropped: what of the file was not taken, in words.
    """

    servos: Servos
    radii: tuple[float, ...]
    contact: dict[str, float]
    sensor: dict[str, Any]
    controller: dict[str, float]
    com_side_offset: float
    rate: float
    estimates: tuple[Estimate, ...]
    dropped: tuple[str, ...]


@cache
def reference() -> tuple[RobotDescription, Size]:
    """The robot that is scaled, and its size."""
    robot = load_robot(Path(__file__).with_name("reference.toml"))
    leg = robot.legs[0]
    return robot, Size(robot.mass, leg.femur_length + leg.tibia_length, len(robot.legs))


def guess(legs: Sequence[LegGeometry], size: Size, rate: float) -> Guessed:
    """Servo, contact, sensor and gains of a robot.

    Args:
        legs: its legs.
        size: its size.
        rate: update rate of the reference robot [Hz].
    """
    like, of = reference()
    m, L = size.mass / of.mass, size.length / of.length
    time = math.sqrt(L)
    found = _Found(size, m, L)
    servos = found.servos(legs)
    radii = found.radii(legs)
    foot = found.lightest_foot(legs)
    contact = {
        "foot_radius": most_frequent(radii),
        "stiffness": found.scaled("contact.stiffness", like.contact.stiffness, m / L, "N/m", "m/L"),
        "damping": found.scaled(
            "contact.damping",
            like.contact.damping,
            math.sqrt(m / L * foot),
            "N s/m",
            f"sqrt(m/L f), f = {foot:.3g} being the mass of a foot",
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
        servos, tuple(radii), contact, sensor, _gains(size.legs, of.legs), offset, rate / time,
        tuple(found.estimates), tuple(found.dropped),
    )  # fmt: skip


def _gains(legs: int, of: int) -> dict[str, float]:
    """Parameters of the controller; some depend on the number of legs (docs/legs.md)."""
    n = legs / of
    # the reference pose is that about which the robot walks
    gains = {**reference()[0].controller, "b1": 0.0, "b2": 0.0}
    if legs != of:
        gains |= {
            "B_f": min(1.0, gain("B_f") * n**2),
            "B_s": min(1.0, gain("B_s") * n**2),
            "alpha": gain("alpha") / n,
            "F_max": gain("F_max") / n,
            "sigma": gain("sigma") * math.sqrt((legs - 1) / (of - 1)),
        }
    return gains


def gain(name: str) -> float:
    """A parameter of the controller of the reference robot."""
    return float(reference()[0].controller.get(name, getattr(Parameters(), name)))


def _foot_mass(tibia: MassProperties, length: float, rotor: float) -> float:
    """Mass that a foot has by the turning of its tibia [kg].

    Args:
        tibia: mass properties in the frame at the knee.
        length: of the tibia [m].
        rotor: reflected inertia of the rotor of the knee [kg m^2].
    """
    x, _, z = tibia.com
    return float(rotor + tibia.inertia[1, 1] + tibia.mass * (x * x + z * z)) / length**2


class _Found:
    """What the file says of the joints, and what is estimated in its place."""

    def __init__(self, size: Size, m: float, L: float) -> None:
        self._size, self._m, self._length = size, m, L
        self._rotors: Mapping[Place, float] = {}
        self.estimates: list[Estimate] = []
        self.dropped: list[str] = []

    def scaled(self, name: str, value: float, factor: float, unit: str, rule: str) -> float:
        """A number of the reference robot times a factor."""
        why = f"the reference robot's {value:g}" + (f" times {rule}" if rule else "")
        self.estimates.append(Estimate(name, value * factor, unit, why))
        return value * factor

    def radii(self, legs: Sequence[LegGeometry]) -> list[float]:
        """Radius of every foot."""
        known = [leg.foot.radius for leg in legs if leg.foot.radius is not None]
        if known:
            radius = most_frequent(known)
        else:
            like, _ = reference()
            radius = self.scaled(
                "contact.foot_radius", like.contact.foot_radius, self._length, "m", "L"
            )
        return [radius if leg.foot.radius is None else leg.foot.radius for leg in legs]

    def servos(self, legs: Sequence[LegGeometry]) -> Servos:
        """The servos of all joints."""
        like, _ = reference()
        own, m, L = like.servo, self._m, self._length
        motors = {
            (k, joint): (leg.turns[angle].joint.name, leg.turns[angle].joint.motor)
            for k, leg in enumerate(legs)
            for joint, (angle, _) in leg.counted(0.0).items()
        }
        most = LARGEST_EFFORT * self._size.mass * GRAVITY * self._size.length
        stall = self._limits(motors, "effort", most, "N m")
        speed = self._limits(motors, "velocity", LARGEST_VELOCITY, "rad/s")
        if stall is None:
            stall = self._all(motors, "stall_torque", own.stall_torque, m * L, "N m", "m L")
            if speed is None:
                speed = self._all(
                    motors, "no_load_speed", own.no_load_speed, L**-0.5, "rad/s", "1/sqrt(L)"
                )
        elif speed is None:
            self._estimate("servo.no_load_speed", USUAL_VELOCITY, "rad/s", "usual of geared motors")
            speed = dict.fromkeys(motors, USUAL_VELOCITY)
        stiffness, damping = self._filled(motors, "stiffness"), None
        shares = {at: min(1.0, value / (own.stall_torque * m * L)) for at, value in stall.items()}
        if stiffness is not None and min(stiffness.values()) > 0.0:
            damping = self._filled(motors, "damping")
        else:
            half = {at: (1.0 + share) / 2.0 for at, share in shares.items()}
            stiffness = self._shared(
                "stiffness", own.stiffness, m * L, half, "N m/rad", "m L (1 + s)/2"
            )
        if damping is None:
            lag = own.damping / own.stiffness
            damping = {at: value * lag for at, value in stiffness.items()}
            why = f"stiffness times the reference robot's lag of {lag:.3g} s"
            self._estimate("servo.damping", max(damping.values()), "N m s/rad", why)
        rotors = self._armatures(motors, stall, speed)
        if rotors is None or not any(rotors.values()):
            rotors = self._shared(
                "reflected_inertia", own.reflected_inertia, m * L**2, shares, "kg m^2", "m L^2 s"
            )
        self._rotors = rotors
        values = {
            "stiffness": stiffness, "damping": damping, "stall_torque": stall,
            "no_load_speed": speed, "reflected_inertia": rotors,
        }  # fmt: skip
        for key, of_joint in (("joint_damping", "passive"), ("dry_friction", "friction")):
            found = {at: getattr(motor, of_joint) or 0.0 for at, (_, motor) in motors.items()}
            if any(found.values()):
                values[key] = found
        # a joint that a leg lacks is as most others, which takes no line of the robot file
        usual = {key: most_frequent(found.values()) for key, found in values.items()}
        return servos_of(
            [
                {
                    joint: {key: found.get((k, joint), usual[key]) for key, found in values.items()}
                    for joint in JOINTS
                }
                for k in range(len(legs))
            ]
        )

    def _all(
        self, motors: Motors, key: str, value: float, factor: float, unit: str, rule: str
    ) -> dict[Place, float]:
        """A number of the reference robot times a factor, for all joints."""
        return dict.fromkeys(motors, self.scaled(f"servo.{key}", value, factor, unit, rule))

    def _shared(
        self,
        key: str,
        value: float,
        factor: float,
        shares: Mapping[Place, float],
        unit: str,
        rule: str,
    ) -> dict[Place, float]:
        """A number of the reference robot times a factor and a share of each joint."""
        most, least = max(shares.values()), min(shares.values())
        if least < most:
            rule += f"; down to {value * factor * least:.4g} where the torque limit is lower"
        self.scaled(f"servo.{key}", value, factor * most, unit, rule)
        return {at: value * factor * share for at, share in shares.items()}

    def _armatures(
        self, motors: Motors, stall: Mapping[Place, float], speed: Mapping[Place, float]
    ) -> dict[Place, float] | None:
        """Inertias of rotors that the file gives, without placeholders."""
        own = reference()[0].servo
        run_up = SHORTEST_RUN_UP * own.reflected_inertia * own.no_load_speed / own.stall_torque
        given = {at: motor.armature for at, (_, motor) in motors.items() if motor.armature}
        light = [at for at, value in given.items() if value * speed[at] < run_up * stall[at]]
        if light:
            at = light[0]
            self.dropped.append(
                f"armature {given[at]:g} kg m^2 of {len(light)} joints ({motors[at][0]} and so "
                f"on): a placeholder, below {run_up * stall[at] / speed[at]:.2g} kg m^2"
            )
        return self._filled(motors, "armature", light)

    def lightest_foot(self, legs: Sequence[LegGeometry]) -> float:
        """Mass of the lightest foot, as a share of that of the reference robot's feet.

        It is known when the servos are.
        """
        like, _ = reference()
        leg = like.legs[0]
        tibia = MassProperties(leg.tibia.mass, np.array(leg.tibia.com), leg.tibia.inertia_tensor())
        usual = _foot_mass(tibia, leg.tibia_length, like.servo.reflected_inertia)
        last = [{angle: joint for joint, (angle, _) in leg.counted(0.0).items()} for leg in legs]
        masses = [
            _foot_mass(leg.bodies[2], leg.tibia, self._rotors[k, of.get("tibia", of["femur"])])
            for k, (leg, of) in enumerate(zip(legs, last, strict=True))
        ]
        return min(masses) / usual

    def _filled(
        self, motors: Motors, key: str, without: Container[Place] = ()
    ) -> dict[Place, float] | None:
        """What the file says of every joint; what it leaves out is as in most joints of its kind.

        Args:
            motors: the drives.
            key: the number.
            without: joints whose number does not count.

        Returns:
            None if it says nothing.
        """
        known = {
            at: float(value)
            for at, (_, motor) in motors.items()
            if at not in without and (value := getattr(motor, key)) is not None
        }
        if not known:
            return None
        usual = most_frequent(known.values())
        kinds = {
            joint: most_frequent(values)
            for joint in JOINTS
            if (values := [value for at, value in known.items() if at[1] == joint])
        }
        return {at: known.get(at, kinds.get(at[1], usual)) for at in motors}

    def _limits(
        self, motors: Motors, key: str, most: float, unit: str
    ) -> dict[Place, float] | None:
        """Limits that the file gives, without placeholders; joints that have none are reported."""
        known = {at: getattr(motor, key) for at, (_, motor) in motors.items()}
        known = {at: value for at, value in known.items() if value is not None and value > 0.0}
        placeholders = {at: value for at, value in known.items() if value >= most}
        if placeholders:
            at, value = next(iter(placeholders.items()))
            self.dropped.append(
                f"{key} {value:g} {unit} of {len(placeholders)} joints ({motors[at][0]} and so "
                f"on): a placeholder, above {most:.3g} {unit}"
            )
        real = known.keys() - placeholders.keys()
        if real and len(real) < len(motors):
            self.dropped.append(
                f"{len(motors) - len(real)} joints have no {key}: that of most joints is taken"
            )
        return self._filled(motors, key, motors.keys() - real)

    def _estimate(self, name: str, value: float, unit: str, why: str) -> None:
        self.estimates.append(Estimate(name, value, unit, why))

"""Robots as data, independent of engines: geometry, masses, servos, contact and sensors."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import field, fields
from functools import partial
from typing import Annotated, Any, Final, Literal

import numpy as np
from pydantic import AfterValidator

from apnc_core import settings
from apnc_core.frozen import Frozen
from apnc_core.variables import variable_named
from apnc_plant.files import KeyRefusedError, Number, checked, limits
from apnc_plant.robot.body import Body, MassProperties, Trunk
from apnc_plant.robot.joint_map import JointMap
from apnc_plant.robot.quantities import (
    Angle,
    Edge,
    Name,
    Range,
    RobotDescriptionError,
    Turns,
    Vector3,
)
from apnc_plant.robot.servo import LegServos, Servo

GRAVITY: Final = 9.81

AT_A_STOP: Final = 1e-9
"""By how much the reference pose may lie beyond a stop [rad]: files round."""

FREE: Final = (-math.inf, math.inf)
"""Range of a joint without stops [rad]."""


@checked(RobotDescriptionError)
class JointInFile:
    """A joint of the robot's own model file: angle there = offset + sign angle here.

    Args:
        name: of the joint in the file.
        sign: 1 or -1.
        offset: angle there in the reference pose [rad].
    """

    name: Name
    sign: Literal[1, -1] = 1
    offset: Turns = 0.0


@checked(RobotDescriptionError)
class JointsInFile:
    """Joints of a leg in the robot's own model file; None where that is not known."""

    abduction: JointInFile | None = None
    hip: JointInFile | None = None
    knee: JointInFile | None = None


CHAINS: Final = (
    ("abduction", "hip", "knee"),
    ("hip", "abduction", "knee"),
    ("hip", "knee"),
    ("coxa", "femur", "tibia"),
    ("coxa", "femur"),
)
"""Joints that a leg may have, from the trunk outward.

Abduction turns about x, hip and knee about y, a coxa about z, and then femur and tibia about the
horizontal axis across the leg.
"""


@checked(RobotDescriptionError)
class Leg:
    """A leg of three joints, usually an abduction about x, and a hip and a knee about y.

    Vectors other than ``mount`` have y pointing outward, away from the middle plane, or along the
    leg if that is ``pointing`` elsewhere.

    Args:
        name: name of the leg, e.g. ``"RF"``.
        mount: first joint on the trunk, from the trunk's reference point [m].
        hip_offset: first joint to second [m].
        femur_length, tibia_length: pivot to pivot, and knee to centre of the foot ball [m].
        femur_angle: reference pose, femur back of vertical [rad].
        tibia_angle: reference pose, tibia forward of the femur [rad].
        hip, femur, tibia: mass properties of the three links, in frames at their joints.
        joints: its joints in the robot's own model file.
        knee: ``"<"`` for a knee behind the line from hip to foot, ``">"`` for one in front of it. A
            positive angle of the knee flexes it either way.
        abduction_angle: reference pose, foot outward of vertical [rad].
        abduction_range, coxa_range, femur_range, tibia_range: stops of the joints, as values of
            ``abduction_angle``, ``pointing``, ``femur_angle`` and ``tibia_angle`` [rad]; None for
            none.
        foot_radius: radius of its foot ball [m]; None for that of the contact.
        servo: what its servos have of their own.
        chain: its joints from the trunk outward, one of ``CHAINS``. With a coxa, ``femur_angle`` is
            outward of vertical and ``tibia_angle`` inward of the femur. The controller's hip angle
            turns the coxa, its knee angle the femur, and the tibia is held as an abduction is.
        pointing: where a leg with a coxa points, forward of straight outward [rad].

    Raises:
        RobotDescriptionError: a value out of range, keys that contradict each other, or the
            reference pose is not between the stops.
    """

    name: Name
    mount: Vector3
    hip_offset: Vector3
    femur_length: Edge
    tibia_length: Edge
    femur_angle: Angle
    tibia_angle: Angle
    hip: Body
    femur: Body
    tibia: Body
    joints: JointsInFile = field(default_factory=JointsInFile)
    knee: Literal["<", ">"] = "<"
    abduction_angle: Angle = 0.0
    abduction_range: Range | None = None
    coxa_range: Range | None = None
    femur_range: Range | None = None
    tibia_range: Range | None = None
    foot_radius: Edge | None = None
    servo: LegServos = field(default_factory=LegServos)
    chain: tuple[str, ...] = CHAINS[0]
    pointing: Angle = 0.0

    def __post_init__(self) -> None:
        if self.chain not in CHAINS:
            known = " or ".join(str(list(chain)) for chain in CHAINS)
            raise KeyRefusedError("chain", f"chain is {list(self.chain)}; allowed: {known}")
        unknown = "abduction_angle" if self.has_coxa else "pointing"
        if getattr(self, unknown) != 0.0:
            raise KeyRefusedError(
                unknown,
                f"{unknown} is {math.degrees(getattr(self, unknown)):.4g} deg and chain is "
                f"{list(self.chain)}; allowed with it: 0",
            )
        stops = "abduction_range" if self.has_coxa else "coxa_range"
        if getattr(self, stops) is not None:
            raise KeyRefusedError(
                stops, f"{stops} is given and chain is {list(self.chain)}; allowed with it: none"
            )
        if (self.tibia_angle > 0.0) if self.knee == ">" else (self.tibia_angle < 0.0):
            sign, other = ("less", "<") if self.knee == ">" else ("more", ">")
            raise KeyRefusedError(
                "tibia_angle",
                f"knee is {self.knee!r} and tibia_angle is "
                f"{math.degrees(self.tibia_angle):.4g} deg; allowed with it: 0 and {sign}, "
                f'or the line knee = "{other}"',
            )
        for key, span, angle in (
            ("abduction_range", self.abduction_range, self.abduction_angle),
            ("coxa_range", self.coxa_range, self.pointing),
            ("femur_range", self.femur_range, self.femur_angle),
            ("tibia_range", self.tibia_range, self.tibia_angle),
        ):
            if span is None or span[0] - AT_A_STOP <= angle <= span[1] + AT_A_STOP:
                continue
            low, high, at = (f"{math.degrees(each):.4g}" for each in (*span, angle))
            if span[0] > span[1]:
                allowed = "the lower end, then the upper"
            else:
                allowed = f"around the reference pose, at {at}"
            raise KeyRefusedError(key, f"{key} is {low} to {high} deg; allowed: {allowed}")

    @property
    def stops(self) -> tuple[tuple[float, float], ...]:
        """Lowest and highest joint angle of abduction, hip and knee [rad]; infinite without."""
        # what a positive joint angle does to the angle of the file: a positive hip angle swings
        # the leg forward, a positive knee angle flexes the knee
        signs = (self.side, -1.0, -1.0 if self.knee == ">" else 1.0)
        ranges = (self.abduction_range, self.femur_range, self.tibia_range)
        angles = (self.abduction_angle, self.femur_angle, self.tibia_angle)
        if self.has_coxa:  # tibia, coxa, femur: outward, forward, up
            signs = (-self.side, 1.0, 1.0)
            ranges = (self.tibia_range, self.coxa_range, self.femur_range)
            angles = (self.tibia_angle, self.pointing, self.femur_angle)
        stops = []
        for sign, (low, high), angle in zip(
            signs, (each or FREE for each in ranges), angles, strict=True
        ):
            ends = sign * (low - angle), sign * (high - angle)
            stops.append((min(ends), max(ends)))
        return tuple(stops)

    @property
    def side(self) -> float:
        """-1 for a leg on the right, +1 on the left or in the middle."""
        return -1.0 if self.mount[1] < 0.0 else 1.0

    @property
    def has_coxa(self) -> bool:
        """Whether the first joint turns about z."""
        return self.chain[0] == "coxa"

    @property
    def yaw(self) -> float:
        """Turn of the leg about z from where it would point straight outward [rad]."""
        return -self.side * self.pointing

    def outward(self, vector: Vector3) -> Vector3:
        """The vector in axes parallel to the trunk's, given one with y pointing outward [m]."""
        x, y, z = vector[0], self.side * vector[1], vector[2]
        if self.pointing == 0.0:
            return (x, y, z)
        c, s = math.cos(self.yaw), math.sin(self.yaw)
        return (c * x - s * y, s * x + c * y, z)

    def mass_properties(self, link: Body) -> MassProperties:
        """Mass properties of one of the links, on the side this leg is on."""
        mirror = np.array([1.0, self.side, 1.0])
        inertia = link.inertia_tensor()
        if link.inertia is not None:
            inertia = inertia * np.outer(mirror, mirror)
        if self.pointing != 0.0:
            c, s = math.cos(self.yaw), math.sin(self.yaw)
            turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
            inertia = turn @ inertia @ turn.T
        return MassProperties(link.mass, np.array(self.outward(link.com)), inertia)

    @property
    def mass(self) -> float:
        """Mass of the three links [kg]."""
        return self.hip.mass + self.femur.mass + self.tibia.mass


@checked(RobotDescriptionError)
class Contact:
    """Contact of a foot, a rubber ball, with hard ground.

    Args:
        foot_radius: radius of the foot ball [m].
        stiffness: normal force per penetration [N/m].
        damping: normal force per speed of penetration, once the foot has sunk in by
            ``damping_depth`` [N s/m].
        damping_depth: penetration over which damping sets in [m].
        friction: Coulomb coefficient [1].
        friction_speed: below this sliding speed friction is proportional to it [m/s].
    """

    foot_radius: Edge
    stiffness: Annotated[Number, limits("N/m", gt=0.0)]
    damping: Annotated[Number, limits("N s/m", ge=0.0)]
    damping_depth: Edge = 0.0002
    friction: Annotated[Number, limits("1", ge=0.0)] = 0.8
    friction_speed: Annotated[Number, limits("m/s", gt=0.0)] = 0.03


@checked(RobotDescriptionError)
class Sensor:
    """Load cells: how the load that the controller gets differs from that on the foot.

    Args:
        component: ``"normal"`` for the force along the normal of the ground, ``"norm"`` for the
            length of the whole force.
        delay: age of the load when it arrives [s].
        time_constant: of the first-order low-pass [s]; 0 for none.
        noise: standard deviation, in halves of the robot's weight [1].
    """

    delay: Annotated[Number, limits("s", ge=0.0)] = 0.0
    time_constant: Annotated[Number, limits("s", ge=0.0)] = 0.0
    noise: Annotated[Number, limits("1", ge=0.0)] = 0.0
    component: Literal["normal", "norm"] = "normal"


OF_THE_RUN: Final = ("Ts", "robot_weight", "method", "stored", "phi_stored")
"""Parameters of the controller that only a run sets, neither a robot nor a preset."""


def _ordered(legs: tuple[Leg, ...]) -> tuple[Leg, ...]:
    """The legs in the order of the controller."""
    legs = tuple(sorted(legs, key=lambda leg: (leg.side, -leg.mount[0])))
    names = [leg.name for leg in legs]
    if len(set(names)) != len(names):
        raise ValueError(f"names are {', '.join(names)}; allowed: names that differ")
    right = [leg.name for leg in legs if leg.side < 0.0]
    if len(right) != len(legs) // 2:
        raise ValueError(
            f"{len(right)} are right ({', '.join(right)}); "
            f"allowed: {len(legs) // 2} of {len(legs)} legs with y < 0, right of the middle"
        )
    return legs


def _preset(values: Mapping[str, Any]) -> Frozen[Any]:
    """Parameters of the controller, checked against its table of variables."""
    for name in OF_THE_RUN:
        if name in values:
            raise ValueError(
                f"{name} is {values[name]!r}; allowed: parameters that a run does not set"
            )
    return Frozen({name: settings.checked(name, value) for name, value in values.items()})


Preset = Annotated[Mapping[str, Any], AfterValidator(_preset)]


def _limits_of(name: str) -> tuple[float, float]:
    """Smallest and largest value of a variable of the controller."""
    variable = variable_named(name)
    assert variable.min is not None and variable.max is not None
    return variable.min, variable.max


_SHORTEST, _LONGEST = _limits_of("Ts")
_LEAST_MI, _MOST_MI = _limits_of("MI")
Rate = Annotated[Number, limits("Hz", ge=1.0 / _LONGEST, le=1.0 / _SHORTEST)]
ModulatoryInput = Annotated[Number, limits("1", ge=_LEAST_MI, le=_MOST_MI)]


def _growing(span: tuple[float, float]) -> tuple[float, float]:
    if span[0] > span[1]:
        raise ValueError(f"{list(span)} falls; allowed: the lower end, then the upper")
    return span


MiRange = Annotated[tuple[ModulatoryInput, ModulatoryInput], AfterValidator(_growing)]


_HASH: Final = "_hash"


@checked(RobotDescriptionError)
class RobotDescription:
    """A robot as data, independent of any engine.

    Args:
        name: its name.
        trunk, servo, contact, sensor: its parts.
        legs: in any order; kept in the order of the controller: right legs (y < 0) from front to
            hind, then the others from front to hind.
        controller: its own preset: parameters of the controller that differ from the defaults, by
            name. Enumerations are given by item name or number.
        rate: update rate that it walks at [Hz]; None for the default of a run.
        mi_range: lowest and highest MI at which its gait was found [1]; None if that is not known.
        mi: MI that it walks at where none is asked for [1]; None for the default of a run.

    Raises:
        RobotDescriptionError: a value out of range; two legs of one name; right legs that are not
            half of all, rounded down (the controller takes the first n // 2 legs for the right
            ones); no such parameter, or a value it cannot have; an ``mi`` outside ``mi_range``; two
            joints of one name.
    """

    name: Name
    trunk: Trunk
    legs: Annotated[tuple[Leg, ...], limits(min_length=1), AfterValidator(_ordered)]
    servo: Servo
    contact: Contact
    sensor: Sensor = field(default_factory=Sensor)
    controller: Preset = field(default_factory=partial(Frozen, {}))
    rate: Rate | None = None
    mi_range: MiRange | None = None
    mi: ModulatoryInput | None = None

    def __post_init__(self) -> None:
        """Check what depends on several fields."""
        if self.mi is not None and self.mi_range is not None:
            low, high = self.mi_range
            if not low <= self.mi <= high:
                raise ValueError(f"mi is {self.mi}; allowed: {low} to {high}, its mi_range [1]")
        taken: dict[str, JointMap] = {}
        for each in self.joint_map:
            if (other := taken.setdefault(each.name, each)) is not each:
                places = f"the {other.joint} of {other.leg} and the {each.joint} of {each.leg}"
                raise ValueError(f"joint {each.name!r} is {places}; allowed: one of them")
        for leg in self.legs:
            self._check_inertia(leg)

    def _check_inertia(self, leg: Leg) -> None:
        """Refuse a joint that turns nothing with inertia."""
        if leg.has_coxa:  # servos by name, see ``Leg.chain``
            outward = (("hip", "coxa"), ("knee", "femur"), ("abduction", "tibia"))
        elif leg.chain[:2] == ("hip", "abduction"):
            outward = (("hip", "hip"), ("abduction", "abduction"), ("knee", "knee"))
        else:
            outward = (("abduction", "abduction"), ("hip", "hip"), ("knee", "knee"))
        carried = 0.0
        for (servo, joint), link in zip(
            outward[::-1], (leg.tibia, leg.femur, leg.hip), strict=True
        ):
            carried += link.mass
            turns = joint in leg.chain
            if turns and carried == self.servo_of(leg, servo).reflected_inertia == 0.0:
                raise ValueError(
                    f"the {joint} of leg {leg.name} turns neither mass nor rotor; allowed: a mass "
                    "behind it, or a reflected_inertia of its servo above 0"
                )

    def __hash__(self) -> int:
        """Hash of all fields, computed once: what depends on a robot is looked up by it."""
        found: int | None = self.__dict__.get(_HASH)
        if found is None:
            found = hash(tuple(getattr(self, each.name) for each in fields(self)))
            object.__setattr__(self, _HASH, found)
        return found

    def __getstate__(self) -> dict[str, Any]:
        """Without the hash, which differs between processes."""
        return {name: value for name, value in self.__dict__.items() if name != _HASH}

    @property
    def leg_names(self) -> tuple[str, ...]:
        """Names of the legs, in the order of the controller."""
        return tuple(leg.name for leg in self.legs)

    @property
    def joint_map(self) -> tuple[JointMap, ...]:
        """Joints of the robot's own model file, as far as they are known."""
        return tuple(
            JointMap(leg.name, joint.name, own.name, own.sign, own.offset)
            for leg in self.legs
            for joint in fields(JointsInFile)
            if (own := getattr(leg.joints, joint.name)) is not None
        )

    @property
    def usual_legs(self) -> bool:
        """Whether the joints of all legs turn about x, y and y."""
        return all(leg.chain in (CHAINS[0], CHAINS[2]) for leg in self.legs)

    @property
    def mass(self) -> float:
        """Total mass [kg]."""
        return self.trunk.mass + sum(leg.mass for leg in self.legs)

    def servo_of(self, leg: Leg, joint: str) -> Servo:
        """The servo of a joint of a leg, with nothing left to its joints."""
        return self.servo.of_joint(joint, leg.servo)

    def foot_radius_of(self, leg: Leg) -> float:
        """Radius of the foot ball of a leg [m]."""
        return self.contact.foot_radius if leg.foot_radius is None else leg.foot_radius

    @property
    def foot_radii(self) -> tuple[float, ...]:
        """Radii of all feet [m]."""
        return tuple(map(self.foot_radius_of, self.legs))

    @property
    def weight(self) -> float:
        """Weight on earth [N]."""
        return self.mass * GRAVITY

"""Robots as data, independent of engines: geometry, masses, servos, contact and sensors."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from functools import partial
from typing import Annotated, Any, Final, Literal

import numpy as np
from pydantic import AfterValidator, ValidationInfo, ValidatorFunctionWrapHandler, WrapValidator

from apnc_core import settings
from apnc_core.frozen import Frozen
from apnc_core.types import Array
from apnc_core.variables import variable_named
from apnc_plant.files import Number, checked, limits
from apnc_plant.robot.joint_map import JointMap


class RobotDescriptionError(ValueError):
    """A robot file is missing, or a value in it or in a robot is not allowed."""


def _angle(value: Any, check: ValidatorFunctionWrapHandler, info: ValidationInfo) -> float:
    """An angle in rad; it is checked in degrees, which is what a file holds."""
    in_file = bool(info.context)
    if in_file or isinstance(value, bool) or not isinstance(value, int | float):
        return math.radians(check(value))
    check(math.degrees(value))
    return float(value)


Length = Annotated[Number, limits("m")]
Edge = Annotated[Number, limits("m", gt=0.0)]
Angle = Annotated[Number, limits("deg", ge=-180.0, le=180.0), WrapValidator(_angle)]
_ODD = r"\p{Cc}\p{Zl}\p{Zp}\p{Noncharacter_Code_Point}"  # not in a line of every file format
_NAME = rf"^[^{_ODD}]*[^\s{_ODD}][^{_ODD}]*$"
Name = Annotated[str, limits(allowed="a name without control characters", pattern=_NAME)]

Vector3 = tuple[Length, Length, Length]

GRAVITY: Final = 9.81

PAYLOAD_SIZE: Final = (0.1, 0.1, 0.06)
"""Edges of the box that represents a payload [m]."""


@dataclass(frozen=True)
class MassProperties:
    """Mass [kg], centre of mass [m], shape (3,), and inertia about it [kg m^2], shape (3, 3)."""

    mass: float
    com: Array
    inertia: Array

    def joined(self, other: MassProperties) -> MassProperties:
        """Mass properties of both bodies rigidly connected, by the parallel-axis theorem."""
        mass = self.mass + other.mass
        com = (self.mass * self.com + other.mass * other.com) / mass
        inertia = self._about(com) + other._about(com)
        return MassProperties(mass, com, inertia)

    def _about(self, point: Array) -> Array:
        d = self.com - point
        return self.inertia + self.mass * ((d @ d) * np.eye(3) - np.outer(d, d))


def _box_inertia(mass: float, size: Vector3) -> Array:
    x, y, z = (edge**2 for edge in size)
    return np.diag([y + z, x + z, x + y]) * (mass / 12.0)


@checked(RobotDescriptionError)
class Body:
    """A rigid link with the inertia of a homogeneous box.

    Args:
        mass: mass [kg].
        size: edge lengths of the box [m].
        com: centre of mass in the frame of the link [m].
    """

    mass: Annotated[Number, limits("kg", gt=0.0)]
    size: tuple[Edge, Edge, Edge]
    com: Vector3

    def inertia(self) -> Array:
        """Inertia tensor about the centre of mass [kg m^2], shape (3, 3)."""
        return _box_inertia(self.mass, self.size)


@checked(RobotDescriptionError)
class Trunk(Body):
    """The body that carries the legs.

    Args:
        mass, size: as in :class:`Body`.
        com: centre of mass, measured from the reference point between the hips [m].
        center: middle of the box [m]; differs from the centre of mass.
        com_side_offset: size of the seeded sideways error of the centre of mass [m].
    """

    center: Vector3 = (0.0, 0.0, 0.0)
    com_side_offset: Annotated[Number, limits("m", ge=0.0)] = 0.0

    def corners(self) -> Array:
        """Corners of the box relative to the reference point [m], shape (8, 3)."""
        signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, 8).T
        return np.asarray(self.center) + signs * (np.asarray(self.size) / 2.0)

    def loaded(self, side_offset: float, payload: float) -> MassProperties:
        """Mass properties with a box of ``PAYLOAD_SIZE`` standing on the middle of the trunk.

        Args:
            side_offset: sideways error of the trunk's own centre of mass [m].
            payload: mass of the box [kg].
        """
        com = np.add(self.com, [0.0, side_offset, 0.0])
        own = MassProperties(self.mass, com, self.inertia())
        top = (self.size[2] + PAYLOAD_SIZE[2]) / 2.0
        on_top = np.add(self.center, [0.0, 0.0, top])
        return own.joined(MassProperties(payload, on_top, _box_inertia(payload, PAYLOAD_SIZE)))


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
    offset: Annotated[Number, limits("deg", ge=-360.0, le=360.0), WrapValidator(_angle)] = 0.0


@checked(RobotDescriptionError)
class JointsInFile:
    """Joints of a leg in the robot's own model file; None where that is not known."""

    abduction: JointInFile | None = None
    hip: JointInFile | None = None
    knee: JointInFile | None = None


@checked(RobotDescriptionError)
class Leg:
    """A leg with an abduction joint about x, and hip and knee joints about y.

    Vectors other than ``mount`` have y pointing outward, away from the middle plane.

    Args:
        name: name of the leg, e.g. ``"RF"``.
        mount: abduction joint on the trunk, from the trunk's reference point [m].
        hip_offset: abduction axis to hip axis [m].
        femur_length, tibia_length: pivot to pivot, and knee to centre of the foot ball [m].
        femur_angle: reference pose, femur back of vertical [rad].
        tibia_angle: reference pose, tibia forward of the femur [rad].
        hip, femur, tibia: mass properties of the three links, in frames at their joints.
        joints: its joints in the robot's own model file.
        knee: ``"<"`` for a knee behind the line from hip to foot, ``">"`` for one in front of it. A
            positive angle of the knee flexes it either way.
        abduction_angle: reference pose, foot outward of vertical [rad].

    Raises:
        RobotDescriptionError: a value out of range, or ``knee`` and ``tibia_angle`` contradict each
            other.
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

    def __post_init__(self) -> None:
        if (self.tibia_angle > 0.0) if self.knee == ">" else (self.tibia_angle < 0.0):
            allowed = "0 and less" if self.knee == ">" else "0 and more, or the other knee"
            raise ValueError(
                f"knee is {self.knee!r} and tibia_angle is "
                f"{math.degrees(self.tibia_angle):.4g} deg; allowed with it: {allowed}"
            )

    @property
    def side(self) -> float:
        """-1 for a leg on the right, +1 on the left or in the middle."""
        return -1.0 if self.mount[1] < 0.0 else 1.0

    def outward(self, vector: Vector3) -> Vector3:
        """The vector in axes parallel to the trunk's, given one with y pointing outward [m]."""
        return (vector[0], self.side * vector[1], vector[2])

    def mass_properties(self, link: Body) -> MassProperties:
        """Mass properties of one of the links, on the side this leg is on."""
        return MassProperties(link.mass, np.array(self.outward(link.com)), link.inertia())

    @property
    def mass(self) -> float:
        """Mass of the three links [kg]."""
        return self.hip.mass + self.femur.mass + self.tibia.mass


@checked(RobotDescriptionError)
class Servo:
    """A geared position servo.

    Args:
        stiffness: torque per position error [N m/rad].
        damping: torque per joint speed [N m s/rad].
        stall_torque: largest torque [N m].
        no_load_speed: speed at which no driving torque is left [rad/s].
        reflected_inertia: rotor inertia times the gear ratio squared [kg m^2].
        latency: age of a command when the servo starts to follow it [s].
        slew_rate: fastest change of the command that the servo follows [rad/s]; 0 for no limit.
    """

    stiffness: Annotated[Number, limits("N m/rad", gt=0.0)]
    damping: Annotated[Number, limits("N m s/rad", ge=0.0)]
    stall_torque: Annotated[Number, limits("N m", gt=0.0)]
    no_load_speed: Annotated[Number, limits("rad/s", gt=0.0)]
    reflected_inertia: Annotated[Number, limits("kg m^2", ge=0.0)] = 0.0
    latency: Annotated[Number, limits("s", ge=0.0)] = 0.0
    slew_rate: Annotated[Number, limits("rad/s", ge=0.0)] = 0.0


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
    def mass(self) -> float:
        """Total mass [kg]."""
        return self.trunk.mass + sum(leg.mass for leg in self.legs)

    @property
    def weight(self) -> float:
        """Weight on earth [N]."""
        return self.mass * GRAVITY

"""Robots as data: geometry, masses, servos, contact and sensors, independent of any engine."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated, Final, cast

import numpy as np

from apnc_core.frozen import Frozen
from apnc_core.settings import checked
from apnc_core.types import Array
from apnc_plant.robot.quantity import FLAT, Checked, NotAllowedError, RobotDescriptionError, Rule

Vector3 = tuple[float, float, float]

GRAVITY: Final = 9.81

PAYLOAD_SIZE: Final = (0.1, 0.1, 0.06)
"""Edges of the box a payload is [m]."""


@dataclass(frozen=True)
class MassProperties:
    """Mass [kg], centre of mass [m], shape (3,), and inertia about it [kg m^2], shape (3, 3)."""

    mass: float
    com: Array
    inertia: Array

    def joined(self, other: MassProperties) -> MassProperties:
        """Both bodies rigidly connected, by the parallel-axis theorem."""
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


@dataclass(frozen=True)
class Body(Checked):
    """A rigid link with the inertia of a homogeneous box.

    Args:
        mass: mass [kg].
        size: edge lengths of the box [m].
        com: centre of mass in the frame of the link [m].
    """

    mass: Annotated[float, Rule("kg", positive=True)]
    size: Annotated[Vector3, Rule("m", positive=True, count=3)]
    com: Annotated[Vector3, Rule("m", count=3)]

    def inertia(self) -> Array:
        """Inertia tensor about the centre of mass [kg m^2], shape (3, 3)."""
        return _box_inertia(self.mass, self.size)


@dataclass(frozen=True)
class Trunk(Checked):
    """The body that carries the legs.

    Args:
        body: mass properties, in a file beside the other keys; ``com`` is measured from the
            reference point between the hips.
        center: middle of the box [m]; differs from the centre of mass.
        com_side_offset: size of the seeded sideways error of the centre of mass [m].
    """

    body: Annotated[Body, FLAT]
    center: Annotated[Vector3, Rule("m", count=3)] = (0.0, 0.0, 0.0)
    com_side_offset: Annotated[float, Rule("m", low=0.0)] = 0.0

    def corners(self) -> Array:
        """Corners of the box relative to the reference point [m], shape (8, 3)."""
        signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, 8).T
        return np.asarray(self.center) + signs * (np.asarray(self.body.size) / 2.0)

    def loaded(self, side_offset: float, payload: float) -> MassProperties:
        """Mass properties with a box of ``PAYLOAD_SIZE`` standing on the middle of the trunk.

        Args:
            side_offset: sideways error of the trunk's own centre of mass [m].
            payload: mass of the box [kg].
        """
        com = np.add(self.body.com, [0.0, side_offset, 0.0])
        own = MassProperties(self.body.mass, com, self.body.inertia())
        top = (self.body.size[2] + PAYLOAD_SIZE[2]) / 2.0
        on_top = np.add(self.center, [0.0, 0.0, top])
        return own.joined(MassProperties(payload, on_top, _box_inertia(payload, PAYLOAD_SIZE)))


@dataclass(frozen=True)
class Leg(Checked):
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
    """

    name: Annotated[str, Rule(words=())]
    mount: Annotated[Vector3, Rule("m", count=3)]
    hip_offset: Annotated[Vector3, Rule("m", count=3)]
    femur_length: Annotated[float, Rule("m", positive=True)]
    tibia_length: Annotated[float, Rule("m", positive=True)]
    femur_angle: Annotated[float, Rule("deg", low=-180.0, high=180.0)]
    tibia_angle: Annotated[float, Rule("deg", low=-180.0, high=180.0)]
    hip: Body
    femur: Body
    tibia: Body

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


@dataclass(frozen=True)
class Servo(Checked):
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

    stiffness: Annotated[float, Rule("N m/rad", positive=True)]
    damping: Annotated[float, Rule("N m s/rad", low=0.0)]
    stall_torque: Annotated[float, Rule("N m", positive=True)]
    no_load_speed: Annotated[float, Rule("rad/s", positive=True)]
    reflected_inertia: Annotated[float, Rule("kg m^2", low=0.0)] = 0.0
    latency: Annotated[float, Rule("s", low=0.0)] = 0.0
    slew_rate: Annotated[float, Rule("rad/s", low=0.0)] = 0.0


@dataclass(frozen=True)
class Contact(Checked):
    """Rubber ball against hard ground.

    Args:
        foot_radius: radius of the foot ball [m].
        stiffness: normal force per penetration [N/m].
        damping: normal force per speed of penetration, once the foot has sunk in by
            ``damping_depth`` [N s/m].
        damping_depth: penetration over which damping sets in [m].
        friction: Coulomb coefficient [1].
        friction_speed: below this sliding speed friction is proportional to it [m/s].
    """

    foot_radius: Annotated[float, Rule("m", positive=True)]
    stiffness: Annotated[float, Rule("N/m", positive=True)]
    damping: Annotated[float, Rule("N s/m", low=0.0)]
    damping_depth: Annotated[float, Rule("m", positive=True)] = 0.0002
    friction: Annotated[float, Rule("1", low=0.0)] = 0.8
    friction_speed: Annotated[float, Rule("m/s", positive=True)] = 0.03


@dataclass(frozen=True)
class Sensor(Checked):
    """What separates the load on a foot from the load the controller sees.

    Args:
        component: ``"normal"`` for the force along the normal of the ground, ``"norm"`` for the
            length of the whole force.
        delay: age of the load when it arrives [s].
        time_constant: of the first-order low-pass [s]; 0 for none.
        noise: standard deviation, in halves of the robot's weight [1].
    """

    delay: Annotated[float, Rule("s", low=0.0)] = 0.0
    time_constant: Annotated[float, Rule("s", low=0.0)] = 0.0
    noise: Annotated[float, Rule("1", low=0.0)] = 0.0
    component: Annotated[str, Rule(words=("normal", "norm"))] = "normal"


OF_THE_RUN: Final = ("Ts", "robot_weight", "method", "stored", "phi_stored")
"""Parameters of the controller that a run sets, no robot and no preset."""


@dataclass(frozen=True)
class RobotDescription(Checked):
    """A robot as data, independent of any engine.

    Args:
        name: its name.
        trunk, servo, contact, sensor: its parts.
        legs: in any order; kept in the order of the controller: right legs (y < 0) from front to
            hind, then the others from front to hind.
        controller: its own preset: parameters of the controller that differ from the defaults, by
            name. Enumerations by item name or number.

    Raises:
        NotAllowedError: two legs of one name; right legs that are not half of all, rounded down
            (the controller takes the first n // 2 legs for the right ones); no such parameter, or
            a value it cannot have.
    """

    name: Annotated[str, Rule(words=())]
    trunk: Trunk
    legs: tuple[Leg, ...]
    servo: Servo
    contact: Contact
    sensor: Sensor = field(default_factory=Sensor)
    controller: Mapping[str, float | int | bool] = field(default_factory=dict)

    def __post_init__(self) -> None:
        """Put the legs in order and check them and the preset."""
        super().__post_init__()
        ordered = tuple(sorted(self.legs, key=lambda leg: (leg.side, -leg.mount[0])))
        object.__setattr__(self, "legs", ordered)
        names = [leg.name for leg in ordered]
        if len(set(names)) != len(names):
            raise NotAllowedError("legs", names, "names that differ")
        right = [leg.name for leg in ordered if leg.side < 0.0]
        if len(right) != len(ordered) // 2:
            allowed = f"{len(ordered) // 2} of {len(ordered)} legs with y < 0, right of the middle"
            raise NotAllowedError("legs", f"{len(right)} right ({', '.join(right)})", allowed)
        object.__setattr__(self, "controller", Frozen(_preset(self.controller)))

    @property
    def mass(self) -> float:
        """Total mass [kg]."""
        return self.trunk.body.mass + sum(leg.mass for leg in self.legs)

    @property
    def weight(self) -> float:
        """Weight on earth [N]."""
        return self.mass * GRAVITY


def _preset(values: Mapping[str, object]) -> dict[str, float | int | bool]:
    preset: dict[str, float | int | bool] = {}
    for name, value in values.items():
        if name in OF_THE_RUN:
            raise NotAllowedError(f"controller.{name}", value, "parameters that a run does not set")
        try:
            preset[name] = cast(float | int | bool, checked(name, value))
        except ValueError as error:
            raise RobotDescriptionError(f"controller: {error}") from None
    return preset

"""Robots as MJCF text, the format of MuJoCo. MuJoCo itself is not needed to write it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from math import cos, sin
from typing import Any, Final
from xml.etree import ElementTree

import numpy as np
from scipy.spatial.transform import Rotation

from apnc_plant.ground import GroundInC, Plane
from apnc_plant.numbers import robot_numbers
from apnc_plant.options import PlantOptions
from apnc_plant.robot.body import MassProperties
from apnc_plant.robot.links import LOCKED, links_of, range_of
from apnc_plant.robot.model import GRAVITY, Leg, RobotDescription
from apnc_plant.robot.servo import Servo
from apnc_plant.signals import JOINTS
from apnc_plant.start import start_coordinates
from mujoco_models.contact import IMPRATIO, STEP, Geom, geom_of, pair_of

SERVOS: Final = ("position", "dcmotor")
"""Ways to write the servos, see :func:`robot_mjcf`."""

NO_LOAD_SPEED: Final = "no_load_speed"
"""Name of a number in ``custom``."""

_LEAST: Final = {"boundmass": "1e-09", "boundinertia": "1e-12"}
"""What MuJoCo takes for the mass [kg] and inertia [kg m^2] of a moving body without any."""

_BASE: Final = (
    ("slide", "x", "1 0 0"),
    ("slide", "y", "0 1 0"),
    ("slide", "z", "0 0 1"),
    ("hinge", "yaw", "0 0 1"),
    ("hinge", "pitch", "0 1 0"),
    ("hinge", "roll", "1 0 0"),
)
_RUBBER, _PLASTIC = "0.15 0.15 0.15 1", "0.55 0.6 0.65 1"

Element = ElementTree.Element
_add = ElementTree.SubElement


def tree_mjcf(robot: RobotDescription, trunk: MassProperties) -> str:
    """The robot in the coordinates of ``apnc_plant.coordinates``, for ``mujoco_models.plant``.

    The base has three slides and three hinges. The model has
    neither actuators nor a ground: the plant computes all forces.

    Args:
        robot: the robot.
        trunk: mass properties of its trunk with the payload.
    """
    root, body = _model(robot)
    for kind, name, axis in _BASE:
        _add(body, "joint", name=name, type=kind, axis=axis)
    _inertial(body, trunk)
    for leg in robot.legs:
        _leg(body, leg, robot)
    return _text(root)


def robot_mjcf(
    robot: RobotDescription, admittances: Sequence[float], *, servo: str = "position"
) -> str:
    """The robot for other programs: free base, servos, sensors, a level ground and visible shapes.

    Joint angles, their signs and the reference pose are ours, see ``apnc_plant.signals``. In the
    keyframe ``stand`` all joints are at 0 and the lowest foot touches the ground. The boxes of
    trunk, hip and femur links collide with everything in the scene but with each other.

    Args:
        robot: the robot, with plain names.
        admittances: A of every foot, MuJoCo's ``body_invweight0`` [1/kg]; the parameters of its
            contact depend on it.
        servo: ``position`` works in every MuJoCo and has stiffness, damping and stall torque, but
            the no-load speed is only noted in ``custom``. ``dcmotor`` needs MuJoCo 3.12 and also
            has the line from stall torque to no-load speed.

    Raises:
        ValueError: the servo is unknown.
    """
    if servo not in SERVOS:
        raise ValueError(f"servo '{servo}' is not one of {', '.join(SERVOS)}")
    root, body = _model(robot)
    ground, start = GroundInC(Plane(), max(robot.foot_radii)), PlantOptions()
    start_position = _numbers(start_coordinates(robot_numbers(robot), ground, start)[:3])
    body.set("pos", start_position)
    _add(body, "freejoint", name="base")
    trunk = robot.trunk
    _inertial(body, trunk.loaded(0.0, 0.0))
    _box(body, trunk.center, trunk.edges, _TOUCHING)
    _add(body, "site", name="imu")
    for leg, admittance in zip(robot.legs, admittances, strict=True):
        _leg(body, leg, robot, geom_of(robot, admittance))
    _ground(root, robot, admittances)
    _actuators(root, robot, servo)
    _sensors(root, robot)
    at_rest = _numbers([0.0] * len(joints_of(robot)))
    stand = {"qpos": f"{start_position} 1.0 0.0 0.0 0.0 {at_rest}", "ctrl": at_rest}
    _add(_add(root, "keyframe"), "key", stand, name="stand")
    return _text(root)


def joints_of(robot: RobotDescription) -> list[str]:
    """Names of the joints, leg by leg from the trunk outward."""
    return [
        f"{leg.name}_{link.joint}"
        for leg in robot.legs
        for link in links_of(leg)
        if not link.locked
    ]


def foot_of(leg: Leg) -> str:
    """Name of the ball and the site of a foot."""
    return f"{leg.name}_foot"


def _model(robot: RobotDescription) -> tuple[Element, Element]:
    """Root of a model and its trunk."""
    root = Element("mujoco", model=robot.name)
    compiler = _add(root, "compiler", angle="radian", autolimits="true", inertiafromgeom="false")
    if any(link.mass == 0.0 for leg in robot.legs for link in (leg.hip, leg.femur, leg.tibia)):
        compiler.attrib.update(_LEAST)
    _add(
        root,
        "option",
        timestep=repr(STEP),
        gravity=_numbers((0.0, 0.0, -GRAVITY)),
        integrator="implicitfast",
        cone="elliptic",
        impratio=repr(IMPRATIO),
    )
    world = _add(root, "worldbody")
    return root, _add(world, "body", name="trunk")


def _leg(trunk: Element, leg: Leg, robot: RobotDescription, foot: Geom | None = None) -> None:
    """A leg: with contact parameters of its foot for other programs, without for our own plant."""
    at = trunk
    for link, box in zip(links_of(leg), (leg.hip, leg.femur, leg.tibia), strict=True):
        half, servo = link.turn / 2.0, robot.servo_of(leg, JOINTS[link.angle])
        turn = (cos(half), *(sin(half) * part for part in link.axis))
        at = _add(
            at, "body", name=f"{leg.name}_{link.name}",
            pos=_numbers(link.position), quat=_numbers(turn),
        )  # fmt: skip
        if not (foot and link.locked):
            joint = _add(
                at, "joint", name=f"{leg.name}_{link.joint}",
                axis=_numbers(link.positive if foot else link.axis),
                armature=repr(LOCKED if link.locked else servo.reflected_inertia),
            )  # fmt: skip
            if foot:
                joint.set("range", _numbers(range_of(leg.stops[link.angle])))
                joint.set("actuatorfrcrange", _numbers(_within(servo.stall_torque)))
                joint.set("damping", repr(servo.joint_damping))
                joint.set("frictionloss", repr(servo.dry_friction))
        _inertial(at, link.body)
        if foot:
            # the box of a tibia must not collide: its edges would touch beside the ball
            touch = _UNTOUCHED if box is leg.tibia else _TOUCHING
            _box(at, leg.outward(box.com), box.size, touch, leg.yaw)
    ball = {"pos": _numbers((0.0, 0.0, -leg.tibia_length)), "type": "sphere"}
    radius = robot.foot_radius_of(leg)
    touch = {**_TOUCHING, "priority": "1", **_contact(robot, *foot)} if foot else _UNTOUCHED
    _add(at, "geom", ball, name=foot_of(leg), size=repr(radius), rgba=_RUBBER, **touch)
    # the load sensor sums the contacts inside its site, so the site is larger than the ball
    size = repr(1.5 * radius)
    _add(at, "site", ball, name=foot_of(leg), size=size, rgba="0 0 0 0")


_UNTOUCHED: Final[Any] = {"contype": "0", "conaffinity": "0", "mass": "0"}
_TOUCHING: Final[Any] = {"contype": "2", "conaffinity": "1", "mass": "0"}
"""Attributes of a geom of the robot that collides with geoms of the scene, whose values are 1 and 1
by default, but not with other geoms of the robot."""


def _contact(
    robot: RobotDescription, impedance: float, normal: tuple[float, float]
) -> dict[str, str]:
    """Attributes of a contact of a foot."""
    return {
        "condim": "3",
        "friction": _numbers((robot.contact.friction, 0.0, 0.0)),
        "solimp": _numbers((impedance, impedance, 0.001, 0.5, 2.0)),
        "solref": _numbers(-value for value in normal),
    }


def _inertial(body: Element, properties: MassProperties) -> None:
    inertia, turn = properties.inertia, {}
    if np.count_nonzero(inertia - np.diag(np.diag(inertia))):
        # MuJoCo itself computes the principal axes to six digits only, at least up to 3.6
        moments, axes = np.linalg.eigh(inertia)
        axes[:, 2] *= np.linalg.det(axes)  # right-handed
        inertia = np.diag(moments)
        turn = {"quat": _numbers(Rotation.from_matrix(axes).as_quat(scalar_first=True))}
    center, mass = _numbers(properties.com), repr(float(properties.mass))
    diagonal = _numbers(np.diag(inertia))
    _add(body, "inertial", turn, pos=center, mass=mass, diaginertia=diagonal)


def _box(
    body: Element, center: Sequence[float], size: Sequence[float], touch: Any, yaw: float = 0.0
) -> None:
    half = _numbers(edge / 2.0 for edge in size)
    geom = _add(body, "geom", type="box", pos=_numbers(center), size=half, rgba=_PLASTIC, **touch)
    if yaw != 0.0:
        geom.set("quat", _numbers((cos(yaw / 2.0), 0.0, 0.0, sin(yaw / 2.0))))


def _ground(root: Element, robot: RobotDescription, admittances: Sequence[float]) -> None:
    """Add a level ground and its contact pairs with the feet."""
    world = root.find("worldbody")
    assert world is not None
    mu = robot.contact.friction
    _add(
        world, "geom", name="ground", type="plane", size="5 5 0.1", rgba="0.9 0.9 0.9 1",
        friction=_numbers((mu, 0.0, 0.0)), mass="0",
    )  # fmt: skip
    contact = _add(root, "contact")
    for leg, admittance in zip(robot.legs, admittances, strict=True):
        pair = pair_of(robot, admittance)
        attributes = _contact(robot, pair.impedance, pair.normal) | {
            "friction": _numbers((mu, mu, 0.0, 0.0, 0.0)),
            "solreffriction": _numbers(-value for value in pair.along),
        }
        _add(contact, "pair", attributes, geom1="ground", geom2=foot_of(leg))


def _actuators(root: Element, robot: RobotDescription, servo: str) -> None:
    servos = [
        robot.servo_of(leg, JOINTS[link.angle])
        for leg in robot.legs
        for link in links_of(leg)
        if not link.locked
    ]
    if servo == "position":
        _no_load_speeds(_add(root, "custom"), robot, servos)
    of = _add(root, "actuator")
    for joint, motor in zip(joints_of(robot), servos, strict=True):
        _add(of, servo, _gains(motor, servo), name=joint, joint=joint)


def _gains(motor: Servo, servo: str) -> dict[str, str]:
    """Attributes of an actuator."""
    stall, speed = motor.stall_torque, motor.no_load_speed
    if servo == "dcmotor":
        # any supply voltage gives the same line from stall torque to no-load speed
        return {
            "nominal": _numbers((1.0, stall, speed)),
            "saturation": _numbers((stall, 0.0, 0.0)),
            "input": "pos",
            "controller": _numbers((motor.stiffness, 0.0, motor.damping, 0.0, 0.0, 1.0)),
        }
    return {
        "kp": repr(motor.stiffness),
        "kv": repr(motor.damping),
        "forcerange": _numbers(_within(stall)),
    }


def _no_load_speeds(custom: Element, robot: RobotDescription, servos: Sequence[Servo]) -> None:
    """Note the no-load speed, and that of joints with another one as ``no_load_speed:JOINT``."""
    common = robot.servo.no_load_speed
    _add(custom, "numeric", name=NO_LOAD_SPEED, data=repr(common))
    for joint, motor in zip(joints_of(robot), servos, strict=True):
        if motor.no_load_speed != common:
            name = f"{NO_LOAD_SPEED}:{joint}"
            _add(custom, "numeric", name=name, data=repr(motor.no_load_speed))


def _sensors(root: Element, robot: RobotDescription) -> None:
    of = _add(root, "sensor")
    for leg in robot.legs:
        _add(of, "touch", name=f"{leg.name}_grf", site=foot_of(leg))
    for joint in joints_of(robot):
        _add(of, "jointpos", name=f"{joint}_angle", joint=joint)
        _add(of, "jointvel", name=f"{joint}_speed", joint=joint)
        _add(of, "actuatorfrc", name=f"{joint}_torque", actuator=joint)
    for kind, name in (
        ("framepos", "position"),
        ("framequat", "orientation"),
        ("framelinvel", "velocity"),
    ):
        _add(of, kind, name=name, objtype="xbody", objname="trunk")
    _add(of, "gyro", name="gyro", site="imu")
    _add(of, "accelerometer", name="accelerometer", site="imu")


def _within(limit: float) -> tuple[float, float]:
    return -limit, limit


def _numbers(values: Iterable[float]) -> str:
    """Numbers with all digits, and without minus zero."""
    return " ".join(repr(float(value) + 0.0) for value in values)


def _text(root: Element) -> str:
    ElementTree.indent(root)
    return ElementTree.tostring(root, encoding="unicode") + "\n"

"""Robots and conditions as structs of the plant in C."""

from __future__ import annotations

import math
from functools import lru_cache
from typing import Any, Final, NamedTuple

from apnc_plant.conditions import Conditions
from apnc_plant.library import library
from apnc_plant.robot.body import PAYLOAD_SIZE, MassProperties, Trunk
from apnc_plant.robot.links import links_of
from apnc_plant.robot.model import GRAVITY, Contact, Leg, RobotDescription, Sensor
from apnc_plant.robot.servo import Servo
from apnc_plant.robot.size import times_heavier, times_longer
from apnc_plant.signals import JOINTS

SUSPENSION: Final = (5000.0, 200.0, 50.0, 2.0)
"""Suspension of the held trunk of Lilibot: stiffness and damping of its position [N/m], [N s/m],
then of its rotation [N m/rad], [N m s/rad].

It is close to critically damped, and so stiff that legs swinging in the air move the trunk by
tenths of a millimetre only.
"""


def suspension(robot: RobotDescription) -> tuple[float, ...]:
    """Suspension of a held trunk: that of Lilibot, scaled so that robots of all sizes move alike.

    Forces grow with the weight, lengths with the leg, and times with the root of the leg.
    """
    m, length = times_heavier(robot), times_longer(robot)
    time = math.sqrt(length)
    scales = (m / length, m / time, m * length, m * length * time)
    return tuple(number * scale for number, scale in zip(SUSPENSION, scales, strict=True))


_KINDS: Final = {"abduction": 0, "hip": 1, "coxa": 2}
"""``PLANT_ABDUCTION`` and so on, by the first joint of a leg."""


class Numbers(NamedTuple):
    """A struct of C and the arrays it points to.

    Args:
        at: pointer to the struct, which lives as long as this object.
        kept: the arrays, which must live as long as the pointer.
    """

    at: Any
    kept: tuple[Any, ...] = ()


def robot_numbers(
    robot: RobotDescription,
    *,
    side_offset: float = 0.0,
    payload: float = 0.0,
    gravity: float = GRAVITY,
) -> Numbers:
    """A robot as ``plant_robot``.

    Args:
        robot: the robot.
        side_offset: sideways error of the trunk's own centre of mass [m].
        payload: mass of the box on the trunk [kg].
        gravity: downward acceleration [m/s^2].
    """
    ffi, _ = library()
    legs = ffi.new("plant_leg[]", _legs(robot))
    numbers = {
        "legs": len(robot.legs),
        "gravity": gravity,
        "weight": robot.weight,
        "trunk": _loaded(robot.trunk, side_offset, payload)[0],
        "trunk_center": list(robot.trunk.center),
        "trunk_size": list(robot.trunk.edges),
        "servo": servo_numbers(robot.servo),
        "contact": contact_numbers(robot.contact),
        "sensor": sensor_numbers(robot.sensor),
        "suspension": suspension(robot),
        "leg": legs,
    }
    return Numbers(ffi.new("plant_robot *", numbers), (legs,))


@lru_cache(maxsize=64)
def _legs(robot: RobotDescription) -> list[dict[str, Any]]:
    """Its legs for cffi, which copies them; a search walks one robot many times."""
    return [leg_numbers(robot, leg) for leg in robot.legs]


def _loaded(trunk: Trunk, side_offset: float, payload: float) -> Any:
    """As ``Trunk.loaded``, by the functions of the robot's FMU, so that the bits are the same."""
    ffi, lib = library()
    own, box = bare_trunk(trunk), ffi.new("plant_body *")
    own.com[1] += side_offset
    (x, y, z), above = trunk.center, (trunk.edges[2] + PAYLOAD_SIZE[2]) / 2.0
    lib.plant_box(payload, PAYLOAD_SIZE, [x, y, z + above], box)
    lib.plant_join(own, box, own)
    return own


def bare_trunk(trunk: Trunk) -> Any:
    """The trunk alone as ``plant_body``."""
    ffi, lib = library()
    body = ffi.new("plant_body *")
    lib.plant_box(trunk.mass, trunk.size, trunk.com, body)
    if trunk.inertia is not None:
        body.inertia = trunk.inertia
    return body


def leg_numbers(robot: RobotDescription, leg: Leg) -> dict[str, Any]:
    """A leg as ``plant_leg``, for cffi."""
    return {
        "mount": list(leg.mount),
        "hip": list(leg.outward(leg.hip_offset)),
        "femur": leg.femur_length,
        "tibia": leg.tibia_length,
        "femur_angle": leg.femur_angle,
        "tibia_angle": leg.tibia_angle,
        "link": [_body(link.body) for link in links_of(leg)],
        "joint": [_joint(robot, leg, *each) for each in zip(JOINTS, leg.stops, strict=True)],
        "foot_radius": math.nan if leg.foot_radius is None else leg.foot_radius,
        "abduction_angle": leg.side * leg.abduction_angle,
        "knee_in_front": int(leg.knee == ">"),
        "kind": _KINDS[leg.chain[0] if len(leg.chain) == 3 or leg.has_coxa else "abduction"],
        "locked": [int(link.locked) for link in links_of(leg)],
        "pointing": leg.side * (math.pi / 2.0 - leg.pointing) if leg.has_coxa else 0.0,
    }


_TUNED: Final = ("stiffness", "damping", "stall_torque", "no_load_speed", "reflected_inertia")
"""What a joint has from the robot's servo, which may change later, unless it has its own."""


def _joint(
    robot: RobotDescription, leg: Leg, joint: str, stops: tuple[float, float]
) -> dict[str, float]:
    """A joint as ``plant_joint``, for cffi."""
    servo, own = robot.servo_of(leg, joint), robot.servo.own_of_joint(joint, leg.servo)
    stiffness, damping = servo.stop
    return {
        **{key: own.get(key, math.nan) for key in _TUNED},
        "joint_damping": servo.joint_damping,
        "dry_friction": servo.dry_friction,
        "friction_speed": servo.friction_speed,
        "low": stops[0],
        "high": stops[1],
        "stop_stiffness": stiffness,
        "stop_damping": damping,
    }


def _body(body: MassProperties) -> dict[str, Any]:
    entries = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    inertia = [float(body.inertia[entry]) for entry in entries]
    return {"mass": float(body.mass), "com": [float(x) for x in body.com], "inertia": inertia}


def servo_numbers(servo: Servo) -> dict[str, float]:
    """A servo as ``plant_servo``, for cffi."""
    return {
        "stiffness": servo.stiffness,
        "damping": servo.damping,
        "stall_torque": servo.stall_torque,
        "no_load_speed": servo.no_load_speed,
        "reflected_inertia": servo.reflected_inertia,
        "latency": servo.latency,
        "slew_rate": servo.slew_rate,
    }


def contact_numbers(contact: Contact) -> dict[str, float]:
    """A contact as ``plant_contact``, for cffi."""
    return {
        "foot_radius": contact.foot_radius,
        "stiffness": contact.stiffness,
        "damping": contact.damping,
        "damping_depth": contact.damping_depth,
        "friction": contact.friction,
        "friction_speed": contact.friction_speed,
    }


def sensor_numbers(sensor: Sensor) -> dict[str, float | int]:
    """A sensor as ``plant_sensor``, for cffi."""
    return {
        "delay": sensor.delay,
        "time_constant": sensor.time_constant,
        "noise": sensor.noise,
        "norm": int(sensor.component == "norm"),
    }


def conditions_numbers(conditions: Conditions, legs: tuple[str, ...], weight: float) -> Numbers:
    """Conditions as ``plant_conditions``; the payload is part of the numbers of the robot.

    Args:
        conditions: the conditions.
        legs: names of the robot's legs.
        weight: weight of the robot without payload [N].
    """
    ffi, _ = library()
    delivered = {leg: value * weight / 2.0 for leg, value in conditions.stuck.items()}
    delivered |= dict.fromkeys(conditions.silent(legs), 0.0)
    damaged = ffi.new("uint8_t[]", [leg in conditions.damaged for leg in legs])
    stuck = ffi.new("double[]", [delivered.get(leg, math.nan) for leg in legs])
    held = conditions.held_at is not None
    numbers = {
        "grf_noise": conditions.grf_noise,
        "held": held,
        "held_at": conditions.held_at or 0.0,
        "damaged": damaged,
        "stuck": stuck,
    }
    return Numbers(ffi.new("plant_conditions *", numbers), (damaged, stuck))

"""Servos, contact of the feet and suspension: every force Exudyn does not know, compiled.

Exudyn calls :func:`evaluate` once per integration step. Its own contact costs more than the rest
of the robot together, and knows neither a contact whose damping sets in gradually nor grounds of
any shape. Where a foot touches is asked of the ground's touch function, which comes by its address.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import Any

from apnc_plant.ground.surface import Integers
from apnc_plant.robot.model import Array
from exudyn_models.physics.compiled import compiled
from exudyn_models.physics.touching import call_touch

V3 = tuple[float, float, float]
Rows = tuple[V3, V3, V3]

# Where things lie in the flat array of parameters.
SERVO = 0  # stiffness, damping, stall torque, no-load speed
CONTACT = 4  # radius, stiffness, damping, damping depth, friction, friction speed, step / mass
HOLD = 11  # on, stiffness and damping of position, of rotation, six coordinates held
GROUND = 22  # rotation from ground to world, row by row
TOP = 31  # greatest height of the ground over its plane
PARAMETERS = 32

TIPPED_OVER = 0.5  # cosine of 60 degrees
UPENDED = 0.174  # cosine of 80 degrees


@compiled
def _dot(a: V3, b: V3) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@compiled
def _cross(a: V3, b: V3) -> V3:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


@compiled
def _add(a: V3, b: V3) -> V3:
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


@compiled
def _sub(a: V3, b: V3) -> V3:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


@compiled
def _scale(s: float, a: V3) -> V3:
    return (s * a[0], s * a[1], s * a[2])


@compiled
def _turn(rows: Rows, a: V3) -> V3:
    return (_dot(rows[0], a), _dot(rows[1], a), _dot(rows[2], a))


@compiled
def _turn_back(rows: Rows, a: V3) -> V3:
    return _add(_add(_scale(a[0], rows[0]), _scale(a[1], rows[1])), _scale(a[2], rows[2]))


@compiled
def _rows(parameters: Array) -> Rows:
    g = parameters[GROUND:TOP]
    return ((g[0], g[1], g[2]), (g[3], g[4], g[5]), (g[6], g[7], g[8]))


@compiled
def rotation_rpy(roll: float, pitch: float, yaw: float) -> Rows:
    """Rows of the rotation from trunk to world, Rz(yaw) Ry(pitch) Rx(roll)."""
    cr, sr, cp, sp, cy, sy = cos(roll), sin(roll), cos(pitch), sin(pitch), cos(yaw), sin(yaw)
    return (
        (cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr),
        (sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr),
        (-sp, cp * sr, cp * cr),
    )


@compiled
def leg_points(leg: Array, abduction: float, hip: float, knee: float) -> tuple[V3, V3, V3, V3]:
    """Hip pivot, knee pivot, foot [m] and axis of hip and knee, all in the trunk frame.

    Args:
        leg: mount, hip offset, femur and tibia length, femur and tibia angle, shape (10,).
        abduction, hip, knee: joint angles relative to the reference pose [rad].
    """
    c, s = cos(abduction), sin(abduction)
    tilt = hip - leg[8]
    low = tilt + knee + leg[9]
    pivot = (leg[0] + leg[3], leg[1] + c * leg[4] - s * leg[5], leg[2] + s * leg[4] + c * leg[5])
    femur = (leg[6] * sin(tilt), s * leg[6] * cos(tilt), -c * leg[6] * cos(tilt))
    tibia = (leg[7] * sin(low), s * leg[7] * cos(low), -c * leg[7] * cos(low))
    knee_pivot = _add(pivot, femur)
    return pivot, knee_pivot, _add(knee_pivot, tibia), (0.0, -c, -s)


@compiled
def servo_torque(servo: Array, error: float, speed: float) -> float:
    """Torque of a position servo [N m].

    tau = P error - D speed, held within what the motor can give at that speed:
    stall_torque (-1 - speed/no_load_speed) <= tau <= stall_torque (1 - speed/no_load_speed) from
    the supply voltage, and |tau| <= stall_torque from the current limit.

    Args:
        servo: P [N m/rad], D [N m s/rad], stall torque [N m], no-load speed [rad/s].
        error: commanded minus actual angle [rad].
        speed: joint speed [rad/s].
    """
    stiffness, damping, stall_torque, no_load_speed = servo[0], servo[1], servo[2], servo[3]
    ratio = speed / no_load_speed
    highest = stall_torque * min(max(1.0 - ratio, -1.0), 1.0)
    lowest = -stall_torque * min(max(1.0 + ratio, -1.0), 1.0)
    torque: float = min(max(stiffness * error - damping * speed, lowest), highest)
    return torque


@compiled
def contact_force(contact: Array, normal: V3, depth: float, velocity: V3) -> tuple[V3, float]:
    """Force on a foot that sinks into a surface, and its normal part [N].

    Normal: max(0, k d + c min(1, d/d_c) d'), so that damping sets in with the depth d instead of
    jumping at first touch (after Hunt and Crossley, 1975), and never pulls. Tangential: Coulomb,
    proportional to the sliding speed below ``friction_speed``, or below the speed from which
    friction stops the foot within one step, mu F h / m, where that is more.

    Args:
        contact: radius, stiffness k, damping c, damping depth d_c, friction mu, friction speed,
            step h over apparent mass m of a foot.
        normal: of the surface, pointing out of it.
        depth: d [m], above 0.
        velocity: of the foot at the point of contact [m/s], in the frame of ``normal``.
    """
    approach = -_dot(velocity, normal)
    onset = min(1.0, depth / contact[3])
    press = max(0.0, contact[1] * depth + contact[2] * onset * approach)
    sliding = _add(velocity, _scale(approach, normal))
    speed = max(sqrt(_dot(sliding, sliding)), contact[5], contact[4] * press * contact[6])
    return _add(_scale(press, normal), _scale(-contact[4] * press / speed, sliding)), press


@compiled
def _suspend(hold: Array, q: Array, v: Array, out: Array) -> None:
    """Spring-dampers on the coordinates of the base: the robot in somebody's hands."""
    if hold[0] == 0.0:
        return
    for i in range(6):
        k, d = (hold[1], hold[2]) if i < 3 else (hold[3], hold[4])
        out[i] += k * (hold[5 + i] - q[i]) - d * v[i]


@compiled
def _drive(
    servo: Array, q: Array, v: Array, target: Array, dt: float, work: Array, out: Array
) -> None:
    for i in range(target.size):
        torque = servo_torque(servo, target[i] - q[6 + i], v[6 + i])
        out[6 + i] += torque
        out[q.size + i] = torque
        work[i] += abs(torque * v[6 + i]) * dt


@compiled
def _touch(
    contact: Array,
    ground: Rows,
    body: Any,
    leg: Any,
    normal: V3,
    depth: float,
    out: Array,
    force: Array,
    load: Array,
) -> None:
    """Add the force of one contact to the generalized forces and to the force on the foot.

    ``body`` is (rotation, base velocity and angular velocity in the trunk frame, roll); ``leg`` is
    (first coordinate, mount, hip pivot, knee pivot, foot, axis, joint speeds).
    """
    rotation, base, spin, roll = body
    first, mount, hip, knee, foot, axis, speeds = leg
    point = _add(foot, _turn_back(rotation, _turn(ground, _scale(-contact[0], normal))))
    from_mount = _sub(point, mount)
    # Exudyn turns hip and knee about +y, the leg swings forward about -y: both signs cancel in
    # (axis, speed), and come back where the torque is written.
    velocity = _add(base, _cross(spin, point))
    velocity = _add(velocity, _scale(speeds[0], _cross((1.0, 0.0, 0.0), from_mount)))
    velocity = _add(velocity, _scale(speeds[1], _cross(axis, _sub(point, hip))))
    velocity = _add(velocity, _scale(speeds[2], _cross(axis, _sub(point, knee))))
    seen = _turn_back(ground, _turn(rotation, velocity))
    pushed, press = contact_force(contact, normal, depth, seen)
    world = _turn(ground, pushed)
    local = _turn_back(rotation, world)
    moment = _cross(point, local)
    for i in range(3):
        out[i] += world[i]
        force[i] += world[i]
    load[0] += press
    out[3] += _dot(rotation[2], moment)
    out[4] += cos(roll) * moment[1] - sin(roll) * moment[2]
    out[5] += moment[0]
    out[first] += _cross(from_mount, local)[0]
    out[first + 1] -= _dot(axis, _cross(_sub(point, hip), local))
    out[first + 2] -= _dot(axis, _cross(_sub(point, knee), local))


@compiled
def evaluate(
    q: Array,
    v: Array,
    target: Array,
    geometry: Array,
    parameters: Array,
    touch: int,
    reals: Array,
    integers: Integers,
    found: Array,
    dt: float,
    work: Array,
    out: Array,
) -> None:
    """Fill ``out`` with what acts on the robot.

    Args:
        q, v: coordinates and speeds of the tree, shape (6 + 3 n_legs,), see ``tree.BASE``.
        target: commanded tree coordinates of the joints [rad], shape (3 n_legs,).
        geometry: a row per leg as :func:`leg_points` takes it, shape (n_legs, 10).
        parameters: see ``SERVO`` to ``TOP``, shape (``PARAMETERS``,).
        touch: address of the ground's touch function.
        reals, integers: what it reads.
        found: where it writes normal and depth of each contact, shape (contacts, 4).
        dt, work: length of the step that begins [s], and what the work of the servos during it,
            |torque speed| dt, is added to [J], shape (3 n_legs,).
        out: generalized forces (6 + 3 n_legs), servo torques (3 n_legs), foot centres and forces
            of the ground on the feet in the world frame (3 n_legs each), sum of the normal forces
            of each foot (n_legs).
    """
    out[:] = 0.0
    legs = geometry.shape[0]
    size = 6 + 3 * legs
    feet = out[size + 3 * legs : size + 6 * legs]
    forces, loads = out[size + 6 * legs : size + 9 * legs], out[size + 9 * legs :]
    _suspend(parameters[HOLD:GROUND], q, v, out)
    _drive(parameters[SERVO:CONTACT], q, v, target, dt, work, out)
    contact = parameters[CONTACT:HOLD]
    radius, top = parameters[CONTACT], parameters[TOP]
    ground = _rows(parameters)
    rotation = rotation_rpy(q[5], q[4], q[3])
    base = _turn_back(rotation, (v[0], v[1], v[2]))
    roll = q[5]
    spin = _add(_scale(v[3], rotation[2]), (v[5], cos(roll) * v[4], -sin(roll) * v[4]))
    body = (rotation, base, spin, roll)
    for k in range(legs):
        i = 6 + 3 * k
        hip, knee, foot, axis = leg_points(geometry[k], q[i], -q[i + 1], -q[i + 2])
        center = _add((q[0], q[1], q[2]), _turn(rotation, foot))
        feet[3 * k], feet[3 * k + 1], feet[3 * k + 2] = center[0], center[1], center[2]
        at = _turn_back(ground, center)
        if at[2] < radius + top:
            count = call_touch(touch, at[0], at[1], at[2], radius, reals, integers, found)
            mount = (geometry[k, 0], geometry[k, 1], geometry[k, 2])
            speeds = (v[i], -v[i + 1], -v[i + 2])
            leg = (i, mount, hip, knee, foot, axis, speeds)
            force, load = forces[3 * k : 3 * k + 3], loads[k : k + 1]
            for c in range(count):
                normal = (found[c, 0], found[c, 1], found[c, 2])
                _touch(contact, ground, body, leg, normal, found[c, 3], out, force, load)


@compiled
def fallen(
    q: Array,
    corners: Array,
    parameters: Array,
    touch: int,
    reals: Array,
    integers: Integers,
    found: Array,
) -> bool:
    """Whether the trunk is tipped by more than 60 degrees or a corner of it is in the ground.

    The tilt is the angle between the upright axis of the trunk and the normal of the ground. On a
    steep slope the trunk can point straight up or down before it is tipped that far; there yaw and
    roll of the tree are one, so that it counts as fallen 10 degrees earlier.

    Args:
        q: coordinates of the tree; the first six count.
        corners: of the trunk, in its frame [m], shape (corners, 3).
        parameters, touch, reals, integers, found: as :func:`evaluate` takes them.
    """
    ground = _rows(parameters)
    rotation = rotation_rpy(q[5], q[4], q[3])
    upright = 0.0
    for i in range(3):
        upright += rotation[i][2] * ground[i][2]
    if not (upright >= TIPPED_OVER and abs(cos(q[4])) >= UPENDED):
        return True
    for k in range(corners.shape[0]):
        corner = _turn(rotation, (corners[k, 0], corners[k, 1], corners[k, 2]))
        at = _turn_back(ground, _add((q[0], q[1], q[2]), corner))
        if at[2] < parameters[TOP]:
            count = call_touch(touch, at[0], at[1], at[2], 0.0, reals, integers, found)
            if count > 0:
                return True
    return False

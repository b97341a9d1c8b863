"""A robot of the plant in C as Pinocchio sees it, and the laws once more in plain numpy.

Nothing here is taken from the sources of the plant: the tree is built from the numbers of
``plant_robot``, the laws of servo, contact and suspension are written from docs/physics.md.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from c_plant import joints_of

from apnc_core.types import Array

pin = pytest.importorskip("pinocchio", reason="pinocchio is missing (PyPI package pin)")

BASE = 6

LOCKED = 1e15
"""Rotor inertia that keeps a joint from moving [kg m^2]."""


def _inertia(body: Any) -> Any:
    xx, yy, zz, xy, xz, yz = body.inertia
    return pin.Inertia(
        body.mass, np.array(list(body.com)), np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
    )


def _about_y(angle: float) -> Array:
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, 0.0, s], [0.0, 1.0, 0.0], [-s, 0.0, c]])


class RigidBody:
    """A floating trunk with legs: x, y, z, yaw, pitch, roll, then abduction, hip and knee of legs.

    Attributes:
        model, data: Pinocchio's.
        feet: numbers of the frames in the centres of the feet.
    """

    def __init__(self, robot: Any) -> None:
        """Build the tree of a ``plant_robot``."""
        self.robot = robot
        self.model = model = pin.Model()
        model.gravity.linear = np.array([0.0, 0.0, -robot.gravity])
        joint, here = 0, pin.SE3.Identity()
        joints = (
            pin.JointModelTranslation(),
            pin.JointModelRZ(),
            pin.JointModelRY(),
            pin.JointModelRX(),
        )
        for kind, name in zip(joints, ("place", "yaw", "pitch", "roll"), strict=True):
            joint = model.addJoint(joint, kind, here, name)
        model.appendBodyToJoint(joint, _inertia(robot.trunk), here)
        self.feet = [self._add_leg(joint, k) for k in range(robot.legs)]
        armature = np.concatenate([np.zeros(BASE), Joints(robot).reflected_inertia])
        locked = np.ravel([list(robot.leg[k].locked) for k in range(robot.legs)])
        armature[BASE:][locked == 1] = LOCKED
        model.armature = armature
        self.data = model.createData()

    def _add_leg(self, trunk: int, k: int) -> int:
        leg, model, joint = self.robot.leg[k], self.model, trunk
        places = (list(leg.mount), list(leg.hip), [0.0, 0.0, -leg.femur])
        for i, (own, place) in enumerate(zip(joints_of(leg), places, strict=True)):
            turn = pin.AngleAxis(own.turn, own.axis).matrix()
            at = pin.SE3(turn, np.array(place))
            kind = pin.JointModelRevoluteUnaligned(own.axis)
            joint = model.addJoint(joint, kind, at, f"{k}.{i}")
            model.appendBodyToJoint(joint, _inertia(leg.link[i]), pin.SE3.Identity())
        below = pin.SE3(np.eye(3), np.array([0.0, 0.0, -leg.tibia]))
        return int(model.addFrame(pin.Frame(f"{k}.foot", joint, 0, below, pin.FrameType.OP_FRAME)))

    def accelerations(self, q: Array, v: Array, force: Array) -> Array:
        """Of the coordinates, from their generalized forces."""
        return np.asarray(pin.aba(self.model, self.data, q, v, force)).copy()

    def move(self, q: Array, v: Array) -> None:
        """Go to coordinates and speeds, for what follows."""
        pin.forwardKinematics(self.model, self.data, q, v)
        pin.computeJointJacobians(self.model, self.data, q)
        pin.updateFramePlacements(self.model, self.data)

    def rotation(self) -> Array:
        """From trunk to world."""
        return np.asarray(self.data.oMi[4].rotation)

    def foot(self, k: int) -> Array:
        """Centre of a foot [m]."""
        return np.asarray(self.data.oMf[self.feet[k]].translation).copy()

    def foot_jacobian(self, k: int) -> Array:
        """Of velocity and angular speed of a foot in world axes, shape (6, 6 + 3 legs)."""
        axes = pin.ReferenceFrame.LOCAL_WORLD_ALIGNED
        return np.asarray(pin.getFrameJacobian(self.model, self.data, self.feet[k], axes))

    def energy(self, q: Array, v: Array) -> float:
        """Kinetic, rotors included, and potential [J]."""
        kinetic = v @ self.mass_matrix(q) @ v / 2.0
        return float(kinetic + pin.computePotentialEnergy(self.model, self.data, q))

    def mass_matrix(self, q: Array) -> Array:
        """With the rotors, shape (6 + 3 legs, 6 + 3 legs)."""
        upper = np.triu(pin.crba(self.model, self.data, q))
        return np.asarray(upper + np.triu(upper, 1).T)

    def momentum(self, q: Array, v: Array) -> tuple[Array, Array]:
        """Momentum [N s], and angular momentum about the centre of mass [N m s], without rotors."""
        found = pin.computeCentroidalMomentum(self.model, self.data, q, v)
        return np.array(found.linear), np.array(found.angular)


class Joints:
    """The numbers of all joints of a ``plant_robot`` in coordinates of the tree, each (3 legs,).

    The attributes are those of ``plant_joint``, with what a joint has from the robot's servo.
    """

    def __init__(self, robot: Any) -> None:
        chains = [(robot.leg[k], own) for k in range(robot.legs) for own in joints_of(robot.leg[k])]
        joints = [leg.joint[own.angle] for leg, own in chains]

        def each(key: str) -> Array:
            return np.array([getattr(joint, key) for joint in joints])

        for key in ("stiffness", "damping", "stall_torque", "no_load_speed", "reflected_inertia"):
            own = each(key)
            setattr(self, key, np.where(np.isnan(own), getattr(robot.servo, key), own))
        for key in ("joint_damping", "dry_friction", "friction_speed", "stop_stiffness"):
            setattr(self, key, each(key))
        self.stop_damping = each("stop_damping")
        turned = np.array([own.sign < 0.0 for _, own in chains])  # minus the joint angle
        low, high = each("low"), each("high")
        self.low, self.high = np.where(turned, -high, low), np.where(turned, -low, high)


def passive_torque(joints: Joints, q: Array, v: Array) -> Array:
    """Torque of damping, friction and stops of the joints [N m]."""
    rubbing = joints.dry_friction * np.clip(v / joints.friction_speed, -1.0, 1.0)
    torque = -joints.joint_damping * v - rubbing
    for sign, depth in ((1.0, joints.low - q), (-1.0, q - joints.high)):
        depth = np.maximum(depth, 0.0)
        onset = np.minimum(1.0, depth / 0.005)
        press = joints.stop_stiffness * depth - sign * joints.stop_damping * onset * v
        torque += sign * np.maximum(press, 0.0) * (depth > 0.0)
    return torque


def radius_of(robot: Any, k: int) -> float:
    """Radius of a foot [m]."""
    own = robot.leg[k].foot_radius
    return float(robot.contact.foot_radius if np.isnan(own) else own)


def servo_torque(servo: Any, error: Array, speed: Array) -> Array:
    """Torque of servos [N m] within what the motor gives at its speed."""
    free = speed / servo.no_load_speed
    high = servo.stall_torque * np.clip(1.0 - free, -1.0, 1.0)
    low = -servo.stall_torque * np.clip(1.0 + free, -1.0, 1.0)
    wanted = servo.stiffness * error - servo.damping * speed
    return np.minimum(np.maximum(wanted, low), high)


def contact_force(
    contact: Any, normal: Array, depth: float, velocity: Array, stopping: float
) -> tuple[Array, float]:
    """Force on a foot and its normal part [N]; stopping: step over apparent mass [s/kg]."""
    approach = -float(velocity @ normal)
    onset = min(1.0, depth / contact.damping_depth)
    press = max(0.0, contact.stiffness * depth + contact.damping * onset * approach)
    sliding = velocity + approach * normal
    grip = contact.friction * press
    speed = max(float(np.linalg.norm(sliding)), contact.friction_speed, grip * stopping)
    return press * normal - grip / speed * sliding, press


def suspension(by: Any, held_at: Array, q: Array, v: Array) -> Array:
    """Generalized forces on the six coordinates of a held trunk."""
    stiffness = np.repeat([by.stiffness, by.angular_stiffness], 3)
    damping = np.repeat([by.damping, by.angular_damping], 3)
    return stiffness * (held_at - q[:BASE]) - damping * v[:BASE]


class Expected:
    """What acts on a robot on a ground, at coordinates and speeds of its tree.

    Attributes:
        robot: the ``plant_robot``.
        force: generalized forces, shape (6 + 3 legs,).
        torque: of the servos in coordinates of the tree [N m], shape (3 legs,).
        foot, push: centres of the feet [m] and forces on them [N], world frame, shape (legs, 3).
        load: sums of the normal forces [N], shape (legs,).
    """

    def __init__(
        self,
        body: RigidBody,
        lib: Any,
        ffi: Any,
        ground: Any,
        q: Array,
        v: Array,
        target: Array,
        *,
        stopping: float = 0.0,
        held_at: Array | None = None,
    ) -> None:
        """Where the ground touches is asked of the library; see the tests of the grounds."""
        robot, n = body.robot, body.robot.legs
        self.robot = robot
        body.move(q, v)
        joints = Joints(robot)
        self.torque = servo_torque(joints, target - q[BASE:], v[BASE:])
        passive = passive_torque(joints, q[BASE:], v[BASE:])
        self.force = np.concatenate([np.zeros(BASE), self.torque + passive])
        if held_at is not None:
            self.force[:BASE] += suspension(robot.suspension, held_at, q, v)
        self.foot = np.array([body.foot(k) for k in range(n)])
        self.push, self.load = np.zeros((n, 3)), np.zeros(n)
        tilt = _about_y(-ground.slope)
        found = ffi.new("double[]", 4 * max(1, ground.contacts))
        for k in range(n):
            radius = radius_of(robot, k)
            count = lib.plant_touches(ground, *(tilt.T @ self.foot[k]), radius, found)
            jacobian = body.foot_jacobian(k) if count else np.zeros((6, q.size))
            for c in range(count):
                normal = tilt @ np.array(list(found[4 * c : 4 * c + 3]))
                lever = -radius * normal
                at = jacobian[:3] - np.cross(lever, jacobian[3:].T).T
                push, press = contact_force(
                    robot.contact, normal, found[4 * c + 3], at @ v, stopping
                )
                self.force += at.T @ push
                self.push[k] += push
                self.load[k] += press

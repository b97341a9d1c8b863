"""Position servos whose torque is limited by stall torque and joint speed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from exudyn_models.description import Array, Servo
from exudyn_models.engine import create_symbolic_user_function, exu, items
from exudyn_models.tree import BASE, Tree


def servo_torque(servo: Servo, target: Array, angle: Array, speed: Array) -> Array:
    """Torque of position servos [N m], any shape.

    tau = P (target - angle) - D speed, held within what the motor can give at that speed:
    stall_torque (-1 - speed/no_load_speed) <= tau <= stall_torque (1 - speed/no_load_speed) from
    the supply voltage, and |tau| <= stall_torque from the current limit.

    Args:
        servo: gains and limits.
        target, angle: commanded and actual joint angle [rad].
        speed: joint speed [rad/s].
    """
    ratio = speed / servo.no_load_speed
    highest = servo.stall_torque * np.clip(1.0 - ratio, -1.0, 1.0)
    lowest = -servo.stall_torque * np.clip(1.0 + ratio, -1.0, 1.0)
    wanted = servo.stiffness * (target - angle) - servo.damping * speed
    return np.clip(wanted, lowest, highest)


@dataclass(frozen=True)
class Servos:
    """The servos of a tree in its Exudyn system, one per joint coordinate.

    Args:
        objects: object numbers, in the order of the joint coordinates.
        law: the compiled torque law; Exudyn does not own it, so it must live as long as they do.
    """

    objects: tuple[Any, ...]
    law: Any

    def command(self, mbs: Any, targets: Array) -> None:
        """Set the commanded tree coordinates [rad], shape (joints,)."""
        for number, target in zip(self.objects, targets, strict=True):
            mbs.SetObjectParameter(number, "offset", float(target))


def add_servos(mbs: Any, tree: Tree, servo: Servo, targets: Array) -> Servos:
    """Add one servo per joint coordinate to an Exudyn system.

    Args:
        mbs: the system.
        tree: the tree to drive.
        servo: gains and limits, the same for every joint.
        targets: initial commanded tree coordinates [rad], shape (joints,).
    """
    law = _compiled_law(mbs, servo)
    ground = mbs.AddNode(items.NodePointGround())
    fixed = mbs.AddMarker(items.MarkerNodeCoordinate(nodeNumber=ground, coordinate=0))
    objects = []
    for joint, target in enumerate(targets):
        moving = mbs.AddMarker(
            items.MarkerNodeCoordinate(nodeNumber=tree.node, coordinate=BASE + joint)
        )
        objects.append(
            mbs.AddObject(
                items.CoordinateSpringDamper(
                    markerNumbers=[fixed, moving],
                    stiffness=servo.stiffness,
                    damping=servo.damping,
                    offset=float(target),
                    springForceUserFunction=law,
                )
            )
        )
    return Servos(tuple(objects), law)


def _compiled_law(mbs: Any, servo: Servo) -> Any:
    """The law of :func:`servo_torque` as an Exudyn expression, evaluated without Python."""
    symbolic = exu.symbolic
    stall, fastest = servo.stall_torque, servo.no_load_speed

    def limited(value: Any, low: Any, high: Any) -> Any:
        return symbolic.min(symbolic.max(value, low), high)

    def spring_force(
        mbs: Any, t: Any, item: Any, angle: Any, speed: Any, P: Any, D: Any, target: Any
    ) -> Any:
        highest = stall * limited(1.0 - speed / fastest, -1.0, 1.0)
        lowest = -stall * limited(1.0 + speed / fastest, -1.0, 1.0)
        # A spring force counts positive when it pulls the joint back, a torque when it drives it.
        return -limited(P * (target - angle) - D * speed, lowest, highest)

    return create_symbolic_user_function(
        mbs,
        spring_force,
        "springForceUserFunction",
        itemTypeName="ObjectConnectorCoordinateSpringDamper",
    )

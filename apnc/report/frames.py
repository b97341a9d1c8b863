"""Where the links of a robot are during a run: a tree of frames, as ROS has it in ``/tf``."""

from __future__ import annotations

from typing import Final, NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from apnc.loop.record import Record
from apnc_core.types import Array
from apnc_plant.robot.links import links_of

WORLD: Final = "world"
TRUNK: Final = "trunk"
"""Name of the trunk's frame, that of its link in the URDF."""


class Frame(NamedTuple):
    """A frame in its parent, for every sample.

    Args:
        parent: name of the parent frame.
        name: name of the frame, that of a link of the URDF.
        translation: origin of the frame in the parent [m], shape (T, 3).
        rotation: quaternion x, y, z, w from the frame to the parent, shape (T, 4).
    """

    parent: str
    name: str
    translation: Array
    rotation: Array


def frames_of(record: Record) -> list[Frame]:
    """The frames of the trunk, of every link and of the centre of every foot.

    Args:
        record: the run; the names of its legs and of its robot's must be plain, see
            ``apnc_plant.robot.names``.

    Returns:
        One frame for each link of ``apnc_plant.robot.urdf.robot_urdf`` with the root ``trunk``.
    """
    count, signals = len(record), record.signals
    turn = Rotation.from_euler("xyz", signals["rpy"]).as_quat()
    frames = [Frame(WORLD, TRUNK, signals["position"], turn)]
    still = np.tile((0.0, 0.0, 0.0, 1.0), (count, 1))
    for number, leg in enumerate(record.robot.legs):
        parent = TRUNK
        angles = signals["joint_angle"][:, number]
        for link in links_of(leg):
            name = f"{leg.name}_{link.name}"
            turned = link.turn + link.sign * angles[:, link.angle]
            rotation = Rotation.from_rotvec(np.outer(turned, link.axis))
            place = np.tile(link.position, (count, 1))
            frames.append(Frame(parent, name, place, rotation.as_quat()))
            parent = name
        place = np.tile((0.0, 0.0, -leg.tibia_length), (count, 1))
        frames.append(Frame(parent, f"{leg.name}_foot", place, still))
    return frames

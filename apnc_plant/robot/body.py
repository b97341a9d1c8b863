"""Rigid bodies: mass properties, the links of a leg and the trunk."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Final

import numpy as np
from pydantic import AfterValidator

from apnc_core.types import Array
from apnc_plant.files import Number, checked, limits
from apnc_plant.robot.quantities import Edges, RobotDescriptionError, Vector3

PAYLOAD_SIZE: Final = (0.1, 0.1, 0.06)
"""Edges of the box that represents a payload [m]."""

ROUNDED: Final = 1e-6
"""By how much a principal moment may exceed the sum of the others, as a part of it: files round."""

Moments = tuple[float, float, float, float, float, float]
"""Entries xx, yy, zz, xy, xz, yz of an inertia tensor [kg m^2]."""


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


def tensor(moments: Moments) -> Array:
    """The inertia tensor of its six entries, shape (3, 3)."""
    xx, yy, zz, xy, xz, yz = moments
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def is_of_a_body(inertia: Array) -> bool:
    """Whether a body can have an inertia tensor.

    Its principal moments are above 0, and none is larger than the sum of the others.

    Args:
        inertia: symmetric, shape (3, 3).
    """
    least, middle, largest = np.linalg.eigvalsh(inertia)
    return bool(least > 0.0 and largest <= (1.0 + ROUNDED) * (least + middle))


def _of_a_body(moments: Moments) -> Moments:
    """Six entries that are the inertia of a body."""
    inertia = tensor(moments)
    if not is_of_a_body(inertia):
        principal = ", ".join(f"{moment:.3g}" for moment in np.linalg.eigvalsh(inertia))
        raise ValueError(
            f"principal moments are {principal} kg m^2; allowed: above 0, "
            "none larger than the sum of the others"
        )
    return moments


_Entry = Annotated[Number, limits("kg m^2")]
Inertia = Annotated[
    tuple[_Entry, _Entry, _Entry, _Entry, _Entry, _Entry], AfterValidator(_of_a_body)
]


def _box_inertia(mass: float, size: Edges) -> Array:
    x, y, z = (edge**2 for edge in size)
    return np.diag([y + z, x + z, x + y]) * (mass / 12.0)


@checked(RobotDescriptionError)
class Body:
    """A rigid link.

    Args:
        mass: mass [kg]; 0 for a link that only joins others.
        size: edge lengths of a box [m]: its shape, and its inertia if it has none of its own.
        com: centre of mass in the frame of the link [m].
        inertia: entries xx, yy, zz, xy, xz and yz of the inertia tensor about the centre of mass,
            in axes parallel to the frame of the link [kg m^2]; None for that of the homogeneous
            box.
    """

    mass: Annotated[Number, limits("kg", ge=0.0)]
    size: Edges
    com: Vector3
    inertia: Inertia | None = None

    def __post_init__(self) -> None:
        if self.mass == 0.0 and self.inertia is not None:
            raise ValueError("mass is 0 and there is an inertia; allowed: none without mass")

    def inertia_tensor(self) -> Array:
        """Inertia tensor about the centre of mass [kg m^2], shape (3, 3)."""
        if self.inertia is not None:
            return tensor(self.inertia)
        return _box_inertia(self.mass, self.size)


@checked(RobotDescriptionError)
class Trunk(Body):
    """The body that carries the legs.

    Args:
        mass, size, inertia: as in :class:`Body`.
        com: centre of mass, measured from the reference point between the hips [m].
        center: middle of its outline [m]; differs from the centre of mass.
        com_side_offset: size of the seeded sideways error of the centre of mass [m].
        outline: edges of the box that tells falls, is drawn and carries a payload [m]; None for
            ``size``.
    """

    mass: Annotated[Number, limits("kg", gt=0.0)]
    center: Vector3 = (0.0, 0.0, 0.0)
    com_side_offset: Annotated[Number, limits("m", ge=0.0)] = 0.0
    outline: Edges | None = None

    @property
    def edges(self) -> Edges:
        """Edges of its outline [m]."""
        return self.size if self.outline is None else self.outline

    def corners(self) -> Array:
        """Corners of the outline relative to the reference point [m], shape (8, 3)."""
        signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, 8).T
        return np.asarray(self.center) + signs * (np.asarray(self.edges) / 2.0)

    def loaded(self, side_offset: float, payload: float) -> MassProperties:
        """Mass properties with a box of ``PAYLOAD_SIZE`` standing on the middle of the outline.

        Args:
            side_offset: sideways error of the trunk's own centre of mass [m].
            payload: mass of the box [kg].
        """
        com = np.add(self.com, [0.0, side_offset, 0.0])
        own = MassProperties(self.mass, com, self.inertia_tensor())
        top = (self.edges[2] + PAYLOAD_SIZE[2]) / 2.0
        on_top = np.add(self.center, [0.0, 0.0, top])
        return own.joined(MassProperties(payload, on_top, _box_inertia(payload, PAYLOAD_SIZE)))

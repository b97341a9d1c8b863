"""Grounds as structs of the plant in C."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from apnc_core.types import Array
from apnc_plant.library import library

if TYPE_CHECKING:
    from apnc_plant.ground.ground import Ground

Integers = NDArray[np.int64]


@dataclass(frozen=True)
class Numbers:
    """Numbers that the touch function of a ground needs; their meaning depends on the ground.

    Args:
        reals: numbers, shape (any,).
        integers: whole numbers, shape (any,).
        contacts: largest number of contact points of a ball.
    """

    reals: Array = field(default_factory=lambda: np.zeros(1))
    integers: Integers = field(default_factory=lambda: np.zeros(1, np.int64))
    contacts: int = 4


class GroundInC:
    """The struct ``plant_ground`` of a ground; it must live as long as a plant in C uses it.

    Attributes:
        at: pointer to the struct.
        contacts: largest number of contact points of a ball.
        flat: whether the ground is just a plane for C.
    """

    def __init__(self, ground: Ground, radius: float) -> None:
        """Fill the struct.

        Args:
            ground: the ground.
            radius: radius of the largest ball that touches it [m].

        Raises:
            ValueError: the ball is too large for the ground, or the ground has no touch function.
        """
        ffi, lib = library()
        self._ground = ground
        self._error: BaseException | None = None
        touch, own = self._touch(ffi)
        self.flat = ground.flat
        numbers = ground.numbers(radius)
        kind = "PLANT_OWN" if own else "PLANT_PLANE" if self.flat else ground.kind_in_c
        self.contacts = numbers.contacts
        reals = np.ascontiguousarray(numbers.reals, np.float64)
        integers = np.ascontiguousarray(numbers.integers, np.int64)
        self._kept = (reals, integers, touch)
        fields = {
            "kind": getattr(lib, kind),
            "contacts": numbers.contacts,
            "slope": ground.slope,
            "top": ground.top,
            "reals": ffi.from_buffer("double[]", reals),
            "integers": ffi.from_buffer("int64_t[]", integers),
            "touch": touch,
        }
        self.at = ffi.new("plant_ground *", fields)
        self._found = np.empty(4 * numbers.contacts)
        self.found = ffi.from_buffer("double[]", self._found)

    def _touch(self, ffi: Any) -> tuple[Any, bool]:
        """Touch function of a ground of one's own, and whether there is one."""
        ground = self._ground
        if ground.address:
            return ffi.cast("plant_touch", ground.address), True
        if ground.touches_itself:
            return ffi.callback("plant_touch", self._ask, 0, self._note), True
        if not ground.kind_in_c:
            raise ValueError(
                f"ground '{ground.kind}' has neither a method touch nor the address of a C function"
            )
        return ffi.NULL, False

    def _ask(
        self, x: float, y: float, z: float, radius: float, reals: Any, integers: Any, found: Any
    ) -> int:
        """Function that C calls for a ground whose touch function is in Python."""
        if self._error is not None:  # the first error is reported
            return 0
        points = self._ground.touch(x, y, z, radius)
        if len(points) > self.contacts:
            raise ValueError(f"{len(points)} contact points; its numbers allow {self.contacts}")
        for k, (nx, ny, nz, depth) in enumerate(points):
            found[4 * k : 4 * k + 4] = (nx, ny, nz, depth)
        return len(points)

    def _note(self, kind: Any, error: BaseException, trace: Any) -> None:
        self._error = error

    def check(self) -> None:
        """Raise an error that occurred in a touch function since the last check.

        Raises:
            ValueError: the touch function of a ground of one's own raised an error.
        """
        if self._error is None:
            return
        error, self._error = self._error, None
        if not isinstance(error, Exception):  # the user interrupted the program
            raise error
        kind = type(error).__name__
        raise ValueError(f"ground '{self._ground.kind}': touch failed: {kind}: {error}") from error

    def rest_height(self, x: float, y: float, radius: float) -> float:
        """Height of a ball's centre over the plane at which the ball just touches the ground [m].

        Args:
            x, y: position of the centre in the frame of the ground [m].
            radius: radius of the ball [m].

        Raises:
            ValueError: as :meth:`check`.
        """
        _, lib = library()
        height = lib.plant_rest_height(self.at, x, y, radius, self.found)
        self.check()
        return float(height)

    def touches(self, position: Sequence[float], radius: float) -> Array:
        """Normals (x, y, z) and depths [m] of a ball's contact points, shape (contacts, 4).

        Args:
            position: centre of the ball in the frame of the ground [m].
            radius: radius of the ball [m].

        Raises:
            ValueError: as :meth:`check`.
        """
        _, lib = library()
        count = lib.plant_touches(self.at, *position, radius, self.found)
        self.check()
        return self._found.reshape(-1, 4)[:count].copy()

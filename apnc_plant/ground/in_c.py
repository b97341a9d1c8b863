"""A ground as the plant in C reads it."""

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
    """What the touch function of a ground reads.

    Args:
        reals: numbers of any meaning, shape (any,).
        integers: whole numbers of any meaning, shape (any,).
        contacts: the most places at which a ball touches at a time.
    """

    reals: Array = field(default_factory=lambda: np.zeros(1))
    integers: Integers = field(default_factory=lambda: np.zeros(1, np.int64))
    contacts: int = 4


class GroundInC:
    """The struct ``plant_ground`` of a ground; keep it as long as anything in C stands on it.

    Attributes:
        at: pointer to the struct.
        contacts: the most places at which a ball touches at a time.
        flat: whether C sees a plane and nothing else.
    """

    def __init__(self, ground: Ground, radius: float) -> None:
        """Fill the struct.

        Args:
            ground: the ground.
            radius: of the largest ball that touches it [m].

        Raises:
            ValueError: the ground does not take such a ball, or has no way to touch it.
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
        """What C calls for a ground that touches in Python."""
        if self._error is not None:  # the first one is told
            return 0
        places = self._ground.touch(x, y, z, radius)
        if len(places) > self.contacts:
            raise ValueError(f"{len(places)} places; its numbers allow {self.contacts}")
        for k, (nx, ny, nz, depth) in enumerate(places):
            found[4 * k : 4 * k + 4] = (nx, ny, nz, depth)
        return len(places)

    def _note(self, kind: Any, error: BaseException, trace: Any) -> None:
        self._error = error

    def check(self) -> None:
        """Tell what went wrong in a touch function since the last check.

        Raises:
            ValueError: the touch function of a ground of one's own raised an error.
        """
        if self._error is None:
            return
        error, self._error = self._error, None
        if not isinstance(error, Exception):  # the user's interrupt
            raise error
        kind = type(error).__name__
        raise ValueError(f"ground '{self._ground.kind}': touch failed: {kind}: {error}") from error

    def rest_height(self, x: float, y: float, radius: float) -> float:
        """Height of a ball's centre over the plane when it just touches what is below it [m].

        Args:
            x, y: place of the centre in the frame of the ground [m].
            radius: of the ball [m].

        Raises:
            ValueError: as :meth:`check`.
        """
        _, lib = library()
        height = lib.plant_rest_height(self.at, x, y, radius, self.found)
        self.check()
        return float(height)

    def touches(self, place: Sequence[float], radius: float) -> Array:
        """Normals (x, y, z) and depths [m] of a ball's contacts, shape (contacts, 4).

        Args:
            place: centre of the ball in the frame of the ground [m].
            radius: of the ball [m].

        Raises:
            ValueError: as :meth:`check`.
        """
        _, lib = library()
        count = lib.plant_touches(self.at, *place, radius, self.found)
        self.check()
        return self._found.reshape(-1, 4)[:count].copy()

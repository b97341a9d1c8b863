"""What every ground is: a surface that a ball can touch."""

from __future__ import annotations

import json
import math
from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, fields
from functools import cache
from typing import Any, ClassVar, Final, get_args, get_origin, get_type_hints

import numpy as np

from apnc_core.in_python import in_python
from apnc_core.types import Array
from apnc_plant.ground.in_c import GroundInC, Numbers

GRID: Final = 0.1
"""Distance between the lines a ground is drawn with [m]."""


@dataclass(frozen=True)
class Ground(ABC):
    """A ground: how high it is and where a ball touches it, in its own frame.

    The frame is the world's, turned about y by ``slope``; z points out of the ground, and the plane
    z = 0 is the ground without what is special about it.

    A ground of one's own is a subclass with ``kind``, :attr:`top`, :meth:`elevation` and a touch
    function: :meth:`touch` in Python, or :attr:`address` of one in C, which is much faster. With an
    entry in ``GROUNDS`` it can be named on the command line. Grounds that the plant in C knows
    itself have :attr:`kind_in_c` and :meth:`numbers`.

    Args:
        slope: angle by which the ground rises along x [rad].

    Raises:
        ValueError: a value out of range.
    """

    kind: ClassVar[str]
    kind_in_c: ClassVar[str] = ""
    """Name of the kind in ``plant.h``; empty for a ground of one's own."""

    slope: float = 0.0

    def __post_init__(self) -> None:
        """Check the values: of the type that their field says, and in range."""
        for name, kind in _types(type(self)).items():
            object.__setattr__(self, name, _typed(name, kind, in_python(getattr(self, name))))
        self._require("slope", abs(self.slope) < math.pi / 2, "less than a right angle [rad]")

    def _require(self, name: str, fits: bool, allowed: str) -> None:
        if not fits:
            raise ValueError(f"{name} is {getattr(self, name)}; allowed: {allowed}")

    @property
    @abstractmethod
    def top(self) -> float:
        """Height over the plane that no point of the ground exceeds [m]; 0 or more."""

    @property
    def flat(self) -> bool:
        """Whether the ground is the plane z = 0 and nothing else."""
        return False

    @abstractmethod
    def elevation(self, x: Array, y: Array) -> Array:
        """Height over the plane [m].

        Args:
            x, y: places in the frame of the ground [m], shapes that broadcast.
        """

    def numbers(self, radius: float) -> Numbers:
        """What the touch function in C reads for balls of a radius up to ``radius`` [m]."""
        return Numbers()

    def touch(self, x: float, y: float, z: float, radius: float) -> Sequence[Sequence[float]]:
        """Where a ball touches a ground of one's own.

        Args:
            x, y, z: centre of the ball in the frame of the ground [m].
            radius: of the ball [m]; 0 for a point.

        Returns:
            Normal (x, y, z), which points out of the ground, and depth [m], above 0, of every place
            of contact: no more places than ``numbers(radius).contacts``. Must be empty where z is
            ``radius + top`` or more.
        """
        raise NotImplementedError

    @property
    def address(self) -> int:
        """Address of a C function of the type ``plant_touch`` that does what :meth:`touch` does.

        It reads :meth:`numbers`. 0 for none. Pitfall: the object it comes from must stay alive.
        """
        return 0

    @property
    def touches_itself(self) -> bool:
        """Whether it has a touch function of its own, in Python or by address."""
        return type(self).touch is not Ground.touch or self.address != 0

    def rotation(self) -> Array:
        """Rotation from ground to world, shape (3, 3); its last column is the normal."""
        c, s = math.cos(self.slope), math.sin(self.slope)
        return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])

    def contacts(self, place: Sequence[float], radius: float) -> Array:
        """Normals (x, y, z) and depths [m] of a ball's contacts, shape (contacts, 4).

        Args:
            place: centre of the ball in the frame of the ground [m].
            radius: of the ball [m].
        """
        return GroundInC(self, radius).touches([float(value) for value in place], radius)

    def rest_height(self, x: float, y: float, radius: float) -> float:
        """Height of a ball's centre over the plane when it just touches what is below it [m].

        Args:
            x, y: place of the centre in the frame of the ground [m].
            radius: of the ball [m].
        """
        return GroundInC(self, radius).rest_height(x, y, radius)

    def lines(self, x0: float, x1: float, y0: float, y1: float) -> list[Array]:
        """Polylines that draw the ground between two corners.

        Args:
            x0, x1, y0, y1: corners in the frame of the ground [m].

        Returns:
            Points on the ground in its frame [m], each line of shape (points, 3).

        Points are 1 cm apart, so a vertical face is drawn as a slope of 1 cm: a ground with faces
        overrides :meth:`_line` and adds both ends of each, as ``Kerb`` does, or ``lines`` as a
        whole, as ``Obstacles`` does.
        """
        lines = [self._line(self._stations(x0, x1), [y]) for y in _multiples(y0, y1)]
        return lines + [
            self._line([x], _between(y0, y1, self._spacing)) for x in _multiples(x0, x1)
        ]

    @property
    def _spacing(self) -> float:
        return math.inf if self.flat else GRID / 10.0

    def _stations(self, x0: float, x1: float) -> Array:
        """Places along x at which a line along x has its points [m]."""
        return _between(x0, x1, self._spacing)

    def _line(self, x: Any, y: Any) -> Array:
        xs, ys = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        return np.column_stack([xs, ys, self.elevation(xs, ys)])

    def text(self) -> str:
        """Kind and fields that are not the default, as :func:`parse_ground` reads them."""
        default = type(self)()
        words = [
            f"{f.name}={':'.join(map(str, value)) if isinstance(value, tuple) else value}"
            for f in fields(self)
            if (value := getattr(self, f.name)) != getattr(default, f.name)
        ]
        return ":".join(filter(None, (self.kind, ",".join(words))))

    def to_dict(self) -> dict[str, Any]:
        """Kind and fields as plain data; :func:`from_dict` makes the ground of it again."""
        return {"kind": self.kind} | {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in asdict(self).items()
        }


GROUNDS: Final[dict[str, type[Ground]]] = {}
"""Every kind of ground by name."""


def from_dict(data: Mapping[str, Any]) -> Ground:
    """A ground of its kind and fields; a field that is left out has its default.

    Args:
        data: as :meth:`Ground.to_dict` gives it.

    Raises:
        ValueError: no such kind or field, or a value of the wrong type or out of range.
    """
    kind = data.get("kind")
    if kind not in GROUNDS:
        raise ValueError(f"ground {kind!r} is not one of {', '.join(GROUNDS)}")
    cls = GROUNDS[kind]
    known = [f.name for f in fields(cls)]
    values = {name: value for name, value in data.items() if name != "kind"}
    for name in values:
        if name not in known:
            raise ValueError(f"ground '{kind}' has no {name!r}; it has {', '.join(known)}")
    try:
        return cls(**values)
    except ValueError as error:
        raise ValueError(f"ground '{kind}': {error}") from None


def parse_ground(text: str) -> Ground:
    """``"kerb:at=0.5,height=0.006"`` -> a ground; numbers of a list are parted by a colon.

    Args:
        text: kind, then a colon and fields, parted by commas; those left out have their defaults.

    Raises:
        ValueError: as :func:`from_dict`.
    """
    kind, _, rest = text.partition(":")
    data: dict[str, Any] = {"kind": kind.strip()}
    for item in filter(None, rest.split(",")):
        name, _, value = item.partition("=")
        parts = [_number(part) for part in value.split(":")]
        data[name.strip()] = parts if len(parts) > 1 else parts[0]
    return from_dict(data)


def _number(text: str) -> object:
    try:
        return json.loads(text)
    except json.JSONDecodeError:
        return text


@cache
def _types(cls: type[Ground]) -> dict[str, Any]:
    """Types of the fields that hold a number or some; others are a ground's own business."""
    try:
        hints = get_type_hints(cls)
    except NameError:  # of a class inside a function
        return {}
    numbers = (int, float)
    types = {f.name: hints[f.name] for f in fields(cls)}
    return {
        name: kind
        for name, kind in types.items()
        if kind in numbers or (get_origin(kind) is tuple and set(get_args(kind)) <= set(numbers))
    }


def _typed(name: str, kind: Any, value: Any) -> Any:
    plain = isinstance(value, int | float) and not isinstance(value, bool)
    if kind is int:
        if plain and math.isfinite(value) and value == int(value):
            return int(value)
        raise ValueError(f"{name} is {value!r}; allowed: a whole number")
    if kind is float:
        if plain and math.isfinite(value):
            return float(value)
        raise ValueError(f"{name} is {value!r}; allowed: a finite number")
    kinds = get_args(kind)
    if isinstance(value, list | tuple) and len(value) == len(kinds):
        return tuple(_typed(name, k, v) for k, v in zip(kinds, value, strict=True))
    raise ValueError(f"{name} is {value!r}; allowed: {len(kinds)} numbers")


def _multiples(low: float, high: float) -> Array:
    """Multiples of ``GRID`` between two places [m]."""
    return np.asarray(GRID * np.arange(math.ceil(low / GRID), math.floor(high / GRID) + 1.0))


def _between(low: float, high: float, spacing: float) -> Array:
    """Places from ``low`` to ``high``, both included, at most ``spacing`` apart [m]."""
    return np.linspace(low, high, max(1, math.ceil((high - low) / spacing)) + 1)

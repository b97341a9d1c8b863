"""Base of all grounds: a surface that a ball can touch."""

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
"""Distance between the lines with which a ground is drawn [m]."""


@dataclass(frozen=True)
class Ground(ABC):
    """A ground: its height, and where a ball touches it, in its own frame.

    The frame of the ground is the world frame, turned about y by ``slope``. z points out of the
    ground; obstacles and the like rise from its plane z = 0.

    A ground of one's own is a subclass with ``kind``, :attr:`top`, :meth:`elevation` and a touch
    function: :meth:`touch` in Python, or :attr:`address` of a function in C, which is much faster.
    An entry in ``GROUNDS`` makes it known to the command line. Grounds that are built into the
    plant in C define :attr:`kind_in_c` and :meth:`numbers` instead.

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
        """Check types and ranges of the fields."""
        for name, kind in _types(type(self)).items():
            object.__setattr__(self, name, _typed(name, kind, in_python(getattr(self, name))))
        self._require("slope", abs(self.slope) < math.pi / 2, "less than a right angle [rad]")

    def _require(self, name: str, fits: bool, allowed: str) -> None:
        if not fits:
            raise ValueError(f"{name} is {getattr(self, name)}; allowed: {allowed}")

    @property
    @abstractmethod
    def top(self) -> float:
        """Upper bound of the height over the plane [m]; 0 or more."""

    @property
    def flat(self) -> bool:
        """Whether the ground is just the plane z = 0."""
        return False

    @abstractmethod
    def elevation(self, x: Array, y: Array) -> Array:
        """Height over the plane [m].

        Args:
            x, y: positions in the frame of the ground [m], shapes that broadcast.
        """

    def numbers(self, radius: float) -> Numbers:
        """Numbers that the touch function in C needs, for balls up to ``radius`` [m]."""
        return Numbers()

    def touch(self, x: float, y: float, z: float, radius: float) -> Sequence[Sequence[float]]:
        """Contact points of a ball with a ground of one's own.

        Args:
            x, y, z: centre of the ball in the frame of the ground [m].
            radius: of the ball [m]; 0 for a point.

        Returns:
            For each contact point its normal (x, y, z), which points out of the ground, and its
            depth [m], which is above 0. There may be at most ``numbers(radius).contacts`` points,
            and none if z is ``radius + top`` or more.
        """
        raise NotImplementedError

    @property
    def address(self) -> int:
        """Address of a C function of the type ``plant_touch`` in place of :meth:`touch`; 0: none.

        The function gets the numbers of :meth:`numbers`. Pitfall: the object that owns the function
        must stay alive.
        """
        return 0

    @property
    def touches_itself(self) -> bool:
        """Whether it has its own touch function, in Python or by address."""
        return type(self).touch is not Ground.touch or self.address != 0

    def rotation(self) -> Array:
        """Rotation from ground to world, shape (3, 3); its last column is the normal."""
        c, s = math.cos(self.slope), math.sin(self.slope)
        return np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]])

    def contacts(self, position: Sequence[float], radius: float) -> Array:
        """Normals (x, y, z) and depths [m] of a ball's contact points, shape (contacts, 4).

        Args:
            position: centre of the ball in the frame of the ground [m].
            radius: radius of the ball [m].
        """
        return GroundInC(self, radius).touches([float(value) for value in position], radius)

    def rest_height(self, x: float, y: float, radius: float) -> float:
        """Height of a ball's centre over the plane at which the ball just touches the ground [m].

        Args:
            x, y: position of the centre in the frame of the ground [m].
            radius: radius of the ball [m].
        """
        return GroundInC(self, radius).rest_height(x, y, radius)

    def lines(self, x0: float, x1: float, y0: float, y1: float) -> list[Array]:
        """Polylines that draw the ground between two corners.

        Args:
            x0, x1, y0, y1: corners in the frame of the ground [m].

        Returns:
            Points on the ground in its frame [m], each line of shape (points, 3).

        Points are 1 cm apart, so a vertical face would be drawn as a slope of 1 cm. A ground with
        faces overrides :meth:`_line` to add both ends of each face, as ``Kerb`` does, or it
        overrides this method, as ``Obstacles`` does.
        """
        lines = [self._line(self._stations(x0, x1), [y]) for y in _multiples(y0, y1)]
        return lines + [
            self._line([x], _between(y0, y1, self._spacing)) for x in _multiples(x0, x1)
        ]

    @property
    def _spacing(self) -> float:
        return math.inf if self.flat else GRID / 10.0

    def _stations(self, x0: float, x1: float) -> Array:
        """Positions along x of the points of a line along x [m]."""
        return _between(x0, x1, self._spacing)

    def _line(self, x: Any, y: Any) -> Array:
        xs, ys = np.broadcast_arrays(np.asarray(x, float), np.asarray(y, float))
        return np.column_stack([xs, ys, self.elevation(xs, ys)])

    def text(self) -> str:
        """Kind and all fields that differ from the default, as a text for :func:`parse_ground`."""
        default = type(self)()
        words = [
            f"{f.name}={':'.join(map(str, value)) if isinstance(value, tuple) else value}"
            for f in fields(self)
            if (value := getattr(self, f.name)) != getattr(default, f.name)
        ]
        return ":".join(filter(None, (self.kind, ",".join(words))))

    def to_dict(self) -> dict[str, Any]:
        """Kind and fields as plain data; the inverse of :func:`from_dict`."""
        return {"kind": self.kind} | {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in asdict(self).items()
        }


GROUNDS: Final[dict[str, type[Ground]]] = {}
"""All kinds of ground by name."""


def from_dict(data: Mapping[str, Any]) -> Ground:
    """The ground of a kind with these fields; a field that is left out has its default.

    Args:
        data: kind and fields, see :meth:`Ground.to_dict`.

    Raises:
        ValueError: the kind or a field is unknown, or a value has a wrong type or is out of range.
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
    """The ground that a text such as ``"kerb:at=0.5,height=0.006"`` describes.

    Args:
        text: kind, then a colon and the fields, separated by commas; the numbers of a list are
            separated by colons. A field that is left out has its default.

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
    """Types of the fields that hold numbers or tuples of numbers.

    Only these are checked here. A ground with a field of another type checks that field in its own
    ``__post_init__``.
    """
    try:
        hints = get_type_hints(cls)
    except NameError:  # the class is defined inside a function
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
    """Multiples of ``GRID`` between two positions [m]."""
    return np.asarray(GRID * np.arange(math.ceil(low / GRID), math.floor(high / GRID) + 1.0))


def _between(low: float, high: float, spacing: float) -> Array:
    """Positions from ``low`` to ``high``, both included, at most ``spacing`` apart [m]."""
    return np.linspace(low, high, max(1, math.ceil((high - low) / spacing)) + 1)

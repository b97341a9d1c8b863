"""Robots as data: geometry, masses, servos, contact and sensors read from a TOML file."""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
Vector3 = tuple[float, float, float]

GRAVITY: Final = 9.81
ROBOTS: Final = Path(__file__).parent / "robots"


class RobotDescriptionError(ValueError):
    """A robot file is missing, or a value in it is not allowed."""


@dataclass(frozen=True)
class Body:
    """A rigid link with the inertia of a homogeneous box.

    Args:
        mass: mass [kg].
        size: edge lengths of the box [m].
        com: centre of mass in the frame of the link [m].
    """

    mass: float
    size: Vector3
    com: Vector3

    def inertia(self) -> Array:
        """Inertia tensor about the centre of mass [kg m^2], shape (3, 3)."""
        x, y, z = (edge**2 for edge in self.size)
        return np.diag([y + z, x + z, x + y]) * (self.mass / 12.0)


@dataclass(frozen=True)
class Trunk:
    """The body that carries the legs.

    Args:
        body: mass properties; ``com`` is measured from the reference point between the hips.
        center: middle of the box [m]; differs from the centre of mass.
        com_side_offset: size of the seeded sideways error of the centre of mass [m].
    """

    body: Body
    center: Vector3
    com_side_offset: float

    def corners(self) -> Array:
        """Corners of the box relative to the reference point [m], shape (8, 3)."""
        signs = np.array(np.meshgrid([-1, 1], [-1, 1], [-1, 1])).reshape(3, 8).T
        return np.asarray(self.center) + signs * (np.asarray(self.body.size) / 2.0)


@dataclass(frozen=True)
class Leg:
    """A leg with an abduction joint about x, and hip and knee joints about y.

    Vectors other than ``mount`` have y pointing outward, away from the middle plane.

    Args:
        name: name of the leg, e.g. ``"RF"``.
        mount: abduction joint on the trunk, from the trunk's reference point [m].
        hip_offset: abduction axis to hip axis [m].
        femur_length, tibia_length: pivot to pivot, and knee to centre of the foot ball [m].
        femur_angle: reference pose, femur back of vertical [rad].
        tibia_angle: reference pose, tibia forward of the femur [rad].
        hip, femur, tibia: mass properties of the three links, in frames at their joints.
    """

    name: str
    mount: Vector3
    hip_offset: Vector3
    femur_length: float
    tibia_length: float
    femur_angle: float
    tibia_angle: float
    hip: Body
    femur: Body
    tibia: Body

    @property
    def side(self) -> float:
        """-1 for a leg on the right, +1 on the left or in the middle."""
        return -1.0 if self.mount[1] < 0.0 else 1.0

    def outward(self, vector: Vector3) -> Vector3:
        """The vector in axes parallel to the trunk's, given one with y pointing outward [m]."""
        return (vector[0], self.side * vector[1], vector[2])

    @property
    def mass(self) -> float:
        """Mass of the three links [kg]."""
        return self.hip.mass + self.femur.mass + self.tibia.mass


@dataclass(frozen=True)
class Servo:
    """A geared position servo.

    Args:
        stiffness: torque per position error [N m/rad].
        damping: torque per joint speed [N m s/rad].
        stall_torque: largest torque [N m].
        no_load_speed: speed at which no driving torque is left [rad/s].
        reflected_inertia: rotor inertia times the gear ratio squared [kg m^2].
    """

    stiffness: float
    damping: float
    stall_torque: float
    no_load_speed: float
    reflected_inertia: float


@dataclass(frozen=True)
class Contact:
    """Rubber ball against hard ground.

    Args:
        foot_radius: radius of the foot ball [m].
        stiffness: normal force per penetration [N/m].
        damping: normal force per speed of penetration [N s/m].
        friction: Coulomb coefficient [1].
        friction_speed: below this sliding speed friction is proportional to it [m/s].
    """

    foot_radius: float
    stiffness: float
    damping: float
    friction: float
    friction_speed: float


@dataclass(frozen=True)
class Sensor:
    """What separates the load on a foot from the load the controller sees.

    Args:
        delay: age of the load when it arrives [s].
        time_constant: of the first-order low-pass [s]; 0 for none.
        noise: standard deviation, in halves of the robot's weight [1].
    """

    delay: float
    time_constant: float
    noise: float


@dataclass(frozen=True)
class RobotDescription:
    """A robot as data, independent of any engine."""

    name: str
    trunk: Trunk
    legs: tuple[Leg, ...]
    servo: Servo
    contact: Contact
    sensor: Sensor

    @property
    def mass(self) -> float:
        """Total mass [kg]."""
        return self.trunk.body.mass + sum(leg.mass for leg in self.legs)

    @property
    def weight(self) -> float:
        """Weight on earth [N]."""
        return self.mass * GRAVITY


def load_robot(name_or_path: str) -> RobotDescription:
    """Read a robot description.

    Args:
        name_or_path: name of a shipped robot (``"lilibot"``) or path of a TOML file.

    Raises:
        RobotDescriptionError: the file is missing, is no TOML, or holds a value out of range.
    """
    path = _find(name_or_path)
    try:
        data = tomllib.loads(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise RobotDescriptionError(f"robot file {path}: not readable as TOML ({error})") from error
    return _robot(_Table(path.name, "", data))


def _find(name_or_path: str) -> Path:
    shipped = sorted(path.stem for path in ROBOTS.glob("*.toml"))
    if name_or_path in shipped:
        return ROBOTS / f"{name_or_path}.toml"
    path = Path(name_or_path)
    if path.suffix == ".toml" and path.is_file():
        return path
    raise RobotDescriptionError(
        f"robot {name_or_path!r} is unknown; allowed: {', '.join(shipped)} or the path of a .toml"
    )


def _robot(root: _Table) -> RobotDescription:
    shared = root.table("leg")
    legs = tuple(_leg(shared, own) for own in root.tables("legs"))
    _check_names(root, legs)
    robot = RobotDescription(
        root.text("name"),
        _trunk(root.table("trunk")),
        legs,
        _servo(root.table("servo")),
        _contact(root.table("contact")),
        _sensor(root.table("sensor")),
    )
    shared.close()
    root.close()
    return robot


def _check_names(root: _Table, legs: tuple[Leg, ...]) -> None:
    names = [leg.name for leg in legs]
    if len(set(names)) != len(names):
        raise root.error("legs", names, "names that differ")


def _trunk(table: _Table) -> Trunk:
    trunk = Trunk(
        Body(table.positive("mass"), table.size("size"), table.vector("com")),
        table.vector("center"),
        table.nonnegative("com_side_offset"),
    )
    table.close()
    return trunk


def _body(table: _Table) -> Body:
    body = Body(table.positive("mass"), table.size("size"), table.vector("com"))
    table.close()
    return body


def _leg(shared: _Table, own: _Table) -> Leg:
    leg = Leg(
        name=own.text("name"),
        mount=own.vector("hip"),
        hip_offset=shared.vector("hip_offset"),
        femur_length=shared.positive("femur_length"),
        tibia_length=shared.positive("tibia_length"),
        femur_angle=math.radians(shared.number("femur_angle", -180.0, 180.0)),
        tibia_angle=math.radians(shared.number("tibia_angle", -180.0, 180.0)),
        hip=_body(shared.table("hip")),
        femur=_body(shared.table("femur")),
        tibia=_body(shared.table("tibia")),
    )
    own.close()
    return leg


def _servo(table: _Table) -> Servo:
    servo = Servo(
        table.positive("stiffness"),
        table.nonnegative("damping"),
        table.positive("stall_torque"),
        table.positive("no_load_speed"),
        table.nonnegative("reflected_inertia"),
    )
    table.close()
    return servo


def _contact(table: _Table) -> Contact:
    contact = Contact(
        table.positive("foot_radius"),
        table.positive("stiffness"),
        table.nonnegative("damping"),
        table.nonnegative("friction"),
        table.positive("friction_speed"),
    )
    table.close()
    return contact


def _sensor(table: _Table) -> Sensor:
    sensor = Sensor(
        table.nonnegative("delay"),
        table.nonnegative("time_constant"),
        table.nonnegative("noise"),
    )
    table.close()
    return sensor


class _Table:
    """One table of the file: hands out checked values and knows which were never asked for."""

    def __init__(self, file: str, path: str, data: Mapping[str, Any]) -> None:
        self._file, self._path, self._data = file, path, data
        self._used: set[str] = set()

    def error(self, key: str, value: object, allowed: str) -> RobotDescriptionError:
        return RobotDescriptionError(
            f"robot file {self._file}: {self._path}{key} is {value!r}; allowed: {allowed}"
        )

    def close(self) -> None:
        """Refuse keys nobody reads: a misspelt optional-looking value must not pass silently."""
        for key in self._data.keys() - self._used:
            raise self.error(key, self._data[key], f"only {', '.join(sorted(self._used))}")

    def _get(self, key: str, kind: type | tuple[type, ...], allowed: str) -> Any:
        self._used.add(key)
        value = self._data.get(key)
        if not isinstance(value, kind) or isinstance(value, bool):
            raise self.error(key, "missing" if value is None else value, allowed)
        return value

    def text(self, key: str) -> str:
        value: str = self._get(key, str, "a name")
        if not value:
            raise self.error(key, value, "a name")
        return value

    def number(self, key: str, low: float = -math.inf, high: float = math.inf) -> float:
        allowed = f"a finite number from {low:g} to {high:g}"
        value = float(self._get(key, (int, float), allowed))
        if not (math.isfinite(value) and low <= value <= high):
            raise self.error(key, value, allowed)
        return value

    def nonnegative(self, key: str) -> float:
        return self.number(key, low=0.0)

    def positive(self, key: str) -> float:
        value = self.nonnegative(key)
        if value == 0.0:
            raise self.error(key, value, "a number above 0")
        return value

    def vector(self, key: str) -> Vector3:
        allowed = "three finite numbers"
        value = self._get(key, list, allowed)
        if len(value) != 3 or not all(_is_finite_number(item) for item in value):
            raise self.error(key, value, allowed)
        return (float(value[0]), float(value[1]), float(value[2]))

    def size(self, key: str) -> Vector3:
        value = self.vector(key)
        if min(value) <= 0.0:
            raise self.error(key, value, "three numbers above 0")
        return value

    def table(self, key: str) -> _Table:
        value = self._get(key, dict, "a table")
        return _Table(self._file, f"{self._path}{key}.", value)

    def tables(self, key: str) -> list[_Table]:
        value = self._get(key, list, "a list of tables")
        if not value or not all(isinstance(item, dict) for item in value):
            raise self.error(key, value, "a list of tables, at least one")
        return [
            _Table(self._file, f"{self._path}{key}[{i}].", item)
            for i, item in enumerate(value, start=1)
        ]


def _is_finite_number(value: object) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and math.isfinite(value)

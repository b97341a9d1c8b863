"""Robot descriptions read from TOML files."""

from __future__ import annotations

import math
import tomllib
from pathlib import Path
from typing import Final

from exudyn_models.robot.model import (
    Body,
    Contact,
    Leg,
    RobotDescription,
    Sensor,
    Servo,
    Trunk,
)
from exudyn_models.robot.toml_table import RobotDescriptionError, Table

__all__ = ["ROBOTS", "RobotDescription", "RobotDescriptionError", "load_robot"]

ROBOTS: Final = Path(__file__).parent / "robots"


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
    return _robot(Table(path.name, "", data))


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


def _robot(root: Table) -> RobotDescription:
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


def _check_names(root: Table, legs: tuple[Leg, ...]) -> None:
    names = [leg.name for leg in legs]
    if len(set(names)) != len(names):
        raise root.error("legs", names, "names that differ")


def _trunk(table: Table) -> Trunk:
    trunk = Trunk(
        Body(table.positive("mass"), table.size("size"), table.vector("com")),
        table.vector("center"),
        table.nonnegative("com_side_offset"),
    )
    table.close()
    return trunk


def _body(table: Table) -> Body:
    body = Body(table.positive("mass"), table.size("size"), table.vector("com"))
    table.close()
    return body


def _leg(shared: Table, own: Table) -> Leg:
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


def _servo(table: Table) -> Servo:
    servo = Servo(
        table.positive("stiffness"),
        table.nonnegative("damping"),
        table.positive("stall_torque"),
        table.positive("no_load_speed"),
        table.nonnegative("reflected_inertia"),
        table.nonnegative("latency"),
        table.nonnegative("slew_rate"),
    )
    table.close()
    return servo


def _contact(table: Table) -> Contact:
    contact = Contact(
        table.positive("foot_radius"),
        table.positive("stiffness"),
        table.nonnegative("damping"),
        table.positive("damping_depth"),
        table.nonnegative("friction"),
        table.positive("friction_speed"),
    )
    table.close()
    return contact


def _sensor(table: Table) -> Sensor:
    sensor = Sensor(
        table.nonnegative("delay"),
        table.nonnegative("time_constant"),
        table.nonnegative("noise"),
        table.choice("component", ("normal", "norm")),
    )
    table.close()
    return sensor

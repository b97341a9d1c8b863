"""A robot as a C header for its FMU: all numbers of the robot that are not parameters."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from typing import Any, Final

import numpy as np

from apnc_plant.conditions import named_conditions
from apnc_plant.generate import start_macro
from apnc_plant.ground.obstacles import CELLS, SINK_IN, TILE, Obstacles
from apnc_plant.numbers import bare_trunk, leg_numbers, suspension
from apnc_plant.robot.body import PAYLOAD_SIZE
from apnc_plant.robot.model import GRAVITY, RobotDescription
from apnc_plant.robot.size import times_longer
from apnc_plant.variables import Condition, starts_of, variable_named

HEADER: Final = "robot_config.h"


def robot_config(robot: RobotDescription) -> bytes:
    """Text of ``robot_config.h`` for a robot.

    Args:
        robot: the robot.

    Raises:
        ValueError: a number of the robot is outside the range of its FMU.
    """
    trunk, field = robot.trunk, Obstacles(roughness=1.0, scale=times_longer(robot))
    lines = [
        f"/* Robot '{robot.name}', written by the build. */",
        "#ifndef ROBOT_CONFIG_H",
        "#define ROBOT_CONFIG_H",
        "",
        *_defines(
            {
                "ROBOT_GRAVITY": (GRAVITY, "[m/s^2]"),
                "ROBOT_WEIGHT": (robot.weight, "[N] without payload"),
                "ROBOT_TRUNK": (_body(bare_trunk(trunk)), "without payload, see plant_body"),
                "ROBOT_TRUNK_EDGES": (trunk.edges, "[m] of its outline"),
                "ROBOT_TRUNK_CENTER": (trunk.center, "[m] middle of its outline"),
                "ROBOT_COM_SIDE_OFFSET": (trunk.com_side_offset, "[m]"),
                "ROBOT_SUSPENSION": (suspension(robot), "of a held trunk, see plant_suspension"),
                "ROBOT_PAYLOAD_SIZE": (PAYLOAD_SIZE, "[m] edges of the box on the trunk"),
                "ROBOT_FIELD_BALLS": (field.balls, "obstacles in a tile"),
                "ROBOT_FIELD_CELLS": (CELLS, "along an edge of a tile"),
                "ROBOT_FIELD_TILE": (TILE, "[m]"),
                "ROBOT_FIELD_STEP": (field.top, "[m] height of obstacles at roughness 1"),
                "ROBOT_FIELD_DIAMETERS": (
                    [diameter * field.scale for diameter in field.diameters],
                    "[m] smallest and largest",
                ),
                "ROBOT_FIELD_SINK_IN": (SINK_IN * field.scale, "[m]"),
            }
        ),
        "/* Start values of parameters. */",
        *_defines(
            {start_macro(variable_named(name)): (v[0], "") for name, v in starts_of(robot).items()}
        ),
        "/* Legs, see plant_leg. */",
        *_table("ROBOT_LEGS", (_initializer(leg_numbers(robot, leg)) for leg in robot.legs)),
        "/* Conditions, see plant_model.c. */",
        *_table(
            "ROBOT_CONDITIONS",
            (_condition(each.name, robot) for each in Condition),
        ),
        "",
        "#endif",
        "",
    ]
    return "\n".join(lines).encode()


def _body(body: Any) -> list[Any]:
    return [body.mass, list(body.com), list(body.inertia)]


def _defines(values: Mapping[str, tuple[object, str]]) -> list[str]:
    return [
        f"#define {name} {_initializer(value)}" + (f" /* {comment} */" if comment else "")
        for name, (value, comment) in values.items()
    ]


def _table(name: str, entries: Iterable[str]) -> list[str]:
    return [" \\\n    ".join([f"#define {name}", ", \\\n    ".join(entries)])]


def _condition(condition: str, robot: RobotDescription) -> str:
    legs = robot.leg_names
    conditions = named_conditions(condition, robot)
    delivered = {leg: value * robot.weight / 2.0 for leg, value in conditions.stuck.items()}
    delivered |= dict.fromkeys(conditions.silent(legs), 0.0)
    held = conditions.held_at is not None
    parts: list[Any] = [
        conditions.payload,
        conditions.grf_noise,
        conditions.held_at or 0.0,
        int(held),
        [int(leg in conditions.damaged) for leg in legs],
        [delivered.get(leg, math.nan) for leg in legs],
    ]
    return _initializer(parts)


def _initializer(value: Any) -> str:
    """A value as a C initializer, without loss of digits."""
    if isinstance(value, dict):
        return _initializer(list(value.values()))
    if isinstance(value, list | tuple | np.ndarray):
        return "{" + ", ".join(map(_initializer, value)) + "}"
    if isinstance(value, float) and not math.isfinite(value):
        return "NAN" if math.isnan(value) else "INFINITY" if value > 0.0 else "-INFINITY"
    return repr(value) if isinstance(value, int) else repr(float(value))

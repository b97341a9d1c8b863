"""Robots and controllers as the page reads them."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final

import cffi

from apnc import metrics
from apnc.controllers import CONTROLLERS
from apnc.loop.experiment import Experiment
from apnc.metrics.strides import STANCE_SHARE
from apnc.report import theme
from apnc_core.schema import Causality, Type
from apnc_core.variable_numbers import VARIABLE_NUMBERS
from apnc_core.variables import TABLE
from apnc_plant.ground.obstacles import CELLS, SINK_IN, STEP_HEIGHT, TILE, Obstacles
from apnc_plant.library import declarations, library
from apnc_plant.numbers import bare_trunk, robot_numbers
from apnc_plant.options import PlantOptions
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.robot.body import PAYLOAD_SIZE
from apnc_plant.robot.links import links_of
from apnc_plant.robot.size import times_longer
from apnc_plant.signals import PLANT_SIGNALS
from build_fmu.library import headers

HEADER: Final = Path(__file__).parent / "play.h"

SHOWN: Final = {"apnc": "APNC", "apc": "APNC without a stored gait"} | {
    label: CONTROLLERS[label].name.replace(" (best)", "")
    for label in ("tegotae_best", "phase_reset_best")
}
"""Labels of the controllers to choose from, and their names on the page."""

START: Final = {"lilibot": (0.25, 0), "hexapod": (0.12, 8), "solo12": (0.22, 2), "a1": (0.21, 0)}
"""MI and seed with which the page opens: a robot that walks nearly straight ahead."""

FILES: Final = Path(__file__).parent / "robots"
"""Robot files that do not ship with the package."""


def robot_of(name: str) -> RobotDescription:
    """A robot of the page: of ``FILES``, else one that ships with the package."""
    file = FILES / f"{name}.toml"
    return load_robot(file if file.is_file() else name)


def struct_of(robot: RobotDescription) -> bytes:
    """A robot as ``play_numbers`` of ``play.h``, without its pointer."""
    ffi, n_legs = _ffi(len(robot.legs)), len(robot.legs)
    own, options, field = ffi.new("play_numbers *"), PlantOptions(), Obstacles()
    run = Experiment(robot=robot)
    numbers = robot_numbers(robot)
    shared = ffi.new("plant_robot *")
    _copy(ffi, shared, numbers.at)
    own.robot = shared[0]
    own.robot.leg = ffi.NULL
    for k in range(n_legs):
        _copy(ffi, ffi.addressof(own.leg, k), numbers.at.leg + k)
    trunk = robot.trunk
    own.trunk_mass, own.com_side_offset = trunk.mass, trunk.com_side_offset
    own.trunk_inertia, own.trunk_com = bare_trunk(trunk).inertia, trunk.com
    own.payload_size = PAYLOAD_SIZE
    own.field = {
        "balls": round(field.density * TILE**2),
        "cells": CELLS,
        "tile": TILE,
        "height": STEP_HEIGHT,
        "smallest": field.diameters[0],
        "largest": field.diameters[1],
        "foot_radius": max(robot.foot_radii),
        "sink_in": SINK_IN,
    }
    own.clearance, own.step, own.Ts = options.clearance, run.step, run.Ts
    own.start = [0.0, options.start_hip, options.start_knee]
    return bytes(ffi.buffer(own))


def size_of(n_legs: int) -> int:
    """Bytes of ``play_numbers`` for so many legs."""
    return int(_ffi(n_legs).sizeof("play_numbers"))


def _ffi(n_legs: int) -> cffi.FFI:
    ffi = cffi.FFI()
    ffi.cdef(declarations(headers()[0]))
    ffi.cdef(declarations(HEADER.read_text()).replace("APNC_LEGS", str(n_legs)))
    return ffi


def _copy(ffi: Any, to: Any, source: Any) -> None:
    """Copy a struct of another ``ffi`` by its bytes."""
    other, size = library()[0], ffi.sizeof(ffi.typeof(to).item)
    ffi.buffer(to, size)[:] = other.buffer(source, size)[:]


def robot_data(name: str) -> dict[str, Any]:
    """All that the page knows of a robot: its numbers, what it looks like, its controllers."""
    robot = robot_of(name)
    legs = tuple(leg.name for leg in robot.legs)
    n = len(legs)
    return {
        "name": name,
        "legs": legs,
        "colours": list(theme.leg_colours(legs).values()),
        "numbers": base64.b64encode(struct_of(robot)).decode(),
        "trunk": {"size": robot.trunk.edges, "center": robot.trunk.center},
        "payload": PAYLOAD_SIZE,
        "footRadius": max(robot.foot_radii),
        "size": times_longer(robot),
        "weight": robot.weight,
        "Ts": Experiment(robot=robot).Ts,
        "chains": chains_of(robot),
        "gaits": metrics.GAITS.get(n, {}),
        "gait": metrics.gait_name(n),
        "mi": START[name][0],
        "seed": START[name][1],
        "parameters": {
            label: _floats(Experiment(robot=robot, controller=label).starts()) for label in SHOWN
        },
        "columns": [column for signal in PLANT_SIGNALS for column in signal.columns(legs)],
    }


def chains_of(robot: RobotDescription) -> list[dict[str, Any]]:
    """The legs as ``chainOf`` of the page takes them: their links and the joints that move them."""
    return [
        {
            "mount": leg.mount,
            "tibia": leg.tibia_length,
            "links": [
                {
                    "position": link.position,
                    "axis": link.axis,
                    "turn": link.turn,
                    "sign": link.sign,
                    "angle": link.angle,
                }
                for link in links_of(leg)
            ],
        }
        for leg in robot.legs
    ]


def _floats(parameters: Mapping[str, Any]) -> dict[str, Any]:
    return {
        name: [float(x) for x in value] if isinstance(value, tuple | list) else float(value)
        for name, value in parameters.items()
    }


def shared_data() -> dict[str, Any]:
    """What the page knows beside robots: variables of the controller, thresholds, names."""
    return {
        "controllers": SHOWN,
        # where a variable stands in apnc_variables, the type of its numbers and for what it has one
        "variables": {
            v.name: {
                "index": index,
                "real": v.type is Type.real,
                "per": v.shape.name,
                "output": v.causality in (Causality.output, Causality.local),
            }
            for index, v in enumerate(sorted(TABLE, key=lambda v: VARIABLE_NUMBERS[v.name]))
        },
        "tolerance": metrics.STRICT_TOLERANCE,
        "stanceShare": STANCE_SHARE,
        "tile": TILE,
        "stepHeight": STEP_HEIGHT,
        "balls": round(Obstacles().density * TILE**2),
    }

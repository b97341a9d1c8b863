"""The plant in C as its interface is, for tests: any build of it, any robot given as numbers."""

from __future__ import annotations

import copy
import functools
import math
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import cffi
import numpy as np
from compilers import NATIVE, run, tool

from apnc_plant.library import aligned_memory, library
from apnc_plant.numbers import SUSPENSION, Numbers

SOURCES = Path(__file__).parents[2] / "fmu_src" / "plant"
TICK = 1 / 60
STEP = TICK / 16
NO_CONTRACTION = "-ffp-contract=off"

Fields = Mapping[str, Any]


def ffi() -> Any:
    """cffi's object for the structs of plant.h, the same for every build."""
    return library()[0]


def lib() -> Any:
    """The library that the package uses."""
    return library()[1]


def objects(sources: Path, files: Sequence[str], folder: Path, *flags: str) -> list[Path]:
    """C files of a folder compiled by the system's compiler, quickly."""
    made = [folder / f"{Path(name).stem}.o" for name in files]
    command = [tool("cc", "gcc"), "-std=c11", "-w", "-O0", NO_CONTRACTION, "-fPIC", *flags]
    for name, target in zip(files, made, strict=True):
        run(*command, f"-I{sources}", "-c", sources / name, "-o", target)
    return made


def linked(parts: Sequence[Path], target: Path) -> Any:
    """The library of compiled files, loaded."""
    run(tool("cc", "gcc"), "-shared", *parts, "-o", target, "-lm")
    return ffi().dlopen(str(target))


@functools.cache
def _inside() -> tuple[Any, Any]:
    own = cffi.FFI()
    own.cdef("void inside_put(void *, int32_t, const double *, const double *);")
    own.cdef("void inside_get(void *, int32_t, double *, double *);")
    folder = tempfile.TemporaryDirectory()
    target = Path(folder.name) / "inside.so"
    command = [tool("cc", "gcc"), "-std=c11", "-O1", "-fPIC", "-shared", f"-I{SOURCES}"]
    run(*command, NATIVE / "plant_inside.c", "-o", target)
    return own.dlopen(str(target)), folder


def random_body(random: np.random.Generator, mass: float, size: float) -> Fields:
    """A body of some shape whose axes point anywhere, as ``plant_body``."""
    axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
    second = axes @ np.diag(mass * (size * random.uniform(0.2, 0.5, 3)) ** 2) @ axes.T
    inertia = np.trace(second) * np.eye(3) - second
    places = ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))
    return {
        "mass": mass,
        "com": list(size * random.uniform(-0.3, 0.3, 3)),
        "inertia": [inertia[place] for place in places],
    }


PLAIN_JOINT = {
    **dict.fromkeys(
        ("stiffness", "damping", "stall_torque", "no_load_speed", "reflected_inertia"), math.nan
    ),
    "friction_speed": 1.0,
    "low": -math.inf,
    "high": math.inf,
}
"""A joint with nothing of its own, as ``plant_joint``."""

PLAIN_LEG = {"joint": [PLAIN_JOINT] * 3, "foot_radius": math.nan}
"""What every leg without numbers of its own has, of ``plant_leg``."""


def random_joint(random: np.random.Generator) -> Fields:
    """A joint that is like no other: its servo, damping, friction and stops."""
    return {
        "stiffness": random.uniform(20.0, 40.0),
        "damping": random.uniform(0.3, 0.8),
        "stall_torque": random.uniform(3.0, 5.0),
        "no_load_speed": random.uniform(4.0, 8.0),
        "reflected_inertia": random.uniform(0.004, 0.01),
        "joint_damping": random.uniform(0.05, 0.2),
        "dry_friction": random.uniform(0.05, 0.3),
        "friction_speed": random.uniform(0.1, 1.0),
        "low": random.uniform(-0.6, -0.01),
        "high": random.uniform(0.01, 0.6),
        "stop_stiffness": random.uniform(100.0, 200.0),
        "stop_damping": random.uniform(0.3, 0.8),
    }


def with_joints(fields: Fields, seed: int) -> dict[str, Any]:
    """A copy of a robot, every joint of which is like no other, and every foot."""
    random = np.random.default_rng(seed)
    legs = [
        {**leg, "joint": [random_joint(random) for _ in range(3)],
         "foot_radius": random.uniform(0.01, 0.02)}
        for leg in fields["leg"]
    ]  # fmt: skip
    return changed(fields, leg=legs)


def _random_leg(random: np.random.Generator) -> Fields:
    own = np.random.default_rng(random.bit_generator.state["state"]["state"] % 2**32)
    return {
        "mount": list(random.uniform(-1, 1, 3) * [0.15, 0.1, 0.03]),
        "hip": list(random.uniform(-0.03, 0.03, 3)),
        "femur": random.uniform(0.05, 0.12),
        "tibia": random.uniform(0.05, 0.12),
        "femur_angle": random.uniform(-1.0, 1.0),
        "tibia_angle": random.uniform(-1.0, 1.0),
        "link": [random_body(random, random.uniform(0.05, 0.2), 0.06) for _ in range(3)],
        **PLAIN_LEG,
        "abduction_angle": own.uniform(-0.3, 0.3),
        "knee_in_front": int(own.integers(2)),
    }


def random_fields(random: np.random.Generator, legs: int) -> dict[str, Any]:
    """A robot that is like no other, as ``plant_robot``: every number differs from every other."""
    robot: dict[str, Any] = {
        "legs": legs,
        "gravity": random.uniform(5.0, 12.0),
        "trunk": random_body(random, random.uniform(1.0, 4.0), 0.2),
        "trunk_center": list(random.uniform(-0.02, 0.02, 3)),
        "trunk_size": list(random.uniform(0.02, 0.1, 3)),
        "servo": {
            "stiffness": random.uniform(20.0, 40.0),
            "damping": random.uniform(0.3, 0.8),
            "stall_torque": random.uniform(3.0, 5.0),
            "no_load_speed": random.uniform(4.0, 8.0),
            "reflected_inertia": random.uniform(0.004, 0.01),
        },
        "contact": {
            "foot_radius": random.uniform(0.01, 0.02),
            "stiffness": random.uniform(3000.0, 6000.0),
            "damping": random.uniform(20.0, 40.0),
            "damping_depth": random.uniform(0.001, 0.03),
            "friction": random.uniform(0.5, 1.0),
            "friction_speed": random.uniform(0.02, 0.05),
        },
        "sensor": {"time_constant": random.uniform(0.01, 0.05), "noise": random.uniform(0.01, 0.1)},
        "suspension": dict(
            zip(
                ("stiffness", "damping", "angular_stiffness", "angular_damping"),
                random.uniform(0.7, 1.3, 4) * SUSPENSION,
                strict=True,
            )
        ),
        "leg": [_random_leg(random) for _ in range(legs)],
    }
    masses = [robot["trunk"]["mass"]] + [b["mass"] for leg in robot["leg"] for b in leg["link"]]
    robot["weight"] = sum(masses) * 9.81
    return robot


def changed(fields: Fields, **sections: Any) -> dict[str, Any]:
    """A copy of a robot with other values in its structs."""
    robot: dict[str, Any] = copy.deepcopy(dict(fields))
    for name, value in sections.items():
        robot[name] = {**robot[name], **value} if isinstance(value, Mapping) else value
    return robot


def robot_of(fields: Fields) -> Numbers:
    """``plant_robot`` of its fields."""
    legs = ffi().new("plant_leg[]", [dict(leg) for leg in fields["leg"]])
    return Numbers(ffi().new("plant_robot *", {**fields, "leg": legs}), (legs,))


def random_robot(seed: int, legs: int, **sections: Any) -> Numbers:
    """A robot that is like no other; see ``changed`` for the rest."""
    return robot_of(changed(random_fields(np.random.default_rng(seed), legs), **sections))


def with_chains(fields: Fields, seed: int) -> dict[str, Any]:
    """The robot with legs of every kind, some of them of two joints."""
    own, kinds = np.random.default_rng(seed + 1000), []
    for k, leg in enumerate(fields["leg"]):
        kind, locked = (2 + k + seed) % 3, [0, 0, 0]
        locked[2 if kind == lib().PLANT_COXA else kind] = int((k + seed) % 5 == 4)
        kinds.append(leg | {"kind": kind, "locked": locked, "pointing": own.uniform(-3.0, 3.0)})
    return {**fields, "leg": kinds}


def mixed_robot(seed: int, legs: int, **sections: Any) -> Numbers:
    """A random robot with legs of every kind, see ``with_chains``."""
    fields = changed(random_fields(np.random.default_rng(seed), legs), **sections)
    return robot_of(with_chains(fields, seed))


def soft_robot(seed: int, legs: int, **sections: Any) -> Numbers:
    """A random robot with all knees to one side and no leg sprawled, which lands more softly."""
    fields = changed(random_fields(np.random.default_rng(seed), legs), **sections)
    alike = [leg | {"abduction_angle": 0.0, "knee_in_front": 0} for leg in fields["leg"]]
    return robot_of(fields | {"leg": alike})


def plane(slope: float = 0.0) -> Numbers:
    return Numbers(ffi().new("plant_ground *", {"contacts": 1, "slope": slope}))


def kerb(begin: float, height: float, end: float = math.inf, slope: float = 0.0) -> Numbers:
    reals = ffi().new("double[]", [begin, end, height])
    fields = {"kind": lib().PLANT_KERB, "contacts": 2, "slope": slope, "top": height}
    return Numbers(ffi().new("plant_ground *", {**fields, "reals": reals}), (reals,))


def waves(amplitude: float = 0.008, wavelength: float = 0.3, slope: float = 0.0) -> Numbers:
    reals = ffi().new("double[]", [amplitude / 2, 2 * math.pi / wavelength])
    fields = {"kind": lib().PLANT_WAVES, "contacts": 1, "slope": slope, "top": amplitude}
    return Numbers(ffi().new("plant_ground *", {**fields, "reals": reals}), (reals,))


def obstacles(seed: int, height: float = 0.008, slope: float = 0.0) -> Numbers:
    """A dense field of obstacles, so that a foot often touches two."""
    of = {"seed": seed, "balls": 200, "cells": 20, "tile": 1.0, "height": height}
    field = ffi().new("plant_field *", of | {"smallest": 0.03, "largest": 0.1})
    field.foot_radius, field.sink_in = 0.02, 0.002
    reals = ffi().new("double[]", lib().plant_field_reals(field))
    integers = ffi().new("int64_t[]", lib().plant_field_integers(field))
    most = lib().plant_field_fill(field, reals, integers)
    fields = {"kind": lib().PLANT_OBSTACLES, "contacts": most, "slope": slope, "top": height}
    arrays = {"reals": reals, "integers": integers}
    return Numbers(ffi().new("plant_ground *", fields | arrays), (reals, integers))


def conditions(legs: int, **fields: Any) -> Numbers:
    """``plant_conditions``; ``damaged``: legs, ``stuck``: values [N] by leg."""
    damaged = ffi().new("uint8_t[]", [k in fields.get("damaged", ()) for k in range(legs)])
    stuck = fields.get("stuck", {})
    delivered = ffi().new("double[]", [stuck.get(k, math.nan) for k in range(legs)])
    simple = {name: fields[name] for name in fields if name not in ("damaged", "stuck")}
    arrays = {"damaged": damaged, "stuck": delivered}
    return Numbers(ffi().new("plant_conditions *", simple | arrays), (damaged, delivered))


def pointer(values: np.ndarray) -> Any:
    """Numbers of an array for C, which must be of doubles, in one piece."""
    return ffi().cast("double *", values.ctypes.data)


class CPlant:
    """Robots in C, as many as the kind has lanes, in any build of the library."""

    def __init__(
        self,
        legs: int,
        *,
        library: Any = None,
        kind: int = 0,
        level: int = 0,
        contacts: int = 0,
        delay: float = 0.0,
        Ts: float = TICK,
    ) -> None:
        """A plant without robots; ``delay``: the longest of latency and delay of the sensors."""
        self.lib = library or lib()
        self.legs, self.Ts = legs, Ts
        self.lanes = self.lib.plant_lanes(kind, level)
        history = self.lib.plant_history(delay, delay, Ts)
        made = (kind, level, legs, contacts, history)
        self.size = self.lib.plant_size(*made)
        self.memory, self._owner = aligned_memory(self.size)
        self.lib.plant_create(self.memory, *made)
        self._grounds = ffi().new("plant_ground *[]", self.lanes)
        self._kept: dict[Any, Any] = {}

    def place(
        self,
        robot: Numbers,
        ground: Numbers,
        lane: int = 0,
        *,
        seed: int = 0,
        clearance: float = 0.0,
        height: float = 0.0,
        angles: Sequence[float] = (0.0, 0.0, 0.0),
    ) -> None:
        """Put a robot on the ground, its lowest foot at ``clearance`` [m]."""
        start, angle = np.zeros(6 + 3 * self.legs), np.array(angles, float)
        found = np.zeros(4 * max(1, ground.at.contacts))
        where = (pointer(angle), clearance, pointer(found), pointer(start))
        self.lib.plant_start(robot.at, ground.at, *where)
        self._grounds[lane] = ground.at
        self._kept[lane] = (robot, ground)
        put = (seed, pointer(start), height, self.Ts)
        self.lib.plant_place(self.memory, lane, robot.at, ground.at, *put)

    def conditions(self, lane: int = 0, **fields: Any) -> None:
        """From now on; see ``conditions``."""
        numbers = conditions(self.legs, **fields)  # the arrays it points to must outlive the call
        self.lib.plant_set_conditions(self.memory, lane, numbers.at)

    def command(self, hip: np.ndarray, knee: np.ndarray, lane: int = 0) -> None:
        hips, knees = np.array(hip, float), np.array(knee, float)
        self.lib.plant_command(self.memory, lane, pointer(hips), pointer(knees))

    def advance(self, duration: float = TICK, step: float = STEP) -> None:
        self.lib.plant_advance(self.memory, self._grounds, duration, step)

    def tick(self, hip: np.ndarray, knee: np.ndarray, step: float = STEP) -> np.ndarray:
        """Command the robot in lane 0, advance a tick, sample it."""
        self.command(hip, knee)
        self.advance(step=step)
        return self.row()

    def row(self, lane: int = 0) -> np.ndarray:
        """A sample as C writes it, shape (9 + 19 legs,)."""
        row = np.zeros(9 + 19 * self.legs)
        self.lib.plant_sample(self.memory, lane, pointer(row))
        return row

    def sample(self, lane: int = 0) -> dict[str, np.ndarray]:
        """A sample by names, in the order that plant.h says."""
        row, n = self.row(lane), self.legs
        named = {
            "position": row[:3],
            "rpy": row[3:6],
            "velocity": row[6:9],
            "grf": row[9 + 18 * n :],
        }
        names = ("angle", "speed", "torque", "work", "foot", "force")
        for k, name in enumerate(names):
            named[name] = row[9 + 3 * n * k : 9 + 3 * n * (k + 1)].reshape(n, 3)
        return named

    def state(self, lane: int = 0) -> int:
        return int(self.lib.plant_state_of(self.memory, lane))

    def accelerations(self, lane: int = 0) -> np.ndarray:
        """Of the coordinates of the tree, shape (6 + 3 legs,)."""
        found = np.zeros(6 + 3 * self.legs)
        self.lib.plant_accelerations(self.memory, lane, pointer(found))
        robot = self._kept[lane][0].at
        found[6:] = in_tree(robot, found[6:].reshape(-1, 3)).ravel()
        return found

    def put(self, q: np.ndarray, v: np.ndarray, lane: int = 0) -> None:
        """Coordinates and speeds of the tree, both of shape (6 + 3 legs,)."""
        _inside()[0].inside_put(self.memory, lane, *self._both(q, v))

    def get(self, lane: int = 0) -> tuple[np.ndarray, np.ndarray]:
        """Coordinates and speeds of the tree."""
        q, v = np.zeros(6 + 3 * self.legs), np.zeros(6 + 3 * self.legs)
        _inside()[0].inside_get(self.memory, lane, *self._both(q, v))
        return q, v

    @staticmethod
    def _both(q: np.ndarray, v: np.ndarray) -> tuple[Any, Any]:
        return pointer(q), pointer(v)

    def bytes(self) -> bytes:
        return bytes(ffi().buffer(self.memory, self.size))

    def restore(self, saved: bytes) -> None:
        ffi().buffer(self.memory, self.size)[:] = saved


class Joint(NamedTuple):
    """A joint of a leg: its axis and its turn to the reference pose, its angle and sign of that."""

    axis: tuple[float, float, float]
    turn: float
    angle: int
    sign: float


X, Y, Z = np.eye(3)


def joints_of(leg: Any) -> tuple[Joint, Joint, Joint]:
    """Joints of a ``plant_leg`` from the trunk outward, written from its description."""
    side, flexes = (-1.0 if leg.mount[1] < 0.0 else 1.0), (1.0 if leg.knee_in_front else -1.0)
    abduction = Joint(X, leg.abduction_angle, 0, 1.0)
    hip = Joint(Y, leg.femur_angle, 1, -1.0)
    knee = Joint(Y, -leg.tibia_angle, 2, flexes)
    if leg.kind == lib().PLANT_ABDUCTION:
        return abduction, hip, knee
    if leg.kind == lib().PLANT_HIP:
        return hip, abduction, knee
    across = np.cross([math.cos(leg.pointing), math.sin(leg.pointing), 0.0], Z)
    femur = Joint(across, leg.femur_angle, 2, 1.0)
    return Joint(Z, 0.0, 1, -side), femur, Joint(across, -leg.tibia_angle, 0, side)


def in_tree(robot: Any, angles: np.ndarray, *, signed: bool = True) -> np.ndarray:
    """Coordinates of the tree, shape (legs, 3), from joint angles, shape (legs, 3)."""
    found = np.zeros((robot.legs, 3))
    for k, own in enumerate(angles):
        for j, joint in enumerate(joints_of(robot.leg[k])):
            found[k, j] = (joint.sign if signed else 1.0) * own[joint.angle]
    return found


def by_angle(robot: Any, tree: np.ndarray, *, signed: bool = True) -> np.ndarray:
    """Joint angles, shape (legs, 3), from coordinates of the tree, flat or not."""
    found = np.zeros((robot.legs, 3))
    for k, own in enumerate(np.reshape(tree, (-1, 3))):
        for j, joint in enumerate(joints_of(robot.leg[k])):
            found[k, joint.angle] = (joint.sign if signed else 1.0) * own[j]
    return found


def trot(legs: int, tick: int, size: float = 1.0) -> tuple[np.ndarray, np.ndarray]:
    """Hip and knee commands of a trot on fixed phases [rad], legs a little apart."""
    phase = 0.16 * tick + math.pi * (np.arange(legs) % 2) + 0.1 * np.arange(legs)
    return size * 0.15 * np.cos(phase) - 0.1, size * 0.15 * np.sin(phase) - 0.1


def same_bits(first: np.ndarray, second: np.ndarray) -> bool:
    """Whether doubles are equal to the last bit, signs of zeros included.

    What is not a number has no bits of its own: which of several it is depends on the machine.
    """
    none = np.isnan(first)
    bits = [np.where(none, 0.0, values).view(np.int64) for values in (first, second)]
    return np.array_equal(none, np.isnan(second)) and np.array_equal(*bits)

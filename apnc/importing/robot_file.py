"""A robot file from what was found: the one place that knows which keys a robot file has."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from apnc.importing.legs import LegGeometry, Pose
from apnc.importing.model import ModelFileError
from apnc.importing.scaling import Guessed
from apnc.importing.stance import Stance
from apnc_core.types import Array
from apnc_plant.robot import JointMap, MassProperties
from apnc_plant.robot.body import is_of_a_body
from apnc_plant.robot.model import CHAINS

DIGITS: Final = 14
"""Significant digits of a number in the file."""

THINNEST: Final = 1e-3
"""Smallest edge of a box, as a share of its largest: inertia of a rod is that of a thin box."""

SMALLEST: Final = 1e-3
"""Edges of a link without inertia in the file [m]."""

TURN: Final = 2.0 * math.pi - 1e-9
"""Range from which on a joint has no stops [rad]: a full turn, which formats write for none."""

_SAME: Final = 1e-9
"""Relative difference below which an inertia is that of its box, and an outline its edges."""

_LEVEL: Final = 1e-9
"""Reference angle below which it is 0 [rad]: files round."""

_TOLD: Final = 0.02
"""Change of an inertia by the box that is told."""


@dataclass(frozen=True)
class Found:
    """All that was found of a robot, in the order of the robot file.

    Args:
        name: of the robot.
        trunk: mass properties of the trunk in its frame.
        outline: box around the simple shapes of the trunk: its middle and its edges [m], shape
            (2, 3); None without shapes.
        names: of the legs.
        legs: the legs.
        forward: the direction of the model file that x is.
        stance: how they stand.
        joints: how their joints are counted in the file.
        guessed: what the file does not say.
    """

    name: str
    trunk: MassProperties
    outline: Array | None
    names: tuple[str, ...]
    legs: tuple[LegGeometry, ...]
    forward: str
    stance: Stance
    joints: tuple[JointMap, ...]
    guessed: Guessed


@dataclass(frozen=True)
class Text:
    """A robot file.

    Args:
        toml: its text.
        dropped: what of the masses it cannot say, in words.
    """

    toml: str
    dropped: tuple[str, ...]


def robot_text(found: Found, source: str) -> Text:
    """The robot file.

    Args:
        found: what was found.
        source: name of the model file, for the first line.

    Raises:
        ModelFileError: a link has a mass but no inertia that a body can have.
    """
    boxes = _Boxes()
    trunk = boxes.box("trunk", found.trunk)
    trunk["center"] = found.trunk.com if found.outline is None else found.outline[0]
    if found.outline is not None and _differ(found.outline[1], trunk["size"]):
        trunk["outline"] = found.outline[1]
    trunk["com_side_offset"] = found.guessed.com_side_offset
    legs = [
        _leg(leg, boxes, pose) for leg, pose in zip(found.legs, found.stance.poses, strict=True)
    ]
    if all(leg["knee"] == "<" for leg in legs):
        legs = [{key: value for key, value in leg.items() if key != "knee"} for leg in legs]
    written = [{key: _value(value) for key, value in leg.items()} for leg in legs]
    common = {
        key: value for key, value in written[0].items()
        if key != "mount" and all(leg.get(key) == value for leg in written)
    }  # fmt: skip
    lines = [
        f"# Imported from {source}. SI units, angles in degrees; x forward, y to the left, z up.",
        *([] if found.forward == "x" else [f"# x here is {found.forward} of that file."]),
        "# [legs.joints]: the joints of that file; its angle = offset + sign times the angle here.",
        "",
        f"name = {json.dumps(found.name, ensure_ascii=False)}",
        f"rate = {_value(found.guessed.rate)} # Hz, at which it moves as Lilibot does at 60 Hz",
        *_table("trunk", {key: _value(value) for key, value in trunk.items()}),
    ]
    if common:
        lines += _table("leg", common)
    servos = found.guessed.servos
    for name, leg, servo, radius in zip(
        found.names, written, servos.legs, found.guessed.radii, strict=True
    ):
        own = {key: value for key, value in leg.items() if key not in common}
        own = {"name": json.dumps(name), **own}
        if radius != found.guessed.contact["foot_radius"]:
            own["foot_radius"] = _value(radius)
        lines += _table("[legs]", own)
        for joint, numbers in servo.items():
            lines += _table(f"legs.servo.{joint}", _values(numbers))
        joints = {each.joint: _joint(each) for each in found.joints if each.leg == name}
        lines += _table("legs.joints", joints)[1:]
    lines += _table("servo", _values(servos.common))
    for joint, numbers in servos.kinds.items():
        lines += _table(f"servo.{joint}", _values(numbers))
    for table in ("contact", "sensor", "controller"):
        lines += _table(table, _values(getattr(found.guessed, table)))
    return Text("\n".join(lines) + "\n", boxes.said())


def _leg(leg: LegGeometry, boxes: _Boxes, pose: Pose) -> dict[str, Any]:
    outward = np.array([1.0, leg.side, 1.0])
    mirror = np.outer(outward, outward)
    names = list(leg.names)
    if len(names) == 2:  # the link of the joint that it lacks is a part of its neighbour
        names.insert(2 if leg.has_coxa else 0, names[1 if leg.has_coxa else 0])
    links = {
        key: boxes.box(name, MassProperties(body.mass, body.com * outward, body.inertia * mirror))
        for key, name, body in zip(("hip", "femur", "tibia"), names, leg.bodies, strict=True)
    }
    written: dict[str, Any] = {
        "mount": leg.mount,
        "hip_offset": leg.hip_offset * outward,
        "femur_length": leg.femur,
        "tibia_length": leg.tibia,
        "femur_angle": math.degrees(pose.femur),
        "tibia_angle": math.degrees(pose.tibia),
    }
    if leg.chain != CHAINS[0]:
        written["chain"] = leg.chain
    for key, angle in (("abduction_angle", leg.side * pose.abduction), ("pointing", pose.pointing)):
        if abs(angle) > _LEVEL:
            written[key] = math.degrees(angle)
    return written | {**_ranges(leg), "knee": ">" if pose.tibia < 0.0 else "<", **links}


_STOPS: Final = {
    "abduction": "abduction_range",
    "pointing": "coxa_range",
    "femur": "femur_range",
    "tibia": "tibia_range",
}
"""Keys of a leg's stops by the angle of :class:`Pose`."""


def _ranges(leg: LegGeometry) -> dict[str, tuple[float, float]]:
    """Stops of the joints of a leg that has them [deg], y outward."""
    found = {}
    for angle, key in _STOPS.items():
        if (turn := leg.turns.get(angle)) is None:
            continue
        low, high = turn.lower, turn.upper
        if angle == "abduction":
            low, high = min(leg.side * low, leg.side * high), max(leg.side * low, leg.side * high)
        if high - low < TURN:
            found[key] = math.degrees(low), math.degrees(high)
    return found


def _differ(a: Array, b: Array) -> bool:
    return bool(np.abs(a - b).max() > _SAME * np.abs(b).max())


class _Boxes:
    """Keys of bodies, and what of their inertia is left out."""

    def __init__(self) -> None:
        self._across: tuple[float, str] = (0.0, "")
        self._thick: tuple[float, str] = (0.0, "")
        self._points: list[str] = []

    def box(self, name: str, body: MassProperties) -> dict[str, Any]:
        """Keys of a body: with the edges of the box of its moments, and what this box has not."""
        if body.mass == 0.0:
            return {"mass": 0.0, "size": np.full(3, SMALLEST), "com": np.zeros(3)}
        moments = np.diag(body.inertia)
        if not moments.any():
            self._points.append(name)
            return {"mass": body.mass, "size": np.full(3, SMALLEST), "com": body.com}
        squares = 6.0 / body.mass * (moments.sum() - 2.0 * moments)
        largest = math.sqrt(max(float(squares.max()), 0.0))
        if not largest > 0.0 or moments.min() < 0.0:
            raise ModelFileError(
                f"{name}: it has {body.mass:.3g} kg and the inertia "
                f"{[float(f'{m:.3g}') for m in moments]} kg m^2; allowed: moments of 0 or more, "
                "none larger than the sum of the others"
            )
        size = np.maximum(np.sqrt(np.maximum(squares, 0.0)), THINNEST * largest)
        made = body.mass / 12.0 * ((size**2).sum() - size**2)
        keys = {"mass": body.mass, "size": size, "com": body.com}
        if not _differ(np.diag(made), body.inertia):
            return keys
        if is_of_a_body(body.inertia):
            (xx, xy, xz), (_, yy, yz), (_, _, zz) = body.inertia
            return {**keys, "inertia": [xx, yy, zz, xy, xz, yz]}
        scale = float(moments.max())
        across = float(np.abs(body.inertia - np.diag(moments)).max()) / scale
        self._across = max(self._across, (across, name))
        self._thick = max(self._thick, (float(np.abs(made - moments).max()) / scale, name))
        return keys

    def said(self) -> tuple[str, ...]:
        """What is left out, in words."""
        words = []
        for (share, name), what in (
            (self._across, "products of inertia that no body has with its moments"),
            (self._thick, "moments of inertia that no body has"),
        ):
            if share > _TOLD:
                words.append(f"{what}: up to {share:.0%} of the largest moment, in {name}")
        if self._points:
            words.append(
                f"{len(self._points)} links have mass but no inertia ({self._points[0]} and so "
                f"on): boxes with edges of {SMALLEST} m"
            )
        return tuple(words)


def _joint(joint: JointMap) -> str:
    return _value({"name": joint.name, "sign": joint.sign, "offset": math.degrees(joint.offset)})


def _value(value: Any) -> str:
    """A value as TOML."""
    if isinstance(value, int):
        return json.dumps(value)
    if isinstance(value, str):
        return json.dumps(value)
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {_value(v)}" for key, v in value.items()) + " }"
    if isinstance(value, Sequence | np.ndarray):
        return "[" + ", ".join(map(_value, value)) + "]"
    return repr(float(f"{float(value):.{DIGITS}g}") + 0.0)


def _values(values: Mapping[str, Any]) -> dict[str, str]:
    return {key: _value(value) for key, value in values.items()}


def _table(name: str, values: Mapping[str, str]) -> list[str]:
    return ["", f"[{name}]", *(f"{key} = {value}" for key, value in values.items())]

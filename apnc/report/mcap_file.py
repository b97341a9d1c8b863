"""A walk as an MCAP log of ROS 2 messages, for Foxglove, PlotJuggler and Rerun."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from apnc.loop.record import Record
from apnc.report import ros_types as ros
from apnc.report.diagnostics import events, statuses
from apnc.report.frames import WORLD, Frame, frames_of
from apnc_core.types import Array
from apnc_plant.robot.names import plain_names, plainly_named
from apnc_plant.robot.urdf import robot_urdf

Message = tuple[str, str, dict[str, Any]]
"""Topic, type and content of a message."""

_SCALARS: Final = ("MI", "turn", "d", "kappa")
_OF_LEGS: Final = ("grf", "grf_expected", "gamma")
"""Signals of the controller that the log has as numbers, each leg's on a topic of its own."""

_NOTE_EVERY_S: Final = 1.0
"""Time between two messages of ``/diagnostics`` [s]."""


def write_mcap(record: Record, path: Path) -> None:
    """Write a run with what the robot's 3D view needs and the signals that one plots first.

    Topics are

    - ``/robot_description`` (String, the URDF) once, and ``/tf`` (TFMessage) with a frame for each
      of its links, from ``world`` over ``trunk`` to the feet;
    - ``/joint_states`` and ``/joint_commands`` (JointState), ``/trunk`` (PoseStamped) and
      ``/foot_force/RF`` ... (WrenchStamped in the world frame);
    - ``/apnc/MI``, ``/apnc/phi12``, ``/apnc/grf/RF`` ... (Float64MultiArray of one number), named
      and with the units as in ``record.csv``;
    - ``/diagnostics`` (DiagnosticArray) once a second, and ``/rosout`` (Log) when the couplings
      switch, a foot sensor fails or the run ends too early.

    Time starts at 0. Names of legs in topics, joints and frames are plain, see
    ``apnc_plant.robot.names``.

    Args:
        record: the run.
        path: file to write.

    Raises:
        ModuleNotFoundError: the extra ``mcap`` is not installed.
        OSError: the file cannot be written.

    Pitfall: Rerun draws no Float64, and of the types for plain numbers it draws only arrays.
    """
    from mcap_ros2.writer import Writer  # noqa: PLC0415  # an extra

    record = replace(record, legs=plain_names(record.legs), robot=plainly_named(record.robot))
    with path.open("wb") as file:
        writer = Writer(file)
        schemas = {
            name: writer.register_msgdef(name, text) for name, text in ros.DEFINITIONS.items()
        }
        for stamp, (topic, kind, message) in _messages(record):
            writer.write_message(topic, schemas[kind], message, log_time=stamp)
        writer.finish()


def _messages(record: Record) -> Iterator[tuple[int, Message]]:
    """Every message of a run with its time [ns], in the order of time."""
    frames, happens = frames_of(record), events(record)
    yield 0, ("/robot_description", ros.TEXT, {"data": robot_urdf(record.robot)})
    note_every = max(1, round(_NOTE_EVERY_S / record.experiment.Ts))
    for tick, t in enumerate(record.time):
        stamp = round(float(t) * 1e9)
        time = dict(zip(("sec", "nanosec"), divmod(stamp, 10**9), strict=True))
        world = {"stamp": time, "frame_id": WORLD}
        for message in (*_robot(record, frames, tick, world), *_controller(record, tick)):
            yield stamp, message
        if tick % note_every == 0:
            notes = {"header": world, "status": statuses(record, tick)}
            yield stamp, ("/diagnostics", ros.DIAGNOSTICS, notes)
        while happens and happens[0].tick == tick:
            event = happens.pop(0)
            log = {"stamp": time, "level": int(event.severity), "name": "apnc", "msg": event.text}
            yield stamp, ("/rosout", ros.LOG, {**log, "file": "", "function": "", "line": 0})


def _robot(
    record: Record, frames: list[Frame], tick: int, world: dict[str, Any]
) -> Iterator[Message]:
    signals, legs = record.signals, record.legs
    tree = [_transform(frame, tick, world) for frame in frames]
    yield "/tf", ros.TRANSFORMS, {"transforms": tree}
    trunk = {"position": tree[0]["transform"]["translation"]}
    trunk |= {"orientation": tree[0]["transform"]["rotation"]}
    yield "/trunk", ros.POSE, {"header": world, "pose": trunk}
    body = world | {"frame_id": ""}
    state = {
        "name": [f"{leg}_{joint}" for leg in legs for joint in ("abduction", "hip", "knee")],
        "position": signals["joint_angle"][tick].ravel().tolist(),
        "velocity": signals["joint_speed"][tick].ravel().tolist(),
        "effort": signals["joint_torque"][tick].ravel().tolist(),
    }
    yield "/joint_states", ros.JOINTS, {"header": body, **state}
    commands = {
        "name": [f"{leg}_{joint}" for joint in ("hip", "knee") for leg in legs],
        "position": [*signals["theta_hip"][tick], *signals["theta_knee"][tick]],
        "velocity": [],
        "effort": [],
    }
    yield "/joint_commands", ros.JOINTS, {"header": body, **commands}
    for leg, force in zip(legs, signals["foot_force"][tick], strict=True):
        wrench = {"force": _named("xyz", force), "torque": dict.fromkeys("xyz", 0.0)}
        yield f"/foot_force/{leg}", ros.WRENCH, {"header": world, "wrench": wrench}


def _transform(frame: Frame, tick: int, world: dict[str, Any]) -> dict[str, Any]:
    return {
        "header": world | {"frame_id": frame.parent},
        "child_frame_id": frame.name,
        "transform": {
            "translation": _named("xyz", frame.translation[tick]),
            "rotation": _named("xyzw", frame.rotation[tick]),
        },
    }


def _controller(record: Record, tick: int) -> Iterator[Message]:
    signals = record.signals
    for name in _SCALARS:
        yield _number(name, signals[name][tick])
    for k, phi in enumerate(signals["phi"][tick], start=2):
        yield _number(f"phi1{k}", phi)
    for name in _OF_LEGS:
        for leg, value in zip(record.legs, signals[name][tick], strict=True):
            yield _number(f"{name}/{leg}", value)


def _number(name: str, value: float) -> Message:
    layout = {"dim": [], "data_offset": 0}
    return f"/apnc/{name}", ros.NUMBERS, {"layout": layout, "data": [float(value)]}


def _named(names: str, values: Array) -> dict[str, float]:
    return dict(zip(names, values.tolist(), strict=True))

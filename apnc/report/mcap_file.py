"""A walk as an MCAP log of ROS 2 messages, e.g. for Foxglove and PlotJuggler."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any, Final

from scipy.spatial.transform import Rotation

from apnc.loop.record import Record
from apnc_plant.robot.names import plain_names

_SEPARATOR: Final = "=" * 80
_TIME: Final = "int32 sec\nuint32 nanosec\n"
_HEADER: Final = "builtin_interfaces/Time stamp\nstring frame_id\n"
_VECTOR: Final = "float64 x\nfloat64 y\nfloat64 z\n"
_STAMPED: Final = {"std_msgs/Header": _HEADER, "builtin_interfaces/Time": _TIME}

_DEFINITIONS: Final = {
    "sensor_msgs/msg/JointState": (
        "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
        "float64[] effort\n",
        _STAMPED,
    ),
    "geometry_msgs/msg/PoseStamped": (
        "std_msgs/Header header\ngeometry_msgs/Pose pose\n",
        {
            **_STAMPED,
            "geometry_msgs/Pose": "geometry_msgs/Point position\n"
            "geometry_msgs/Quaternion orientation\n",
            "geometry_msgs/Point": _VECTOR,
            "geometry_msgs/Quaternion": f"{_VECTOR}float64 w\n",
        },
    ),
    "geometry_msgs/msg/WrenchStamped": (
        "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n",
        {
            **_STAMPED,
            "geometry_msgs/Wrench": "geometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n",
            "geometry_msgs/Vector3": _VECTOR,
        },
    ),
    "std_msgs/msg/Float64": ("float64 data\n", {}),
}


def write_mcap(record: Record, path: Path) -> None:
    """Write joint states and commands, pose of the trunk, foot forces and state of the controller.

    Topics are ``/joint_states`` and ``/joint_commands`` (JointState), ``/trunk`` (PoseStamped),
    ``/foot_force/RF`` ... (WrenchStamped in the world frame), and ``/apnc/phi12`` ...,
    ``/apnc/kappa`` and ``/apnc/d`` (Float64). Time starts at 0. Names of legs in topics and joints
    are plain, see ``apnc_plant.robot.names``.

    Args:
        record: the run.
        path: file to write.

    Raises:
        ModuleNotFoundError: the extra ``mcap`` is not installed.
        OSError: the file cannot be written.
    """
    from mcap_ros2.writer import Writer  # noqa: PLC0415  # an extra

    record = replace(record, legs=plain_names(record.legs))
    with path.open("wb") as file:
        writer = Writer(file)
        schemas = {
            name: writer.register_msgdef(name, _definition(*parts))
            for name, parts in _DEFINITIONS.items()
        }
        for tick, t in enumerate(record.time):
            stamp = round(float(t) * 1e9)
            for topic, kind, message in _messages(record, tick, stamp):
                writer.write_message(topic, schemas[kind], message, log_time=stamp)
        writer.finish()


def _definition(own: str, others: dict[str, str]) -> str:
    return own + "".join(f"{_SEPARATOR}\nMSG: {name}\n{text}" for name, text in others.items())


def _messages(record: Record, tick: int, stamp: int) -> Iterator[tuple[str, str, dict[str, Any]]]:
    time = dict(zip(("sec", "nanosec"), divmod(stamp, 10**9), strict=True))
    body, world = ({"stamp": time, "frame_id": frame} for frame in ("", "world"))
    signals, legs = record.signals, record.legs
    joints = [f"{leg}_{joint}" for leg in legs for joint in ("abduction", "hip", "knee")]
    position, velocity, effort = (
        signals[name][tick].ravel().tolist()
        for name in ("joint_angle", "joint_speed", "joint_torque")
    )
    state = {"name": joints, "position": position, "velocity": velocity, "effort": effort}
    yield "/joint_states", "sensor_msgs/msg/JointState", {"header": body, **state}
    commands = {
        "name": [f"{leg}_{joint}" for joint in ("hip", "knee") for leg in legs],
        "position": [*signals["theta_hip"][tick], *signals["theta_knee"][tick]],
        "velocity": [],
        "effort": [],
    }
    yield "/joint_commands", "sensor_msgs/msg/JointState", {"header": body, **commands}
    turn = Rotation.from_euler("xyz", signals["rpy"][tick]).as_quat()
    pose = {
        "position": dict(zip("xyz", signals["position"][tick], strict=True)),
        "orientation": dict(zip("xyzw", turn, strict=True)),
    }
    yield "/trunk", "geometry_msgs/msg/PoseStamped", {"header": world, "pose": pose}
    for leg, force in zip(legs, signals["foot_force"][tick], strict=True):
        wrench = {
            "force": dict(zip("xyz", force, strict=True)),
            "torque": dict.fromkeys("xyz", 0.0),
        }
        message = {"header": world, "wrench": wrench}
        yield f"/foot_force/{leg}", "geometry_msgs/msg/WrenchStamped", message
    for k, phi in enumerate(signals["phi"][tick], start=2):
        yield f"/apnc/phi1{k}", "std_msgs/msg/Float64", {"data": float(phi)}
    for name in ("d", "kappa"):
        value = {"data": float(signals[name][tick])}
        yield f"/apnc/{name}", "std_msgs/msg/Float64", value

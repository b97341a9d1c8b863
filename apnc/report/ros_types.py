"""Types of ROS 2 messages as text, for logs that are read without ROS."""

from __future__ import annotations

from typing import Final

_SEPARATOR: Final = "=" * 80
_TIME: Final = "int32 sec\nuint32 nanosec\n"
_HEADER: Final = "builtin_interfaces/Time stamp\nstring frame_id\n"
_VECTOR: Final = "float64 x\nfloat64 y\nfloat64 z\n"
_STAMPED: Final = {"std_msgs/Header": _HEADER, "builtin_interfaces/Time": _TIME}
_VECTOR3: Final = {"geometry_msgs/Vector3": _VECTOR}
_QUATERNION: Final = {"geometry_msgs/Quaternion": f"{_VECTOR}float64 w\n"}


def _definition(own: str, others: dict[str, str]) -> str:
    return own + "".join(f"{_SEPARATOR}\nMSG: {name}\n{text}" for name, text in others.items())


DIAGNOSTICS: Final = "diagnostic_msgs/msg/DiagnosticArray"
JOINTS: Final = "sensor_msgs/msg/JointState"
LOG: Final = "rcl_interfaces/msg/Log"
NUMBERS: Final = "std_msgs/msg/Float64MultiArray"
POSE: Final = "geometry_msgs/msg/PoseStamped"
TEXT: Final = "std_msgs/msg/String"
TRANSFORMS: Final = "tf2_msgs/msg/TFMessage"
WRENCH: Final = "geometry_msgs/msg/WrenchStamped"

DEFINITIONS: Final = {
    DIAGNOSTICS: _definition(
        "std_msgs/Header header\ndiagnostic_msgs/DiagnosticStatus[] status\n",
        {
            **_STAMPED,
            "diagnostic_msgs/DiagnosticStatus": "byte level\nstring name\nstring message\n"
            "string hardware_id\ndiagnostic_msgs/KeyValue[] values\n",
            "diagnostic_msgs/KeyValue": "string key\nstring value\n",
        },
    ),
    JOINTS: _definition(
        "std_msgs/Header header\nstring[] name\nfloat64[] position\nfloat64[] velocity\n"
        "float64[] effort\n",
        _STAMPED,
    ),
    LOG: _definition(
        "builtin_interfaces/Time stamp\nuint8 level\nstring name\nstring msg\nstring file\n"
        "string function\nuint32 line\n",
        {"builtin_interfaces/Time": _TIME},
    ),
    NUMBERS: _definition(
        "std_msgs/MultiArrayLayout layout\nfloat64[] data\n",
        {
            "std_msgs/MultiArrayLayout": "std_msgs/MultiArrayDimension[] dim\nuint32 data_offset\n",
            "std_msgs/MultiArrayDimension": "string label\nuint32 size\nuint32 stride\n",
        },
    ),
    POSE: _definition(
        "std_msgs/Header header\ngeometry_msgs/Pose pose\n",
        {
            **_STAMPED,
            "geometry_msgs/Pose": "geometry_msgs/Point position\n"
            "geometry_msgs/Quaternion orientation\n",
            "geometry_msgs/Point": _VECTOR,
            **_QUATERNION,
        },
    ),
    TEXT: "string data\n",
    TRANSFORMS: _definition(
        "geometry_msgs/TransformStamped[] transforms\n",
        {
            "geometry_msgs/TransformStamped": "std_msgs/Header header\nstring child_frame_id\n"
            "geometry_msgs/Transform transform\n",
            **_STAMPED,
            "geometry_msgs/Transform": "geometry_msgs/Vector3 translation\n"
            "geometry_msgs/Quaternion rotation\n",
            **_VECTOR3,
            **_QUATERNION,
        },
    ),
    WRENCH: _definition(
        "std_msgs/Header header\ngeometry_msgs/Wrench wrench\n",
        {
            **_STAMPED,
            "geometry_msgs/Wrench": "geometry_msgs/Vector3 force\ngeometry_msgs/Vector3 torque\n",
            **_VECTOR3,
        },
    ),
}
"""Name of a type -> its definition, followed by those of the types in it."""

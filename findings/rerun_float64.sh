#!/usr/bin/env bash
# Rerun draws an array of numbers from a ROS 2 log, but not a single number.
#
# Version: rerun-sdk 0.41.0 and mcap-ros2-support 0.6.0 (PyPI), run on 2026-12-01. Takes 700 MB.
# Behaviour: a std_msgs/Float64, the type that ROS has for a number over time, is decoded into a
# structure of its own that no view draws, without a warning. A std_msgs/Float64MultiArray with the
# same number becomes a curve, and so does a sensor_msgs/JointState, one curve for each name.
# Output seen: topic, what Rerun makes of it
#   /float64 std_msgs.msg.Float64:message
#   /float64_multi_array Scalars:scalars
# Way out: send the number as an array of one.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "rerun-sdk==0.41.0" "mcap-ros2-support==0.6.0"
cd "$work"
cat >look.py <<'END'
import sys

from mcap_ros2.writer import Writer
from rerun.chunk import McapReader

LAYOUT = """std_msgs/MultiArrayLayout layout
float64[] data
================================================================================
MSG: std_msgs/MultiArrayLayout
std_msgs/MultiArrayDimension[] dim
uint32 data_offset
================================================================================
MSG: std_msgs/MultiArrayDimension
string label
uint32 size
uint32 stride
"""
with open("numbers.mcap", "wb") as file:
    writer = Writer(file)
    single = writer.register_msgdef("std_msgs/msg/Float64", "float64 data\n")
    array = writer.register_msgdef("std_msgs/msg/Float64MultiArray", LAYOUT)
    for tick in range(10):
        at, value = tick * 10**8, tick / 10
        writer.write_message("/float64", single, {"data": value}, log_time=at)
        many = {"layout": {"dim": [], "data_offset": 0}, "data": [value]}
        writer.write_message("/float64_multi_array", array, many, log_time=at)
    writer.finish()

seen = {}
for chunk in McapReader("numbers.mcap").stream():
    names = chunk.to_record_batch().schema.names
    data = [name for name in names if ":" in name and not name.startswith("Mcap")]
    if chunk.entity_path in ("/float64", "/float64_multi_array"):
        seen.setdefault(chunk.entity_path, []).extend(data)
for topic, names in sorted(seen.items()):
    print(topic, *names)
expected = {
    "/float64": ["std_msgs.msg.Float64:message"],
    "/float64_multi_array": ["Scalars:scalars"],
}
sys.exit(0 if seen == expected else 1)
END
"$work/venv/bin/python" look.py

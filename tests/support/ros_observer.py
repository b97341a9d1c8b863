"""Listens to the controller node for some seconds and prints what it heard as JSON."""

from __future__ import annotations

import json
import sys

import rospy
from diagnostic_msgs.msg import DiagnosticArray
from geometry_msgs.msg import PoseStamped
from sensor_msgs.msg import JointState

commands: list[float] = []
reports: list[dict[str, str]] = []
places: list[float] = []
rospy.init_node("observer", disable_signals=True)
rospy.Subscriber("joint_commands", JointState, lambda m: commands.append(m.header.stamp.to_sec()))
rospy.Subscriber("trunk", PoseStamped, lambda m: places.append(m.pose.position.x))
rospy.Subscriber(
    "diagnostics",
    DiagnosticArray,
    lambda m: reports.append({pair.key: pair.value for pair in m.status[0].values}),
)
rospy.sleep(float(sys.argv[1]))
print(json.dumps({"commands": commands, "reports": reports, "places": places}))

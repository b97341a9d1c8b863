#!/usr/bin/env python3
"""The robot in plain C as a ROS 1 node, in real time: a stand-in for the real one.

Subscribes to ``joint_commands`` (JointState [rad]). Publishes ``foot_loads`` (Float64MultiArray
[N]), ``joint_states`` (JointState) and ``trunk`` (PoseStamped).

Parameters: ``~robot`` (name or file), ``~seed``.
"""

from __future__ import annotations

import numpy as np
import rospy
from geometry_msgs.msg import Point, PoseStamped, Quaternion
from scipy.spatial.transform import Rotation
from sensor_msgs.msg import JointState
from std_msgs.msg import Float64MultiArray, MultiArrayDimension, MultiArrayLayout

from apnc import Experiment
from apnc.loop.simulate import plant_of


class Node:
    """One robot and the topics around it."""

    def __init__(self) -> None:
        experiment = Experiment(
            robot=rospy.get_param("~robot", "lilibot"),
            seed=int(rospy.get_param("~seed", 0)),
            engine="compiled",
        )
        self.plant, self.Ts = plant_of(experiment), experiment.Ts
        self.legs = self.plant.legs
        self.target = np.zeros((2, len(self.legs)))
        dimension = MultiArrayDimension(" ".join(self.legs), len(self.legs), len(self.legs))
        self.layout = MultiArrayLayout([dimension], 0)
        self.joints = [f"{leg}_{j}" for leg in self.legs for j in ("abduction", "hip", "knee")]
        self.loads = rospy.Publisher("foot_loads", Float64MultiArray, queue_size=1)
        self.states = rospy.Publisher("joint_states", JointState, queue_size=1)
        self.trunk = rospy.Publisher("trunk", PoseStamped, queue_size=1)
        rospy.Subscriber("joint_commands", JointState, self.take, tcp_nodelay=True)

    def take(self, message: JointState) -> None:
        """Keep the newest command."""
        self.target = np.array(message.position).reshape(2, -1)

    def run(self) -> None:
        """Integrate as wall time goes by."""
        rate = rospy.Rate(1.0 / self.Ts)
        while not rospy.is_shutdown() and not self.plant.fell:
            self.plant.advance(*self.target, self.Ts)
            self.loads.publish(Float64MultiArray(self.layout, self.plant.grf().tolist()))
            self.publish_state()
            rate.sleep()
        if self.plant.fell:
            rospy.logerr("the robot fell")

    def publish_state(self) -> None:
        """Joints and trunk."""
        now = self.plant.sample()
        states, pose = JointState(name=self.joints), PoseStamped()
        states.header.stamp = pose.header.stamp = rospy.Time.now()
        states.position = now["joint_angle"].ravel()
        states.velocity = now["joint_speed"].ravel()
        states.effort = now["joint_torque"].ravel()
        pose.header.frame_id = "world"
        pose.pose.position = Point(*now["position"])
        pose.pose.orientation = Quaternion(*Rotation.from_euler("xyz", now["rpy"]).as_quat())
        self.states.publish(states)
        self.trunk.publish(pose)


if __name__ == "__main__":
    rospy.init_node("plant")
    Node().run()

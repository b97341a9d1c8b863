#!/usr/bin/env python3
"""The controller FMU as a ROS 1 node: foot loads in, joint commands out, at 60 Hz of wall time.

Subscribes to ``foot_loads`` (Float64MultiArray [N], legs in the order of the robot), ``mi`` and
``turn`` (Float64), ``reset`` (Bool). Publishes ``joint_commands`` (JointState [rad], relative to
the reference pose) and ``diagnostics``. For a robot whose file maps its joints it also publishes
``joint_commands_in_file``: the same with names and angles of the robot's own model file.

Parameters: ``~robot`` (name or file), ``~mi``, ``~gait`` (gait file: written when a gait has been
stored, read at the start, so that a node that is started again goes on with its gait).
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from sensor_msgs.msg import JointState
from std_msgs.msg import Bool, Float64, Float64MultiArray

from apnc import Experiment, Gait, read_gait, write_gait
from apnc.loop.fmu_controller import FmuController
from build_fmu.build import host_fmu

TOO_OLD = 0.5  # s; loads older than this count as missing, and the FMU raises its fault outputs


class Node:
    """One controller and the topics around it."""

    def __init__(self) -> None:
        experiment = Experiment(robot=rospy.get_param("~robot", "lilibot"))
        self.legs = tuple(leg.name for leg in experiment.description.legs)
        self.Ts, self.gait_file = experiment.Ts, rospy.get_param("~gait", "")
        parameters = experiment.starts()
        self.stored = bool(self.gait_file) and Path(self.gait_file).is_file()
        if self.stored:
            parameters |= read_gait(Path(self.gait_file)).settings(self.legs)
            rospy.loginfo("start with the gait of %s", self.gait_file)
        self.fmu = FmuController(host_fmu(len(self.legs)), parameters)
        self.loads, self.loads_at = np.zeros(len(self.legs)), rospy.get_time()
        self.mi = float(rospy.get_param("~mi", experiment.mi))
        self.turn, self.reset = 0.0, False
        self.late: list[float] = []
        self.joints = [f"{leg}_{joint}" for joint in ("hip", "knee") for leg in self.legs]
        self.joint_map = experiment.description.joint_map
        self.commands = rospy.Publisher("joint_commands", JointState, queue_size=1)
        self.in_file = rospy.Publisher("joint_commands_in_file", JointState, queue_size=1)
        self.diagnostics = rospy.Publisher("diagnostics", DiagnosticArray, queue_size=1)
        rospy.Subscriber("foot_loads", Float64MultiArray, self.take_loads, tcp_nodelay=True)
        rospy.Subscriber("mi", Float64, lambda message: setattr(self, "mi", message.data))
        rospy.Subscriber("turn", Float64, lambda message: setattr(self, "turn", message.data))
        rospy.Subscriber("reset", Bool, lambda message: setattr(self, "reset", message.data))

    def take_loads(self, message: Float64MultiArray) -> None:
        """Keep the newest loads."""
        if len(message.data) == len(self.legs):
            self.loads, self.loads_at = np.array(message.data), rospy.get_time()

    def run(self) -> None:
        """Tick until ROS shuts down."""
        rate, begin = rospy.Rate(1.0 / self.Ts), rospy.get_time()
        n = 0
        while not rospy.is_shutdown():
            now = rospy.get_time()
            self.late.append(now - begin - n * self.Ts)
            missing = now - self.loads_at > TOO_OLD
            loads = np.full(len(self.legs), np.nan) if missing else self.loads
            self.fmu.step(n * self.Ts, self.Ts, loads, self.mi, self.turn, self.reset)
            self.publish()
            n += 1
            if n % round(1.0 / self.Ts) == 0:
                self.report(missing)
            rate.sleep()

    def publish(self) -> None:
        """Joint commands of this tick."""
        message = JointState(name=self.joints)
        message.header.stamp = rospy.Time.now()
        message.position = [*self.fmu.theta_hip, *self.fmu.theta_knee]
        self.commands.publish(message)
        if self.joint_map:
            angles = dict(zip(message.name, message.position, strict=True))
            own = JointState(name=[joint.name for joint in self.joint_map])
            own.header.stamp = message.header.stamp
            own.position = [
                joint.in_file(angles.get(f"{joint.leg}_{joint.joint}", 0.0))  # abduction stays at 0
                for joint in self.joint_map
            ]
            self.in_file.publish(own)

    def report(self, missing: bool) -> None:
        """Once a second: what the controller knows, how late its ticks were, and its gait kept."""
        now = self.fmu.sample()
        if now["kappa"] == 1.0 and self.gait_file and not self.stored:
            write_gait(Gait(self.legs, tuple(now["phi_memory"].tolist())), Path(self.gait_file))
            self.stored = True
        jitter = np.diff(self.late) * 1e3
        self.late = self.late[-1:]
        values = {
            "kappa": f"{now['kappa']:.0f}",
            "phi": " ".join(f"{angle:.3f}" for angle in now["phi"]),
            "gamma": " ".join(f"{gain:.4f}" for gain in now["gamma"]),
            "fault": " ".join(leg for leg, bad in zip(self.legs, now["fault"], strict=True) if bad),
            "tick": f"{now['tick']:.0f}",
            "jitter_std_ms": f"{jitter.std():.3f}",
            "jitter_max_ms": f"{np.abs(jitter).max():.3f}",
        }
        level = DiagnosticStatus.WARN if missing else DiagnosticStatus.OK
        words = "no foot loads" if missing else "walking"
        pairs = [KeyValue(key, value) for key, value in values.items()]
        message = DiagnosticArray(status=[DiagnosticStatus(level, "apnc", words, "", pairs)])
        message.header.stamp = rospy.Time.now()
        self.diagnostics.publish(message)


if __name__ == "__main__":
    rospy.init_node("controller")
    Node().run()

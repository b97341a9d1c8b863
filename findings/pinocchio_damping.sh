#!/usr/bin/env bash
# Pinocchio reads the damping and the friction of a joint from a URDF and computes without them.
#
# Version: pin 4.1.0 (PyPI), run on 2026-12-01.
# Behaviour: model.damping and model.friction hold the numbers of <dynamics>, but aba and rnea give
# the accelerations and torques of a robot whose joints have neither. model.armature, which stands
# beside them and which no URDF sets, does count.
# Output seen, for a rotor of 0.02 kg m^2 that turns at 1 rad/s, with damping 0.5 N m s/rad and
# friction 0.1 N m, so that it is slowed down by (0.5 + 0.1) / 0.02 = 30 rad/s^2:
#   read: damping 0.5, friction 0.1
#   aba: 0.0 rad/s^2, rnea at constant speed: 0.0 N m
#   aba of 1 N m: 50.0 rad/s^2, with an armature of 0.02: 25.0 rad/s^2
# Way out: subtract damping times speed, and the friction, from the torques that are given to aba.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "pin==4.1.0"
cd "$work"
cat >look.py <<'END'
import numpy as np
import pinocchio

urdf = """<robot name="x">
  <link name="stand"/>
  <link name="rotor">
    <inertial>
      <mass value="1"/>
      <inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <joint name="axle" type="revolute">
    <parent link="stand"/><child link="rotor"/><axis xyz="0 0 1"/>
    <limit lower="-3" upper="3" effort="9" velocity="9"/>
    <dynamics damping="0.5" friction="0.1"/>
  </joint>
</robot>"""
model = pinocchio.buildModelFromXML(urdf)
data = model.createData()
none, one = np.zeros(1), np.ones(1)


def accelerated(speed, torque):
    return round(float(pinocchio.aba(model, data, none, speed, torque)[0]), 9)


print(f"read: damping {model.damping[0]}, friction {model.friction[0]}")
held = round(float(pinocchio.rnea(model, data, none, one, none)[0]), 9)
print(f"aba: {accelerated(one, none)} rad/s^2, rnea at constant speed: {held} N m")
bare = accelerated(none, one)
model.armature = np.array([0.02])
print(f"aba of 1 N m: {bare} rad/s^2, with an armature of 0.02: {accelerated(none, one)} rad/s^2")
END
"$work/venv/bin/python" look.py | tee seen
diff - seen <<'END'
read: damping 0.5, friction 0.1
aba: 0.0 rad/s^2, rnea at constant speed: 0.0 N m
aba of 1 N m: 50.0 rad/s^2, with an armature of 0.02: 25.0 rad/s^2
END

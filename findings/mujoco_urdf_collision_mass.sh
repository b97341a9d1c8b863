#!/usr/bin/env bash
# MuJoCo gives a URDF link without an inertial the mass of water in its collision shapes.
#
# Version: mujoco 4.0.0 (PyPI), run on 2026-12-01.
# Behaviour: a link of a URDF that has no <inertial> has no mass, by the definition of the format.
# MuJoCo fills its collision shapes with 1000 kg/m^3, also where the link is fixed to one that has
# an inertial. A published quadruped of 52.1 kg becomes one of 81.5 kg so. There is no message.
# Output seen, for a leg of 1 kg and a bumper of 0.1 m x 0.1 m x 0.2 m that is fixed to it:
#   leg and bumper: 3.0 kg, with density 0 before compiling: 1.0 kg
# Way out: read the file with MjSpec and set density 0 of all shapes before compiling.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "mujoco==4.0.0"
cd "$work"
cat >look.py <<'END'
import mujoco

urdf = """<robot name="x">
  <link name="stand"/>
  <link name="leg">
    <inertial>
      <mass value="1"/>
      <inertia ixx="0.01" iyy="0.01" izz="0.01" ixy="0" ixz="0" iyz="0"/>
    </inertial>
  </link>
  <link name="bumper">
    <collision><geometry><box size="0.1 0.1 0.2"/></geometry></collision>
  </link>
  <joint name="hip" type="revolute">
    <parent link="stand"/><child link="leg"/><axis xyz="0 1 0"/>
    <limit lower="-1" upper="1" effort="9" velocity="9"/>
  </joint>
  <joint name="mount" type="fixed"><parent link="leg"/><child link="bumper"/></joint>
</robot>"""
spec = mujoco.MjSpec.from_string(urdf)
filled = spec.compile().body_mass.sum()
spec = mujoco.MjSpec.from_string(urdf)
for shape in spec.geoms:
    shape.density = 0.0
empty = spec.compile().body_mass.sum()
print(f"leg and bumper: {filled:.1f} kg, with density 0 before compiling: {empty:.1f} kg")
END
"$work/venv/bin/python" look.py | tee seen
diff - seen <<'END'
leg and bumper: 3.0 kg, with density 0 before compiling: 1.0 kg
END

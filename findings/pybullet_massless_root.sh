#!/usr/bin/env bash
# PyBullet has no place for the massless root link that ROS asks for.
#
# Version: pybullet 3.2.7 (PyPI), run on 2026-12-01.
# Behaviour: KDL (ROS) leaves the inertia of a root link out and says so: "add an extra dummy link".
# With such a link, to which the trunk of 1.3 kg is fixed, and the defaults of loadURDF, among them
# useFixedBase=False, the robot
# - weighs 1 kg more, with a moment of inertia of 1 kg m^2, if the link has no inertial (a warning);
# - hangs in the air if the link has an inertial of zero mass (no warning). URDF_MERGE_FIXED_LINKS
#   does not help: it still hangs, and the mass of the trunk is gone, too.
# Output seen: kg in all, and m fallen in the first half second under gravity
#   trunk is root 1.3 1.2
#   no inertial 2.3 1.2
#   zero mass 1.3 0.0
#   zero mass, merged 0.0 0.0
# Way out: the link with the mass as root, whatever KDL says.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "pybullet==3.2.7" "numpy==2.4.6"
cd "$work"
cat >look.py <<'END'
import sys

import pybullet

HEAVY = """<inertial><mass value="{mass}"/>
<inertia ixx="{i}" ixy="0" ixz="0" iyy="{i}" iyz="0" izz="{i}"/></inertial>"""
TRUNK = f'<link name="trunk">{HEAVY.format(mass=1.3, i=0.01)}</link>'
FIXED = """<joint name="floating_base" type="fixed">
<parent link="base"/><child link="trunk"/></joint>"""
NOTHING = HEAVY.format(mass=0, i=0)
MODELS = {
    "trunk is root": (TRUNK, 0),
    "no inertial": (f'<link name="base"/>{TRUNK}{FIXED}', 0),
    "zero mass": (f'<link name="base">{NOTHING}</link>{TRUNK}{FIXED}', 0),
}
MODELS["zero mass, merged"] = (MODELS["zero mass"][0], pybullet.URDF_MERGE_FIXED_LINKS)

pybullet.connect(pybullet.DIRECT)
seen = {}
for what, (links, flags) in MODELS.items():
    pybullet.resetSimulation()
    pybullet.setGravity(0, 0, -9.81)
    path = f"{what}.urdf"  # files are cached by name
    with open(path, "w") as file:
        file.write(f'<robot name="x">{links}</robot>')
    robot = pybullet.loadURDF(path, [0, 0, 5], useFixedBase=False, flags=flags)
    parts = range(-1, pybullet.getNumJoints(robot))
    mass = sum(pybullet.getDynamicsInfo(robot, part)[0] for part in parts)
    for _ in range(120):
        pybullet.stepSimulation()
    fallen = 5 - pybullet.getBasePositionAndOrientation(robot)[0][2]
    seen[what] = (round(mass, 6), round(fallen, 1))
print()
for what, (mass, fallen) in seen.items():
    print(what, mass, fallen)
expected = {
    "trunk is root": (1.3, 1.2),
    "no inertial": (2.3, 1.2),
    "zero mass": (1.3, 0.0),
    "zero mass, merged": (0.0, 0.0),
}
sys.exit(0 if seen == expected else 1)
END
"$work/venv/bin/python" look.py

#!/usr/bin/env bash
# urchin puts the joints of a robot in another order on another processor.
#
# Version: urchin 0.0.30 and numpy 2.4.6 (PyPI), run on 2026-12-01 on x86-64 with AVX2, which it needs.
# Behaviour: actuated_joints, and with it the meaning of a configuration given as an array, is
# sorted by depth with numpy.argsort, which keeps no order among equals. How it leaves them depends
# on the instructions that numpy finds: legs that stand in the file as a, b, c, d change places
# from one depth to the next, and on a processor without AVX2, for which numpy is told here to take
# this one, they do not.
# Output seen:
#   with AVX2    a1 b1 c1 d1 c2 b2 d2 a2 b3 a3 c3 d3
#   without AVX2 a1 b1 c1 d1 a2 b2 c2 d2 a3 b3 c3 d3
# Way out: configurations as a dict by name.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "urchin==0.0.30" "numpy==2.4.6"
cd "$work"
cat >look.py <<'END'
from urchin import URDF

links, joints = ['<link name="trunk"/>'], []
for leg in "abcd":
    parent = "trunk"
    for depth in "123":
        name = leg + depth
        links.append(f'<link name="{name}_link"/>')
        joints.append(
            f'<joint name="{name}" type="revolute"><parent link="{parent}"/>'
            f'<child link="{name}_link"/><axis xyz="0 1 0"/>'
            '<limit lower="-1" upper="1" effort="1" velocity="1"/></joint>'
        )
        parent = f"{name}_link"
with open("robot.urdf", "w") as file:
    file.write(f'<robot name="x">{"".join(links + joints)}</robot>')
print(*URDF.load("robot.urdf").actuated_joint_names)
END
with=$("$work/venv/bin/python" look.py)
without=$(NPY_DISABLE_CPU_FEATURES="X86_V3 X86_V4 AVX512_ICL AVX512_SPR" \
    "$work/venv/bin/python" -W ignore look.py)
echo "with AVX2    $with"
echo "without AVX2 $without"
[ "$with" = "a1 b1 c1 d1 c2 b2 d2 a2 b3 a3 c3 d3" ] &&
    [ "$without" = "a1 b1 c1 d1 a2 b2 c2 d2 a3 b3 c3 d3" ]

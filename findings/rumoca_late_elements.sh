#!/usr/bin/env bash
# rumoca delays a sampled signal by one sample if it enters an array element by element.
#
# Version: rumoca 0.10.2 (PyPI), run on 2026-12-01.
# Behaviour: two counters go up by 1 at every sample, and a block of the same sample time reads the
# first of them. By the rules of Modelica it reads the new value, however the equation is
# written. That holds if the input is set as a whole array; if its elements are connected or set
# one by one, the block reads the value of the sample before. Nothing is said, and a control loop
# gets one more sample of delay.
# Output seen: how the input is set, last value of the counter, last value that was read
#   whole 6.0 6.0
#   elements 6.0 5.0
#   connections 6.0 5.0
# Way out: equations between whole arrays.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "rumoca==0.10.2"
cd "$work"
cat >look.py <<'END'
import sys

import rumoca

BLOCKS = """
block Counter
  output Real y(start=0.0, fixed=true);
equation
  when sample(0.0, 0.1) then
    y = pre(y) + 1.0;
  end when;
end Counter;

block First
  input Real u[2];
  output Real y(start=0.0, fixed=true);
equation
  when sample(0.0, 0.1) then
    y = u[1];
  end when;
end First;

model Test
  Counter a;
  Counter b;
  First first;
equation
"""
WAYS = {
    "whole": "first.u = {a.y, b.y};",
    "elements": "first.u[1] = a.y; first.u[2] = b.y;",
    "connections": "connect(a.y, first.u[1]); connect(b.y, first.u[2]);",
}
seen = {}
for way, equations in WAYS.items():
    source = f"{BLOCKS}  {equations}\nend Test;\n"
    model = rumoca.Session().loads(source, model="Test")
    config = rumoca.SimConfig(solver="rk-like", dt=0.1)
    result = model.simulate(t=(0.0, 0.55), config=config)
    seen[way] = (float(result["a.y"][-1]), float(result["first.y"][-1]))
    print(way, *seen[way])
sys.exit(0 if list(seen.values()) == [(6.0, 6.0), (6.0, 5.0), (6.0, 5.0)] else 1)
END
"$work/venv/bin/python" look.py

#!/usr/bin/env bash
# fmpy.ssp feeds an input without a connection from the connection of the one listed before it.
#
# Version: FMPy 0.3.32 and pythonfmu 0.7.0 (PyPI), run on 2026-12-01.
# Behaviour: an SSP may list a connector that nothing is connected to; its variable then keeps the
# start value. fmpy.ssp gets its connections by going through the inputs, and an input for which
# it finds none takes over what was found for the one before: in the first step it is 0, then the
# value of a signal that has nothing to do with it. Nothing is said.
# Output seen: input, its start value, its value in the first and in the last step
#   connected 1.0 0.0 7.0
#   free 3.0 0.0 7.0
#   unlisted 5.0 5.0 5.0
# Way out: list no connector that has no connection.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "fmpy==0.3.32" "pythonfmu==0.7.0"
cd "$work"
cat >source.py <<'END'
from pythonfmu import Fmi2Causality, Fmi2Slave, Real


class Source(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.y = 7.0
        self.register_variable(Real("y", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        return True
END
cat >sink.py <<'END'
import json

from pythonfmu import Fmi2Causality, Fmi2Slave, Real

NAMES = ("connected", "free", "unlisted")


class Sink(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.connected, self.free, self.unlisted = 1.0, 3.0, 5.0
        for name in NAMES:
            self.register_variable(Real(name, causality=Fmi2Causality.input))

    def do_step(self, current_time, step_size):
        with open("steps.txt", "a") as file:
            print(json.dumps({name: getattr(self, name) for name in NAMES}), file=file)
        return True
END
for name in source sink; do
    "$work/venv/bin/pythonfmu" build -f "$name.py" >/dev/null
done
cat >look.py <<'END'
import json
import sys
import zipfile
from pathlib import Path

from fmpy import read_model_description
from fmpy.ssp.simulation import simulate_ssp

SSD = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription name="x" version="1.0"
  xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
  xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="x">
    <ssd:Elements>
      <ssd:Component name="source" source="resources/Source.fmu"><ssd:Connectors>
        <ssd:Connector name="y" kind="output"><ssc:Real/></ssd:Connector>
      </ssd:Connectors></ssd:Component>
      <ssd:Component name="sink" source="resources/Sink.fmu"><ssd:Connectors>
        <ssd:Connector name="connected" kind="input"><ssc:Real/></ssd:Connector>
        <ssd:Connector name="free" kind="input"><ssc:Real/></ssd:Connector>
      </ssd:Connectors></ssd:Component>
    </ssd:Elements>
    <ssd:Connections>
      <ssd:Connection startElement="source" startConnector="y"
        endElement="sink" endConnector="connected"/>
    </ssd:Connections>
  </ssd:System>
</ssd:SystemStructureDescription>"""

with zipfile.ZipFile("x.ssp", "w") as archive:
    archive.writestr("SystemStructure.ssd", SSD)
    for name in ("Source", "Sink"):
        archive.write(f"{name}.fmu", f"resources/{name}.fmu")
simulate_ssp("x.ssp", stop_time=1.0, step_size=0.1)
steps = [json.loads(line) for line in Path("steps.txt").read_text().splitlines()]
variables = {v.name: v for v in read_model_description("Sink.fmu").modelVariables}
seen = [
    (name, float(variables[name].start), steps[0][name], steps[-1][name]) for name in steps[0]
]
for line in seen:
    print(*line)
expected = [
    ("connected", 1.0, 0.0, 7.0),
    ("free", 3.0, 0.0, 7.0),
    ("unlisted", 5.0, 5.0, 5.0),
]
sys.exit(0 if seen == expected else 1)
END
"$work/venv/bin/python" look.py

#!/usr/bin/env bash
# fmpy.ssp sets a Boolean parameter to true when the parameter set says false.
#
# Version: FMPy 0.3.32 and pythonfmu 0.7.0 (PyPI), run on 2026-12-01.
# Behaviour: read_ssv keeps the values of a parameter set (SSV) as text. Numbers are converted when
# they are set in the FMU; a Boolean is compared with 0, and any text differs from it. So "false",
# and "0" as well, switch on what they should switch off, without a word.
# Output seen: value in the file, value in the FMU
#   true True
#   false True
#   0 True
#   left out False
# Way out: leave a Boolean that is false by default out of the parameter set.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "fmpy==0.3.32" "pythonfmu==0.7.0"
cd "$work"
cat >switch.py <<'END'
from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Fmi2Variability


class Switch(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.on = self.seen = False
        fixed = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.fixed}
        self.register_variable(Boolean("on", **fixed))
        self.register_variable(Boolean("seen", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.seen = self.on
        return True
END
"$work/venv/bin/pythonfmu" build -f switch.py >/dev/null
cat >look.py <<'END'
import sys
import zipfile
from pathlib import Path

from fmpy.ssp.simulation import simulate_ssp
from fmpy.ssp.ssd import read_ssv

SSD = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription name="x" version="1.0"
  xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription"
  xmlns:ssc="http://ssp-standard.org/SSP1/SystemStructureCommon">
  <ssd:System name="x"><ssd:Elements>
    <ssd:Component name="switch" source="resources/Switch.fmu"><ssd:Connectors>
      <ssd:Connector name="seen" kind="output"><ssc:Boolean/></ssd:Connector>
    </ssd:Connectors></ssd:Component>
  </ssd:Elements></ssd:System>
</ssd:SystemStructureDescription>"""
SSV = """<?xml version="1.0" encoding="UTF-8"?>
<ssv:ParameterSet name="own" version="1.0"
  xmlns:ssv="http://ssp-standard.org/SSP1/SystemStructureParameterValues">
  <ssv:Parameters>
    <ssv:Parameter name="switch.on"><ssv:Boolean value="{}"/></ssv:Parameter>
  </ssv:Parameters>
</ssv:ParameterSet>"""

with zipfile.ZipFile("x.ssp", "w") as archive:
    archive.writestr("SystemStructure.ssd", SSD)
    archive.write("Switch.fmu", "resources/Switch.fmu")
seen = {}
for value in ("true", "false", "0", "left out"):
    Path("own.ssv").write_text(SSV.format(value))
    parameters = None if value == "left out" else read_ssv("own.ssv")
    result = simulate_ssp("x.ssp", stop_time=1.0, step_size=0.1, parameter_set=parameters)
    seen[value] = bool(result["switch.seen"][-1])
    print(value, seen[value])
sys.exit(0 if list(seen.values()) == [True, True, True, False] else 1)
END
"$work/venv/bin/python" look.py

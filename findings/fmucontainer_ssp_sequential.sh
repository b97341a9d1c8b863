#!/usr/bin/env bash
# fmucontainer does not pass -sequential on to a system that is given as SSP.
#
# Version: fmu-manipulation-toolbox 2.0 (PyPI), run on 2026-12-01.
# Behaviour: an assembly is read with default_sequential=True, which `fmucontainer -sequential` sets
# too. Read from a description in JSON its FMUs step one after the other, as asked for. Read from an
# SSP they step side by side, without a word: outputs arrive a step late.
# Output seen: {'ssp': False, 'json': True}
# Way out: a description in JSON with "sequential": true.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "fmu-manipulation-toolbox==2.0"
cd "$work"
cat >look.py <<'END'
import json
import sys
import zipfile
from pathlib import Path

from fmu_manipulation_toolbox.assembly import Assembly

SSD = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription name="x" version="1.0"
  xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription">
  <ssd:System name="x">
    <ssd:Elements><ssd:Component name="a" source="resources/a.fmu"/></ssd:Elements>
  </ssd:System>
</ssd:SystemStructureDescription>"""

with zipfile.ZipFile("x.ssp", "w") as archive:
    archive.writestr("SystemStructure.ssd", SSD)
    archive.writestr("resources/a.fmu", b"")  # FMUs are not opened before a container is built
Path("x.json").write_text(json.dumps({"name": "x.fmu", "fmu": ["a.fmu"]}))
seen = {
    kind: Assembly(f"x.{kind}", fmu_directory=Path(), default_sequential=True).root.sequential
    for kind in ("ssp", "json")
}
print(seen)
sys.exit(0 if seen == {"ssp": False, "json": True} else 1)
END
"$work/venv/bin/python" look.py

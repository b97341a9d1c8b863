#!/usr/bin/env bash
# pyssp-standard rewrites an SSP that is only looked into.
#
# Version: pyssp-standard 0.9.1 (PyPI), run on 2026-12-01.
# Behaviour: SSP(path) opens for appending unless mode="r" is given, and looking at
# system_structure counts as a change. At the end of the with statement the archive is packed anew:
# comments are gone and the time of day is in it, so that a checksum or signature of the file does
# not hold any more.
# Output seen: mode, whether the file is the same afterwards, whether its comment is left
#   none False False
#   r True True
# Way out: SSP(path, mode="r").
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "pyssp-standard==0.9.1"
cd "$work"
cat >look.py <<'END'
import sys
import zipfile
from pathlib import Path

from pyssp_standard.ssp import SSP

SSD = """<?xml version="1.0" encoding="UTF-8"?>
<ssd:SystemStructureDescription name="x" version="1.0"
  xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription">
  <!-- released by the owner of the system -->
  <ssd:System name="x"/>
</ssd:SystemStructureDescription>"""

seen = {}
for mode in ("none", "r"):
    path = Path(f"{mode}.ssp")
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("SystemStructure.ssd", SSD)
    before = path.read_bytes()
    with SSP(path, **({} if mode == "none" else {"mode": mode})) as ssp:
        with ssp.system_structure as structure:
            assert structure.name == "x"
    text = zipfile.ZipFile(path).read("SystemStructure.ssd").decode()
    seen[mode] = (path.read_bytes() == before, "released" in text)
    print(mode, *seen[mode])
sys.exit(0 if seen == {"none": (False, False), "r": (True, True)} else 1)
END
"$work/venv/bin/python" look.py

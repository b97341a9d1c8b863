"""fmucontainer drops -sequential for an SSP.

Tool: fmu-manipulation-toolbox 2.0 (PyPI), run on 2026-12-01.
Done: an SSP is read with ``default_sequential=True``, which ``fmucontainer -sequential`` sets too.
Expected: FMUs that step one after the other, as with a description in JSON.
Seen: FMUs that step side by side, without a word: outputs arrive a step late.
Way out: ``assembly.root.sequential = True``, or a JSON description with ``"sequential": true``.

``python findings/fmucontainer_ssp_sequential.py`` prints what it sees; exit code 0 while it is so.
"""

from __future__ import annotations

import json
import sys
import tempfile
import zipfile
from pathlib import Path

from fmu_manipulation_toolbox.assembly import Assembly

SSD = """<ssd:SystemStructureDescription name="x" version="1.0"
  xmlns:ssd="http://ssp-standard.org/SSP1/SystemStructureDescription">
<ssd:System name="x"><ssd:Elements>
<ssd:Component name="a" source="resources/a.fmu"/>
</ssd:Elements></ssd:System></ssd:SystemStructureDescription>"""

with tempfile.TemporaryDirectory() as name:
    folder = Path(name)
    with zipfile.ZipFile(folder / "x.ssp", "w") as archive:
        archive.writestr("SystemStructure.ssd", SSD)
        archive.writestr("resources/a.fmu", b"")  # nothing looks into it before it is built
    (folder / "x.json").write_text(json.dumps({"name": "x.fmu", "fmu": ["a.fmu"]}))
    seen = {
        kind: Assembly(f"x.{kind}", fmu_directory=folder, default_sequential=True).root.sequential
        for kind in ("ssp", "json")
    }
print(f"sequential asked for; got: {seen}")
sys.exit(0 if seen == {"ssp": False, "json": True} else 1)

"""``apnc info``: what an FMU is and what it connects to."""

from __future__ import annotations

import zipfile
from pathlib import Path

import fmpy
from rich.table import Table

import apnc_core
from apnc.cli.console import out
from apnc.loop.fmu_controller import check_fmu


def show_info(path: Path) -> None:
    """Print the FMU's identity, platforms, inputs and outputs.

    Raises:
        FmuError: no FMU.
    """
    description = check_fmu(path)
    with zipfile.ZipFile(path) as archive:
        platforms = sorted(
            {n.split("/")[1] for n in archive.namelist() if n.startswith("binaries/")}
        )
    facts = Table(show_header=False, box=None, padding=(0, 2))
    for label, value in (
        ("apnc", apnc_core.__version__),
        ("FMU", str(path)),
        ("model", f"{description.modelName}, FMI {description.fmiVersion} co-simulation"),
        ("guid", description.guid),
        ("platforms", ", ".join(platforms) or "sources only"),
        ("fmpy", fmpy.__version__),
    ):
        facts.add_row(label, value)
    out.print(facts, highlight=False)
    table = Table(box=None, padding=(0, 2))
    for heading in ("name", "causality", "start", "unit", "description"):
        table.add_column(heading, no_wrap=heading == "name")
    for v in description.modelVariables:
        if v.causality in ("input", "output", "parameter"):
            table.add_row(v.name, v.causality, v.start or "", v.unit or "", v.description or "")
    out.print(table, highlight=False, markup=False)

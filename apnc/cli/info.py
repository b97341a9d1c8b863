"""``apnc info``: version, platforms and interface of an FMU."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Annotated

import typer

from apnc.cli.console import show_table, status


def info(
    fmu: Annotated[Path | None, typer.Argument(help="FMU file. Default: the built one.")] = None,
) -> None:
    """Show version, platforms and interface of an FMU for co-simulation, FMI 2.0 or 3.0."""
    with status("reading"):
        import fmpy

        from apnc.loop.fmu_controller import describe_fmu
        from apnc_core import __version__
        from build_fmu.build import host_fmu

        path = fmu or host_fmu()
        model = describe_fmu(path)
    with zipfile.ZipFile(path) as archive:
        folders = {n.split("/")[1] for n in archive.namelist() if n.startswith("binaries/")}
    show_table(
        [
            ("apnc", __version__),
            ("FMU", str(path)),
            ("model", f"{model.modelName}, FMI {model.fmiVersion} co-simulation"),
            ("guid", model.guid),
            ("platforms", ", ".join(sorted(folders)) or "sources only"),
            ("fmpy", fmpy.__version__),
        ]
    )
    headings = ("name", "causality", "start", "unit", "description")
    rows = [
        (v.name + "".join(f"[{n}]" for n in v.shape), v.causality, v.start, v.unit, v.description)
        for v in model.modelVariables
        if v.causality in ("input", "output", "parameter")
    ]
    show_table(([cell or "" for cell in row] for row in rows), *headings)

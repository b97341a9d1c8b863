"""Build a system as an SSP archive, and as a folder for tools that read other formats."""

from __future__ import annotations

import io
import zipfile
from collections.abc import Container, Mapping
from pathlib import Path
from typing import Final

from lxml import etree

from apnc.loop.experiment import Experiment
from apnc.system.container import CONTAINER_FILE, container
from apnc.system.header import HEADER_FILE, header
from apnc.system.osp import OSP_FILE, osp
from apnc.system.plant_fmu import plant_fmu
from apnc.system.ssp import SSD_FILE, ssd, ssv, ssv_file
from apnc.system.structure import RESOURCES, plant_build, structure_of
from apnc_core.settings import Setting
from build_fmu.build import cached_fmu
from build_fmu.options import BuildOptions
from build_fmu.package import zip_fmu
from build_fmu.platforms import host_platform
from build_fmu.writing import write_atomically

_BESIDE: Final = (OSP_FILE, CONTAINER_FILE, HEADER_FILE)
"""Files of the folder that the archive does not hold."""


def system_files(
    experiment: Experiment,
    naming: str = "structured",
    platforms: tuple[str, ...] = (),
    numbers: Mapping[str, Setting] | None = None,
) -> dict[str, bytes]:
    """Every file of the system by its path in the folder.

    Args:
        experiment: what walks, see ``structure_of``.
        naming: of the variables, ``structured`` or ``flat``.
        platforms: binaries of both FMUs; this machine's if empty.
        numbers: of the robot, see ``structure_of``.

    Raises:
        ValueError: an experiment that a system cannot hold, or FMUs that cannot be built.
        OSError: the cache folder cannot be written.
    """
    structure = structure_of(experiment, naming, numbers)
    machines = platforms or (host_platform(),)
    # enumerations as numbers: libcosim knows no enumerations
    options = BuildOptions(
        legs=len(structure.legs), naming=naming, platforms=machines, enumerations="integer"
    )
    controller = cached_fmu(options).read_bytes()
    plant = plant_fmu(plant_build(experiment, naming, machines)).read_bytes()
    fmus = dict(zip(structure.components, (controller, plant), strict=True))
    return {
        SSD_FILE: ssd(structure),
        **{ssv_file(part): ssv(structure, part) for part in fmus},
        **{part.source: content for part, content in fmus.items()},
        OSP_FILE: osp(structure),
        CONTAINER_FILE: container(structure),
        HEADER_FILE: header(structure, {part.name: _guid(fmu) for part, fmu in fmus.items()}),
    }


def _guid(fmu: bytes) -> str:
    with zipfile.ZipFile(io.BytesIO(fmu)) as archive:
        return str(etree.fromstring(archive.read("modelDescription.xml")).get("guid"))


def build_system(
    output: Path,
    experiment: Experiment,
    naming: str = "structured",
    platforms: tuple[str, ...] = (),
    numbers: Mapping[str, Setting] | None = None,
) -> Path:
    """Write ``output`` (an SSP archive) and, beside it, the folder of the same name without suffix.

    Args:
        output: file to write, with the suffix ``.ssp``.
        experiment, naming, platforms, numbers: see ``system_files``.

    Returns:
        The folder: the archive unpacked, OspSystemStructure.xml, container.json and system.h.

    Raises:
        ValueError: another suffix, or as ``system_files``.
        OSError: a file cannot be written.
    """
    if output.suffix != ".ssp":
        raise ValueError(f"output {output} does not end in .ssp")
    files = system_files(experiment, naming, platforms, numbers)
    folder = output.with_suffix("")
    _remove_older_fmus(folder, files)
    for name, content in files.items():
        write_atomically(folder / name, content)
    write_atomically(output, zip_fmu({n: c for n, c in files.items() if n not in _BESIDE}))
    return folder


def _remove_older_fmus(folder: Path, files: Container[str]) -> None:
    """Remove the FMUs of an older system in the folder that the new one does not replace."""
    try:
        older = etree.parse(folder / SSD_FILE)
    except (OSError, etree.XMLSyntaxError):  # no system, or what a killed build has left
        return
    named = {part.get("source") for part in older.iter("{*}Component")}
    for fmu in (folder / RESOURCES).glob("*.fmu"):
        name = f"{RESOURCES}/{fmu.name}"
        if name in named and name not in files:
            fmu.unlink()

"""Build a system: an SSP archive, and beside it the same as a folder that OSP can read."""

from __future__ import annotations

from pathlib import Path

from apnc.loop.experiment import Experiment
from apnc.system.osp import OSP_FILE, osp
from apnc.system.plant_fmu import plant_fmu
from apnc.system.ssp import SSD_FILE, ssd, ssv, ssv_file
from apnc.system.structure import plant_build, structure_of
from build_fmu.build import cached_fmu
from build_fmu.cache import write_atomically
from build_fmu.options import BuildOptions
from build_fmu.package import zip_fmu
from build_fmu.platforms import host_platform


def system_files(
    experiment: Experiment, naming: str = "structured", platforms: tuple[str, ...] = ()
) -> dict[str, bytes]:
    """Every file of the system by its path in the archive, and OspSystemStructure.xml.

    Args:
        experiment: what walks, see ``structure_of``.
        naming: of the variables, ``structured`` or ``flat``.
        platforms: binaries of both FMUs; this machine's if empty.

    Raises:
        ValueError: an experiment that a system cannot hold, or FMUs that cannot be built.
        OSError: the cache folder cannot be written.
    """
    structure = structure_of(experiment, naming)
    controller, plant = structure.components
    machines = platforms or (host_platform(),)
    legs = len(experiment.description.legs)
    options = BuildOptions(legs=legs, naming=naming, platforms=machines)
    return {
        SSD_FILE: ssd(structure),
        **{ssv_file(part): ssv(structure, part) for part in structure.components},
        OSP_FILE: osp(structure),
        controller.source: cached_fmu(options).read_bytes(),
        plant.source: plant_fmu(plant_build(experiment, naming, machines)).read_bytes(),
    }


def build_system(
    output: Path,
    experiment: Experiment,
    naming: str = "structured",
    platforms: tuple[str, ...] = (),
) -> Path:
    """Write ``output`` (an SSP archive) and, beside it, the folder of the same name without suffix.

    Args:
        output: file to write, with the suffix ``.ssp``.
        experiment, naming, platforms: see ``system_files``.

    Returns:
        The folder: the archive unpacked, and OspSystemStructure.xml.

    Raises:
        ValueError: another suffix, or as ``system_files``.
        OSError: a file cannot be written.
    """
    if output.suffix != ".ssp":
        raise ValueError(f"output {output} does not end in .ssp")
    files = system_files(experiment, naming, platforms)
    folder = output.with_suffix("")
    for name, content in files.items():
        write_atomically(folder / name, content)
    write_atomically(output, zip_fmu({n: c for n, c in files.items() if n != OSP_FILE}))
    return folder

"""Build the plant FMU: a robot in Exudyn as an FMU 2.0 for co-simulation, by PythonFMU."""

from __future__ import annotations

import contextlib
import hashlib
import importlib.util
import io
import re
import sys
import tempfile
import zipfile
from pathlib import Path
from typing import Final

from apnc_core import __version__
from apnc_plant.robot import ROBOTS, load_robot
from build_fmu.package import zip_fmu

MODEL_SUFFIX: Final = "Plant"

_SCRIPT: Final = '''\
"""{description}."""

try:
    from apnc.system.plant_slave import PlantSlave, hold
except ImportError as error:
    import sys

    raise ImportError(
        "{model}.fmu needs the package apnc {version} in the Python that runs it, "
        f"{{sys.executable}} (version {{sys.version.split()[0]}}): {{error}}"
    ) from error

hold(globals())


class {model}(PlantSlave):
    """The robot of robot.toml."""

    NAMING = "{naming}"
    BUILT_BY = "{version}"
    GUID = "{guid}"
'''


class PlantFmuError(ValueError):
    """A plant FMU that cannot be built, in one line."""


def plant_model(robot: str) -> str:
    """Name of the model: ``LilibotPlant`` for robot ``lilibot``.

    Args:
        robot: name of a shipped robot, or its file.

    Raises:
        RobotDescriptionError: no such robot, or a file with mistakes.
    """
    words = re.findall(r"[A-Za-z0-9]+", load_robot(robot).name)
    name = "".join(word[0].upper() + word[1:] for word in words)
    return (name if name[:1].isalpha() else f"Robot{name}") + MODEL_SUFFIX


def plant_fmu(robot: str = "lilibot", naming: str = "structured") -> bytes:
    """The plant FMU as bytes; the same arguments give the same bytes.

    Args:
        robot: name of a shipped robot, or its file; it travels in the FMU.
        naming: ``structured`` (``leg[1].grf``) or ``flat`` (``leg1_grf``).

    Pitfall: it holds no simulator. Where it runs, this package must be importable.

    Raises:
        PlantFmuError: PythonFMU is missing.
        ValueError: another naming, or a robot that cannot be read.
    """
    if importlib.util.find_spec("pythonfmu") is None:
        raise PlantFmuError('PythonFMU is missing: pip install "apnc[system]"')
    from pythonfmu import FmuBuilder  # noqa: PLC0415  # an extra

    from apnc.system.plant_variables import plant_variables  # noqa: PLC0415

    description, model = load_robot(robot), plant_model(robot)
    plant_variables(len(description.legs), naming)  # refuses another naming
    shipped = ROBOTS / f"{robot}.toml"
    text = (shipped if shipped.is_file() else Path(robot)).read_bytes()
    guid = hashlib.sha256(f"{__version__} {naming} {model}\n".encode() + text).hexdigest()[:32]
    script = _SCRIPT.format(
        description=f"Robot '{description.name}' in Exudyn",
        model=model, version=__version__, naming=naming, guid=guid,
    )  # fmt: skip
    # one module per build: a process may hold several plant FMUs
    module = f"plant_{guid[:12]}"
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / f"{module}.py").write_text(script, encoding="utf-8")
        (folder / "robot.toml").write_bytes(text)
        path = list(sys.path)
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                FmuBuilder.build_FMU(
                    folder / f"{module}.py", folder / "out.fmu", [folder / "robot.toml"]
                )
        finally:
            sys.path[:] = path
            sys.modules.pop(module, None)
        with zipfile.ZipFile(folder / "out.fmu") as archive:
            return zip_fmu({entry: archive.read(entry) for entry in archive.namelist()})

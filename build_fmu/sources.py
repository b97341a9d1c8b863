"""The C sources of an FMU, compiled and shipped in one folder, and their configuration."""

from __future__ import annotations

import hashlib
import importlib.resources
import itertools
from collections.abc import Iterable
from typing import Final

from apnc_core.schema import Shape, Value
from build_fmu.options import BuildOptions

_FMI_HEADERS: Final = {
    2: ("fmi2Functions.h", "fmi2FunctionTypes.h", "fmi2TypesPlatform.h"),
    3: ("fmi3Functions.h", "fmi3FunctionTypes.h", "fmi3PlatformTypes.h"),
}


CONTROLLER: Final = "controller"
PLANT: Final = "plant"
"""The models that have an FMU."""

_FOLDERS: Final = {CONTROLLER: ("core", "fmi"), PLANT: ("plant", "fmi")}
_SHARED: Final = ("apnc_names.h", "apnc_real.h", "apnc_variable.h")
"""Headers of the core that the FMI functions of every model need."""

_CONFIGURED: Final = ("apnc_config.h", "plant_config.h", "robot_config.h")
"""Headers that every build writes."""


def collect(fmi: int = 2, model: str = CONTROLLER) -> dict[str, bytes]:
    """C files and headers by name, without the configuration headers.

    Args:
        fmi: version of the standard, 2 or 3.
        model: ``controller`` or ``plant``.

    The headers of the standard come from the ``fmpy`` package.
    """
    files = own_files(fmi, model)
    headers = importlib.resources.files("fmpy").joinpath("c-code")
    files |= {name: headers.joinpath(name).read_bytes() for name in _FMI_HEADERS[fmi]}
    return dict(sorted(files.items()))


def own_files(fmi: int = 2, model: str = CONTROLLER) -> dict[str, bytes]:
    """As ``collect``, without the headers of the standard."""
    root = importlib.resources.files("fmu_src")
    entries = [e for folder in _FOLDERS[model] for e in root.joinpath(folder).iterdir()]
    entries += [root.joinpath("core").joinpath(name) for name in _SHARED]
    files = {e.name: e.read_bytes() for e in entries if _is_source(e.name, fmi, model)}
    return dict(sorted(files.items()))


def _is_source(name: str, fmi: int, model: str) -> bool:
    if name in _CONFIGURED or not name.endswith((".c", ".h")):
        return False
    if name.startswith(tuple(f"{other}_" for other in {CONTROLLER, PLANT} - {model})):
        return False
    # an FMU has one robot
    if model == PLANT and name.startswith("robots"):
        return False
    # files named fmi2... and fmi3... belong to that version of the standard only
    return not name.startswith("fmi") or name.startswith(f"fmi{fmi}")


def c_files(files: dict[str, bytes]) -> list[str]:
    """Names of the files to compile."""
    return [name for name in files if name.endswith(".c")]


def config_header(options: BuildOptions, guid: str) -> bytes:
    """``apnc_config.h``: the build-time choices of a controller.

    Args:
        options: what is built.
        guid: of the FMU; empty for the core alone.
    """
    own = _own_defaults(options)
    return shell_config(options.legs, options.naming, guid, own, reals=options.reals)


def shell_config(
    legs: int, naming: str, guid: str, more: Iterable[str] = (), *, reals: bool = False
) -> bytes:
    """``apnc_config.h``: the build-time choices of any model.

    Args:
        legs: number of legs.
        naming: ``structured`` or ``flat``.
        guid: of the FMU; empty for a core alone.
        more: lines of the model's own.
        reals: whether every variable is shown as a Real.
    """
    lines = [
        "/* Build-time choices, written by the build. */",
        "#ifndef APNC_CONFIG_H",
        "#define APNC_CONFIG_H",
        "",
        f"#define APNC_LEGS {legs}",
        *(["#define APNC_NAMING_FLAT"] if naming == "flat" else []),
        *(["#define APNC_REALS"] if reals else []),
        f'#define APNC_GUID "{guid}"',
        # static libraries of two builds then share no name; the core alone is named by its legs
        *([f"#define APNC_PREFIX {prefix_of(guid)}"] if guid else []),
        *more,
        "",
        "#endif",
        "",
    ]
    return "\n".join(lines).encode()


def prefix_of(guid: str) -> str:
    """Prefix of all external names of a build."""
    return f"apnc_{guid[1:9]}_"


def _own_defaults(options: BuildOptions) -> list[str]:
    """Macro that sets the start values which differ from the table; nothing if none does."""
    lines = [
        f"    (p)->{v.name}{'' if v.shape is Shape.scalar else f'[{k}]'} = {_c_number(value)};"
        for v in options.changed()
        for k, value in enumerate(options.start(v))
    ]
    return [" \\\n".join(["#define APNC_DEFAULTS(p)", *lines])] if lines else []


def _c_number(value: Value) -> str:
    return repr(value) if isinstance(value, float) else str(int(value))


def guid_of(*parts: bytes) -> str:
    """A guid that changes with any of ``parts``, in the form of the standard's examples."""
    digest = hashlib.sha256(b"\0".join(parts)).hexdigest()
    cuts = (0, 8, 12, 16, 20, 32)
    return "{" + "-".join(digest[a:b] for a, b in itertools.pairwise(cuts)) + "}"

"""What was run, in full, so that the result in a summary or report can be made again."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from importlib.metadata import version
from typing import Any, Final

import apnc_core
from apnc.loop.as_dict import to_dict
from apnc.loop.code import code_hash
from apnc.loop.engines import EXTRAS
from apnc.loop.experiment import Experiment
from apnc_core.settings import Setting

_LIBRARIES: Final = ("cffi", "exudyn", "fmpy", "numpy")


def what_was_run(
    experiment: Experiment, parameters: Mapping[str, Setting] | None = None
) -> dict[str, Any]:
    """The command that repeats the run, the whole experiment, all parameters, and versions.

    Args:
        experiment: what was run.
        parameters: as read back from the controller; those of the experiment if there are none.
    """
    engine = {experiment.engine} & set(EXTRAS)
    return {
        "command": experiment.command(),
        "key": experiment.key(),
        "experiment": experiment.to_dict(),
        "parameters": to_dict(parameters or experiment.parameters()),
        "versions": {
            "apnc": apnc_core.__version__,
            "python": platform.python_version(),
            "code": code_hash(),
            **{name: version(name) for name in sorted({*_LIBRARIES, *engine})},
        },
    }

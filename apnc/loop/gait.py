"""Stored gaits as files: the phase relations that the neural couplings hold."""

from __future__ import annotations

import hashlib
import json
from dataclasses import asdict
from pathlib import Path
from typing import Annotated, Any, Final, Literal

from apnc.loop.last_sample import last_sample
from apnc_core.variables import variable_named
from apnc_plant.files import Number, checked, checked_file, limits
from apnc_plant.robot.leg_names import same_legs
from build_fmu.writing import write_atomically

FORMAT: Final = "apnc-gait"
VERSION: Final = 1

_LIMITS: Final = variable_named("phi_stored")


class GaitError(ValueError):
    """A file or a run that holds no usable gait, in one line."""


Relation = Annotated[Number, limits("rad", ge=_LIMITS.min, le=_LIMITS.max)]


@checked(GaitError)
class Gait:
    """A stored gait.

    Args:
        legs: leg names, the reference leg first.
        phi: relations phi_12, phi_13, ... [rad], one per leg from the second on; positive when
            that leg leads the first (Eq. 12).

    Raises:
        GaitError: values that do not fit or are out of range.
    """

    legs: tuple[str, ...]
    phi: tuple[Relation, ...]

    def __post_init__(self) -> None:
        """Check that there is a relation for every leg but the first."""
        if len(self.phi) != len(self.legs) - 1:
            raise ValueError(f"{len(self.phi)} relations do not fit {len(self.legs)} legs")

    def settings(self, legs: tuple[str, ...]) -> dict[str, Any]:
        """Parameters of the FMU to start with this gait on a robot with these legs.

        The legs may have other names at the same places, see
        :func:`apnc_plant.robot.leg_names.leg_named`.

        Raises:
            GaitError: the gait is one of other legs.
        """
        if not same_legs(self.legs, legs):
            raise GaitError(
                f"the gait is of legs {', '.join(self.legs)}; the robot has {', '.join(legs)}"
            )
        return {"stored": True, "phi_stored": self.phi}


def gait_of_run(folder: Path | str) -> Gait:
    """The gait stored at the end of a recorded run.

    Args:
        folder: output folder of ``apnc walk``.

    Raises:
        GaitError: no run, a damaged record, or a run whose couplings were off at the end.
    """
    path = Path(folder) / "record.csv"
    try:
        last = last_sample(path)
    except ValueError as error:
        raise GaitError(str(error)) from None
    legs = tuple(name.removesuffix(".o1") for name in last if name.endswith(".o1"))
    relations = [f"phi_memory1{k}" for k in range(2, len(legs) + 1)]
    if not relations or not {"kappa", *relations} <= last.keys():
        raise GaitError(f"{path} is not the record of a walk")
    if last["kappa"] != 1.0:
        raise GaitError(f"{folder}: no gait was stored in this run (kappa is 0 at its end)")
    return Gait(legs, tuple(last[name] for name in relations))


@checked(GaitError)
class _GaitFile:
    """What a gait file holds, with its checksum."""

    format: Literal["apnc-gait"]
    version: Literal[1]
    unit: Literal["rad"]
    legs: tuple[str, ...]
    phi: tuple[Relation, ...]
    sha256: str

    def __post_init__(self) -> None:
        """Check that nothing was changed since the file was written."""
        content = asdict(self)
        if content.pop("sha256") != _checksum(content):
            raise ValueError("damaged: its checksum does not fit")


def _checksum(content: dict[str, Any]) -> str:
    text = json.dumps(content, sort_keys=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def write_gait(gait: Gait, path: Path | str) -> None:
    """Write a gait file.

    Raises:
        OSError: the file cannot be written.
    """
    content = {"format": FORMAT, "version": VERSION, "unit": "rad", **asdict(gait)}
    text = json.dumps({**content, "sha256": _checksum(content)}, indent=2, allow_nan=False)
    write_atomically(Path(path), f"{text}\n".encode())


def read_gait(path: Path | str) -> Gait:
    """Read a gait file.

    Raises:
        GaitError: no file, a damaged or a foreign one.
    """
    if Path(path).is_dir():
        raise GaitError(f"{path} is a folder; apnc gait save {path} gait.json makes a gait file")
    try:
        found = checked_file(_GaitFile, path)
        return Gait(found.legs, found.phi)
    except GaitError as error:
        raise GaitError(f"{path}: {error}") from None
    except ValueError as error:
        raise GaitError(f"gait file {error}") from None

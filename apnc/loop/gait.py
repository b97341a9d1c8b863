"""Learned gaits as files: the phase relations that the neural couplings hold."""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any, Final

from apnc.loop.last_sample import last_sample
from apnc_core.in_python import in_python
from apnc_core.variables import variable_named

FORMAT: Final = "apnc-gait"
VERSION: Final = 1


class GaitError(ValueError):
    """A gait file, or a run, that holds no usable gait, in one line."""


@dataclass(frozen=True)
class Gait:
    """A stored gait.

    Args:
        legs: leg names, the reference leg first.
        phi: relations phi_12, phi_13, ... [rad], one per leg from the second on; positive when
            that leg leads the first (Eq. 12).

    Raises:
        GaitError: numbers that do not fit or are out of range.
    """

    legs: tuple[str, ...]
    phi: tuple[float, ...]

    def __post_init__(self) -> None:
        """Check that there is a usable relation per leg."""
        for name in ("legs", "phi"):
            entries = in_python(getattr(self, name))
            if not isinstance(entries, list | tuple):
                raise GaitError(f"{name} = {entries!r} is not one entry per leg")
            object.__setattr__(self, name, tuple(entries))
        for leg in self.legs:
            if not isinstance(leg, str):
                raise GaitError(f"leg {leg!r} is not a name")
        limits = variable_named("phi_stored")
        assert limits.min is not None and limits.max is not None
        if len(self.phi) != len(self.legs) - 1:
            raise GaitError(f"{len(self.phi)} relations do not fit {len(self.legs)} legs")
        for leg, angle in zip(self.legs[1:], self.phi, strict=True):
            number = isinstance(angle, int | float) and not isinstance(angle, bool)
            if not (number and math.isfinite(angle) and limits.min <= angle <= limits.max):
                allowed = f"{limits.min:g} ... {limits.max:g} rad"
                raise GaitError(f"relation of leg {leg} is {angle}; {allowed} is allowed")
        object.__setattr__(self, "phi", tuple(map(float, self.phi)))

    def settings(self, legs: tuple[str, ...]) -> dict[str, Any]:
        """Parameters of the FMU that start it with this gait on a robot with these legs.

        Raises:
            GaitError: the gait is one of other legs.
        """
        if legs != self.legs:
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


def _checksum(content: dict[str, Any]) -> str:
    text = json.dumps(content, sort_keys=True, allow_nan=False)
    return hashlib.sha256(text.encode()).hexdigest()


def write_gait(gait: Gait, path: Path | str) -> None:
    """Write a gait file.

    Raises:
        OSError: the file cannot be written.
    """
    content = {"format": FORMAT, "version": VERSION, "unit": "rad", **asdict(gait)}
    # what the checksum sees is what a reader of the file sees: lists, not tuples
    content = json.loads(json.dumps(content))
    text = json.dumps({**content, "sha256": _checksum(content)}, indent=2, allow_nan=False)
    Path(path).write_text(text + "\n", encoding="utf-8")


def read_gait(path: Path | str) -> Gait:
    """Read a gait file.

    Raises:
        GaitError: no file, a damaged or a foreign one.
    """
    try:
        content = json.loads(Path(path).read_text(encoding="utf-8"))
    except OSError as error:
        raise GaitError(f"{path} cannot be read: {error.strerror}") from None
    except (ValueError, RecursionError):
        raise GaitError(f"{path} is not a gait file, or damaged: not JSON") from None
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise GaitError(f"{path} is not a gait file")
    if content.get("version") != VERSION:
        raise GaitError(f"{path} has version {content.get('version')}; {VERSION} is known")
    claimed = content.pop("sha256", None)
    if claimed != _checksum(content):
        raise GaitError(f"{path} is damaged: its checksum does not fit")
    try:
        return Gait(content["legs"], content["phi"])
    except KeyError as error:
        raise GaitError(f"{path} is damaged: it has no {error}") from None
    except GaitError as error:
        raise GaitError(f"{path}: {error}") from None

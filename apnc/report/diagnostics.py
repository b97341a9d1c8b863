"""What a controller would report during a run: its state once a second, and what happens."""

from __future__ import annotations

from collections.abc import Iterator
from enum import IntEnum
from typing import Any, Final, NamedTuple

import numpy as np

from apnc.loop.record import Record

_NAME: Final = "apnc"
_STORED: Final = "a gait is stored and the couplings are on"
_FORMING: Final = "the couplings are off"
_UNUSABLE: Final = "the load cannot be used and counts as zero"


class Severity(IntEnum):
    """How serious a log message is, numbered as in rcl_interfaces/Log."""

    info = 20
    error = 40


class Event(NamedTuple):
    """Something that happens in a run.

    Args:
        tick: number of the sample.
        severity: how serious it is.
        text: what happens.
    """

    tick: int
    severity: Severity
    text: str


def events(record: Record) -> list[Event]:
    """When the couplings switch, a foot sensor fails or returns, and a run ends too early."""
    found = []
    for tick, on in _changes(record.signals["kappa"] > 0.0):
        found.append(Event(tick, Severity.info, _STORED if on else _FORMING))
    for leg, bad in zip(record.legs, record.signals["fault"].T > 0.0, strict=True):
        for tick, broken in _changes(bad):
            words = _UNUSABLE if broken else "the load can be used again"
            severity = Severity.error if broken else Severity.info
            found.append(Event(tick, severity, f"foot sensor of {leg}: {words}"))
    if not record.complete:
        words = f"{record.end}: {record.message}" if record.message else str(record.end)
        found.append(Event(len(record) - 1, Severity.error, words))
    return sorted(found, key=lambda event: event.tick)


def _changes(on: np.ndarray[Any, Any]) -> Iterator[tuple[int, bool]]:
    """Samples at which a signal that is off before the run switches, with its new state."""
    before = np.concatenate([[False], on[:-1]])
    for tick in np.flatnonzero(on != before):
        yield int(tick), bool(on[tick])


def statuses(record: Record, tick: int) -> list[dict[str, Any]]:
    """The state of the controller and of every foot sensor, as diagnostic_msgs/DiagnosticStatus.

    The level is 0 (OK), or 2 (error) for a foot sensor that cannot be used.
    """
    signals = record.signals
    stored = signals["kappa"][tick] > 0.0
    values = {name: signals[name][tick] for name in ("MI", "turn", "d", "kappa")}
    found = [_status("controller", 0, _STORED if stored else _FORMING, values)]
    for number, leg in enumerate(record.legs):
        bad = signals["fault"][tick, number] > 0.0
        values = {name: signals[name][tick, number] for name in ("grf", "gamma")}
        words = _UNUSABLE if bad else "OK"
        found.append(_status(f"foot sensor {leg}", 2 if bad else 0, words, values))
    return found


def _status(name: str, level: int, message: str, values: dict[str, float]) -> dict[str, Any]:
    return {
        "level": level,
        "name": name,
        "message": message,
        "hardware_id": _NAME,
        "values": [{"key": key, "value": f"{value:.6g}"} for key, value in values.items()],
    }

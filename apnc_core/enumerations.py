"""The enumeration types of the interface: which method, measure, rule and sign is used."""

from __future__ import annotations

from dataclasses import dataclass
from enum import IntEnum
from typing import Final


class Method(IntEnum):
    """Controller that runs."""

    apnc = 1
    apc = 2
    tegotae = 3
    phase_reset = 4


class ForwardModel(IntEnum):
    """How the expected load is computed."""

    low_pass_hip = 1
    low_pass_knee = 2
    radial_basis = 3


class PhaseMeasure(IntEnum):
    """How the relative phases are measured."""

    vector = 1
    peak = 2


class KappaRule(IntEnum):
    """When the neural couplings switch on."""

    armed = 1
    printed = 2


class CouplingSign(IntEnum):
    """Sign of the coupling term g in Eq. 18."""

    reversed = 1
    printed = 2


@dataclass(frozen=True)
class Enumeration:
    """An enumeration type: its items and a sentence on each."""

    items: type[IntEnum]
    descriptions: tuple[str, ...]

    @property
    def name(self) -> str:
        """Type name in the model description."""
        return self.items.__name__


ENUMERATIONS: Final[tuple[Enumeration, ...]] = (
    Enumeration(
        Method,
        (
            "adaptive physical and neural communication, Eq. 1-18",
            "adaptive physical communication only, Eq. 1-11",
            "Tegotae baseline: Eq. 5 with a fixed gain",
            "phase-resetting baseline: activations set to (1, 0) at touch-down",
        ),
    ),
    Enumeration(
        ForwardModel,
        (
            "low-pass filter of the stance of the hip command, Eq. 10-11 as printed",
            "Eq. 10-11 with the knee command, as the text of section 2.1.2 has it",
            "radial basis functions of (o1, o2) that learn the load",
        ),
    ),
    Enumeration(
        PhaseMeasure,
        (
            "angle between the vectors (o1, o2) of two legs, low-pass filtered",
            "times of the peaks of o1, Eq. 12",
        ),
    ),
    Enumeration(
        KappaRule,
        (
            "on after d has exceeded sigma and then stayed at or below it for kappa_hold ticks",
            "Eq. 16 as printed: on whenever d is at or below sigma",
        ),
    ),
    Enumeration(
        CouplingSign,
        ("g subtracted: recovers the stored gait", "g added, as printed in Eq. 18"),
    ),
)

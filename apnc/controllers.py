"""Controllers by label: a method of the FMU with its settings.

A baseline stands twice: at the setting of the paper, as the authors' code has it for a study, and
at its best on this robot, found by the study ``gains``.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import Final, NamedTuple

from apnc_core.variables import variable_named

Settings = Mapping[str, float]

NONE: Final[Settings] = MappingProxyType({})


class Controller(NamedTuple):
    """A method of the FMU with its settings.

    Args:
        method: name of the FMU's method, see ``Method``.
        name: in figures and words.
        settings: parameters that differ from the robot's own.
        in_study: settings by study, where a study has others in place of these.
    """

    method: str
    name: str
    settings: Settings = NONE
    in_study: Mapping[str, Settings] = MappingProxyType({})

    def settings_in(self, study: str) -> Settings:
        """Parameters that differ from the robot's own in a study."""
        return self.in_study.get(study, self.settings)


def _authors_gain(gain: float) -> Settings:
    """Tegotae's gain of the authors' code, where loads are over the whole weight, not half of it.

    It has 0.03 for MI, update rates and rough ground, and 0.3 for the robot's conditions.
    """
    return {"gamma_tegotae": 0.5 * gain}


def _printed(*names: str) -> Settings:
    """Parameters as the paper prints them."""
    return {name: variable_named(name).paper or 0.0 for name in names}


_VARIED: Final = {"gains": NONE}
"""The study ``gains`` sets what it varies in its own experiments."""
_IN_CONDITIONS: Final = dict.fromkeys(("conditions", "damage", "states"), _authors_gain(0.3))

CONTROLLERS: Final[Mapping[str, Controller]] = {
    "apnc": Controller("apnc", "APNC"),
    "apc": Controller("apc", "APC alone"),
    "tegotae": Controller("tegotae", "Tegotae", _authors_gain(0.03), _IN_CONDITIONS | _VARIED),
    "tegotae_best": Controller("tegotae", "Tegotae (best)", {"gamma_tegotae": 0.15}),
    "phase_reset": Controller("phase_reset", "phase resetting", {"grf_reset": 0.4}, _VARIED),
    "phase_reset_best": Controller("phase_reset", "phase resetting (best)", {"grf_reset": 0.6}),
    "apnc_kept": Controller("apnc", "APNC, feedback kept", {"feedback_kept": 1.0}),
    "apnc_printed": Controller("apnc", "APNC, printed rates", _printed("B_f", "B_s")),
}
"""By label; a result of a study holds the label as its controller."""

OWN_CONTROLLER: Final = "apnc"
"""Label of the controller that walks if none is named."""

TEGOTAE: Final = ("tegotae", "tegotae_best")
PHASE_RESET: Final = ("phase_reset", "phase_reset_best")
BASELINES: Final = (*TEGOTAE, *PHASE_RESET)
"""The baselines at both settings."""

ALL: Final = ("apnc", *BASELINES)
"""What the paper compares, the baselines at both settings."""


def distinct(labels: Sequence[str], study: str) -> tuple[str, ...]:
    """Labels without those that in a study are the same controller as an earlier one.

    Where the paper's setting of a baseline is also its best, the baseline is there once.
    """
    found: dict[tuple[str, tuple[tuple[str, float], ...]], str] = {}
    for label in labels:
        used = named_controller(label)
        found.setdefault((used.method, tuple(sorted(used.settings_in(study).items()))), label)
    return tuple(found.values())


def named_controller(label: str) -> Controller:
    """The controller of a label.

    Raises:
        ValueError: an unknown label.
    """
    if label not in CONTROLLERS:
        raise ValueError(f"controller '{label}' is not one of {', '.join(CONTROLLERS)}")
    return CONTROLLERS[label]

"""The controllers that studies compare, by label: how each is set, and how it is drawn.

A baseline stands twice: at the setting of the paper, as the authors' code has it for the study,
and at its best on this robot, found by the study ``gains``.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import Final, NamedTuple

from apnc.report import theme
from apnc_core.presets import preset

Settings = Mapping[str, float]

NONE: Final[Settings] = MappingProxyType({})


class Contender(NamedTuple):
    """A controller under a setting.

    Args:
        method: of the FMU.
        name: in figures and words.
        colour: one of the theme.
        symbol: of the plots.
        settings: parameters that differ from the robot's own.
        in_study: settings by study, where a study has others.
    """

    method: str
    name: str
    colour: str
    symbol: str
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


_PRINTED: Final = preset("paper")
_VARIED: Final = {"gains": NONE}
_IN_CONDITIONS: Final = dict.fromkeys(("conditions", "damage", "states"), _authors_gain(0.3))

CONTENDERS: Final[Mapping[str, Contender]] = {
    "apnc": Contender("apnc", "APNC", theme.BLUE, "circle"),
    "apc": Contender("apc", "APC alone", theme.SKY, "circle-open"),
    "tegotae": Contender(
        "tegotae", "Tegotae", theme.ORANGE, "diamond-open",
        _authors_gain(0.03), _IN_CONDITIONS | _VARIED,
    ),
    "tegotae_best": Contender(
        "tegotae", "Tegotae (best)", theme.VERMILLION, "diamond", {"gamma_tegotae": 0.2},
    ),
    "phase_reset": Contender(
        "phase_reset", "phase resetting", theme.GREEN, "triangle-up-open",
        {"grf_reset": 0.4}, _VARIED,
    ),
    "phase_reset_best": Contender(
        "phase_reset", "phase resetting (best)", theme.PURPLE, "triangle-up", {"grf_reset": 0.2},
    ),
    "apnc_kept": Contender(
        "apnc", "APNC, feedback kept", theme.GREY, "square", {"feedback_kept": 1.0},
    ),
    "apnc_printed": Contender(
        "apnc", "APNC, printed rates", theme.BLACK, "square-open",
        {"B_f": _PRINTED.B_f, "B_s": _PRINTED.B_s},
    ),
}  # fmt: skip
"""By label; rows hold the label as their method."""

TEGOTAE: Final = ("tegotae", "tegotae_best")
PHASE_RESET: Final = ("phase_reset", "phase_reset_best")
RIVALS: Final = (*TEGOTAE, *PHASE_RESET)
"""The baselines at both settings."""

ALL: Final = ("apnc", *RIVALS)
"""What the paper compares, the baselines at both settings."""


def contender(label: str) -> Contender:
    """The controller of a label.

    Raises:
        ValueError: an unknown label.
    """
    if label not in CONTENDERS:
        raise ValueError(f"method '{label}' is not one of {', '.join(CONTENDERS)}")
    return CONTENDERS[label]

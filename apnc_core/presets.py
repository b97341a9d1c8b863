"""Named sets of parameters."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import fields
from functools import cache
from types import MappingProxyType

from apnc_core.interface import Parameters
from apnc_core.schema import Causality
from apnc_core.settings import Setting
from apnc_core.variables import variables_of

PRESETS = ("lilibot", "paper")


def preset(name: str) -> Parameters:
    """The parameters of one preset.

    Args:
        name: ``lilibot``, the default: the set with which Lilibot forms its gait in the
            multibody model; ``paper``: the constants and rules as printed.

    Raises:
        ValueError: no such preset.
    """
    if name not in PRESETS:
        raise ValueError(f"preset '{name}' is not one of {', '.join(PRESETS)}")
    if name == "lilibot":
        return Parameters()
    printed = {v.name: v.paper for v in variables_of(Causality.parameter) if v.paper is not None}
    return Parameters(**printed)  # type: ignore[arg-type]  # the table gives each its type


@cache
def preset_values(name: str) -> Mapping[str, Setting]:
    """The parameters of one preset by name, see :func:`preset`."""
    chosen = preset(name)
    return MappingProxyType({each.name: getattr(chosen, each.name) for each in fields(chosen)})

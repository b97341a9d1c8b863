"""A robot whose motion diverges: an impact law so stiff that the step cannot follow."""

from __future__ import annotations

import re

from apnc_plant.robot import ROBOTS


def stiff_robot() -> str:
    """Text of lilibot's file with feet of 1e300 N/m."""
    before, contact = (ROBOTS / "lilibot.toml").read_text(encoding="utf-8").split("[contact]")
    stiff = re.sub(r"(?m)^stiffness = \S+", "stiffness = 1e300", contact)
    return f"{before}[contact]{stiff}"

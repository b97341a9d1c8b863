"""The studies of the model. A study is imported when it is loaded, not here."""

from __future__ import annotations

from typing import Final

from apnc.studies.registry import ROBOT, Entry, Registry

STUDIES: Final[Registry] = {
    entry.name: entry
    for entry in (
        Entry("symmetry", "Equal loads", "4.1.1", ("mi",), "research"),
        Entry(
            "duty",
            "Bodies with a larger duty factor",
            "",
            ("mi", "lag", "foot", "a1", "a2"),
            "research",
        ),
        Entry("departures", "Departures taken back", "", ("removed", "task"), "research"),
        Entry("sensitivity", "Numbers of the robot", "", ("change", "mi"), "research"),
        Entry("forward_model", "Forward models", "", ("model", "mi"), "research"),
        Entry("engines", "Three engines", "", (ROBOT, "engine", "mi"), "research"),
        Entry("robustness", "Bodies by chance", "", (ROBOT, "share", "walk"), "research"),
        Entry(
            "robustness.numbers",
            "One number at a time",
            "",
            (ROBOT, "number", "level", "walk"),
            "research",
        ),
        Entry(
            "basin.pushes",
            "Pushes that are forgotten",
            "",
            (ROBOT, "mi", "direction", "froude"),
            "research",
        ),
        Entry("limits", "Limits of the claim", "", (ROBOT, "case"), "research"),
        Entry(
            "contact", "Integration step of the ground contact", "", ("depth", "steps"), "research"
        ),
    )
}
"""By name."""

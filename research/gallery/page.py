"""The page of the gallery: a row per robot, and which aims it misses."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from itertools import pairwise, zip_longest
from pathlib import Path
from typing import Any, Final

import numpy as np
from jinja2 import Environment, StrictUndefined

from apnc.studies.table import markdown
from apnc.tune import MI_AIMED
from research.gallery.measure import CONTROLLERS, OFF, Walk, chosen, median
from research.gallery.robots import GalleryRobot

TEMPLATE: Final = Path(__file__).with_name("gallery.md.j2")

STRICT: Final = {"ANC": 1.0, "APC": 0.9}
"""Least share of the seeds at every MI on which the gait forms and holds, by controller."""

LIFT: Final = 0.05
"""Least lift of every foot, in leg lengths."""

SLIP: Final = 0.18
"""Most slip of every foot, as a share of the stride."""


def missed(found: Sequence[Walk]) -> list[str]:
    """Aims that the walks of one robot miss, in words with figures.

    Lift, slip and speed are those with ANC: medians over the seeds at an MI, and the worst MI.
    """
    own = chosen(found, body="own")
    words = []
    for label, share in STRICT.items():
        counts = {mi: _strict(chosen(own, controller=label, mi=mi)) for mi in _mis(own)}
        low = {mi: text for mi, (part, text) in counts.items() if part < share}
        if low:
            words.append(f"{label} " + ", ".join(f"{t} at MI {mi:g}" for mi, t in low.items()))
    lift, slip, speeds = _lift(own), _slip(own), _speeds(own)
    if not lift >= LIFT:
        words.append(f"lift {_percent(lift)}")
    if not slip <= SLIP:
        words.append(f"slip {_percent(slip)}")
    if not all(after > before for before, after in pairwise(speeds)):
        words.append("speed does not grow: " + ", ".join(f"{speed:.3f}" for speed in speeds))
    return words


def robot_row(robot: GalleryRobot, about: Mapping[str, Any]) -> dict[str, str]:
    """Row of a robot: what it is, and how long it was tuned.

    Args:
        robot: the robot.
        about: ``mass`` [kg], ``leg_length`` [m], ``version`` of the source; ``minutes`` of tuning
            and number of ``candidates``, if it was tuned.
    """
    minutes = about.get("minutes")
    tuned = "no" if minutes is None else f"{minutes:.1f}"
    return {
        "robot": robot.title,
        "mass [kg]": f"{about['mass']:.1f}",
        "leg [m]": f"{about['leg_length']:.2f}",
        "source": f"{robot.kind}, {robot.source} {about['version']}",
        "licence": robot.licence,
        "tuned [min]": "by hand" if robot.by_hand else tuned,
        "candidates": f"{about.get('candidates', '-')}",
    }


def searches(about: Mapping[str, Any]) -> list[str]:
    """Commands that find a robot again, each with the commit at which it did.

    Args:
        about: ``commands``, and the commit of each as ``at``; commands after the last have none.
    """
    at = [f"  # {commit}" for commit in about.get("at", ())]
    return ["".join(pair) for pair in zip_longest(about.get("commands", ()), at, fillvalue="")]


def fmu_row(robot: GalleryRobot, fmu: Mapping[str, Any]) -> dict[str, str]:
    """Row of an FMU, see ``fmu_of``."""
    return {
        "robot": robot.title,
        "size [kB]": f"{fmu['kB']}",
        "rate [Hz]": f"{fmu['rate']:.1f}",
        "weight [N]": f"{fmu['weight']:.1f}",
        "MI to set": f"{fmu['mi']:g}",
        "walk differs by [m]": f"{fmu['apart']:.1g}",
    }


def walk_row(robot: GalleryRobot, found: Sequence[Walk]) -> dict[str, str]:
    """Row of the walks of a robot."""
    own, mis, speeds = chosen(found, body="own"), _mis(found), _speeds(found)
    return {
        "robot": robot.title,
        "MI": f"{mis[0]:g} to {mis[-1]:g}",
        **{f"{label} trots": _strict(chosen(own, controller=label))[1] for label in CONTROLLERS},
        **{
            f"margin {label}": _strict(chosen(found, body="varied", controller=label))[1]
            for label in CONTROLLERS
        },
        "speed [m/s]": f"{min(speeds):.2f} to {max(speeds):.2f}",
        "lift": _percent(_lift(found)),
        "slip": _percent(_slip(found)),
    }


def text(
    robots: Sequence[GalleryRobot], about: Mapping[str, Any], walks: Sequence[Walk], films: Path
) -> str:
    """The page.

    Args:
        robots: those of the gallery, in their order.
        about: what was measured, and how, see ``store.ABOUT``.
        walks: every walk that was measured.
        films: folder of the films, below ``docs/pictures``.
    """
    shown = [robot for robot in robots if robot.name in about["robots"]]
    found = {robot.name: chosen(walks, robot=robot.name) for robot in shown}
    known = {robot.name: about["robots"][robot.name] for robot in shown}
    fmus = [(robot, known[robot.name]["fmu"]) for robot in shown if "fmu" in known[robot.name]]
    titles = {robot.name: robot.title for robot in robots}
    pictures = [
        f"![Film: {robot.title} walks](../pictures/{films.name}/{robot.name}.webp)"
        for robot in shown
        if (films / f"{robot.name}.webp").is_file()
    ]
    searched = [known[robot.name] for robot in shown if robot.by_hand is None]
    tuned = [each.get("minutes") is not None for each in searched]
    template = Environment(undefined=StrictUndefined, keep_trailing_newline=True).from_string(
        TEMPLATE.read_text("utf-8")
    )
    return template.render(
        about=about, summary=summary(found, titles), films="\n".join(pictures),
        robots=markdown([robot_row(robot, known[robot.name]) for robot in shown]),
        walks=markdown([walk_row(robot, found[robot.name]) for robot in shown]),
        missed=[(robot.title, missed(found[robot.name]), robot.why) for robot in shown],
        fmus=markdown([fmu_row(robot, fmu) for robot, fmu in fmus]) if fmus else "",
        repositories=[robot for robot in shown if robot.repository],
        searches=[line for each in known.values() for line in searches(each)],
        apart=[
            f"{robot.title} at {known[robot.name]['commit']}"
            for robot in shown
            if known[robot.name].get("commit", about["commit"]) != about["commit"]
        ],
        by_hand=[robot.title for robot in shown if robot.by_hand],
        tuned=any(tuned), untuned=None if all(tuned) else MI_AIMED,
        apc=round(STRICT["APC"] * about["seeds"]), lift=_percent(LIFT), slip=_percent(SLIP),
        off=f"{100.0 * OFF:.0f} %",
        refused=[(titles[name], why) for name, why in sorted(about["refused"].items())],
    )  # fmt: skip


def summary(found: Mapping[str, Sequence[Walk]], titles: Mapping[str, str]) -> str:
    """Which robots reach all aims, in a sentence."""
    good = [titles[name] for name, walks in found.items() if not missed(walks)]
    names = f": {', '.join(good)}" if good else ""
    return f"{len(good)} of {len(found)} robots reach every aim{names}."


def _mis(found: Sequence[Walk]) -> list[float]:
    return sorted({walk.mi for walk in found})


def _strict(found: Sequence[Walk]) -> tuple[float, str]:
    """Share of the walks that are strict, and the same in words."""
    count = sum(walk.strict for walk in found)
    return count / max(1, len(found)), f"{count}/{len(found)}"


def _with_anc(found: Sequence[Walk]) -> list[list[Walk]]:
    """Walks of the robot itself with ANC, by MI."""
    return [chosen(found, body="own", controller="ANC", mi=mi) for mi in _mis(found)]


def _speeds(found: Sequence[Walk]) -> list[float]:
    return [median([walk.speed_m_per_s for walk in walks]) for walks in _with_anc(found)]


def _lift(found: Sequence[Walk]) -> float:
    return min(median([walk.lift_share for walk in walks]) for walks in _with_anc(found))


def _slip(found: Sequence[Walk]) -> float:
    # nan, for feet that do not step, is the worst
    return float(
        np.max([median([walk.slip_share for walk in walks]) for walks in _with_anc(found)])
    )


def _percent(share: float) -> str:
    return "-" if math.isnan(share) else f"{100.0 * share:.1f} %"

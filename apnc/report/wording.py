"""Texts of the report and the command line: what was run, and what is measured of it."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, fields, replace
from typing import Any, Final

from apnc import metrics, walking
from apnc.features import WalkFeatures
from apnc.loop.experiment import Experiment
from apnc.loop.push import Push
from apnc.loop.record import End, Record
from apnc.loop.schedule import schedule_text
from apnc_plant.conditions import Conditions

DASH: Final = "–"
_SPACE: Final = "\N{NO-BREAK SPACE}"
_UNITS: Final = {"duration": " s", "rate": " Hz", "step": " s"}
_SPEAK_FOR_THEMSELVES: Final = ("robot", "controller", "ground", "conditions")


@dataclass(frozen=True)
class Verdict:
    """The answer to a question of the reader.

    Args:
        question: what is asked.
        answer: in a word or two.
        detail: in a line.
        mood: good, fair, bad or plain; the page colours it so.
    """

    question: str
    answer: str
    detail: str
    mood: str


def heading(experiment: Experiment) -> str:
    """Robot, MI, and what else of an experiment is not default, in a line."""
    changed = {**experiment.changed()}
    changed = {"robot": experiment.description.name, "mi": experiment.mi} | changed
    changed["robot"] = experiment.description.name
    settings = changed.pop("settings", {})
    pushes = len(changed.pop("pushes", ()))
    pushed = [f"pushed {pushes} times" if pushes > 1 else "pushed once"] if pushes else []
    words = [
        _plain(value)
        if name in _SPEAK_FOR_THEMSELVES
        else f"{'MI' if name == 'mi' else name} {_plain(value)}{_UNITS.get(name, '')}"
        for name, value in changed.items()
    ]
    return ", ".join([*words, *_settings(settings), *pushed])


def facts(record: Record) -> list[tuple[str, str]]:
    """What was run: names and values."""
    e = record.experiment
    p = record.parameters or e.parameters()
    stored = p["phi_stored"] if p["stored"] else None
    return [
        ("Robot", f"{record.robot.name}, {record.mass:.2f} kg, legs {', '.join(record.legs)}"),
        ("Controller", f"{e.controller_name}, preset {e.preset}, {e.rate:g} Hz"),
        *_own_fmu(e, p),
        ("Changed parameters", ", ".join(_settings(e.settings)) or "none"),
        ("Stored gait", f"φ {_plain(stored)} rad at the start" if stored else "none at the start"),
        *((name.capitalize(), _plain(getattr(e, name))) for name in ("turn", "conditions")),
        *(("MI", _plain(e.mi)), ("Ground", _plain(e.ground)), ("Seed", str(e.seed))),
        *([("Pushes", _pushes(e.pushes))] if e.pushes else []),
        ("Engine", f"{e.engine}, step {1e6 * e.step:.4g} µs"),
    ]


def _pushes(pushes: Iterable[Push]) -> str:
    """When and how hard a robot was pushed, e.g. ``0.2 N s forward, 0.1 N s right at 3 s``."""
    return "; ".join(
        f"{_way(push.x, 'forward', 'back')}, {_way(push.y, 'left', 'right')} at {push.at:.4g} s"
        for push in pushes
    )


def _way(impulse: float, positive: str, negative: str) -> str:
    return f"{abs(impulse):.3g} N s {positive if impulse >= 0.0 else negative}"


def _own_fmu(e: Experiment, parameters: Mapping[str, Any]) -> list[tuple[str, str]]:
    """The user's FMU, and those of its own start values that held."""
    if e.fmu is None:
        return []
    held = {name: value for name, value in e.fmu_starts.items() if parameters[name] == value}
    return [("FMU", e.fmu), ("Start values of the FMU", ", ".join(_settings(held)) or "as usual")]


def verdicts(summary: WalkFeatures, planned: float) -> list[Verdict]:
    """Whether it walked, whether the gait formed, and how fast it was.

    Args:
        summary: what is measured of the run.
        planned: duration that was asked for [s].
    """
    walked = _walked(summary, planned)
    return [walked, _formed(summary), _fast(summary, walked)]


def number(value: float | None, digits: int = 2, unit: str = "") -> str:
    """Fixed-point text with unit; a dash if undefined."""
    if value is None or not math.isfinite(value):
        return DASH
    return f"{value:.{digits}f}{_SPACE * bool(unit)}{unit}"


def rows(s: WalkFeatures) -> list[tuple[str, str, str]]:
    """Rows of the table of figures: name, value with unit, and meaning."""
    phases = [f"φ1{k}{_SPACE}{phase_text(p)}" for k, p in enumerate(s.phi_final, start=2)]
    target = metrics.gait_name(len(s.phi_final) + 1).capitalize()
    strict = f"within {metrics.STRICT_TOLERANCE} rad to the end"
    share = None if s.fmu_share_of_wall_time is None else 100.0 * s.fmu_share_of_wall_time
    percent = {leg: None if part is None else 100.0 * part for leg, part in s.slip_share.items()}
    steadier = "1/std roll + 1/std pitch; larger is steadier: 80 is 1.4° of sway, 200 is 0.6°"
    evener = "1 / spread of the share of stance; larger is more even: 10 is a spread of 0.1"
    return [
        ("Speed along the path", number(s.path_speed_m_per_s, 3, "m/s"), "smoothed over 1.5 s"),
        ("Turned", _turned(s), "from the first heading to the last, and the range between"),
        ("Forward speed", number(s.forward_speed_m_per_s, 3, "m/s"), "along the present heading"),
        ("Net displacement", number(s.distance_m, 2, "m"), "along the first heading"),
        ("Simulated", number(s.duration_s, 2, "s"), ": ".join(filter(None, (s.end, s.message)))),
        (f"{target}, strict", number(s.convergence_time_s, 2, "s"), strict),
        (
            f"{target}, authors",
            number(s.convergence_time_authors_s, 2, "s"),
            "first within 2.8 rad",
        ),
        ("Final gait", s.gait or DASH, ", ".join(phases)),
        ("Gait stored", number(s.stored_at_s, 2, "s"), "neural couplings first on"),
        ("Stride frequency", number(s.stride_frequency_hz, 2, "Hz"), "cycles of the oscillators"),
        ("Stride length", number(s.stride_length_mm, 1, "mm"), "along the path"),
        ("Duty factor", _by_leg(s.duty_factor, 2), "share of stance"),
        (
            "Touch-downs per stride",
            f"{_by_leg(s.touch_downs_by_leg, 2)}; mean {number(s.touch_downs_per_stride)}",
            "1 is a clean step, more: it scuffs, less: it drags",
        ),
        ("Foot lift", _by_leg(s.foot_lift_mm, 1), "mm, mid-swing above stance"),
        ("Slip per stride", _by_leg(s.slip_per_stride_mm, 1), "mm in stance, rolling included"),
        ("Slip share", _by_leg(percent, 0), "% of the stride length"),
        ("Balance", number(s.balance, 1, "1/rad"), steadier),
        ("Coordination", number(s.coordination, 1), evener),
        ("Cost of transport", number(s.cost_of_transport), "energy / (m g path); less is better"),
        ("Real-time factor", number(s.real_time_factor, 1, "×"), "simulated / wall time"),
        ("Controller's share", number(share, 1, "%"), "of wall time"),
    ]


def phase_text(phase: float | None) -> str:
    """Phase [rad] as a multiple of pi, e.g. 0.98 π."""
    return DASH if phase is None else f"{round(phase / math.pi, 2) + 0.0:.2f}{_SPACE}π"


def _settings(settings: Any) -> list[str]:
    return [f"{name} {_plain(v)}" for name, v in settings.items() if name != "phi_stored"]


def _plain(value: Any) -> str:
    """A value of an experiment in words, e.g. a schedule, conditions or a ground."""
    if isinstance(value, Conditions):
        default = Conditions()
        changed = {f.name: getattr(value, f.name) for f in fields(value)}
        words = [f"{k} {_plain(v)}" for k, v in changed.items() if v != getattr(default, k)]
        return ", ".join(words) or "none"
    if isinstance(value, tuple) and value and isinstance(value[0], tuple):
        return schedule_text(tuple((start, _plain(entry)) for start, entry in value))
    if isinstance(value, tuple | list):
        return " ".join(_plain(entry) for entry in value)
    if hasattr(value, "text"):
        slope = f", slope {math.degrees(value.slope):.3g}°" if value.slope else ""
        return str(replace(value, slope=0.0).text()) + slope
    return f"{value:.6g}" if isinstance(value, float) else str(getattr(value, "name", value))


def _walked(s: WalkFeatures, planned: float) -> Verdict:
    question, when = "Did it walk?", number(s.duration_s, 2, "s")
    speed = s.path_speed_m_per_s
    way = "" if speed is None else f"{speed * s.duration_s:.2f} m of path"
    after = f", after {way}" if way else ""
    if s.end == End.fell:
        return Verdict(question, "It fell", f"at {when}{after}", "bad")
    if s.end == End.diverged:
        return Verdict(question, "It diverged", f"at {when}: {s.message}", "bad")
    if s.end == End.interrupted:
        return Verdict(question, "Interrupted", f"at {when} of {planned:g} s{after}", "fair")
    return _stepped(s, question)


def _stepped(s: WalkFeatures, question: str) -> Verdict:
    """The verdict on a run that came to its end upright."""
    when = number(s.duration_s, 2, "s")
    if s.path_speed_m_per_s is None or not walking.moves(s):
        return Verdict(question, "No", f"It stayed upright, but got nowhere in {when}.", "bad")
    way = f"{s.path_speed_m_per_s * s.duration_s:.2f}{_SPACE}m of path"
    feet = walking.dragging(s)
    if not walking.goes_forward(s):
        ahead = (s.forward_speed_m_per_s or 0.0) * s.duration_s
        backwards = f"It moved backwards by {-ahead:.2f}{_SPACE}m in {when}."
        little = f"Of {way}, only {max(ahead, 0.0):.2f}{_SPACE}m led forward in {when}."
        moved = backwards if -ahead > 0.1 * s.path_speed_m_per_s * s.duration_s else little
        return Verdict(question, "No", " ".join([moved, *_dragged(s, feet)]), "bad")
    if not feet:
        clean = f"{way} in {when}, upright throughout; every foot lifts and holds"
        return Verdict(question, "Yes", clean, "good")
    answer, mood = ("No", "bad") if 2 * len(feet) > len(s.slip_share) else ("Partly", "fair")
    moved = f"It covered {way} in {when} upright."
    return Verdict(question, answer, " ".join([moved, *_dragged(s, feet)]), mood)


def _dragged(s: WalkFeatures, feet: tuple[str, ...]) -> list[str]:
    """Which feet drag, and what they would have to do, as a sentence; none if all step."""
    if not feet:
        return []
    lifts = [s.foot_lift_mm[leg] for leg in feet]
    slips = [s.slip_share[leg] for leg in feet]
    lift = _span([v for v in lifts if v is not None], 1, f"{_SPACE}mm")
    slip = _span([100.0 * v for v in slips if v is not None], 0, f"{_SPACE}%")
    one = len(feet) == 1
    found = f"lift{'s' * one} {lift} and slip{'s' * one} {slip} of a stride"
    if DASH in (lift, slip):
        found = f"make{'s' * one} no whole steps"
    who = f"{', '.join(feet)} drag{'s' * one}"
    if len(feet) == len(s.slip_share):
        who = "All feet drag"
    lift_asked, slip_asked = (100.0 * share for share in (walking.MIN_LIFT, walking.MAX_SLIP))
    asked = (
        f"a step lifts the foot by {lift_asked:g}{_SPACE}% of the leg and slips at most "
        f"{slip_asked:g}{_SPACE}% of a stride"
    )
    return [f"{who}: {'it' if one else 'they'} {found}; {asked}."]


def _span(values: list[float], digits: int, unit: str) -> str:
    if not values:
        return DASH
    low, high = f"{min(values):.{digits}f}", f"{max(values):.{digits}f}"
    return (low if low == high else f"{low} to {high}") + unit


def _formed(s: WalkFeatures) -> Verdict:
    question = f"Did the {metrics.gait_name(len(s.phi_final) + 1)} form?"
    final = f"ended in {s.gait or 'no known gait'}: {', '.join(map(phase_text, s.phi_final))}"
    if s.end in (End.fell, End.diverged):
        return Verdict(question, DASH, "the run did not last", "plain")
    if s.converged is None:
        return Verdict(question, DASH, "too short, or no gait is known for these legs", "plain")
    if s.converged:
        until = "the end" if s.complete else "the interruption"
        when = number(s.convergence_time_s, 1, "s")
        return Verdict(question, f"After {when}", f"from touch-down, and held to {until}", "good")
    if s.convergence_time_authors_s is not None:
        near = f"near it at {number(s.convergence_time_authors_s, 1, 's')}; {final}"
        return Verdict(question, "Not for good", near, "fair")
    return Verdict(question, "No", final, "bad")


def _fast(s: WalkFeatures, walked: Verdict) -> Verdict:
    if s.path_speed_m_per_s is None:
        return Verdict("How fast?", DASH, "not measured", "plain")
    speed = number(s.path_speed_m_per_s, 3, "m/s")
    along = f"along the path, turned {_turned(s)}"
    if walked.mood == "bad":
        why = "until it fell" if s.end == End.fell else "but it did not walk"
        return Verdict("How fast?", DASH, f"{speed} {along}, {why}", "plain")
    stride = f"stride {number(s.stride_frequency_hz, 2, 'Hz')}"
    detail = f"{stride}, cost of transport {number(s.cost_of_transport)}"
    return Verdict("How fast?", speed, f"{along}; {detail}", "plain")


def _turned(s: WalkFeatures) -> str:
    """Turn at the end, and between which headings it was on the way."""
    if s.turned_deg is None:
        return DASH
    right, left = s.rightmost_heading_deg, s.leftmost_heading_deg
    if right is None or left is None or left - right < 0.5:
        return _side(s.turned_deg)
    low, high = _side(right), _side(left)
    return f"{_side(s.turned_deg)} (heading from {low} to {high})"


def _side(degrees: float) -> str:
    side = "left" if degrees > 0 else "right"
    return f"{abs(degrees):.0f}°{_SPACE}{side}" if abs(degrees) >= 0.5 else "0°"


def _by_leg(values: dict[str, float | None], digits: int) -> str:
    return ", ".join(f"{leg}{_SPACE}{number(value, digits)}" for leg, value in values.items())

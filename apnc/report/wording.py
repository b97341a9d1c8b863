"""What was run and what came of it, in plain words and formatted figures."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields
from typing import Any

from apnc import metrics
from apnc.loop.experiment import Experiment
from apnc.loop.record import End, Record
from apnc.loop.steps import steps_text
from apnc.summary import Summary
from exudyn_models.conditions import Conditions

DASH = "–"
_SPACE = "\N{NO-BREAK SPACE}"


@dataclass(frozen=True)
class Verdict:
    """One finding: what was asked, the answer in a word, the detail, and whether it is good."""

    question: str
    answer: str
    detail: str
    mood: str


def heading(experiment: Experiment) -> str:
    """What is not default, in a line."""
    words = []
    for name, value in experiment.changed().items():
        if name == "settings":
            words += [f"{key} {_plain(entry)}" for key, entry in value.items()]
        elif name in ("robot", "method", "ground", "conditions"):
            words.append(_plain(value))
        else:
            words.append(f"{name.replace('mi', 'MI')} {_plain(value)}{_UNITS.get(name, '')}")
    return ", ".join(words) or "all as by default"


def facts(record: Record) -> list[tuple[str, str]]:
    """What was run: name and value."""
    e = record.experiment
    stored = e.parameters()["phi_stored"] if e.settings.get("stored") else None
    changed = [f"{name} {_plain(v)}" for name, v in e.settings.items() if name != "phi_stored"]
    return [
        ("Robot", f"{record.robot.name}, {record.mass:.2f} kg, legs {', '.join(record.legs)}"),
        ("Controller", f"{e.method}, preset {e.preset}, {e.rate:g} Hz"),
        ("Changed parameters", ", ".join(changed) or "none"),
        ("Memory", f"starts with φ {_plain(stored)} rad" if stored else "empty at the start"),
        ("MI", _plain(e.mi)),
        ("Turn", _plain(e.turn)),
        ("Conditions", _plain(e.conditions)),
        ("Ground", _plain(e.ground)),
        ("Seed", str(e.seed)),
        ("Contact", f"{e.contact}, step {1e6 * e.step:.4g} µs"),
    ]


def verdicts(summary: Summary, planned: float) -> list[Verdict]:
    """The three questions a reader has first: did it walk, did the gait form, how fast.

    Args:
        summary: key figures of the run.
        planned: how long it was to last [s].
    """
    return [_walked(summary, planned), _formed(summary), _quality(summary)]


def number(value: float | None, digits: int = 2, unit: str = "") -> str:
    """Fixed-point text with unit, a dash if undefined."""
    if value is None or not math.isfinite(value):
        return DASH
    return f"{value:.{digits}f}{_SPACE * bool(unit)}{unit}"


def rows(summary: Summary) -> list[tuple[str, str, str]]:
    """Rows of the summary table: name, value with unit, what it means."""
    s = summary
    pairs = zip(range(2, 99), s.phi_final, strict=False)
    phases = ", ".join(f"φ1{k}{_SPACE}{phase_text(phase)}" for k, phase in pairs)
    target = metrics.gait_name(len(s.phi_final) + 1).capitalize()
    tolerance = f"within {metrics.STRICT_TOLERANCE} rad to the end"
    return [
        ("Speed along the path", number(s.path_speed_m_per_s, 3, "m/s"), "path smoothed over 1.5 s"),
        ("Turned", _turned(s), "from the first heading to the last"),
        ("Net displacement", number(s.distance_m, 2, "m"), "along the first heading"),
        ("Simulated", number(s.duration_s, 2, "s"), _ending(s)),
        (f"{target}, strict", number(s.convergence_time_s, 2, "s"), tolerance),
        (f"{target}, authors", number(s.convergence_time_authors_s, 2, "s"), "below 2.8 rad, first"),
        ("Final gait", s.gait or DASH, phases),
        ("Gait stored", number(s.stored_at_s, 2, "s"), "neural couplings first on"),
        ("Stride frequency", number(s.stride_frequency_hz, 2, "Hz"), "cycles of the oscillators"),
        ("Duty factor", _by_leg(s.duty_factor), "share of stance"),
        ("Touch-downs per stride", number(s.touch_downs_per_stride), "1 is a clean step"),
        ("Foot lift", _by_leg(s.foot_lift_mm, 1), "mm, mid-swing above stance"),
        ("Slip per stride", _by_leg(s.slip_per_stride_mm, 1), "mm, in stance"),
        (
            "Balance",
            number(s.balance, 1, "1/rad"),
            "1/std roll + 1/std pitch; larger is steadier: 80 is 1.4° of sway, 200 is 0.6°",
        ),
        (
            "Coordination",
            number(s.coordination, 1),
            "1 / spread of the share of stance; larger is more even: 10 is a spread of 0.1",
        ),
        ("Cost of transport", number(s.cost_of_transport), "energy / (m g path); less is better"),
        ("Real-time factor", number(s.real_time_factor, 1, "×"), "simulated / wall time"),
        ("Controller's share", _percent(s.fmu_share_of_wall_time), "of wall time"),
    ]


def phase_text(phase: float | None) -> str:
    """Phase as a multiple of pi, such as 0.98 π."""
    return DASH if phase is None else f"{phase / math.pi:.2f}{_SPACE}π"


_UNITS = {"duration": " s", "rate": " Hz", "step": " s"}


def _plain(value: Any) -> str:
    """A value of an experiment in words: steps, conditions and grounds, too."""
    if isinstance(value, Conditions):
        default = Conditions()
        changed = {f.name: getattr(value, f.name) for f in fields(value)}
        words = [f"{k} {_plain(v)}" for k, v in changed.items() if v != getattr(default, k)]
        return ", ".join(words) or "none"
    if hasattr(value, "text"):
        return str(value.text())
    if isinstance(value, tuple) and value and isinstance(value[0], tuple):
        return steps_text(tuple((start, _plain(entry)) for start, entry in value))
    if isinstance(value, tuple | list):
        return " ".join(_plain(entry) for entry in value)
    if isinstance(value, float):
        return f"{value:.6g}"
    return str(getattr(value, "name", value))


def _ending(s: Summary) -> str:
    return "as planned" if s.complete else f"{s.end}{': ' if s.message else ''}{s.message}"


def _walked(s: Summary, planned: float) -> Verdict:
    question, when = "Did it walk?", number(s.duration_s, 2, "s")
    way = "" if s.path_speed_m_per_s is None else f", after {_way(s)}"
    if s.end == End.fell:
        return Verdict(question, "It fell", f"at {when}{way}", "bad")
    if s.end == End.diverged:
        return Verdict(question, "It diverged", f"at {when}: {s.message}", "bad")
    if s.end == End.interrupted:
        return Verdict(question, "Interrupted", f"at {when} of {planned:g} s{way}", "fair")
    if s.path_speed_m_per_s is None or s.path_speed_m_per_s < metrics.MIN_SPEED:
        return Verdict(question, "No", f"upright, but it got nowhere in {when}", "bad")
    return Verdict(question, "Yes", f"{_way(s)} in {when}, upright throughout", "good")


def _formed(s: Summary) -> Verdict:
    gait = metrics.gait_name(len(s.phi_final) + 1)
    question = f"Did the {gait} form?"
    final = f"ended in {s.gait or 'no known gait'}: {', '.join(map(phase_text, s.phi_final))}"
    if s.end in (End.fell, End.diverged):
        return Verdict(question, DASH, "the run did not last", "plain")
    if s.converged is None:
        return Verdict(question, DASH, "too short, or no gait is known for these legs", "plain")
    if s.converged:
        when = number(s.convergence_time_s, 1, "s")
        until = "the end" if s.complete else "the interruption"
        return Verdict(question, f"After {when}", f"from touch-down, and held to {until}", "good")
    if s.convergence_time_authors_s is not None:
        when = number(s.convergence_time_authors_s, 1, "s")
        return Verdict(question, "Not for good", f"near it at {when}; {final}", "fair")
    return Verdict(question, "No", final, "bad")


def _quality(s: Summary) -> Verdict:
    stride = f"stride {number(s.stride_frequency_hz, 2, 'Hz')}"
    cost = f"cost of transport {number(s.cost_of_transport)}"
    speed = number(s.path_speed_m_per_s, 3, "m/s")
    detail = f"along the path, turned {_turned(s)}; {stride}, {cost}"
    return Verdict("How fast?", speed, detail, "plain")


def _way(s: Summary) -> str:
    return f"{(s.path_speed_m_per_s or 0.0) * s.duration_s:.2f} m of path"


def _turned(s: Summary) -> str:
    if s.turned_deg is None:
        return DASH
    side = "left" if s.turned_deg > 0 else "right"
    return f"{abs(s.turned_deg):.0f}° to the {side}" if abs(s.turned_deg) >= 0.5 else "0°"


def _by_leg(values: dict[str, float | None], digits: int = 2) -> str:
    return ", ".join(f"{leg}{_SPACE}{number(value, digits)}" for leg, value in values.items())


def _percent(share: float | None) -> str:
    return DASH if share is None else f"{100 * share:.1f}{_SPACE}%"

"""The findings of a run in plain words and formatted figures."""

from __future__ import annotations

import math
from dataclasses import dataclass

from apnc.metrics.motion import MIN_SPEED
from apnc.summary import Summary

DASH = "–"


@dataclass(frozen=True)
class Verdict:
    """One finding: what was asked, the answer in a word, the detail, and whether it is good."""

    question: str
    answer: str
    detail: str
    mood: str


def verdicts(summary: Summary) -> list[Verdict]:
    """The three questions a reader has first: did it walk, did the gait form, how well."""
    return [_walked(summary), _formed(summary), _quality(summary)]


def gait_name(summary: Summary) -> str:
    """Name of the target gait."""
    return {3: "trot", 5: "tripod"}.get(len(summary.phi_final), "gait")


def number(value: float | None, digits: int = 2, unit: str = "") -> str:
    """Fixed-point text with unit, a dash if undefined."""
    if value is None or not math.isfinite(value):
        return DASH
    return f"{value:.{digits}f}{unit}"


def rows(summary: Summary) -> list[tuple[str, str, str]]:
    """Rows of the summary table: name, value with unit, what it means."""
    s = summary
    legs = ", ".join(
        f"{leg}\N{NO-BREAK SPACE}{number(duty)}" for leg, duty in s.duty_factor.items()
    )
    pairs = zip(range(2, 9), s.phi_final, strict=False)
    phases = ", ".join(f"φ1{k}\N{NO-BREAK SPACE}{phase_text(phase)}" for k, phase in pairs)
    name = gait_name(s).capitalize()
    return [
        ("Controller", f"{s.method.upper()}, MI {s.mi:g}, seed {s.seed}", ""),
        ("Simulated", number(s.duration_s, 2, " s") + ("" if s.complete else " (interrupted)"), ""),
        ("Forward speed", number(s.speed_m_per_s, 3, " m/s"), "along the initial heading"),
        ("Speed along path", number(s.path_speed_m_per_s, 3, " m/s"), "smoothed path"),
        (f"{name}, strict", number(s.convergence_time_s, 2, " s"), "within 0.6 rad to the end"),
        (f"{name}, authors", number(s.convergence_time_authors_s, 2, " s"), "below 2.8 rad, first"),
        ("Final phases", phases, ""),
        ("Stride frequency", number(s.stride_frequency_hz, 2, " Hz"), ""),
        ("Duty factor", legs, "share of stance"),
        ("Balance", number(s.balance, 1, " 1/rad"), "1/std roll + 1/std pitch"),
        ("Coordination", number(s.coordination, 1), "1 / spread of duty factor"),
        ("Cost of transport", number(s.cost_of_transport, 2), "energy / (m g distance)"),
        ("Real-time factor", number(s.real_time_factor, 1, " ×"), "simulated / wall time"),
        ("FMU share", _percent(s.fmu_share_of_wall_time), "of wall time"),
    ]


def phase_text(phase: float | None) -> str:
    """Phase as a multiple of pi, such as 0.98 π."""
    return DASH if phase is None else f"{phase / math.pi:.2f}\N{NO-BREAK SPACE}π"


def _walked(s: Summary) -> Verdict:
    question = "Did it walk?"
    span = number(s.duration_s, 1, " s") + ("" if s.complete else ", interrupted")
    if s.fell:
        return Verdict(
            question, "It fell", f"trunk on the ground or beyond 60° within {span}", "bad"
        )
    speed = s.path_speed_m_per_s
    if speed is None or speed < MIN_SPEED:
        return Verdict(question, "No", f"upright, but it got nowhere in {span}", "bad")
    if (s.speed_m_per_s or 0.0) < MIN_SPEED:
        return Verdict(question, "Not forward", f"{_distance(s)} in {span}, upright", "fair")
    return Verdict(question, "Yes", f"{_distance(s)} in {span}, upright throughout", "good")


def _formed(s: Summary) -> Verdict:
    gait = gait_name(s)
    question = f"Did the {gait} form?"
    final = ", ".join(phase_text(p) for p in s.phi_final)
    if s.converged is None:
        return Verdict(question, "Unknown", "no target gait for this number of legs", "fair")
    if s.converged:
        when = number(s.convergence_time_s, 1, " s")
        return Verdict(question, f"After {when}", "from touch-down, and held to the end", "good")
    if s.convergence_time_authors_s is not None:
        when = number(s.convergence_time_authors_s, 1, " s")
        return Verdict(question, "Not for good", f"near it at {when}; ended at {final}", "fair")
    return Verdict(question, "No", f"ended at {final}", "bad")


def _quality(s: Summary) -> Verdict:
    detail = (
        f"stride {number(s.stride_frequency_hz, 2, ' Hz')}, "
        f"cost of transport {number(s.cost_of_transport, 2)}"
    )
    return Verdict("How fast?", number(s.speed_m_per_s, 3, " m/s"), detail, "plain")


def _distance(s: Summary) -> str:
    distance = s.distance_m or 0.0
    return f"{abs(distance):.2f} m {'forward' if distance >= 0 else 'backward'}"


def _percent(share: float | None) -> str:
    return DASH if share is None else f"{100 * share:.1f} %"

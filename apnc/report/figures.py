"""The panels of a walk's report."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from apnc import metrics
from apnc.report import theme
from apnc.report.encoding import float32
from apnc.report.figure import Figure, Trace
from apnc.report.panels import Array, Run, line, stacked
from apnc.report.skeleton import clearance, in_ground

PI_TICKS: Final = {
    "tickvals": [-np.pi / 2, 0.0, np.pi / 2, np.pi, 3 * np.pi / 2],
    "ticktext": ["−π/2", "0", "π/2", "π", "3π/2"],
}
# Columns of a joint in the channels per joint.
_HIP, _KNEE = 1, 2


def all_figures(run: Run) -> list[Figure]:
    """Every panel in reading order; the record has at least one sample."""
    makers: list[Callable[[Run], Figure]] = [
        *(gait, phases, speed, path, trunk, clearances, loads, outputs),
        *(gains, stability, hips, knees, torques),
    ]
    return [make(run) for make in makers]


def gait(run: Run) -> Figure:
    """Gait diagram: a bar where a foot stands."""
    record = run.record
    standing = metrics.stance(record.plant["foot_force"][..., 2])
    bars = [_bars(run, i, column) for i, column in enumerate(standing.T)]
    again = _second_touches(run, standing)
    n = record.n_legs
    names = [f'<b style="color:{colour}">{leg}</b>' for leg, colour in run.colours.items()]
    ticks = {"tickvals": list(range(n)), "ticktext": names, "range": [n - 0.4, -0.6]}
    layout = theme.layout(
        90 + 32 * n,
        xaxis=theme.axis("time [s]"),
        yaxis=theme.axis("leg", fixedrange=True, showgrid=False, **ticks),
        hovermode="closest",
    )
    target = metrics.gait_name(n)
    note = f"Black: the foot stands. Legs that are in phase in the {target} stand together."
    return Figure("gait", "Gait diagram", note, [*bars, again], layout)


def phases(run: Run) -> Figure:
    """Relative phases against the target gait and the tolerance of the strict criterion."""
    c, legs, target = run.record.controller, run.record.legs, run.summary.phi_target
    smoothed = metrics.relative_phases(c["o1"], c["o2"])
    traces: list[Trace] = []
    for k, leg in enumerate(legs[1:]):
        name, colour = f"φ1{k + 2} ({legs[0]}–{leg})", run.colours[leg]
        own = {"width": 1, "dash": "dot", "visible": "legendonly"}
        traces.append(line(_uncut(run.samples.of(smoothed[:, k])), name, colour, width=2.4))
        seen = _uncut(run.samples.of(c["phi"][:, k]))
        traces.append(line(seen, f"φ1{k + 2} in the FMU", colour, **own))
    shown = metrics.wrap_for_display(target) if target else []
    levels = sorted({round(float(level), 6) for level in shown})
    layout = theme.layout(
        330,
        xaxis=theme.axis("time [s]"),
        yaxis=theme.axis("relative phase [rad]", range=[-np.pi / 2, 3 * np.pi / 2], **PI_TICKS),
        shapes=[shape for level in levels for shape in (_band(level), _level(level))],
    )
    note = (
        f"Smoothed over 1.5 s; positive where the leg is ahead of {legs[0]}. Dashed: target gait "
        f"({metrics.gait_name(len(legs))}) with the ±{metrics.STRICT_TOLERANCE} rad of the strict "
        "criterion. Dotted, by a click on the legend: the phase that the FMU estimates."
    )
    return Figure("phi", "Relative phases", note, traces, layout)


def speed(run: Run) -> Figure:
    """Speed along the heading, raw and smoothed, and the mean along the path."""
    plant, mean = run.record.plant, run.summary.path_speed_m_per_s
    yaw = plant["rpy"][:, 2]
    raw = plant["velocity"][:, 0] * np.cos(yaw) + plant["velocity"][:, 1] * np.sin(yaw)
    slow = metrics.smoothed_speed(run.record.time, plant["position"], yaw)
    traces = [
        run.line(raw, "trunk", theme.SKY, width=0.8, opacity=0.55),
        run.line(slow, "smoothed over 1.5 s", theme.BLUE, width=2.4),
    ]
    layout = theme.layout(
        260,
        xaxis=theme.axis("time [s]"),
        yaxis=theme.axis("speed [m/s]", rangemode="tozero"),
        shapes=[] if mean is None else [_level(mean)],
    )
    note = "Along the present heading. Dashed: mean along the path."
    return Figure("speed", "Forward speed", note, traces, layout)


def path(run: Run) -> Figure:
    """Trunk path from above, equal axes, start and end marked."""
    x, y = run.record.plant["position"][run.samples.at, :2].T
    track = line(y, "trunk", theme.BLUE) | {"x": float32(x)}
    ends = [
        _points(x[:1], y[:1], "start", "circle-open", theme.GREEN),
        _points(x[-1:], y[-1:], "end", "circle", theme.VERMILLION),
    ]
    layout = theme.layout(
        330,
        xaxis=theme.axis("x [m]"),
        yaxis=theme.axis("y [m]", scaleanchor="x", scaleratio=1),
        hovermode="closest",
    )
    note = "Seen from above, equal scales; the robot starts along x."
    return Figure("path", "Path of the trunk", note, [track, *ends], layout, over_time=False)


def trunk(run: Run) -> Figure:
    """Height over the ground and attitude of the trunk."""
    plant = run.record.plant
    height = in_ground(run.record.experiment.ground, plant["position"])[:, 2]
    roll, pitch, yaw = np.degrees(np.unwrap(plant["rpy"], axis=0)).T
    signals = [
        ("height [m]", height),
        ("roll [°]", roll),
        ("pitch [°]", pitch),
        ("yaw [°]", yaw),
    ]
    look = {"showlegend": False, "width": 1.4}
    rows = [(name, [run.line(values, name, theme.BLUE, **look)]) for name, values in signals]
    note = (
        "Height over the plane of the ground; angles against the horizontal. Positive: left side "
        "up (roll), nose down (pitch), to the left (yaw)."
    )
    return stacked("trunk", "Height and attitude of the trunk", note, rows)


def clearances(run: Run) -> Figure:
    """Height of the feet over the ground."""
    record, at = run.record, run.samples.at
    gap = 1000.0 * clearance(record.experiment.ground, record.robot, record.plant, at)
    rows = [
        (f"<b>{leg}</b> [mm]", [line(gap[:, i], leg, colour, showlegend=False)])
        for i, (leg, colour) in enumerate(run.colours.items())
    ]
    note = (
        "Lowest point of the foot over the ground below it; negative where it sinks in, or "
        "touches the flank of an obstacle."
    )
    return stacked("clearance", "Foot clearance", note, rows, matches="y")


def loads(run: Run) -> Figure:
    """Vertical ground force and sensor signal."""
    force = run.record.plant["foot_force"][..., 2]
    # A handful of impacts may be ten times the load of a step and would flatten every step.
    usual = float(np.nanquantile(force, 0.995))
    series = {"force of the ground": force, "sensor": run.record.plant["grf"]}
    note = (
        "Vertical force of the ground on the foot, and what the sensor of the foot tells the FMU. "
        "The rows are made for the loads of walking and cut off impact peaks; Autoscale shows all."
    )
    limits = (-0.05 * usual, max(1.2 * usual, 1.0))
    return run.leg_rows("grf", "Ground reaction forces", "N", series, note, limits)


def outputs(run: Run) -> Figure:
    """CPG outputs."""
    series = {"o1 (hip)": run.record.controller["o1"], "o2 (knee)": run.record.controller["o2"]}
    note = "o1 drives the hip, o2 the knee."
    return run.leg_rows("cpg", "CPG outputs", "1", series, note, (-1.2, 1.2))


def gains(run: Run) -> Figure:
    """Adaptive feedback gain gamma per leg."""
    layout = theme.layout(
        260, xaxis=theme.axis("time [s]"), yaxis=theme.axis("γ [1]", rangemode="tozero")
    )
    note = "Gain of the load feedback on each CPG, learned while walking (Eq. 9)."
    traces = run.per_leg(run.record.controller["gamma"])
    return Figure("gamma", "Sensory feedback gain γ", note, traces, layout)


def stability(run: Run) -> Figure:
    """Phase variance d and switch kappa of the neural coupling."""
    d = run.line(run.record.controller["d"], "d, left axis", theme.INK)
    area = {"yaxis": "y2", "fill": "tozeroy", "fillcolor": "rgba(213, 94, 0, 0.10)"}
    kappa = run.line(run.record.controller["kappa"], "κ, right axis", theme.VERMILLION, **area)
    kappa["line"]["shape"] = "hv"
    right = {"overlaying": "y", "side": "right", "range": [0, 1.08], "tickvals": [0, 1]}
    layout = theme.layout(
        260,
        xaxis=theme.axis("time [s]"),
        yaxis=theme.axis("d [rad]", rangemode="tozero"),
        yaxis2=theme.axis("κ [1]", showgrid=False, **right),
    )
    note = "κ = 1: the neural coupling (ANC) holds the stored phases. d: how much they still vary."
    return Figure("kappa", "Phase stability d and coupling switch κ", note, [kappa, d], layout)


def hips(run: Run) -> Figure:
    """Commanded and actual hip angles."""
    return _joint(run, "hip", _HIP, "positive swings the leg forward")


def knees(run: Run) -> Figure:
    """Commanded and actual knee angles."""
    return _joint(run, "knee", _KNEE, "positive swings the foot forward and up")


def torques(run: Run) -> Figure:
    """Hip and knee torque."""
    torque = run.record.plant["joint_torque"]
    series = {"hip": torque[..., _HIP], "knee": torque[..., _KNEE]}
    note = "Torque of the servos on the joints, in the direction of positive angles."
    return run.leg_rows("torque", "Joint torques", "N m", series, note)


def _joint(run: Run, joint: str, column: int, sign: str) -> Figure:
    record = run.record
    series = {
        "actual": np.degrees(record.plant["joint_angle"][..., column]),
        "commanded": np.degrees(record.controller[f"theta_{joint}"]),
    }
    note = f"Against the reference pose; {sign}. Commanded: by the FMU, before slew and latency."
    return run.leg_rows(joint, f"{joint.capitalize()} angles", "°", series, note)


def _bars(run: Run, row: int, standing: NDArray[np.bool_]) -> Trace:
    record = run.record
    edges = np.flatnonzero(np.diff(np.concatenate([[0], standing.astype(np.int8), [0]])))
    ends = np.append(record.time, record.ended_at)[edges]
    # One broken line instead of thousands of bars: a long run stays quick.
    x = np.insert(ends, np.arange(2, len(ends) + 1, 2), np.nan)
    bars = line(np.full(len(x), float(row)), record.legs[row], theme.BLACK, width=20)
    hover = f"{record.legs[row]}, %{{x:.2f}} s<extra></extra>"
    return bars | {"x": float32(x), "showlegend": False, "hovertemplate": hover}


def _second_touches(run: Run, standing: NDArray[np.bool_]) -> Trace:
    """Marks where a foot comes down again in the same cycle of its oscillator."""
    c = run.record.controller
    starts = metrics.cycle_starts(c["o1"], c["o2"])
    x, rows = [], []
    for row, (column, start) in enumerate(zip(standing.T, starts, strict=True)):
        downs = np.flatnonzero(column[1:] & ~column[:-1]) + 1
        cycle = np.searchsorted(start, downs, side="right")
        again = downs[1:][np.diff(cycle) == 0]
        x.append(run.record.time[again])
        rows.append(np.full(len(again), float(row)))
    name = "second touch-down in a cycle"
    touches = _points(np.concatenate(x), np.concatenate(rows), name, "diamond", theme.VERMILLION)
    touches["marker"] |= {"size": 9, "line": {"width": 1, "color": "#ffffff"}}
    return touches


def _level(y: float) -> Trace:
    style = {"color": theme.GREY, "width": 1.2, "dash": "dash"}
    return {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": y, "y1": y, "line": style}


def _band(y: float) -> Trace:
    fill = {"fillcolor": theme.BAND, "line": {"width": 0}, "layer": "below"}
    low, high = y - metrics.STRICT_TOLERANCE, y + metrics.STRICT_TOLERANCE
    return {"type": "rect", "xref": "paper", "x0": 0, "x1": 1, "y0": low, "y1": high} | fill


def _uncut(phase: Array) -> Array:
    """The phase as shown, without the strokes where it leaves on one side and comes back."""
    shown = metrics.wrap_for_display(phase)
    shown[1:][np.abs(np.diff(shown)) > np.pi] = np.nan
    return shown


def _points(x: Array, y: Array, name: str, symbol: str, colour: str) -> Trace:
    style: dict[str, Any] = {"symbol": symbol, "size": 12, "color": colour, "line": {"width": 2.5}}
    at = {"x": float32(x), "y": float32(y)}
    return {"type": "scatter", "mode": "markers", "name": name, "marker": style} | at

"""The plots of the report, as plain plotly figures; time plots share one time vector."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from apnc import metrics
from apnc.loop.recording import Record
from apnc.report import theme
from apnc.report.encoding import float32
from apnc.report.panels import leg_panels
from apnc.summary import Summary

Trace = dict[str, Any]

PI_TICKS: Final = {
    "tickvals": [-np.pi / 2, 0.0, np.pi / 2, np.pi, 3 * np.pi / 2],
    "ticktext": ["−π/2", "0", "π/2", "π", "3π/2"],
}
# A jump larger than this between two samples is the cut of the display, not motion.
_CUT: Final = np.pi


@dataclass(frozen=True)
class Figure:
    """One plot: element id, heading, a line on how to read it, traces, layout, kind of x-axis."""

    key: str
    title: str
    note: str
    data: list[Trace]
    layout: dict[str, Any]
    over_time: bool = True


def all_figures(record: Record, summary: Summary) -> list[Figure]:
    """Every plot of the report in reading order."""
    makers: list[Callable[[Record, Summary], Figure]] = [
        gait,
        phases,
        loads,
        outputs,
        gains,
        stability,
        speed,
        torques,
        path,
    ]
    return [make(record, summary) for make in makers]


def line(y: NDArray[np.float64], name: str, colour: str, **more: Any) -> Trace:
    """Line over the shared time vector."""
    style = {"color": colour, "width": more.pop("width", 1.6), "dash": more.pop("dash", "solid")}
    return {"type": "scatter", "mode": "lines", "y": float32(y), "name": name, "line": style} | more


def gait(record: Record, _: Summary) -> Figure:
    """Gait diagram: black bars where a foot stands."""
    colours = theme.leg_colours(record.legs)
    standing = metrics.stance(record.plant["foot_force"][..., 2])
    tick = float(np.median(np.diff(record.time))) if len(record) > 1 else 0.0
    bars = [_bars(record, leg, standing[:, i], tick) for i, leg in enumerate(record.legs)]
    rows = {
        "categoryorder": "array",
        "categoryarray": list(reversed(record.legs)),
        "tickvals": list(record.legs),
        "ticktext": [f'<b style="color:{colours[leg]}">{leg}</b>' for leg in record.legs],
        "fixedrange": True,
        "showgrid": False,
    }
    layout = theme.layout(
        90 + 32 * record.n_legs,
        xaxis=theme.axis("time [s]"),
        yaxis=theme.axis("leg", type="category", **rows),
        showlegend=False,
        barmode="overlay",
        hovermode="closest",
        margin={"l": 74, "r": 46, "t": 30, "b": 44},
    )
    note = "Black: the foot stands. In a trot diagonal legs stand together (RF with LH)."
    return Figure("gait", "Gait diagram", note, bars, layout)


def phases(record: Record, summary: Summary) -> Figure:
    """Relative phases against the target gait and the tolerance of the strict criterion."""
    colours = theme.leg_colours(record.legs)
    smoothed = metrics.relative_phases(record.controller["o1"], record.controller["o2"])
    traces: list[Trace] = []
    for k, leg in enumerate(record.legs[1:]):
        name = f"φ1{k + 2} ({record.legs[0]}–{leg})"
        own = {"width": 1, "dash": "dot", "visible": "legendonly"}
        seen = record.controller["phi"][:, k]
        traces.append(line(_uncut(smoothed[:, k]), name, colours[leg], width=2.4))
        traces.append(line(_uncut(seen), f"φ1{k + 2} in the FMU", colours[leg], **own))
    layout = theme.layout(
        330,
        xaxis=theme.axis("time [s]"),
        yaxis=theme.axis("relative phase [rad]", range=[-np.pi / 2, 3 * np.pi / 2], **PI_TICKS),
        shapes=_targets(summary),
    )
    note = (
        "Smoothed over 1.5 s. Dashed: target gait, with the ±0.6 rad band of the strict criterion. "
        "Click a legend entry to add the phase the FMU itself estimates."
    )
    return Figure("phi", "Relative phases", note, traces, layout)


def loads(record: Record, _: Summary) -> Figure:
    """Vertical ground force and sensor signal, one row per leg."""
    force = record.plant["foot_force"][..., 2]
    sensed = record.plant["grf"]
    series = [("ground", force, 1.6, "solid", 1.0), ("sensor", sensed, 1.2, "dot", 0.8)]
    data, layout = leg_panels(record.legs, series, "GRF [N]", _load_range(record))
    note = (
        "Solid: force of the ground on the foot. Dotted: what the foot sensor tells the FMU. "
        "The frame is made for the loads of walking and cuts off impact peaks; Autoscale shows all."
    )
    return Figure("grf", "Ground reaction forces", note, data, layout)


def outputs(record: Record, _: Summary) -> Figure:
    """CPG outputs, one row per leg."""
    c = record.controller
    series = [("o1 (hip)", c["o1"], 1.8, "solid", 1.0), ("o2 (knee)", c["o2"], 1.2, "dot", 0.9)]
    data, layout = leg_panels(record.legs, series, "output [1]", (-1.2, 1.2))
    return Figure("cpg", "CPG outputs", "o1 drives the hip, o2 the knee.", data, layout)


def gains(record: Record, _: Summary) -> Figure:
    """Adaptive feedback gain gamma per leg."""
    colours = theme.leg_colours(record.legs)
    gamma = record.controller["gamma"]
    traces = [line(gamma[:, i], leg, colours[leg]) for i, leg in enumerate(record.legs)]
    layout = theme.layout(
        260, xaxis=theme.axis("time [s]"), yaxis=theme.axis("γ [1]", rangemode="tozero")
    )
    note = "Gain of the load feedback on each CPG (Eq. 9), learned while walking."
    return Figure("gamma", "Sensory feedback gain γ", note, traces, layout)


def stability(record: Record, _: Summary) -> Figure:
    """Phase variance d and switch kappa of the neural coupling."""
    d = line(record.controller["d"], "d, left axis", theme.INK)
    switch = {"dash": "solid", "yaxis": "y2", "fill": "tozeroy", "width": 1.6}
    kappa = line(record.controller["kappa"], "κ, right axis", theme.VERMILLION, **switch)
    kappa["fillcolor"] = "rgba(213, 94, 0, 0.10)"
    kappa["line"]["shape"] = "hv"
    right = theme.axis(
        "κ [1]",
        overlaying="y",
        side="right",
        range=[0, 1.08],
        showgrid=False,
        tickvals=[0, 1],
        tickmode="array",
    )
    layout = theme.layout(
        260,
        xaxis=theme.axis("time [s]"),
        yaxis=theme.axis("d [rad]", rangemode="tozero"),
        yaxis2=right,
    )
    note = "κ = 1: the neural coupling (ANC) holds the stored phases. d: how much they still vary."
    return Figure("kappa", "Phase stability d and coupling switch κ", note, [kappa, d], layout)


def speed(record: Record, summary: Summary) -> Figure:
    """Forward speed over time, raw and smoothed, with the mean."""
    plant = record.plant
    yaw = plant["rpy"][:, 2]
    raw = plant["velocity"][:, 0] * np.cos(yaw) + plant["velocity"][:, 1] * np.sin(yaw)
    slow = metrics.smoothed_speed(record.time, plant["position"], yaw)
    traces = [
        line(raw, "trunk", theme.SKY, width=0.8, opacity=0.55),
        line(slow, "smoothed over 1.5 s", theme.BLUE, width=2.4),
    ]
    mean = summary.speed_m_per_s
    shapes = [] if mean is None else [_level(mean)]
    layout = theme.layout(
        260,
        xaxis=theme.axis("time [s]"),
        yaxis=theme.axis("speed [m/s]", rangemode="tozero"),
        shapes=shapes,
    )
    note = "Along the current heading. Dashed: mean over the run, along the initial heading."
    return Figure("speed", "Forward speed", note, traces, layout)


def torques(record: Record, _: Summary) -> Figure:
    """Hip and knee torque, one row per leg."""
    torque = record.plant["joint_torque"]
    series = [
        ("hip", torque[..., 1], 1.6, "solid", 1.0),
        ("knee", torque[..., 2], 1.2, "dot", 0.9),
    ]
    data, layout = leg_panels(record.legs, series, "torque [N m]")
    return Figure("torque", "Joint torques", "Torque of the servos.", data, layout)


def path(record: Record, _: Summary) -> Figure:
    """Trunk path from above, equal axes, start and end marked."""
    x, y = record.plant["position"][:, 0], record.plant["position"][:, 1]
    track = line(y, "trunk path", theme.BLUE) | {"x": float32(x)}
    ends = [
        _marker(x[:1], y[:1], "start", "circle-open", theme.GREEN),
        _marker(x[-1:], y[-1:], "end", "circle", theme.VERMILLION),
    ]
    layout = theme.layout(
        330,
        xaxis=theme.axis("x [m]"),
        yaxis=theme.axis("y [m]", scaleanchor="x", scaleratio=1),
        hovermode="closest",
    )
    note = "Seen from above, equal scales."
    return Figure("path", "Trunk path", note, [track, *ends], layout, over_time=False)


def _bars(record: Record, leg: str, standing: NDArray[np.bool_], tick: float) -> Trace:
    edges = np.flatnonzero(np.diff(np.concatenate([[0], standing.astype(np.int8), [0]])))
    begins, ends = edges[::2], edges[1::2]
    return {
        "type": "bar",
        "orientation": "h",
        "name": leg,
        "base": [round(float(b), 4) for b in record.time[begins]],
        "x": [round(float(length), 4) for length in (ends - begins) * tick],
        "y": [leg] * len(begins),
        "width": 0.62,
        "marker": {"color": "#111418", "line": {"width": 0}},
        "hovertemplate": f"{leg} stands for %{{x:.2f}} s<extra></extra>",
    }


def _load_range(record: Record) -> tuple[float, float]:
    force = record.plant["foot_force"][..., 2]
    # A handful of impacts may be ten times the load of a step and would flatten every step.
    usual = float(np.quantile(force, 0.995))
    return -0.05 * usual, max(1.2 * usual, 1.0)


def _targets(summary: Summary) -> list[Trace]:
    levels = sorted({round(t, 6) for t in summary.phi_target or ()})
    return [shape for level in levels for shape in (_band(level), _level(level))]


def _level(y: float) -> Trace:
    style = {"color": theme.GREY, "width": 1.2, "dash": "dash"}
    return {"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": y, "y1": y, "line": style}


def _band(y: float, half: float = metrics.STRICT_TOLERANCE) -> Trace:
    fill = {"fillcolor": theme.BAND, "line": {"width": 0}, "layer": "below"}
    return {
        "type": "rect",
        "xref": "paper",
        "x0": 0,
        "x1": 1,
        "y0": y - half,
        "y1": y + half,
    } | fill


def _uncut(phase: NDArray[np.float64]) -> NDArray[np.float64]:
    shown = metrics.wrap_for_display(phase)
    shown[1:][np.abs(np.diff(shown)) > _CUT] = np.nan
    return shown


def _marker(
    x: NDArray[np.float64], y: NDArray[np.float64], name: str, symbol: str, colour: str
) -> Trace:
    style = {"symbol": symbol, "size": 12, "color": colour, "line": {"width": 2.5}}
    points = {"x": float32(x), "y": float32(y)}
    return {"type": "scatter", "mode": "markers", "name": name, "marker": style} | points

"""The figures of a walk's report."""

from __future__ import annotations

from typing import Any, Final

import numpy as np

from apnc import metrics
from apnc.report import theme
from apnc.report.encoding import Signal
from apnc.report.figure import Figure, Trace
from apnc.report.lines import Run, line, stacked
from apnc.report.skeleton import clearance, in_ground
from apnc_core.types import Array
from apnc_plant.signals import JOINT_SIGNS, JOINTS

PI_TICKS: Final = {
    "tickvals": [-np.pi / 2, 0.0, np.pi / 2, np.pi, 3 * np.pi / 2],
    "ticktext": ["−π/2", "0", "π/2", "π", "3π/2"],
}


def all_figures(run: Run) -> list[Figure]:
    """Every figure in reading order."""
    makers = (gait, phases, _speed, _path, _trunk, _clearances, _loads, outputs, _gains)
    joints = [_angles(run, joint) for joint in ("hip", "knee")]
    return [*(make(run) for make in makers), _stability(run), *joints, _torques(run)]


def _over_time(key: str, title: str, note: str, data: list[Trace], y: Any, **more: Any) -> Figure:
    layout = theme.layout(more.pop("height", 260), xaxis=theme.axis("time [s]"), yaxis=y, **more)
    return Figure(key, title, note, data, layout)


def gait(run: Run) -> Figure:
    """Which feet stand, over time."""
    n, target = run.record.n_legs, metrics.gait_name(run.record.n_legs)
    names = [f'<b style="color:{colour}">{leg}</b>' for leg, colour in run.colours.items()]
    rows = {"tickvals": list(range(n)), "ticktext": names, "range": [n - 0.4, -0.6]}
    return _over_time(
        "gait",
        "Gait diagram",
        f"Bars: the foot stands. Legs that are in phase in the {target} stand together.",
        [*(_bars(run, row) for row in range(n)), _second_touches(run)],
        theme.axis("leg", fixedrange=True, showgrid=False, **rows),
        height=90 + 32 * n,
        hovermode="closest",
    )


def phases(run: Run) -> Figure:
    """Relative phases of the oscillators, and the target gait."""
    c, legs, target = run.record.signals, run.record.legs, run.summary.phi_target
    smoothed = metrics.relative_phases(c["o1"], c["o2"])
    own = {"width": 1, "dash": "dot", "visible": "legendonly", "legendgroup": "fmu"}
    traces = []
    for k, leg in enumerate(legs[1:]):
        # one entry for all, since with six legs the legend would cover the plot above
        one, more = own | {"showlegend": k == 0}, " …" if k == 0 else ""
        for name, phi, style in (
            (f"φ1{k + 2} ({legs[0]}–{leg})", smoothed[:, k], {"width": 2.4}),
            (f"φ1{k + 2}{more} in the FMU", c["phi"][:, k], one),
        ):
            traces.append(line(_uncut(run.samples.of(phi)), name, run.colours[leg], **style))
    levels = sorted({round(float(metrics.wrap_for_display(phi)), 6) for phi in target or ()})
    return _over_time(
        "phi",
        "Relative phases",
        f"Smoothed over 1.5 s; positive where the leg is ahead of {legs[0]}. Dashed: target gait "
        f"({metrics.gait_name(len(legs))}) with the ±{metrics.STRICT_TOLERANCE} rad of the strict "
        "criterion. Click on the legend to show the phases that the FMU estimates, dotted.",
        traces,
        theme.axis("relative phase [rad]", range=[-np.pi / 2, 3 * np.pi / 2], **PI_TICKS),
        height=330,
        shapes=[
            *(_level(y, "rect", metrics.STRICT_TOLERANCE) for y in levels),
            *(_level(y) for y in levels),
        ],
    )


def _speed(run: Run) -> Figure:
    plant, mean = run.record.signals, run.summary.path_speed_m_per_s
    yaw = plant["rpy"][:, 2]
    raw = plant["velocity"][:, 0] * np.cos(yaw) + plant["velocity"][:, 1] * np.sin(yaw)
    slow = metrics.smoothed_speed(run.record.time, plant["position"], yaw)
    return _over_time(
        "speed",
        "Forward speed",
        "Along the present heading. Dashed: mean along the path.",
        [
            run.line(raw, "trunk", theme.SKY, width=0.8, opacity=0.55),
            run.line(slow, "smoothed over 1.5 s", theme.BLUE, width=2.4),
        ],
        theme.axis("speed [m/s]", rangemode="tozero"),
        shapes=[] if mean is None else [_level(mean)],
    )


def _path(run: Run) -> Figure:
    x, y = run.shown["position"][:, :2].T
    traces = [
        line(y, "trunk", theme.BLUE) | {"x": Signal(x)},
        _points(x[:1], y[:1], "start", "circle-open", theme.GREEN),
        _points(x[-1:], y[-1:], "end", "circle", theme.VERMILLION),
    ]
    equal = theme.axis("y [m]", scaleanchor="x", scaleratio=1)
    layout = theme.layout(330, xaxis=theme.axis("x [m]"), yaxis=equal, hovermode="closest")
    note = "Seen from above, equal scales; the robot starts along x."
    return Figure("path", "Path of the trunk", note, traces, layout, over_time=False)


def _trunk(run: Run) -> Figure:
    plant = run.record.signals
    height = in_ground(run.record.experiment.ground, plant["position"])[:, 2]
    angles = np.degrees(np.unwrap(plant["rpy"], axis=0)).T
    names = ("height [m]", "roll [°]", "pitch [°]", "yaw [°]")
    note = (
        "Height over the plane of the ground; angles against the horizontal. Positive: left side "
        "up (roll), nose down (pitch), to the left (yaw)."
    )
    rows = [
        (name, [run.line(values, name, theme.BLUE, showlegend=False)])
        for name, values in zip(names, [height, *angles], strict=True)
    ]
    return stacked("trunk", "Height and attitude of the trunk", note, rows)


def _clearances(run: Run) -> Figure:
    robot, ground = run.record.robot, run.record.experiment.ground
    gap = 1000.0 * clearance(ground, robot, run.shown["foot_position"])
    rows = [
        (f"<b>{leg}</b> [mm]", [line(gap[:, i], leg, colour, showlegend=False)])
        for i, (leg, colour) in enumerate(run.colours.items())
    ]
    note = "Lowest point of the foot over the ground below it; negative where the foot sinks in."
    return stacked("clearance", "Foot clearance", note, rows, matches="y")


def _loads(run: Run) -> Figure:
    force = run.record.signals["foot_force"][..., 2]
    # a few impacts of ten times the load of a step would make every step look flat
    usual = max(float(np.nanquantile(force, 0.995)), 1.0)
    series = {"force of the ground": force, "sensor": run.record.signals["grf"]}
    note = (
        "Vertical force of the ground on the foot, and the load that the sensor of the foot sends "
        "to the FMU. Peaks of impacts are cut off; Autoscale shows them."
    )
    limits = [-0.05 * usual, 1.2 * usual]
    return run.leg_rows("grf", "Ground reaction forces", "N", series, note, range=limits)


def outputs(run: Run) -> Figure:
    """Outputs of the oscillators, a row per leg."""
    series = {"o1 (hip)": run.record.signals["o1"], "o2 (knee)": run.record.signals["o2"]}
    note = "o1 drives the hip, o2 the knee."
    return run.leg_rows("cpg", "CPG outputs", "1", series, note, range=[-1.2, 1.2])


def _gains(run: Run) -> Figure:
    gamma = run.record.signals["gamma"].T
    lines = [run.line(g, *leg) for g, leg in zip(gamma, run.colours.items(), strict=True)]
    note = (
        "Gain with which the load feedback acts on each CPG. It is learned while walking (Eq. 9), "
        "and multiplied by feedback_kept once the couplings are on."
    )
    axis = theme.axis("γ [1]", rangemode="tozero")
    return _over_time("gamma", "Sensory feedback gain γ", note, lines, axis)


def _stability(run: Run) -> Figure:
    d = run.line(run.record.signals["d"], "d, left axis", theme.INK)
    area = {"yaxis": "y2", "fill": "tozeroy", "fillcolor": "rgba(213, 94, 0, 0.10)"}
    kappa = run.line(run.record.signals["kappa"], "κ, right axis", theme.VERMILLION, **area)
    kappa["line"]["shape"] = "hv"
    right = {"overlaying": "y", "side": "right", "range": [0, 1.08], "tickvals": [0, 1]}
    return _over_time(
        "kappa",
        "Phase stability d and coupling switch κ",
        "κ = 1: the neural coupling (ANC) keeps the stored phases. d: how much the phases vary.",
        [kappa, d],
        theme.axis("d [rad]", rangemode="tozero"),
        yaxis2=theme.axis("κ [1]", showgrid=False, **right),
    )


def _angles(run: Run, joint: str) -> Figure:
    actual = run.record.signals["joint_angle"][..., JOINTS.index(joint)]
    commanded = run.record.signals[f"theta_{joint}"]
    series = {"actual": np.degrees(actual), "commanded": np.degrees(commanded)}
    note = (
        f"Measured from the reference pose; a positive angle {JOINT_SIGNS[joint]}. Commanded: "
        "output of the FMU, before limits of the servo and damage act."
    )
    return run.leg_rows(joint, f"{joint.capitalize()} angles", "°", series, note)


def _torques(run: Run) -> Figure:
    torque = run.record.signals["joint_torque"]
    series = {joint: torque[..., JOINTS.index(joint)] for joint in ("hip", "knee")}
    note = "Torque of the servos on the joints, positive in the direction of positive angles."
    return run.leg_rows("torque", "Joint torques", "N m", series, note)


def _bars(run: Run, row: int) -> Trace:
    record, standing = run.record, run.standing[:, row].astype(np.int8)
    edges = np.flatnonzero(np.diff(standing, prepend=0, append=0))
    ends = np.append(record.time, record.ended_at)[edges]
    # one line with gaps, since thousands of bars would make a long run slow to draw
    x = np.insert(ends, np.arange(2, len(ends) + 1, 2), np.nan)
    bars = line(np.full(len(x), float(row)), record.legs[row], theme.BLACK, width=20)
    hover = f"{record.legs[row]}, %{{x:.2f}} s<extra></extra>"
    return bars | {"x": Signal(x, exact=True), "showlegend": False, "hovertemplate": hover}


def _second_touches(run: Run) -> Trace:
    """Marks where a foot touches down again in the same cycle of its oscillator."""
    c, x, y = run.record.signals, [], []
    starts = metrics.cycle_starts(c["o1"], c["o2"])
    for row, (stands, start) in enumerate(zip(run.standing.T, starts, strict=True)):
        downs = np.flatnonzero(stands[1:] & ~stands[:-1]) + 1
        again = downs[1:][np.diff(np.searchsorted(start, downs, side="right")) == 0]
        x += run.record.time[again].tolist()
        y += [float(row)] * len(again)
    name = "second touch-down in a cycle"
    return _points(np.array(x), np.array(y), name, "diamond", theme.VERMILLION, 9)


def _level(y: float, kind: str = "line", half: float = 0.0) -> Trace:
    """A dashed line, or a faint band, across the whole width."""
    edge = {"color": theme.GREY, "width": 0 if half else 1.2, "dash": "dash"}
    look = {"fillcolor": theme.BAND, "layer": "below"} if half else {}
    span = {"xref": "paper", "x0": 0, "x1": 1, "y0": y - half, "y1": y + half}
    return {"type": kind, "line": edge, **span, **look}


def _uncut(phase: Array) -> Array:
    """The phase as shown, without the lines across the plot where it wraps."""
    shown = metrics.wrap_for_display(phase)
    shown[1:][np.abs(np.diff(shown)) > np.pi] = np.nan
    return shown


def _points(x: Array, y: Array, name: str, symbol: str, colour: str, size: int = 12) -> Trace:
    style = {"symbol": symbol, "size": size, "color": colour, "line": {"width": 2}}
    at = {"x": Signal(x), "y": Signal(y)}
    return {"type": "scatter", "mode": "markers", "name": name, "marker": style} | at

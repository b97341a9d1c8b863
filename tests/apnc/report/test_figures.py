"""What every panel plots, on a made-up walk whose signals all differ."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from records import FOOT_RADIUS, QUADRUPED, synthetic_record
from traces import axis_of, numbers

from apnc.features import walk_features
from apnc.loop.record import Record
from apnc.report import figures, theme
from apnc.report.figure import Figure
from apnc.report.lines import Run
from apnc_core.types import Array
from apnc_plant.ground import Ground, Kerb, Obstacles, Plane
from apnc_plant.signals import PLANT_SIGNALS

PHASES = (0.5, 1.5, 2.5)


def distinct(record: Record) -> Record:
    """The record with other numbers in every signal and column."""
    random = np.random.default_rng(1)
    of_plant = {signal.name for signal in PLANT_SIGNALS}
    others = {}
    for name, values in record.signals.items():
        if name not in ("position", "rpy", "foot_position", "o1", "o2", "phi"):
            low, high = (1.0, 2.0) if name in of_plant else (0.0, 0.1)
            others[name] = values + random.uniform(low, high, values.shape)
    return replace(record, signals={**record.signals, **others})


RECORD = distinct(synthetic_record(10.0, PHASES, yaw=0.7))


def drawn(key: str, record: Record = RECORD, **summary: Any) -> Figure:
    run = Run(record, replace(walk_features(record), **summary))
    return {f.key: f for f in figures.all_figures(run)}[key]


def on(ground: Ground, record: Record = RECORD) -> Record:
    return replace(record, experiment=replace(record.experiment, ground=ground))


def y(trace: dict[str, Any]) -> Array:
    return numbers(trace["y"])


def lines(figure: Figure) -> list[dict[str, Any]]:
    """Traces with samples, without the empty ones of the legend."""
    return [t for t in figure.data if t.get("x") != [None]]


def columns(signal: str, at: Any = ...) -> Array:
    return RECORD.signals[signal][at]


ROWS: dict[str, tuple[str, dict[str, Array]]] = {
    "grf": (
        "N",
        {"force of the ground": columns("foot_force")[..., 2], "sensor": columns("grf")},
    ),
    "cpg": ("1", {"o1 (hip)": columns("o1"), "o2 (knee)": columns("o2")}),
    "hip": (
        "°",
        {
            "actual": np.degrees(columns("joint_angle")[..., 1]),
            "commanded": np.degrees(columns("theta_hip")),
        },
    ),
    "knee": (
        "°",
        {
            "actual": np.degrees(columns("joint_angle")[..., 2]),
            "commanded": np.degrees(columns("theta_knee")),
        },
    ),
    "torque": (
        "N m",
        {"hip": columns("joint_torque")[..., 1], "knee": columns("joint_torque")[..., 2]},
    ),
}


@pytest.mark.parametrize("key", ROWS)
def test_rows_per_leg_show_the_signals_they_name(key: str) -> None:
    unit, series = ROWS[key]
    figure = drawn(key)
    found = {(axis_of(figure, t), t["name"]): t for t in lines(figure)}
    assert len(found) == 8
    for i, leg in enumerate(QUADRUPED):
        for name, values in series.items():
            trace = found[f"<b>{leg}</b> [{unit}]", f"{leg} {name}"]
            assert y(trace) == pytest.approx(values[:, i], rel=1e-6)
            assert trace["line"]["color"] == theme.leg_colours(QUADRUPED)[leg]
    # The legend says which of the two is dotted.
    legend = {t["name"]: t["line"]["dash"] for t in figure.data if t.get("x") == [None]}
    assert legend == dict(zip(series, ("solid", "dot"), strict=True))
    assert all(t["line"]["dash"] == legend[t["name"][3:]] for t in lines(figure))


def test_gains_of_every_leg() -> None:
    figure = drawn("gamma")
    assert [t["name"] for t in figure.data] == list(QUADRUPED)
    for i, trace in enumerate(figure.data):
        assert y(trace) == pytest.approx(columns("gamma")[:, i], rel=1e-6)
    assert axis_of(figure, figure.data[0]) == "γ [1]"


def test_phases_are_those_of_the_leg_and_relation_they_name() -> None:
    figure = drawn("phi")
    smoothed = {t["name"]: y(t) for t in figure.data if "FMU" not in t["name"]}
    names = ["φ12 (RF–RH)", "φ13 (RF–LF)", "φ14 (RF–LH)"]
    assert list(smoothed) == names
    for name, phase in zip(names, PHASES, strict=True):
        assert smoothed[name] == pytest.approx(phase, abs=0.02)
    own = [t for t in figure.data if "FMU" in t["name"]]
    assert [t["name"][:3] for t in own] == ["φ12", "φ13", "φ14"]
    assert [t["showlegend"] for t in own] == [True, False, False]
    for k, trace in enumerate(own):
        assert y(trace) == pytest.approx(columns("phi")[:, k], rel=1e-5)
    assert axis_of(figure, own[0]) == "relative phase [rad]"


def test_phases_are_not_struck_through_where_they_leave_the_panel() -> None:
    record = synthetic_record(10.0, (0.0, 0.0, 0.0))
    turning = np.linspace(0.0, 4 * np.pi, len(record))
    record.signals["phi"][:, 0] = turning
    shown = y(next(t for t in drawn("phi", record).data if t["name"] == "φ12 … in the FMU"))
    assert np.isnan(shown).sum() == 2
    assert np.nanmax(np.abs(np.diff(shown))) < 0.1
    known = ~np.isnan(shown)
    assert np.exp(1j * shown[known]) == pytest.approx(np.exp(1j * turning[known]), abs=1e-5)


def test_bands_lie_around_the_target_with_the_tolerance_of_the_criterion() -> None:
    shapes = drawn("phi").layout["shapes"]
    bands = sorted((s["y0"], s["y1"]) for s in shapes if s["type"] == "rect")
    assert np.array(bands) == pytest.approx(np.array([(-0.6, 0.6), (np.pi - 0.6, np.pi + 0.6)]))
    levels = sorted(s["y0"] for s in shapes if s["type"] == "line")
    assert levels == pytest.approx([0.0, np.pi])


def test_bars_stand_where_the_feet_stand() -> None:
    record = synthetic_record(10.0)
    force = record.signals["foot_force"]
    force[:] = 0.0
    contacts = {0: [(60, 120)], 1: [(30, 60), (300, 330)], 2: [(0, 12)], 3: [(540, 600)]}
    for leg, spans in contacts.items():
        for begin, end in spans:
            force[begin:end, leg, 2] = 10.0
    figure = drawn("gait", record)
    rows = figure.layout["yaxis"]
    for leg, spans in contacts.items():
        bars = figure.data[leg]
        ends = numbers(bars["x"]).reshape(-1, 3)
        assert ends[:, :2] == pytest.approx(np.array(spans) / 60.0, abs=1e-4)
        assert np.isnan(ends[:, 2]).all()
        assert set(y(bars)) == {float(leg)}
        assert QUADRUPED[leg] in rows["ticktext"][rows["tickvals"].index(leg)]
    assert figure.layout["yaxis"]["range"][0] > figure.layout["yaxis"]["range"][1]  # RF on top


def test_a_second_touch_down_in_a_cycle_is_marked() -> None:
    record = synthetic_record(10.0, (0.0, 0.0, 0.0), frequency=1.0)
    # One cycle a second, from mid-swing at 0.75 s on.
    force = record.signals["foot_force"]
    force[:] = 0.0
    for second in range(9):
        for leg in range(4):
            force[60 * second + 50 : 60 * second + 70, leg, 2] = 10.0
    force[60 * 4 + 80 : 60 * 4 + 90, 2, 2] = 10.0
    marks = drawn("gait", record).data[-1]
    assert numbers(marks["x"]) == pytest.approx([4 + 80 / 60], abs=1e-4)
    assert y(marks) == pytest.approx([2.0])


def test_stability_and_switch_have_their_own_axes() -> None:
    figure = drawn("kappa")
    found = {axis_of(figure, t): y(t) for t in figure.data}
    assert found["d [rad]"] == pytest.approx(columns("d"), rel=1e-6)
    assert found["κ [1]"] == pytest.approx(columns("kappa"), rel=1e-6)


def test_speed_is_along_the_heading_and_its_mean_along_the_path() -> None:
    record = synthetic_record(10.0, speed=0.12, yaw=0.7)
    figure = drawn("speed", record, path_speed_m_per_s=0.146, speed_m_per_s=0.004)
    for trace in figure.data:
        assert y(trace) == pytest.approx(0.12, abs=1e-6)
    assert figure.layout["shapes"][0]["y0"] == 0.146
    assert axis_of(figure, figure.data[0]) == "speed [m/s]"
    backwards = synthetic_record(10.0, speed=-0.12, yaw=0.7)
    assert y(drawn("speed", backwards).data[0]) == pytest.approx(-0.12, abs=1e-6)


def test_path_is_drawn_from_start_to_end_in_equal_scales() -> None:
    figure = drawn("path")
    x, lateral = RECORD.signals["position"][:, :2].T
    track, start, end = figure.data
    assert numbers(track["x"]) == pytest.approx(x, abs=1e-6)
    assert y(track) == pytest.approx(lateral, abs=1e-6)
    assert (numbers(start["x"])[0], y(start)[0]) == pytest.approx((x[0], lateral[0]), abs=1e-6)
    assert (numbers(end["x"])[0], y(end)[0]) == pytest.approx((x[-1], lateral[-1]), abs=1e-6)
    assert not figure.over_time
    assert figure.layout["yaxis"]["scaleanchor"] == "x"
    titles = [figure.layout[a]["title"]["text"] for a in ("xaxis", "yaxis")]
    assert titles == ["x [m]", "y [m]"]


def test_trunk_shows_height_over_the_ground_and_its_angles() -> None:
    slope = 0.2
    found = {t["name"]: y(t) for t in drawn("trunk", on(Plane(slope=slope))).data}
    x, _, z = RECORD.signals["position"].T
    assert found["height [m]"] == pytest.approx(z * np.cos(slope) - x * np.sin(slope), abs=1e-6)
    roll, pitch, yaw = np.degrees(RECORD.signals["rpy"]).T
    assert found["roll [°]"] == pytest.approx(roll, abs=1e-5)
    assert found["pitch [°]"] == pytest.approx(pitch, abs=1e-5)
    assert found["yaw [°]"] == pytest.approx(yaw, abs=1e-4)


def test_yaw_goes_on_beyond_half_a_turn() -> None:
    record = synthetic_record(10.0)
    turned = np.linspace(0.0, 5.0, len(record))
    record.signals["rpy"][:, 2] = (turned + np.pi) % (2 * np.pi) - np.pi
    found = {t["name"]: y(t) for t in drawn("trunk", record).data}
    assert found["yaw [°]"] == pytest.approx(np.degrees(turned), abs=1e-4)


@pytest.mark.parametrize(
    ("ground", "below"),
    [
        (Plane(), lambda x: 0.0 * x),
        (Kerb(at=0.3, height=0.006), lambda x: np.where(x >= 0.3, 0.006, 0.0)),
    ],
)
def test_clearance_is_the_height_of_the_sole_over_the_ground(ground: Ground, below: Any) -> None:
    figure = drawn("clearance", on(ground))
    for i, (leg, trace) in enumerate(zip(QUADRUPED, figure.data, strict=True)):
        x, _, z = RECORD.signals["foot_position"][:, i].T
        assert y(trace) == pytest.approx(1000 * (z - FOOT_RADIUS - below(x)), abs=1e-3)
        assert axis_of(figure, trace) == f"<b>{leg}</b> [mm]"


def test_clearance_is_measured_along_the_normal_of_a_slope() -> None:
    record = synthetic_record(1.0)
    record.signals["foot_position"][:] = [1.0, 0.0, 0.5]
    gap = np.array([1.0, 0.5]) @ [-np.sin(0.1), np.cos(0.1)] - FOOT_RADIUS
    for trace in drawn("clearance", on(Obstacles(slope=0.1), record)).data:
        assert y(trace) == pytest.approx(1000 * gap, abs=1e-3)


def test_every_panel_over_time_has_a_unit_and_none_lacks_a_note() -> None:
    for figure in figures.all_figures(Run(RECORD, walk_features(RECORD))):
        assert figure.note and figure.title
        titles = [v["title"]["text"] for k, v in figure.layout.items() if k[1:5] == "axis"]
        assert all("[" in title for title in titles if title != "leg"), figure.key
        assert figure.over_time == (figure.layout["xaxis"]["title"]["text"] == "time [s]")

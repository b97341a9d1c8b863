"""Single runs over time: commands, loads and intervals, on made-up records."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from records import synthetic_record
from traces import axis_of, numbers

from apnc.loop.record import Record
from apnc.report import theme
from apnc.report.figure import Figure
from apnc.studies.states.figures import broken, over_time
from apnc.studies.states.timeline import TIMELINE
from apnc.studies.steering.figures import WAYS, path, speeds_over_time, turns_over_time
from apnc.studies.steering.schedules import experiment
from apnc_core.types import Array


def results(figure: Figure) -> dict[str, list[dict[str, Any]]]:
    """Traces with samples by the title of their axis."""
    found: dict[str, list[dict[str, Any]]] = {}
    for trace in figure.data:
        if trace["x"] != [None]:
            found.setdefault(axis_of(figure, trace), []).append(trace)
    return found


def labels(figure: Figure) -> list[tuple[str, float]]:
    return [(note["text"], note["x"]) for note in figure.layout["annotations"]]


def bands(figure: Figure) -> list[tuple[float, float]]:
    shapes = figure.layout["shapes"]
    return [(s["x0"], s["x1"]) for s in shapes if s.get("yref") == "paper"]


# --- states ------------------------------------------------------------------------------------


def test_a_run_through_the_states_is_shown_over_time() -> None:
    record = synthetic_record(34.0)
    figures = over_time(record, "with ANC")
    assert {figure.key for figure in figures} == {
        f"states-{key}-apnc" for key in ("loads", "cpg", "phi", "gait", "gamma", "kappa")
    }
    for figure in figures:
        assert not figure.over_time and all("x" in trace for trace in figure.data)
        assert figure.title.endswith(", with ANC")
        assert labels(figure) == [
            ("S1", 7.85),
            ("S2: RF, LF stuck at 0.9", 17.0),
            ("MI = 0", 22.0),
            ("S3: no feedback", 29.0),
        ]
        assert bands(figure) == [(1.7, 14.0), (20.0, 24.0)]
        assert figure.layout["xaxis"]["range"] == [0.0, 34.0]


def through_the_states() -> Record:
    base = synthetic_record(34.0)
    grf = np.tile([1.0, 2.0, 3.0, 40.0], (len(base), 1))
    mi = np.where((base.time >= 20.0) & (base.time < 24.0), 0.0, 0.15)
    return replace(
        base,
        experiment=TIMELINE.experiment("apnc", 0),
        signals={**base.signals, "grf": grf, "MI": mi},
    )


def test_loads_are_those_of_the_circuits_and_broken_sensors_stand_out() -> None:
    record = through_the_states()
    weight = record.experiment.parameters()["robot_weight"]
    shown = results(over_time(record, "")[0])
    assert list(shown) == ["MI [1]", *(f"<b>{leg}</b> F [1]" for leg in record.legs)]
    assert numbers(shown["MI [1]"][0]["y"]) == pytest.approx(record.signals["MI"])
    # halves of the weight, at most F_max = 1
    expected = np.minimum(np.array([1.0, 2.0, 3.0, 40.0]) * 2 / weight, 1.0)
    for i, (ground, sound, faulty) in enumerate(list(shown.values())[1:]):
        force = record.signals["foot_force"][:, i, 2]
        assert numbers(ground["y"]) == pytest.approx(2 * force / weight, abs=1e-6)
        assert (ground["line"]["color"], faulty["line"]["color"]) == (theme.GREY, theme.VERMILLION)
        begins = 14.0 if i in (0, 2) else 20.0
        late = record.time >= begins
        for trace, there in ((sound, ~late), (faulty, late)):
            values = numbers(trace["y"])
            assert np.isnan(values[~there]).all()
            assert values[there] == pytest.approx(expected[i])


def test_no_sensor_of_a_sound_robot_is_broken() -> None:
    assert not broken(synthetic_record(3.0)).any()


# --- schedules -----------------------------------------------------------------------------------


def on_schedule(schedule: str, **signals: Array) -> Record:
    base = synthetic_record(60.0, frequency=1.5, speed=0.08)
    asked = experiment(schedule)
    commands = {name: _over(base.time, getattr(asked, name)) for name in ("mi", "turn")}
    told = {"MI": commands["mi"], "turn": commands["turn"]}
    return replace(base, experiment=asked, signals={**base.signals, **told, **signals})


def _over(time: Array, command: Any) -> Array:
    if not isinstance(command, tuple):
        return np.full_like(time, command)
    starts, values = zip(*command, strict=True)
    found: Array = np.array(values)[np.searchsorted(starts, time, side="right") - 1]
    return found


def test_the_schedule_of_speeds_shows_command_speed_way_and_frequency() -> None:
    record = on_schedule("speeds")
    figure = speeds_over_time(record)
    shown = results(figure)
    (command,) = shown["MI [1]"]
    assert numbers(command["y"]) == pytest.approx(record.signals["MI"])
    raw, slow = shown["speed [m/s]"]
    assert numbers(raw["y"]) == pytest.approx(0.08) and numbers(slow["y"]) == pytest.approx(0.08)
    (way,) = shown["path [m]"]
    assert numbers(way["y"]) == pytest.approx(0.08 * record.time, abs=1e-4)
    stride = shown["stride [Hz]"]
    assert [trace["name"] for trace in stride] == list(record.legs)
    assert all(numbers(trace["y"]) == pytest.approx(1.5) for trace in stride)
    # The middle of the first cycle of RF: from mid-swing at 3/4 of a cycle to the next.
    assert numbers(stride[0]["x"])[:2] == pytest.approx([1.25 / 1.5, 2.25 / 1.5], abs=1e-3)
    assert labels(figure) == [("MI 0.15", 12.5), ("MI 0.4", 32.5), ("MI 0.15", 50.0)]
    assert bands(figure) == [(0.0, 25.0), (40.0, 60.0)]


def test_speed_is_along_the_heading() -> None:
    base = synthetic_record(60.0)
    turned = {name: base.signals[name].copy() for name in ("velocity", "rpy")}
    turned["velocity"][:, :2] = [0.0, 0.2]
    turned["rpy"][:, 2] = np.pi / 6
    raw, _ = results(speeds_over_time(on_schedule("speeds", **turned)))["speed [m/s]"]
    assert numbers(raw["y"]) == pytest.approx(0.1)


def test_the_schedule_of_turns_shows_command_hips_yaw_and_its_rate() -> None:
    t = synthetic_record(60.0).time
    yaw = np.select([t < 20, t < 35], [0 * t, -0.2 * (t - 20)], -3.0 + 0.3 * (t - 35))
    record = on_schedule("turns", rpy=np.column_stack([0 * t, 0 * t, np.angle(np.exp(1j * yaw))]))
    figure = turns_over_time(record)
    shown = results(figure)
    assert list(shown) == ["turn [1]", "hip RF [°]", "hip LF [°]", "yaw [°]", "rate [rad/s]"]
    assert numbers(shown["turn [1]"][0]["y"]) == pytest.approx(record.signals["turn"])
    for i, leg in ((0, "RF"), (2, "LF")):
        expected = np.degrees(record.signals["theta_hip"][:, i])
        assert numbers(shown[f"hip {leg} [°]"][0]["y"]) == pytest.approx(expected, abs=1e-4)
    assert numbers(shown["yaw [°]"][0]["y"]) == pytest.approx(np.degrees(yaw), abs=1e-3)
    rate = numbers(shown["rate [rad/s]"][0]["y"])
    assert rate[[600, 1650, 2400]] == pytest.approx([0.0, -0.2, 0.3], abs=1e-6)
    assert [text for text, _ in labels(figure)] == list(WAYS)


def test_the_path_has_equal_scales_and_a_colour_per_interval() -> None:
    record = on_schedule("turns")
    figure = path(record)
    assert (
        figure.layout["yaxis"]["scaleanchor"] == "x" and figure.layout["yaxis"]["scaleratio"] == 1
    )
    *intervals, start, end = figure.data
    assert [trace["name"] for trace in intervals] == [
        "straight, 0 to 20 s",
        "right, 20 to 35 s",
        "left, 35 to 50 s",
        "straight again, 50 to 60 s",
    ]
    assert len({trace["line"]["color"] for trace in intervals}) == 4
    ends = [numbers(trace["x"])[[0, -1]].tolist() for trace in intervals]
    # One interval begins where the other ends.
    assert np.ravel(ends)[1:-1:2] == pytest.approx(np.ravel(ends)[2::2])
    assert ends[1] == pytest.approx([1.6, 2.8], abs=1e-3)
    assert (start["x"], end["x"]) == (
        pytest.approx([0.0], abs=1e-6),
        pytest.approx([4.8], abs=0.01),
    )


def test_a_run_that_fell_on_its_schedule_is_shown_as_far_as_it_went() -> None:
    record = synthetic_record(24.0)
    turns = replace(record, experiment=experiment("turns"))
    speeds = replace(record, experiment=experiment("speeds"))
    assert turns_over_time(turns).layout["xaxis"]["range"] == [0.0, 60.0]
    assert speeds_over_time(speeds).layout["xaxis"]["range"] == [0.0, 60.0]
    assert [len(numbers(trace["x"])) for trace in path(turns).data[:4]] == [
        1201,
        240,
        0,
        0,
    ]

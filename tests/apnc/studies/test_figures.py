"""Traces of every figure, and the Markdown tables, on made-up results."""

from __future__ import annotations

from typing import Any

import pytest
from made_up_results import Result, made_up

from apnc.controllers import CONTROLLERS
from apnc.report.figure import Figure
from apnc.studies import conditions, gains, mi, states, steering
from apnc.studies.plots import LOOKS, convergence, over_axis, side_by_side, spread
from apnc.studies.registry import STUDIES
from apnc.studies.results import AUTHORS, STRICT, controllers_in
from apnc.studies.study import load

AXIS = ("mi", "MI [1]")
OLD = ("apnc", "tegotae", "phase_reset")


def times(cell: Result) -> Result:
    """APNC forms at every MI, Tegotae at the higher one only, phase resetting in two trials."""
    at = {"apnc": 2.0, "tegotae": 9.0 if cell["mi"] > 0.1 else None}
    late = 5.0 if cell["mi"] < 0.1 and cell["seed"] < 2 else None
    time = at.get(cell["controller"], late)
    return {STRICT: time, AUTHORS: 1.0, "path_speed_m_per_s": 0.1 + cell["mi"]}


def points_of(figure: Figure, name: str) -> list[dict[str, Any]]:
    """Traces of points by their name, with or without the number of runs behind it."""
    found = [trace for trace in figure.data if trace["name"].split(", n = ")[0] == name]
    return [trace for trace in found if "error_y" not in trace]


def quartiles(traces: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [trace for trace in traces if "error_y" in trace]


def test_convergence_shows_times_and_the_share_of_success() -> None:
    strict, authors = convergence(made_up({"mi": (0.08, 0.2)}, times, OLD), AXIS)
    (apnc,) = points_of(strict, "APNC")
    assert apnc["x"] == ["0.08"] * 6 + ["0.2"] * 6 and apnc["y"] == [2.0] * 12
    (tegotae,) = points_of(strict, "Tegotae")
    assert tegotae["x"] == ["0.2"] * 6 and tegotae["y"] == [9.0] * 6
    (share,) = points_of(strict, "Tegotae: success")
    assert share["x"] == ["0.08", "0.2"] and share["y"] == [0.0, 100.0]
    assert share["yaxis"] == "y2"
    (share,) = points_of(strict, "phase resetting: success")
    assert share["y"] == pytest.approx([100 / 3, 0.0])
    (share,) = points_of(authors, "phase resetting: success")
    assert share["y"] == [100.0, 100.0]
    assert strict.key == "mi-convergence_time_s" and "strict" in strict.note
    assert authors.key == "mi-convergence_time_authors_s" and "2.8 rad" in authors.note
    assert strict.layout["xaxis"]["categoryarray"] == ["0.08", "0.2"]
    assert strict.layout["xaxis"]["title"]["text"] == "MI [1]"


def test_a_cell_that_was_not_run_has_no_share() -> None:
    results = made_up({"mi": (0.08, 0.2)}, times, OLD)
    part = [r for r in results if r["controller"] != "apnc" or r["mi"] == 0.2]
    (share,) = points_of(convergence(part, AXIS)[0], "APNC: success")
    assert share["y"] == [None, 100.0]


def test_fewer_than_five_values_are_points() -> None:
    results = made_up({"mi": (0.08, 0.2)}, times, OLD, seeds=4)
    assert not quartiles(convergence(results, AXIS)[0].data)
    (points,) = points_of(convergence(results, AXIS)[0], "APNC")
    assert points["mode"] == "markers" and points["y"] == [2.0] * 8
    mixed = spread([("a", 1.0)] * 5 + [("b", 2.0)] * 4, "n", "#000000")
    assert [("error_y" in t, t["x"], t["showlegend"]) for t in mixed] == [
        (False, ["a"] * 5, True),
        (True, ["a"], False),
        (False, ["b"] * 4, False),
    ]
    assert spread([], "n", "#000000") == []


def test_quartiles_of_five_and_more_values() -> None:
    values = [1.0, 2.0, 3.0, 5.0, 9.0]
    _, mark = spread([("a", value) for value in values], "n", "#000000")
    assert (mark["x"], mark["y"]) == (["a"], [3.0])
    assert (mark["error_y"]["array"], mark["error_y"]["arrayminus"]) == ([2.0], [1.0])


def test_few_points_carry_the_names_of_their_seeds() -> None:
    speed, label = "path_speed_m_per_s", "speed [m/s]"
    few = made_up({"mi": (0.08, 0.2)}, times, OLD, seeds=2)
    (points,) = points_of(over_axis(few, AXIS, speed, label), "APNC")
    assert points["mode"] == "markers+text" and points["text"] == ["seed 0", "seed 1"] * 2
    more = made_up({"mi": (0.08, 0.2)}, times, OLD, seeds=4)
    (points,) = points_of(over_axis(more, AXIS, speed, label), "APNC")
    assert points["mode"] == "markers" and "%{text}" in points["hovertemplate"]


def test_the_axis_shows_every_cell_even_without_a_number() -> None:
    figure = convergence(made_up({"mi": (0.08, 0.2)}, times, ("tegotae",)), AXIS)[0]
    assert figure.layout["xaxis"]["categoryarray"] == ["0.08", "0.2"]
    assert figure.layout["xaxis"]["range"] == [-0.5, 1.5]


def test_every_controller_has_a_look_of_its_own() -> None:
    assert LOOKS.keys() == CONTROLLERS.keys()
    for part in ("colour", "symbol"):
        assert len({getattr(each, part) for each in LOOKS.values()}) == len(LOOKS)
    assert len({each.name for each in CONTROLLERS.values()}) == len(CONTROLLERS)


def test_an_unknown_controller_is_an_error() -> None:
    with pytest.raises(ValueError, match="controller 'moo' is not one of apnc, apc, tegotae"):
        controllers_in([{"controller": "moo"}])


def test_names_tell_how_many_of_the_runs_have_the_figure() -> None:
    strict, _ = convergence(made_up({"mi": (0.08, 0.2)}, times), AXIS)
    names = {trace["name"] for trace in quartiles(strict.data)}
    # phase resetting has two values at one MI, which are points
    assert names == {"APNC, n = 12", "Tegotae, n = 6 of 12"}
    assert "phase resetting (best), n = 2 of 12" in {trace["name"] for trace in strict.data}
    assert "Tegotae (best): success" in {trace["name"] for trace in strict.data}
    (share,) = [t for t in strict.data if t["name"] == "Tegotae: success"]
    (box,) = points_of(strict, "Tegotae")
    assert share["legendgroup"] == box["legendgroup"] and share["offsetgroup"] == box["offsetgroup"]


def test_over_axis_shows_the_column() -> None:
    figure = over_axis(
        made_up({"mi": (0.08, 0.2)}, times, OLD), AXIS, "path_speed_m_per_s", "speed [m/s]"
    )
    (apnc,) = points_of(figure, "APNC")
    assert sorted(set(apnc["y"])) == pytest.approx([0.18, 0.3])
    assert (figure.key, figure.title) == ("mi-path_speed_m_per_s", "Speed")
    assert figure.layout["yaxis"]["title"]["text"] == "speed [m/s]"


def test_side_by_side_keeps_the_order() -> None:
    figure = side_by_side("k", "T", "n", "speed [m/s]", {"b": [1.0, 2.0], "a": [3.0] * 5})
    assert [(t["x"][0], t["y"]) for t in figure.data] == [
        ("b", [1.0, 2.0]),
        ("a", [3.0] * 5),
        ("a", [3.0]),
    ]
    assert figure.layout["xaxis"]["categoryarray"] == ["b", "a"]


def test_the_studies_of_the_paper_have_their_figures() -> None:
    def keys(name: str, results: list[Result]) -> list[str]:
        return [figure.key for figure in load(STUDIES[name]).figures(results)]

    results = made_up({"mi": (0.08, 0.2)}, times, OLD)
    both = [STRICT, AUTHORS]
    assert keys("mi", results) == [f"mi-{c}" for c in [*both, mi.DUTY, "path_speed_m_per_s"]]
    for name, axis in (("rate", "rate"), ("terrain", "roughness")):
        cells = made_up({axis: (5.0, 60.0)}, lambda cell: {STRICT: 3.0, AUTHORS: 2.0}, study=name)
        assert keys(name, cells) == [f"{name}-{c}" for c in both]
        title = load(STUDIES[name]).figures(cells)[0].layout["xaxis"]["title"]["text"]
        assert title in ("update rate [Hz]", "roughness R [1]")


def test_conditions_name_what_differs() -> None:
    def figures(cell: Result) -> Result:
        better = 5.0 * (cell["controller"] == "apnc" and cell["condition"] == "C2")
        return dict.fromkeys(conditions.METRICS, 0.1 * cell["seed"] + better)

    results = made_up({"condition": ("C1", "C2")}, figures, seeds=20, study="conditions")
    for figure in load(STUDIES["conditions"]).figures(results):
        assert figure.note.startswith("APNC differs from: C2 Tegotae (p < 0.001")
        assert "C2 phase resetting (p < 0.001" in figure.note and "C1" not in figure.note
        assert "Holm" in figure.note
    alike = load(STUDIES["conditions"]).figures([r for r in results if r["condition"] == "C1"])
    assert alike[0].note.startswith("APNC differs from: no baseline.")
    assert [f.layout["yaxis"]["title"]["text"] for f in alike] == [
        "balance [1/rad]",
        "coordination [1]",
        "cost of transport [1]",
    ]


def test_damage_shows_the_speed_of_every_method() -> None:
    speed = {"apnc": 0.1, "tegotae": 0.2, "phase_reset": 0.3}
    results = made_up(
        {}, lambda c: {"path_speed_m_per_s": speed[c["controller"]]}, OLD, study="damage"
    )
    results[0]["path_speed_m_per_s"] = None
    (figure,) = load(STUDIES["damage"]).figures(results)
    assert (figure.key, figure.title) == ("damage-speed", "Speed")
    assert figure.note == "Commands of the right front leg held at 0."
    assert figure.layout["yaxis"]["title"]["text"] == "speed [m/s]"
    assert [(t["name"], t["y"][0]) for t in quartiles(figure.data)] == [
        ("APNC, n = 5 of 6", 0.1),
        ("Tegotae, n = 6", 0.2),
        ("phase resetting, n = 6", 0.3),
    ]


def state_results() -> list[Result]:
    def figures(cell: Result) -> Result:
        with_anc = cell["controller"] == "apnc"
        speeds = {f"state_speed_s{i}": 0.1 * i + 0.01 * with_anc for i in (1, 2, 3)}
        good = {"state_S1": True, "state_S2": cell["seed"] > 1, "state_S3": with_anc}
        return speeds | good | {states.FORMED[0]: 1.5, states.BACK[0]: 1.0 + cell["seed"]}

    return made_up({}, figures, controllers=("apnc", "apc"), study="states")


def test_states_show_speeds_with_and_without_couplings() -> None:
    (figure,) = states.STUDY.figures(state_results())
    assert [(t["name"], t["y"][0]) for t in quartiles(figure.data)] == [
        ("S1 with ANC", pytest.approx(0.11)),
        ("S1 without ANC", pytest.approx(0.1)),
        ("S2 with ANC", pytest.approx(0.21)),
        ("S2 without ANC", pytest.approx(0.2)),
        ("S3 with ANC", pytest.approx(0.31)),
        ("S3 without ANC", pytest.approx(0.3)),
    ]


def test_the_table_of_states() -> None:
    text = states.table(state_results())
    assert text.splitlines()[0] == (
        "| couplings | state | as the paper says | success (95 % interval) | "
        "time [s], median (range) | speed [m/s], median (range) |"
    )
    assert text.splitlines()[2:4] == [
        "| with ANC | S1 | the gait forms and lasts to the break | 6/6 (54 ... 100 %) | "
        "1.5 (1.5 ... 1.5) | 0.110 (0.110 ... 0.110) |",
        "| with ANC | S2 | keeps the gait at every moment and walks, front sensors stuck | "
        "4/6 (22 ... 96 %) | - | 0.210 (0.210 ... 0.210) |",
    ]
    assert (
        "| without ANC | S3 | rocks in place, legs in phase | 0/6 (0 ... 46 %) | 3.5 (1.0" in text
    )
    assert len(text.splitlines()) == 2 + 6
    only = states.table([result for result in state_results() if result["controller"] == "apc"])
    assert "with ANC | S1" not in only.replace("without ANC", "")


def test_steering_shows_every_interval() -> None:
    def figures(cell: Result) -> Result:
        column = "speed" if cell["schedule"] == "speeds" else "yaw_rate"
        return {f"{column}_section_{i}": 0.1 * i for i in range(1, 5)}

    results = made_up(
        {"schedule": ("speeds", "turns")}, figures, controllers=("apnc",), study="steering"
    )
    speed, yaw = steering.STUDY.figures(results)
    assert (speed.key, yaw.key) == ("steering-speeds", "steering-turns")
    assert (speed.title, yaw.title) == ("Speed", "Yaw rate")
    assert yaw.note == "Positive turns left."
    assert [f.layout["yaxis"]["title"]["text"] for f in (speed, yaw)] == [
        "speed [m/s]",
        "yaw rate [rad/s]",
    ]
    assert [(t["name"], t["y"][0]) for t in quartiles(speed.data)] == [
        ("MI 0.15, interval 1", pytest.approx(0.1)),
        ("MI 0.4, interval 2", pytest.approx(0.2)),
        ("MI 0.15, interval 3", pytest.approx(0.3)),
    ]
    assert [(t["name"], t["y"][0]) for t in quartiles(yaw.data)] == [
        ("straight", pytest.approx(0.1)),
        ("right", pytest.approx(0.2)),
        ("left", pytest.approx(0.3)),
        ("straight again", pytest.approx(0.4)),
    ]
    (only,) = steering.STUDY.figures(
        [result for result in results if result["schedule"] == "turns"]
    )
    assert only.key == "steering-turns"


def test_the_table_of_mi_counts_failures_and_errors() -> None:
    results = made_up({"mi": (0.1,)}, times, controllers=("apnc",), seeds=4)
    for result, time in zip(results, (3.0, 5.0, None, None), strict=True):
        result |= {STRICT: time, AUTHORS: 2.0, "late_speed_m_per_s": 0.1}
    results[2]["fell"] = True
    for result, gait in zip(results, ("pace", "trot", None, "trot"), strict=True):
        result[mi.GAIT] = gait
    del (
        results[3][STRICT],
        results[3][AUTHORS],
        results[3]["late_speed_m_per_s"],
        results[3]["fell"],
    )
    assert mi.table(results).splitlines()[2] == (
        "| APNC | 0.10 | 2/4 (7 ... 93 %) | 4.0 (3.5 ... 4.5; 5.0) | "
        "trot 2, pace 1 | 3/4 | 2.0 | 0.100 (0.100 ... 0.100) | 1 |"
    )


def test_the_table_of_mi_has_a_line_per_method_and_mi() -> None:
    lines = mi.table(made_up({"mi": (0.2, 0.08)}, times, OLD)).splitlines()
    assert lines[:2] == [
        "| controller | MI | gait kept, strict (95 % interval) | "
        "strict time [s], median (quartiles; longest) | gait at the end | authors' criterion | "
        "authors' time [s], median | speed [m/s], median (range) | fell |",
        "| --- | --- | --- | --- | --- | --- | --- | --- | --- |",
    ]
    lines = lines[2:]
    assert [line[2:17] for line in lines[:2]] == ["APNC | 0.08 | 6", "APNC | 0.20 | 6"]
    assert lines[2].startswith("| Tegotae | 0.08 | 0/6 (0 ... 46 %) | - | - | 6/6 | 1.0 | - | 0 |")
    assert len(lines) == 6


def gain_results() -> list[Result]:
    def figures(cell: Result) -> Result:
        good = cell["gain"] == 1.0
        return {
            STRICT: 3.0 if good else None,
            AUTHORS: 2.0,
            "late_speed_m_per_s": 0.1,
            gains.STILL: 0 if good else 4,
        }

    return made_up(
        {"gain": (1.0, 2.0)}, figures, controllers=tuple(gains.GAINS), seeds=5, study="gains"
    )


def test_the_table_of_gains_marks_the_best() -> None:
    lines = gains.table(gain_results()).splitlines()
    assert len(lines) == 2 + 8
    assert lines[2].startswith(
        "| gain of Tegotae [1] | 1 | best | 5/5 | 5/5 (48 ... 100 %) | 5/5 (48 ... 100 %) | "
        "2.0 (2.0 ... 2.0) | 0.100 (0.100 ... 0.100) | 0 | 0 |"
    )
    assert lines[3].startswith("| gain of Tegotae [1] | 2 |  | 0/5 |") and "| 5 | 0 |" in lines[3]
    assert lines[6].startswith("| factor on the learning rates of APNC [1] | 1 | used | 5/5")
    assert lines[8].startswith("| APNC, printed rates | 1 |  | 5/5")
    used = CONTROLLERS["tegotae_best"].settings["gamma_tegotae"]
    results = [result | {"gain": used * result["gain"]} for result in gain_results()]
    assert f"| {used:g} | best, used | 5/5" in gains.table(results)


def test_gains_have_figures_per_method_and_criterion() -> None:
    figures = gains.STUDY.figures(gain_results())
    assert [figure.key for figure in figures] == [
        f"gains-{label}-{column}"
        for label in ("tegotae", "phase_reset", "apnc")
        for column in (STRICT, AUTHORS)
    ]
    assert figures[0].layout["xaxis"]["title"]["text"] == "gain of Tegotae [1]"
    assert {t["name"].split(",")[0] for t in figures[0].data} == {"Tegotae", "Tegotae: success"}
    assert "APNC, printed rates, n = 5 of 10" in {t["name"] for t in figures[4].data}


@pytest.mark.parametrize(("legs", "gait"), [(4, "trot"), (6, "tripod"), (10, "gait")])
def test_baselines_in_the_states_are_judged_by_the_gait_of_the_robot(legs: int, gait: str) -> None:
    def figures(cell: Result) -> Result:
        phases = {f"phi_final_1{k}": None for k in range(2, legs + 1)}
        return {"state_S1": True, "state_S2": cell["seed"] == 0, "state_S3": False, **phases}

    text = states.table(made_up({}, figures, controllers=("tegotae_best",), study="states"))
    assert (
        f"| Tegotae (best) | S2 | keeps the {gait} and walks | 1/6 (0 ... 64 %) | - | - |" in text
    )

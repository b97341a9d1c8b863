"""The search: variables, and costs of made-up walks with closed-form answers."""

from __future__ import annotations

import csv
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from records import TROT, synthetic_record

from apnc import metrics
from apnc.loop.experiment import Experiment
from apnc.loop.many import compiled
from apnc.loop.record import End, Record
from apnc.loop.simulate import simulate
from apnc.studies.search.__main__ import Spread, search
from apnc.studies.search.costs import (
    BANDS,
    FAILED,
    STEERING,
    WANTED_STEERING,
    WANTED_TURN,
    blocked,
    blocked_cost,
    costs,
    costs_of,
    damage_cost,
    feet_cost,
    formation_cost,
    names,
    payload_cost,
    ratio_cost,
    steering_cost,
    tasks,
    walk_cost,
)
from apnc.studies.search.design import DESIGN, OWN, built_robot, design_variables, gains, start
from apnc.studies.search.front import (
    BETTER,
    MI_VALUES,
    best_ranks,
    candidates_of,
    front,
    measured,
    non_dominated,
    result_of,
    walks_of,
)
from apnc.studies.search.log import read_log
from apnc_core.types import Array
from apnc_plant.robot import ROBOTS, load_robot

LILIBOT = load_robot("lilibot")


SHIPPED = [name for name in DESIGN if (ROBOTS / f"{name}.toml").exists()]


@pytest.mark.parametrize("robot", SHIPPED)
def test_design_variables_reach_their_ends_and_the_shipped_robot_lies_between(robot: str) -> None:
    shipped = load_robot(robot)
    for variable in DESIGN[robot]:
        assert variable.value(0.0) == pytest.approx(variable.low)
        assert variable.value(1.0) == pytest.approx(variable.high)
        value = start(shipped, variable.name)
        assert variable.low <= value <= variable.high
        assert variable.value(variable.scaled(value)) == pytest.approx(value)


@pytest.mark.parametrize("robot", SHIPPED)
def test_the_shipped_numbers_make_the_shipped_robot(robot: str) -> None:
    shipped = load_robot(robot)
    numbers = {variable.name: start(shipped, variable.name) for variable in DESIGN[robot]}
    assert built_robot(numbers, robot) == shipped
    Experiment(robot=shipped, settings=gains(numbers))  # all are parameters


def test_a_candidate_is_a_robot_and_gains() -> None:
    candidate = {"a1": 0.2, "trunk.com_z": 0.003, "trunk.com_x": 0.01, "servo.damping": 0.5}
    robot = built_robot(candidate)
    assert robot.trunk.com[0] == 0.01 and robot.trunk.com[2] == 0.003
    assert robot.servo.damping == 0.5
    assert gains(candidate) == {"a1": 0.2}


def test_outer_and_inner_legs_move_on_both_sides() -> None:
    robot = built_robot({"outer.y": 0.05, "inner.y": 0.11, "inner.z": 0.003}, "hexapod")
    y = {leg.name: leg.mount[1] for leg in robot.legs}
    assert y == {"RF": -0.05, "RM": -0.11, "RH": -0.05, "LF": 0.05, "LM": 0.11, "LH": 0.05}
    assert {leg.name for leg in robot.legs if leg.mount[2] == 0.003} == {"RM", "LM"}


def test_a_baseline_searches_its_own_number_and_if_asked_the_robot() -> None:
    for controller, variable in OWN.items():
        assert design_variables("lilibot", controller) == (variable,)
        found = {
            variable.name for variable in design_variables("lilibot", controller, own_robot=True)
        }
        assert found == {variable.name} | {k.name for k in DESIGN["lilibot"]} - {
            "B_f", "B_s", "turn_gain"
        }  # fmt: skip


@pytest.mark.parametrize(
    ("robot", "controller", "named"), [("cat", "apnc", "cat"), ("lilibot", "fuzzy", "fuzzy")]
)
def test_what_is_not_searched_is_named(robot: str, controller: str, named: str) -> None:
    with pytest.raises(ValueError, match=f"'{named}' is not one of"):
        design_variables(robot, controller)


def test_a_single_number_is_looked_at_all_over_its_range() -> None:
    spread, told = Spread(10, seed=1), list[list[float]]()
    for _ in range(5):
        points = spread.ask()
        assert [int(10 * point[0]) for point in points] == list(range(10))
        costs = [abs(float(x[0]) - 0.7) for x in points]  # a valley at 0.7
        costs[2] -= 0.6 * (len(told) == 0)  # and one lucky value elsewhere
        told.append(costs)
        spread.tell(points, costs)
    assert spread.xfavorite[0] == pytest.approx(0.7, abs=0.06)


def test_the_front_is_what_no_other_beats() -> None:
    points = [(0.0, 3.0), (1.0, 1.0), (3.0, 0.0), (2.0, 2.0), (1.0, 1.0), (0.5, 3.0)]
    assert non_dominated(points).tolist() == [True, True, True, False, True, False]
    assert best_ranks(points, 4).tolist() == [0, 1, 4, 2]
    assert best_ranks(points, 5).tolist() == [0, 1, 4, 2, 5]
    assert best_ranks(points, 99).tolist() == [0, 1, 4, 2, 5, 3]


def test_candidates_come_from_logs_without_their_means(tmp_path: Path) -> None:
    variables = [variable.name for variable in design_variables("lilibot", "apnc")]
    numbers = ",".join("0.1" for _ in variables)
    lines = [
        ",".join(
            ["generation", "cost", "cost_mi_0.08", "cost_feet_0.08", "cost_ratio", *variables]
        ),
        f"0,9,2.0,3.0,1.0,{numbers}",
        f"0,9,3.0,3.0,2.0,{numbers}",
        f"mean0,9,0.0,0.0,0.0,{numbers}",
        f"1,9,3.0,1.0,1.0,{numbers}",
    ]
    log = tmp_path / "one" / "search.csv"
    log.parent.mkdir()
    log.write_text("\n".join(lines))
    assert list(candidates_of([log], 2, "lilibot")) == ["one:2", "one:5"]


def log_of(tmp_path: Path, lines: Sequence[str]) -> Path:
    log = tmp_path / "search.csv"
    log.write_text("\n".join(lines))
    return log


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (("", "--begin", "torn.csv"), "torn.csv line 3: a2 is missing; allowed: a finite number"),
        (("", "--begin", "odd.csv"), "odd.csv line 2: a2 is 'x'; allowed: a finite number"),
        (("", "--begin", "search.csv", "--output", "."), "would overwrite the log search.csv"),
        (("", "--sigma", "0"), "sigma = 0.0; allowed: above 0, up to 1"),
        (("", "--feet", "nan"), "feet = nan; allowed: a finite number from 0 on"),
        ((".front", "torn.csv", "--output", "torn.csv"), "would overwrite the log torn.csv"),
        (("", "--begin", "bytes.csv"), "bytes.csv is no log of a search"),
        ((".front", "torn.csv"), "torn.csv has no column "),
        (("", "--robot", "cat"), "robot 'cat' is not one of lilibot, "),
        (("", "--controller", "fuzzy"), "controller 'fuzzy' is not one of apnc, "),
        (("", "--begin", "other.csv"), "other.csv has no mean of a generation"),
        ((".front", "search.csv"), "search.csv has no column 'a2'; it is no log of this search"),
        ((".front", "nowhere.csv"), "nowhere.csv"),
    ],
)
def test_bad_input_is_one_line_and_exit_code_2(
    tmp_path: Path, arguments: tuple[str, ...], named: str
) -> None:
    log_of(tmp_path, ["generation,b1", "0,0.1"])
    (tmp_path / "other.csv").write_text("generation,b1\n0,0.1\n")
    (tmp_path / "torn.csv").write_text("generation,b1,a2\n0,0.1,0.2\nmean0,0.1")
    (tmp_path / "odd.csv").write_text("generation,a2\nmean0,x\n")
    (tmp_path / "bytes.csv").write_bytes(b"generation,b1\n\xff\xfe")
    before = {path.name: path.read_bytes() for path in tmp_path.iterdir()}
    module, *rest = arguments
    if not module:
        rest = ["--output", ".", "--generations", "1", *rest]
    done = subprocess.run(
        [sys.executable, "-m", f"apnc.studies.search{module}", *rest],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 2
    (line,) = [line for line in done.stderr.splitlines() if line.startswith("error: ")]
    assert named in line and "Traceback" not in done.stderr
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == before


def asked(robot: str, controller: str) -> tuple[dict[str, float], list[Experiment]]:
    """Costs by name of walks in the robot's gait, and the experiments that were asked for."""
    legs = len(load_robot(robot).legs)
    gait = metrics.default_target(legs)
    assert gait is not None
    runs, found = list(tasks({}, 0, robot, controller)), dict[str, float]()
    for run in runs:
        walk = synthetic_record(run.experiment.duration, gait)
        found |= run.judge(replace(walk, experiment=run.experiment))
    own = dict(zip(names(legs), costs(found, legs), strict=True))
    return own, [run.experiment for run in runs]


def test_four_legs_are_asked_for_all() -> None:
    found, runs = asked("lilibot", "apnc")
    bands = BANDS[4]
    assert [run.mi for run in runs[: len(bands)]] == [band[0] for band in bands]
    assert [run.controller for run in runs[: len(bands)]].count("apc") == 1
    conditions = [run.conditions for run in runs]
    assert conditions.count("C3") == conditions.count("C4") == 1
    assert [run.rate for run in runs if run.rate != 60.0] == [25.0]
    assert sum("stored" in run.settings for run in runs) == 2  # memory and steering
    assert found["ratio"] > 0.0  # all walk at one speed


def test_six_legs_have_bands_of_their_own_and_no_payload_or_rate() -> None:
    found, runs = asked("hexapod", "apnc")
    assert [run.mi for run in runs[: len(BANDS[6])]] == [band[0] for band in BANDS[6]]
    assert all(run.rate == 60.0 and run.conditions != "C4" for run in runs)
    (stored,) = [run.settings["phi_stored"] for run in runs if "stored" in run.settings]
    assert np.abs(np.subtract(stored, metrics.default_target(6) or ())).max() < 0.2
    assert found["ratio"] == found["rate"] == found["payload"] == found["steering"] == 0.0


def test_a_baseline_is_asked_for_no_memory() -> None:
    found, runs = asked("lilibot", "tegotae")
    assert {run.controller for run in runs} == {"tegotae"}
    assert {"C3", "C4"} < {run.conditions for run in runs}
    assert found["memory"] == found["steering"] == found["blocked"] == 0.0


def test_every_run_has_a_seed_of_its_own_and_that_of_its_generation() -> None:
    seeds = [run.experiment.seed for run in tasks({}, 7)]
    assert seeds[:-1] == list(range(700, 700 + len(seeds) - 1))


def test_a_run_that_fell_costs_the_most_and_has_no_speed() -> None:
    for run in tasks({}, 0):
        walk = synthetic_record(run.experiment.duration)
        found = dict(run.judge(replace(walk, experiment=run.experiment, end=End.fell)))
        speeds = {name: found.pop(name) for name in list(found) if name.startswith("speed")}
        assert set(found.values()) == {FAILED} and set(speeds.values()) <= {0.0}


def test_a_candidate_that_is_no_robot_costs_the_most_and_spoils_no_other() -> None:
    sound = {"gamma_tegotae": 0.1}
    broken = {"gamma_tegotae": 0.1, "servo.stiffness": -1.0}
    alone = costs_of([sound], 1, controller="tegotae")
    assert costs_of([broken, sound], 1, controller="tegotae") == [(FAILED,) * len(names(4)), *alone]


def test_figures_of_the_front_are_those_of_the_walks() -> None:
    """Of walks that are a trot but for MI 0.06, at 1 MI m/s: 8 of 9 strict, 0.4 / 0.15 in speed."""
    results = []
    for experiment in walks_of({}, "lilibot", 2):
        assert isinstance(experiment.mi, float)
        phases = (0.0, 0.0, 0.0) if experiment.mi == 0.06 else TROT
        results.append(
            result_of(synthetic_record(experiment.duration, phases, speed=experiment.mi))
        )
    found = measured(results, 2)
    assert found["strict"] == pytest.approx(8 / 9) and found["payload"] == 1.0
    assert found["ratio"] == pytest.approx(0.4 / 0.15, rel=1e-3)
    assert found["turn_deg"] == pytest.approx(0.0, abs=1e-6)
    assert found["lift_mm"] == pytest.approx(found["least_lift_mm"])
    assert found["lifts"] == len(MI_VALUES) * (found["lift_mm"] >= 6.0)


def test_the_front_walks_every_candidate_with_and_without_payload(tmp_path: Path) -> None:
    variables = [variable.name for variable in design_variables("lilibot", "apnc")]
    numbers = ",".join(str(start(LILIBOT, name)) for name in variables)
    log = log_of(tmp_path, [",".join(["generation", *variables]), f"0,{numbers}"])
    front([log], tmp_path / "front.csv", "lilibot", 1, 1, 2)
    with (tmp_path / "front.csv").open(newline="") as file:
        shipped, same = csv.DictReader(file)
    assert (shipped.pop("candidate"), same.pop("candidate")) == ("shipped", f"{tmp_path.name}:2")
    # at all MI but the lowest and the highest every run forms the trot
    assert shipped == same and float(shipped["strict"]) > 6.9 / 9.0


def test_the_front_is_marked_and_an_interrupt_keeps_what_has_walked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    variables = [variable.name for variable in design_variables("lilibot", "apnc")]
    head = ",".join(["generation", "cost", "cost_mi_0.08", "cost_feet_0.08", *variables])
    numbers = ",".join("0.1" for _ in variables)
    log = log_of(tmp_path, [head, *(f"0,9,{n}.0,{-n}.0,{numbers}" for n in range(3))])

    def walked(
        tried: dict[str, dict[str, float]], robot: str, seeds: int, workers: int
    ) -> Iterator[tuple[str, dict[str, float]]]:
        for label, lift in zip(tried, (5.0, 6.0, 4.0), strict=False):
            yield label, {**dict.fromkeys(BETTER, 1.0), "lift_mm": lift}
        raise KeyboardInterrupt

    monkeypatch.setattr("apnc.studies.search.front.walked", walked)
    with pytest.raises(KeyboardInterrupt):
        front([log], tmp_path / "front.csv", "lilibot", 3, 1, 1)
    with (tmp_path / "front.csv").open(newline="") as file:
        results = list(csv.DictReader(file))
    assert [result["lift_mm"] for result in results] == ["5", "6", "4"]
    assert [result["front"] for result in results] == ["0", "1", "0"] and results[0][
        "candidate"
    ] == "shipped"
    assert float(results[0]["a2"]) == start(LILIBOT, "a2")


def walk(phases: Sequence[float] = TROT, speed: float = 0.1) -> Record:
    return synthetic_record(15.0, phases, speed=speed)


def on_feet(record: Record, feet: Array) -> Record:
    return replace(record, signals={**record.signals, "foot_position": feet})


def test_an_exact_straight_trot_on_clean_feet_costs_nothing() -> None:
    assert formation_cost(walk()) == pytest.approx(0.0, abs=1e-6)
    assert walk_cost(walk()) == pytest.approx(0.0, abs=0.05)
    assert feet_cost(walk()) == pytest.approx(0.0, abs=0.05)


def test_another_gait_costs_its_distance() -> None:
    # all of the time pi from the trot: 2 x 1, and 1.5 x the limit of 1.5
    assert formation_cost(walk((0.0, 0.0, 0.0))) == pytest.approx(2.0 + 1.5 * 1.5, abs=0.01)


def test_every_foot_that_hardly_lifts_costs() -> None:
    record = walk()
    flat = record.signals["foot_position"].copy()
    flat[:, 0, 2] = 0.0
    assert feet_cost(on_feet(record, flat)) - feet_cost(record) == pytest.approx(0.35, abs=0.01)
    flat[..., 2] = 0.0
    assert feet_cost(on_feet(record, flat)) - feet_cost(record) == pytest.approx(1.4, abs=0.01)


def test_every_foot_that_slips_costs() -> None:
    record = walk()
    feet = record.signals["foot_position"].copy()
    # in stance, 0.6 of a cycle of 1 / 1.4 s, a fifth of a stride of 0.1 / 1.4 m: twice what may be
    standing = record.signals["foot_force"][:, 3, 2] > 0.0
    feet[:, 3, 1] += np.cumsum(standing) * (0.2 * 0.1 / 1.4) / (0.6 / 1.4 * 60.0)
    found = feet_cost(on_feet(record, feet)) - feet_cost(record)
    assert found == pytest.approx(0.35 * (0.2 / 0.1 - 1.0), abs=0.08)


def test_a_slow_walk_costs() -> None:
    # at MI 0.08 0.068 m/s are asked for; a slow walk has short strides, so the rest differs
    assert walk_cost(walk(speed=0.038)) - walk_cost(walk()) == pytest.approx(0.6, abs=0.02)
    assert payload_cost(walk(speed=0.03)) - payload_cost(walk()) == pytest.approx(0.4, abs=0.02)


def test_a_curve_costs_by_its_rate_to_either_side() -> None:
    record = walk()
    for sign in (1.0, -1.0):
        rpy = record.signals["rpy"].copy()
        rpy[:, 2] = sign * 3.0 * WANTED_TURN * record.time
        turned = replace(record, signals={**record.signals, "rpy": rpy})
        added = feet_cost(turned) - feet_cost(record)
        assert added == pytest.approx(0.35 * np.log(4.0), abs=0.02)


def test_less_than_twice_the_speed_costs() -> None:
    assert ratio_cost(0.1, 0.2) == ratio_cost(0.1, 0.3) == 0.0
    assert ratio_cost(0.1, 0.15) == pytest.approx(0.5)
    assert ratio_cost(0.0, 0.0) == 2.0


def test_a_cost_per_band_and_name() -> None:
    for n_legs, bands in BANDS.items():
        assert len(names(n_legs)) == 2 * len(bands) + 7 == len(set(names(n_legs)))


def test_stopped_oscillators_cost_half_each() -> None:
    record = walk()
    o1 = record.signals["o1"].copy()
    o1[:, :2] = 0.3
    stopped = replace(record, signals={**record.signals, "o1": o1})
    assert damage_cost(stopped) - damage_cost(record) == pytest.approx(1.0)


def test_turning_goes_left_and_then_right() -> None:
    assert Experiment(**STEERING).turn == ((0.0, 0.0), (3.0, 0.5), (7.5, -0.5))


@pytest.mark.parametrize(
    ("left", "right", "cost"),
    [(1.0, 1.0, 0.0), (1.2, 1.2, 0.0), (0.5, 0.5, 1.0), (1.0, 0.5, 1.0), (0.0, 0.0, 2.0)],
)
def test_slow_and_unlike_turns_cost(left: float, right: float, cost: float) -> None:
    """In shares of what is asked for: what is missing on each side, and the difference."""
    record = synthetic_record(12.0)
    rate = np.where(record.time < 7.5, left, -right) * WANTED_STEERING
    rpy = record.signals["rpy"].copy()
    rpy[:, 2] = np.cumsum(rate) / 60.0
    turned = replace(record, signals={**record.signals, "rpy": rpy})
    assert steering_cost(turned) == pytest.approx(cost, abs=0.02)


def stuck(settings: dict[str, float]) -> Record:
    return simulate(compiled(blocked(LILIBOT, settings)))


def test_no_foot_feels_a_load_until_all_sensors_stick() -> None:
    grf, load = stuck({}).signals["grf"], 0.9 * LILIBOT.weight / 2.0
    # what the sensors deliver from a tick on is read at the next
    assert (grf[:301] == 0.0).all() and grf[301:] == pytest.approx(load)


def test_a_stuck_load_stops_an_oscillator_that_learns_and_not_one_that_does_not() -> None:
    assert blocked_cost(stuck({})) == 0.0
    assert blocked_cost(stuck({"B_f": 0.0, "B_s": 0.0})) == pytest.approx(0.2 + 0.5 * 2.0, abs=0.2)


def test_without_cma_the_extra_is_named(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(__import__("sys").modules, "cma", None)
    with pytest.raises(RuntimeError, match=r"'cma' is not installed: pip install .*\[search\]"):
        search(tmp_path)


def test_a_log_is_whole_or_the_older_one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("apnc.studies.search.__main__.costs_of", interrupted_after(1))
    log = log_of(tmp_path, ["older"])
    with pytest.raises(KeyboardInterrupt):
        search(tmp_path, controller="tegotae", generations=3, candidates=2)
    columns, lines = read_log(log, ["gamma_tegotae"])
    assert [line.texts["generation"] for line in lines] == ["0", "0", "mean0"]
    assert all(line.numbers(columns[1:]) for line in lines)
    monkeypatch.setattr("apnc.studies.search.__main__.costs_of", interrupted_after(0))
    log = log_of(tmp_path, ["older"])
    with pytest.raises(KeyboardInterrupt):
        search(tmp_path, controller="tegotae", generations=3, candidates=2)
    assert log.read_text() == "older"


def interrupted_after(generations: int) -> Callable[..., Array]:
    """Costs of 0; the signal comes after so many generations."""
    left = [None] * generations

    def costs_of(candidates: Sequence[object], *_: object) -> Array:
        if not left:
            raise KeyboardInterrupt
        left.pop()
        return np.zeros((len(candidates), len(names(4))))

    return costs_of


def test_workers_make_the_same_search(tmp_path: Path) -> None:
    pytest.importorskip("cma", reason="the extra search is not installed")
    for workers in (1, 2):
        search(tmp_path / str(workers), generations=1, candidates=2, workers=workers)
    one, two = ((tmp_path / name / "search.csv").read_text() for name in "12")
    assert one == two and one.count("\n") == 1 + 3

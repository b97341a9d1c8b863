"""What every study runs."""

from __future__ import annotations

from collections import Counter
from typing import Any

import pytest

from apnc.controllers import ALL, BASELINES, distinct, named_controller
from apnc.loop.schedule import parse_schedule, steps_of
from apnc.studies import gains
from apnc.studies.registry import STUDIES, names_of
from apnc.studies.runner import grid_of
from apnc.studies.study import Trial, load
from apnc_core.enumerations import Method
from apnc_plant.robot import load_robot


def count(name: str, trials: int = 2, **more: Any) -> Counter[tuple[Any, ...]]:
    """How often each controller and value of the axes occurs."""
    axes = load(STUDIES[name]).axes
    return Counter(
        (t.cell["controller"], *(t.cell[axis] for axis in axes))
        for t in grid_of(name, trials, **more)
    )


def of(name: str, **cell: Any) -> list[Trial]:
    return [t for t in grid_of(name, 2) if all(t.cell[k] == v for k, v in cell.items())]


@pytest.mark.parametrize(
    ("name", "cells", "others", "controllers", "duration"),
    [
        ("mi", 13, 7, ("apnc", "apc", *BASELINES), 45.0),
        ("rate", 8, 5, ALL, 60.0),
        ("terrain", 7, 5, ALL, 45.0),
        ("conditions", 4, 4, distinct(ALL, "conditions"), 45.0),
        ("damage", 1, 1, distinct(ALL, "damage"), 45.0),
        ("states", 1, 1, ("apnc", "apc", *distinct(BASELINES, "states"), "apnc_kept"), 34.0),
    ],
)
def test_apnc_walks_every_cell_and_the_others_fewer_with_half_of_the_seeds(
    name: str, cells: int, others: int, controllers: tuple[str, ...], duration: float
) -> None:
    found = count(name, 4)
    assert {cell[0] for cell in found} == set(controllers)
    own = {cell[1:]: n for cell, n in found.items() if cell[0] == "apnc"}
    assert len(own) == cells and set(own.values()) == {4}
    for controller in controllers[1:]:
        there = {cell[1:]: n for cell, n in found.items() if cell[0] == controller}
        assert len(there) == others and set(there.values()) == {2} and set(there) <= set(own)
    assert {t.experiment.duration for t in grid_of(name, 1)} == {duration}


@pytest.mark.parametrize("name", STUDIES)
def test_a_trial_is_what_its_cell_says(name: str) -> None:
    for trial in grid_of(name, 2):
        assert trial.experiment.duration == trial.cell["duration"]
        assert trial.experiment.controller == trial.cell["controller"]
        assert trial.experiment.seed == trial.cell["seed"]
        assert trial.experiment.preset == "robot"
        assert trial.experiment.description.name == "lilibot"
        if name not in ("gains", "steering"):  # which set something themselves
            used = named_controller(trial.cell["controller"])
            assert dict(trial.experiment.settings) == dict(used.in_study.get(name, {}))
            found = trial.experiment.parameters()
            assert found["method"] == Method[used.method]
            assert {n: found[n] for n in used.settings_in(name)} == used.settings_in(name)


def test_all_of_the_paper_takes_a_minute() -> None:
    """On two cores at 1,000 simulated seconds per second and core, with a little to spare."""
    assert sum(trial.experiment.duration for trial in grid_of("all", 20)) <= 95_000.0


def test_values_that_are_chosen_are_walked_in_full() -> None:
    found = count("rate", 4, chosen={"rate": [10.0]})
    assert found == dict.fromkeys([(label, 10.0) for label in ALL], 4)
    assert not [cell for cell in count("rate", 4) if cell[0] != "apnc" and cell[1] == 10.0]


def test_gains_are_those_of_each_method() -> None:
    found = count("gains", 20)
    wanted = {(m, mi, g) for m, grid in gains.GAINS.items() for mi in (0.08, 0.2) for g in grid}
    assert found == dict.fromkeys(wanted, 5)
    (own,) = of("gains", controller="apnc", gain=1.0, mi=0.08, seed=0)
    assert not own.experiment.settings
    rates = own.experiment.parameters()
    (tenth,) = of("gains", controller="apnc", gain=0.1, mi=0.08, seed=0)
    assert tenth.experiment.settings == pytest.approx({n: 0.1 * rates[n] for n in ("B_f", "B_s")})
    (printed,) = of("gains", controller="apnc_printed", mi=0.08, seed=0)
    rates = printed.experiment.parameters()
    assert (rates["B_f"], rates["B_s"]) == (0.002, 0.0002)
    (fixed,) = of("gains", controller="tegotae", gain=0.09, mi=0.08, seed=0)
    assert fixed.experiment.settings == {"gamma_tegotae": 0.09}
    (reset,) = of("gains", controller="phase_reset", gain=0.8, mi=0.2, seed=0)
    assert reset.experiment.settings == {"grf_reset": 0.8} and reset.experiment.mi == 0.2


def test_learning_rates_end_at_their_limit() -> None:
    (most,) = grid_of("gains", 1, ["apnc"], {"gain": [1000.0], "mi": [0.08]})
    assert most.experiment.settings["B_f"] == 1.0


def test_the_paper_is_all_of_its_experiments() -> None:
    assert names_of("all") == [name for name in STUDIES if name != "gait"]
    assert {t.study for t in grid_of("all", 1)} == set(names_of("all"))


def test_every_trial_has_its_own_place() -> None:
    trials = grid_of("all", 2)
    assert len({t.id for t in trials}) == len(trials)


def test_mi_is_that_of_the_cell() -> None:
    mis = {t.experiment.mi for t in grid_of("mi", 1)}
    assert sorted(mis) == pytest.approx([0.04 + 0.02 * i for i in range(13)])
    assert all(t.experiment.mi == t.cell["mi"] for t in grid_of("mi", 1))


def test_the_rate_is_the_rate_of_the_controller() -> None:
    assert sorted({1 / t.experiment.Ts for t in grid_of("rate", 1)}) == pytest.approx(
        [5.0, 10.0, 15.0, 20.0, 25.0, 30.0, 45.0, 60.0]
    )
    for trial in grid_of("rate", 1):
        assert trial.experiment.parameters()["Ts"] == pytest.approx(1.0 / trial.cell["rate"])
        assert trial.experiment.mi == 0.08


def test_the_ground_is_rough_and_other_for_every_seed() -> None:
    for trial in grid_of("terrain", 2):
        ground = trial.experiment.ground.to_dict()
        assert ground["kind"] == "obstacles"
        assert ground["roughness"] == trial.cell["roughness"]
        assert ground["seed"] == trial.cell["seed"]
        assert trial.experiment.mi == 0.08
    assert [t.cell["roughness"] for t in of("terrain", controller="apnc", seed=0)] == pytest.approx(
        [0.0, 0.2, 0.4, 0.6, 0.8, 0.9, 1.0]
    )


def test_conditions_are_the_papers() -> None:
    assert {t.experiment.conditions for t in grid_of("conditions", 1)} == {"C1", "C2", "C3", "C4"}
    assert all(t.experiment.conditions == t.cell["condition"] for t in grid_of("conditions", 1))
    assert all(t.experiment.mi == 0.08 for t in grid_of("conditions", 1))


def test_damage_is_a_damaged_leg() -> None:
    assert {(t.experiment.conditions, t.experiment.mi) for t in grid_of("damage", 1)} == {
        ("C3", 0.15)
    }


def test_states_follow_the_timeline() -> None:
    for trial in grid_of("states", 1):
        assert trial.experiment.conditions == (
            (0.0, "S1"),
            (1.7, "C1"),
            (14.0, "S2"),
            (20.0, "S3"),
        )
        assert trial.experiment.mi == ((0.0, 0.15), (20.0, 0.0), (24.0, 0.15))
        assert parse_schedule("mi", trial.cell["mi"], float) == trial.experiment.mi


def test_steering_turns_right_and_then_left() -> None:
    (turns,) = of("steering", schedule="turns", seed=0)
    assert turns.experiment.turn == ((0.0, 0.0), (20.0, -1.0), (35.0, 1.0), (50.0, 0.0))
    assert turns.experiment.mi == 0.15
    (speeds,) = of("steering", schedule="speeds", seed=1)
    assert speeds.experiment.mi == ((0.0, 0.15), (25.0, 0.4), (40.0, 0.15))
    assert steps_of(speeds.experiment.turn) == ((0.0, 0.0),)
    assert turns.experiment.duration == speeds.experiment.duration == 60.0


def test_slopes_are_scaled_on_straight_walks_with_half_of_the_seeds() -> None:
    assert set(count("steering", 4).items()) == {
        *((("apnc", schedule), 4) for schedule in ("speeds", "turns")),
        *((("apnc", f"slopes x {x}"), 2) for x in ("0.6", "0.8", "1", "1.2", "1.4")),
    }
    (own,) = of("steering", schedule="slopes x 1", seed=0)
    (more,) = of("steering", schedule="slopes x 1.2", seed=0)
    assert own.experiment.mi == more.experiment.mi == 0.15 and more.experiment.duration == 25.0
    for name in ("a1", "a2"):
        before, after = (t.experiment.parameters()[name] for t in (own, more))
        assert after == pytest.approx(1.2 * before)  # type: ignore[operator]


def test_chosen_values_methods_and_duration() -> None:
    trials = grid_of("mi", 1, ["tegotae"], {"mi": ["0.1", "0.1", 0.3]}, 5.0)
    assert [(t.experiment.controller, t.experiment.mi, t.experiment.duration) for t in trials] == [
        ("tegotae", 0.1, 5.0),
        ("tegotae", 0.3, 5.0),
    ]
    assert trials[0].cell["duration"] == 5.0


def test_methods_of_all_leave_the_others_alone() -> None:
    by_study = {(t.study, t.cell["controller"]) for t in grid_of("all", 1, ["tegotae"])}
    assert ("rate", "tegotae") in by_study and ("rate", "apnc") not in by_study
    assert {"apnc", "apc"} < {controller for study, controller in by_study if study == "states"}


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("moo", 1), "study 'moo' is not one of mi, rate, .*, all"),
        (("mi", 0), "trials = 0 is not at least 1"),
        (("mi", 1, ["moo"]), "controller 'moo' is not one of apnc"),
        (("mi", 1, []), "no controller is given"),
        (("states", 1, ["tegotae"]), "study 'states' takes no controllers"),
        (("mi", 1, None, {"mi": []}), "no mi is given"),
        (("mi", 1, None, {"mi": ["fast"]}), "mi = fast: not a number"),
        (("mi", 1, None, {"mi": [9.0]}), "mi: 9.0 is not in"),
        (("mi", 1, None, {"rate": [5.0]}), "rate is no axis of 'mi'; allowed: mi"),
        (("damage", 1, None, {"mi": [5.0]}), "mi is no axis of 'damage'; allowed: none"),
        (("conditions", 1, None, {"condition": ["C9"]}), "condition 'C9' is not one of C1, "),
        (("mi", 1, None, None, -1.0), "duration = -1"),
    ],
)
def test_bad_grids_are_refused(arguments: tuple[Any, ...], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        grid_of(*arguments)


def test_the_robot_asked_for_walks_with_its_own_numbers() -> None:
    for name in [name for name, entry in STUDIES.items() if "robot" in entry.options]:
        trials = grid_of(name, 1, robot="hexapod")
        assert {(t.cell["robot"], t.experiment.robot) for t in trials} == {("hexapod", "hexapod")}
    (steep,) = grid_of("steering", 1, chosen={"schedule": ["slopes x 1.2"]}, robot="hexapod")
    own = load_robot("hexapod").controller
    assert steep.experiment.settings == {k: pytest.approx(1.2 * own[k]) for k in ("a1", "a2")}


def test_options_of_the_registry_are_those_of_the_grid() -> None:
    for name, entry in STUDIES.items():
        assert set(entry.options) - {"controllers", "robot"} == set(load(STUDIES[name]).axes)

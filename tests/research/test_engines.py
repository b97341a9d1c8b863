"""Engines compared: grid, table, the replay of the same commands, cost at equal error."""

from __future__ import annotations

from collections import Counter

import pytest

from apnc.studies.runner import grid_of
from research import engines
from research.engines.replay import distances, path_of
from research.engines.speed import Cost, at_equal_error
from research.registry import STUDIES

needs_mujoco = pytest.mark.skipif(
    "not __import__('importlib').util.find_spec('mujoco')", reason="mujoco is not installed"
)


def walked_by(trials: int, **chosen: list[object]) -> Counter[str]:
    """Trials by engine."""
    found = grid_of("engines", trials, chosen=chosen or None, studies=STUDIES)
    return Counter(trial.cell["engine"] for trial in found)


def test_engines_that_are_not_installed_walk_only_if_they_are_asked_for(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(engines, "find_spec", lambda name: object())
    assert walked_by(1) == dict.fromkeys(engines.ENGINES, 12)
    monkeypatch.setattr(engines, "find_spec", lambda name: None)
    assert set(walked_by(1)) == {"exudyn", "compiled"}
    assert walked_by(3, engine=["mujoco"], mi=[0.08]) == {"mujoco": 3}


@needs_mujoco
def test_with_the_same_commands_the_engines_stay_together_up_to_rounding() -> None:
    assert path_of("mujoco", 2.0)[-1, 0] > 0.05  # m
    # also says that Exudyn's Velocity Verlet, "under development", is the one in the textbook
    assert distances("mujoco", 2.0).max() < 1e-11


def test_with_the_same_commands_plain_c_stays_with_exudyn_up_to_rounding() -> None:
    assert 0.0 < distances("compiled", 1.0).max() < 1e-11


def test_the_study_runs_every_engine_and_shows_them_side_by_side() -> None:
    trials = grid_of("engines", 2, chosen={"mi": ["0.15"]}, studies=STUDIES)
    found = {(t.cell["engine"], t.experiment.engine) for t in trials}
    assert found == {(engine, engine) for engine in ("exudyn", "mujoco", "compiled")}
    results = [
        {"study": "engines", **trial.cell, "convergence_time_s": 1.0 + k, "fell": False}
        for k, trial in enumerate(trials)
    ]
    table = engines.STUDY.table(results).splitlines()  # type: ignore[misc]
    assert [line.split(" | ")[1:4] for line in table[2:]] == [
        ["Exudyn", "2/2 (16 ... 100 %)", "1.5 (1.0 ... 2.0)"],
        ["MuJoCo", "2/2 (16 ... 100 %)", "3.5 (3.0 ... 4.0)"],
        ["plain C", "2/2 (16 ... 100 %)", "5.5 (5.0 ... 6.0)"],
    ]
    first = engines.STUDY.figures(results)[0]
    assert [trace["y"] for trace in first.data] == [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]]


def test_cost_at_equal_error_goes_along_the_powers_of_the_step() -> None:
    # twice the error at half the time per step: at equal error the same time
    costs = {("exudyn", n): Cost(1.0 / n, 2.0 * n) for n in (8, 16, 32)}
    costs |= {("mujoco", n): Cost(2.0 / n, 1.0 * n) for n in (8, 16, 32)}
    assert at_equal_error(costs, "exudyn") == pytest.approx(1.0)
    assert at_equal_error(costs, "mujoco") == pytest.approx(1.0)
    costs |= {("mujoco", n): Cost(8.0 / n, 1.0 * n) for n in (8, 16, 32)}  # beyond the measured
    assert at_equal_error(costs, "mujoco") == pytest.approx(4.0)
    bent = zip((8, 16, 32), (0.02, 0.01, 0.001), strict=True)
    costs |= {("mujoco", n): Cost(error, 1.0 * n) for n, error in bent}
    wanted, nearest = costs["exudyn", 16].force_error, 0.02  # by the two coarsest: first order
    assert at_equal_error(costs, "mujoco") == pytest.approx(8 * nearest / wanted / 32)

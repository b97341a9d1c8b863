from __future__ import annotations

import csv
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np
import pytest
from apnc.loop.walk import WalkOptions, walk
from apnc.studies.formation_picture import formation_svg
from apnc.studies.formation_study import run_formation
from apnc.studies.formation_table import formation_markdown, success_interval
from apnc.studies.memory_study import run_memory
from apnc.studies.scenarios import Outcome, Timeline, judge, run_scenario
from apnc.studies.trial_table import Execution, Row, run_trials
from jobs import JOBS, square

from apnc import metrics
from apnc.studies.search import KNOBS, formation_cost
from apnc.summary import summarise

# --- the preset forms its gait -----------------------------------------------------------------


@pytest.mark.parametrize("seed", range(5))
def test_default_walk_forms_a_trot_and_keeps_it(fmu4: Path, seed: int) -> None:
    options = WalkOptions(seed=seed, duration=20.0)
    record = walk(options, fmu4)
    summary = summarise(record, method=options.method, mi=options.mi, seed=seed)
    assert summary.converged
    assert summary.convergence_time_s is not None and summary.convergence_time_s < 9.0
    assert not summary.fell
    assert summary.speed_m_per_s is not None and summary.speed_m_per_s > 0.03
    # what is stored is the trot rather than pace, bound or legs in phase, if not to the last tenth,
    c = record.controller
    assert (c["kappa"] > 0.0).any()
    away = np.abs(metrics.wrap(c["phi_memory"][-1] - np.array([np.pi, np.pi, 0.0])))
    assert away.max() < np.pi / 4
    # and the couplings draw the gait nearer to the trot than what they hold
    error = metrics.phase_error(c["o1"], c["o2"], (np.pi, np.pi, 0.0))
    assert error[-300:].max() < 0.3


@pytest.mark.parametrize("seed", range(3))
def test_trot_forms_under_the_payload(fmu4: Path, seed: int) -> None:
    options = WalkOptions(mi=0.15, seed=seed, duration=20.0, condition="C4")
    summary = summarise(walk(options, fmu4), method=options.method, mi=options.mi, seed=seed)
    assert summary.converged and not summary.fell
    assert summary.speed_m_per_s is not None and summary.speed_m_per_s > 0.06


def test_without_the_limit_of_loads_the_payload_changes_the_feedback(fmu4: Path) -> None:
    """F_max acts where the load exceeds half the weight, which is in every step under payload."""
    options = WalkOptions(mi=0.15, duration=6.0, condition="C4", settings={"F_max": 100.0})
    limited = walk(replace(options, settings={}), fmu4).controller["gamma"]
    assert walk(options, fmu4).controller["gamma"].mean() > 1.2 * limited.mean()


@pytest.mark.parametrize("mi", [0.08, 0.15])
def test_walks_with_leg_rf_held_still(fmu4: Path, mi: float) -> None:
    options = WalkOptions(mi=mi, duration=20.0, condition="C3")
    record = walk(options, fmu4)
    summary = summarise(record, method=options.method, mi=mi, seed=0)
    assert not summary.fell
    assert summary.path_speed_m_per_s is not None and summary.path_speed_m_per_s > 0.03
    assert np.ptp(record.controller["o1"][-240:], axis=0).min() > 1.0  # none has stopped
    assert np.ptp(record.plant["joint_angle"][-240:, 0, 1:], axis=0).max() < 0.1


def test_without_load_feedback_no_trot_forms(fmu4: Path) -> None:
    """The criterion tells a trot from four legs in phase: the learners off, nothing forms."""
    options = WalkOptions(method="apc", duration=12.0, settings={"B_f": 0.0, "B_s": 0.0})
    summary = summarise(walk(options, fmu4), method="apc", mi=options.mi, seed=0)
    assert summary.converged is False
    assert summary.convergence_time_authors_s is None


# --- S1 to S3 ----------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def with_anc(fmu4: Path) -> Outcome:
    return judge(run_scenario(fmu4, 1, True))


@pytest.fixture(scope="module")
def without_anc(fmu4: Path) -> Outcome:
    return judge(run_scenario(fmu4, 1, False))


def test_with_couplings_the_gait_survives_broken_sensors_and_a_stop(with_anc: Outcome) -> None:
    assert with_anc.as_paper_says(anc=True) == {"S1": True, "S2": True, "S3": True}
    assert with_anc.stored_at_s is not None and with_anc.stored_at_s < Timeline().broken
    assert with_anc.recovery_time_s is not None and with_anc.recovery_time_s < 5.0
    assert not with_anc.front_stopped and not with_anc.in_phase


def test_without_couplings_it_does_not(without_anc: Outcome) -> None:
    assert without_anc.stored_at_s is None
    assert not without_anc.kept and not without_anc.recovered
    says = without_anc.as_paper_says(anc=False)
    assert says["S2"] and says["S3"]
    assert without_anc.speed_s2 < 0.05 and without_anc.front_stopped and without_anc.in_phase


def test_no_load_before_the_robot_is_set_down(fmu4: Path) -> None:
    when = Timeline(lowered=1.0, broken=2.0, stopped=2.2, restarted=2.4, end=2.6)
    record = run_scenario(fmu4, 0, True, when)
    force = record.plant["foot_force"][..., 2]
    assert np.all(force[record.time < 0.99] == 0.0)
    assert force[record.time > 1.5].sum(axis=1).mean() == pytest.approx(2.5 * 9.81, rel=0.1)
    stuck = record.plant["grf"][(record.time > 2.05) & (record.time < 2.2)]
    assert np.allclose(stuck[:, [0, 2]], 0.9 * 24.525 / 2.0)
    assert not np.allclose(stuck[:, 1], stuck[0, 1])
    assert np.all(record.plant["grf"][record.time > 2.25] == 0.0)
    stopped = (record.time > 2.2 - 1e-9) & (record.time < 2.4 - 1e-9)
    assert np.all(record.controller["MI"][stopped] == 0.0)
    assert np.all(record.controller["MI"][~stopped] == when.mi)


def test_times_must_follow_each_other() -> None:
    with pytest.raises(ValueError, match="do not follow"):
        Timeline(broken=1.0)


# --- study -------------------------------------------------------------------------------------


def _table(path: Path) -> list[dict[str, str]]:
    with path.open(newline="") as file:
        return list(csv.DictReader(file))


def test_formation_study_small(tmp_path: Path) -> None:
    seen: list[tuple[int, int]] = []
    execution = Execution(2, progress=lambda *n: seen.append(n))
    table = run_formation(tmp_path, 2, (0.08,), ("apnc", "apc"), 6.0, execution)
    rows = _table(table)
    assert [(r["method"], r["mi"], r["seed"]) for r in rows] == [
        ("apnc", "0.08", "0"),
        ("apnc", "0.08", "1"),
        ("apc", "0.08", "0"),
        ("apc", "0.08", "1"),
    ]
    assert all(r["error"] == "" and r["fell"] == "0" for r in rows)
    assert rows[0]["turned_deg"] != rows[1]["turned_deg"]  # seeds differ
    assert seen[0] == (0, 4) and seen[-1] == (4, 4)
    assert "| apc | 0.08 |" in (tmp_path / "formation.md").read_text()
    ElementTree.parse(tmp_path / "formation.svg")

    before = table.read_text()
    with pytest.raises(ValueError, match="is there already"):
        run_formation(tmp_path, 2, (0.08,), duration=6.0)
    seen.clear()
    again = Execution(resume=True, progress=lambda *n: seen.append(n))
    run_formation(tmp_path, 2, (0.08,), duration=6.0, execution=again)
    assert seen == [(4, 4)]  # nothing was run again
    assert table.read_text() == before


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"seeds": 0}, "trials = 0"),
        ({"mis": (1.5,)}, "mi = 1.5"),
        ({"mis": ()}, "at least one"),
        ({"methods": ("trot",)}, "method 'trot'"),
        ({"duration": -1.0}, "duration = -1"),
    ],
)
def test_formation_study_refuses(tmp_path: Path, arguments: dict[str, Any], message: str) -> None:
    with pytest.raises(ValueError, match=message):
        run_formation(tmp_path, **({"seeds": 1, "mis": (0.08,)} | arguments))
    assert not (tmp_path / "formation.csv").exists()


def test_memory_study_refuses(tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="trials = 0"):
        run_memory(tmp_path, 0)


def test_interval_of_a_rate() -> None:
    # closed form at the ends: (alpha / 2)^(1 / n)
    assert success_interval(20, 20)[0] == pytest.approx(0.025 ** (1 / 20))
    assert success_interval(0, 20) == pytest.approx((0.0, 1.0 - 0.025 ** (1 / 20)))
    with pytest.raises(ValueError, match="at least one"):
        success_interval(0, 0)


def _row(method: str, mi: float, seconds: float | None) -> Row:
    return {
        "method": method,
        "mi": mi,
        "converged": int(seconds is not None),
        "convergence_time_s": seconds,
        "convergence_time_authors_s": 2.0,
        "late_speed_m_per_s": 0.1,
        "fell": 0,
    }


def test_table_counts_failures_and_errors() -> None:
    failed = {"method": "apnc", "mi": 0.1, "error": "PlantError: diverged"}
    rows = [_row("apnc", 0.1, 3.0), _row("apnc", 0.1, 5.0), _row("apnc", 0.1, None), failed]
    assert "| apnc | 0.10 | 2/4 |" in formation_markdown(rows)
    assert "| 4.0 (3.5 ... 4.5; 5.0) | 3/4 | 2.0 |" in formation_markdown(rows)


def test_picture_shows_every_group() -> None:
    rows = [_row(m, mi, 2.0 + mi + n) for m in "ab" for mi in (0.1, 0.2) for n in range(5)]
    rows += [_row("b", 0.3, None)]
    root = ElementTree.fromstring(formation_svg(rows))
    boxes = [e for e in root.iter() if e.tag.endswith("rect") and float(e.get("y", 0)) > 40]
    assert len(boxes) == 4  # no time, no box
    assert "s]" in "".join(root.itertext())


# --- table of trials ---------------------------------------------------------------------------


def test_trial_that_raises_is_a_row(tmp_path: Path) -> None:
    rows = run_trials(JOBS, square, tmp_path / "t.csv")
    assert [row["number"] for row in _table(tmp_path / "t.csv")] == ["3", "1", "2", "5"]
    assert rows[0]["error"] == "RuntimeError: three, of all numbers"
    assert rows[3]["square"] == "25" and rows[3]["error"] == ""


def test_rows_do_not_depend_on_the_number_of_workers(tmp_path: Path) -> None:
    run_trials(JOBS, square, tmp_path / "1.csv")
    run_trials(JOBS, square, tmp_path / "2.csv", Execution(workers=2))
    assert (tmp_path / "1.csv").read_text() == (tmp_path / "2.csv").read_text()


def test_stopped_and_resumed_is_the_same_as_run_through(tmp_path: Path) -> None:
    asked = iter([False, False, True])
    run_trials(JOBS, square, tmp_path / "t.csv", Execution(stop=lambda: next(asked)))
    assert len(_table(tmp_path / "t.csv")) == 2
    with (tmp_path / "t.csv").open("a") as file:
        file.write("5,2")  # cut off while it was written
    run_trials(JOBS, square, tmp_path / "t.csv", Execution(resume=True))
    run_trials(JOBS, square, tmp_path / "whole.csv")
    assert (tmp_path / "t.csv").read_text() == (tmp_path / "whole.csv").read_text()


def test_execution_refuses_no_workers() -> None:
    with pytest.raises(ValueError, match="workers = 0"):
        Execution(workers=0)


# --- search ------------------------------------------------------------------------------------


def test_knobs_reach_their_ends_and_their_start() -> None:
    for knob in KNOBS:
        assert knob.value(0.0) == pytest.approx(knob.low)
        assert knob.value(1.0) == pytest.approx(knob.high)
        assert knob.value(knob.place(knob.start)) == pytest.approx(knob.start)


def test_search_prefers_a_formed_trot(fmu4: Path) -> None:
    settings = {"B_f": 0.0, "B_s": 0.0}
    formed = walk(WalkOptions(duration=12.0, method="apc"), fmu4)
    in_phase = walk(WalkOptions(duration=12.0, method="apc", settings=settings), fmu4)
    assert formation_cost(formed, 0.07) + 1.0 < formation_cost(in_phase, 0.07)

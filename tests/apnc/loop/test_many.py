"""Many closed loops side by side: each as it walks alone, whatever else happens."""

from __future__ import annotations

import threading
import time
import weakref
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from apnc.features import walk_features
from apnc.loop import controller_library as loader
from apnc.loop.batch import Batch, Run, lanes_of
from apnc.loop.experiment import Experiment
from apnc.loop.many import compiled, walk_many
from apnc.loop.record import End, Record
from apnc.loop.simulate import simulate
from apnc.many import simulate_many
from apnc_plant.ground import Kerb, Obstacles
from apnc_plant.robot import load_robot

WALK = Experiment(engine="compiled", mi=0.15, duration=1.5)
TIMED: dict[str, Any] = {"real_time_factor": None, "fmu_share_of_wall_time": None}
"""Figures that differ from run to run."""


def several() -> list[Experiment]:
    """Runs of six kinds, of unequal length, one of which falls, more of a kind than lanes."""
    top_heavy = load_robot("lilibot")
    trunk = replace(top_heavy.trunk, com=(-0.2, 0.0, 0.3))
    top_heavy = replace(top_heavy, trunk=trunk)
    return [
        *(replace(WALK, seed=seed, duration=0.5 + 0.1 * seed) for seed in range(11)),
        replace(WALK, robot=top_heavy, duration=5.0),
        replace(WALK, robot="hexapod"),
        replace(WALK, rate=30.0, conditions=((0.0, "S1"), (0.5, "C2"))),
        replace(WALK, ground=Obstacles(roughness=0.8, seed=3)),
        replace(WALK, ground=Kerb(at=0.05, height=0.004)),
        replace(WALK, settings={"xi": 0.05}, controller="tegotae", turn=((0.0, 0.0), (0.7, 1.0))),
    ]


def same(a: Record, b: Record) -> bool:
    pairs = [(a.signals[name], b.signals[name]) for name in a.signals]
    return a.end == b.end and all(np.array_equal(x, y) for x, y in pairs)


def test_chosen_signals_have_the_bits_that_they_have_among_all() -> None:
    chosen = frozenset({"o2", "phi", "rpy", "foot_force"})
    runs, found = several(), dict[int, Any]()
    for index, record in walk_many(runs, lambda _, record: record, signals=chosen):
        found[index] = record
    for run, record in zip(runs, map(found.__getitem__, range(len(runs))), strict=True):
        whole = simulate(run)
        assert chosen <= set(record.signals) and "o1" not in record.signals
        assert "position" not in record.signals and record.end == whole.end
        for name, values in record.signals.items():
            assert np.array_equal(values, whole.signals[name]), name


@pytest.mark.parametrize("workers", [1, 3])
def test_each_walks_as_it_walks_alone(workers: int) -> None:
    runs, told = several(), list[tuple[int, int]]()
    alone = [simulate(run) for run in runs]
    assert [record.end for record in alone].count(End.fell) == 1
    found = simulate_many(
        runs, workers=workers, records=True, progress=lambda *numbers: told.append(numbers)
    )
    assert all(many is not None and same(many, one) for many, one in zip(found, alone, strict=True))
    assert told == [(n, len(runs)) for n in range(1, len(runs) + 1)]
    summaries = simulate_many(runs, workers=workers)
    for summary, record in zip(summaries, alone, strict=True):
        assert summary is not None
        assert replace(summary, **TIMED) == replace(walk_features(record), **TIMED)


def test_another_engine_walks_in_c_and_the_record_says_so() -> None:
    (record,) = simulate_many([replace(WALK, engine="exudyn")], records=True)
    assert record is not None and record.experiment == compiled(record.experiment) == WALK


def test_none_is_no_work_and_no_workers_are_refused() -> None:
    assert simulate_many([]) == []
    with pytest.raises(ValueError, match="workers = 0 is not at least 1"):
        simulate_many([], workers=0)


def test_a_controller_that_cannot_be_used_is_said(fmu4: Path, tmp_path: Path) -> None:
    path = tmp_path / "own.fmu"
    path.write_bytes(fmu4.read_bytes())
    own = replace(WALK, fmu=str(path))
    path.write_bytes(b"no zip")
    with pytest.raises(ValueError, match=r"own\.fmu: not an FMU"):
        simulate_many([WALK, own])


def test_an_error_of_one_run_ends_no_other() -> None:
    def each(index: int, record: Record) -> int:
        if index == 2:
            raise ZeroDivisionError("moo")
        return len(record)

    runs = [replace(WALK, seed=seed, duration=0.5) for seed in range(10)]
    found = dict(walk_many(runs, each, workers=2))
    error = found.pop(2)
    assert isinstance(error, ZeroDivisionError)
    assert found == {n: 30 for n in range(10) if n != 2}


def test_an_error_of_no_run_ends_the_work(monkeypatch: pytest.MonkeyPatch) -> None:
    def walk(batch: Batch, ticks: int) -> None:
        raise OSError("moo")

    monkeypatch.setattr(Batch, "walk", walk)
    with pytest.raises(OSError, match="moo"):
        simulate_many([WALK] * 3, workers=2)


def test_a_stop_ends_the_work_and_what_is_done_stays() -> None:
    done = [0]

    def progress(count: int, total: int) -> None:
        done[0] = count

    runs = [replace(WALK, duration=0.5), *[replace(WALK, duration=3000.0)] * 3]
    before = threading.active_count()
    found = simulate_many(runs, workers=2, progress=progress, stop=lambda: done[0] == 1)
    assert [summary is None for summary in found] == [False, True, True, True]
    assert threading.active_count() == before


def test_who_looks_at_no_more_results_leaves_no_threads() -> None:
    before = threading.active_count()
    results = walk_many([WALK, *[replace(WALK, duration=3000.0)] * 2], lambda *run: 0, workers=2)
    assert next(results) == (0, 0)
    results.close()  # type: ignore[attr-defined]  # a generator
    assert threading.active_count() == before


def test_a_run_that_was_told_takes_no_memory(monkeypatch: pytest.MonkeyPatch) -> None:
    alive, most = weakref.WeakSet[Run](), [0]

    def begun(*what: Any) -> Run:
        run = Run(*what)
        alive.add(run)
        most[0] = max(most[0], len(alive))
        return run

    monkeypatch.setattr("apnc.loop.many.Run", begun)
    lanes = Batch(lanes_of(WALK), 1).size
    simulate_many([replace(WALK, seed=seed, duration=0.2) for seed in range(4 * lanes)])
    assert most == [lanes]


def test_threads_that_begin_together_load_a_controller_once(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    loaded: list[Path] = []

    def slowly(path: Path) -> str:
        loaded.append(path)
        time.sleep(0.1)
        return "controller"

    monkeypatch.setattr(loader, "ControllerLibrary", slowly)
    threads = [
        threading.Thread(target=loader.controller_library, args=[tmp_path / "any.fmu"])
        for _ in range(2)
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    loader._loaded.cache_clear()
    assert len(loaded) == 1


@pytest.mark.parametrize("later", [1e9, 3e17, 1e300])
@pytest.mark.parametrize(("name", "values"), [("mi", (0.15, 0.4)), ("conditions", ("C1", "S3"))])
def test_a_step_after_the_end_of_a_run_changes_nothing(
    name: str, values: tuple[object, object], later: float
) -> None:
    plain = Experiment(engine="compiled", duration=1, **{name: values[0]})
    stepped = replace(plain, **{name: ((0.0, values[0]), (later, values[1]))})
    a, b = simulate(plain), simulate(stepped)
    assert len(b) == 60
    assert np.array_equal(a.signals["position"], b.signals["position"])

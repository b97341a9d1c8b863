"""A walk under an FMU of one's own: its start values hold, and the summary shows what it had."""

from __future__ import annotations

import json
import shlex
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
import typer

from apnc import Experiment, Record, load_robot, simulate, simulate_many, write_report
from apnc.cli.app import app
from apnc.cli.walk import experiment_of
from apnc.report.wording import facts
from apnc_core.enumerations import Method
from build_fmu.build import cached_fmu
from build_fmu.options import BuildOptions, host_platform

GAIT = (3.1, 3.2, 0.1)
OWN: dict[str, Any] = {
    "a1": 0.0,
    "robot_weight": 60.0,
    "stored": True,
    "phi_stored": GAIT,
    "Ts": 0.02,
    "method": "apc",
}
"""Start values that are not those of the table."""

COMMAND: Any = typer.main.get_command(app).commands["walk"]  # type: ignore[attr-defined]


def built(settings: dict[str, Any], legs: int = 4) -> str:
    options = BuildOptions(legs=legs, platforms=(host_platform(),), settings=settings)
    return str(cached_fmu(options))


@pytest.fixture(scope="module")
def own() -> str:
    return built(OWN)


def said(*words: str) -> Experiment:
    return experiment_of(COMMAND.make_context("walk", list(words)).params)


def starts(experiment: Experiment) -> dict[str, Any]:
    return {name: experiment.parameters()[name] for name in OWN}


HELD = OWN | {"method": Method.apc}


def test_its_values_hold_and_nothing_else_changes(own: str) -> None:
    found, usual = Experiment(fmu=own), Experiment().parameters()
    assert starts(found) == HELD
    assert (found.rate, found.controller, found.ticks) == (50.0, None, 45 * 50)
    assert found.controller_name == "apc"
    assert {n: v for n, v in found.parameters().items() if n not in OWN} == {
        n: v for n, v in usual.items() if n not in OWN
    }


def walks(experiment: Experiment) -> list[Record]:
    """In Python, in C alone and in C beside another."""
    in_c = replace(experiment, engine="compiled")
    records = [simulate(experiment), simulate(in_c), *simulate_many([in_c] * 2, records=True)]
    return [record for record in records if record is not None]


def test_it_walks_with_them_in_every_loop_and_they_are_read_back(own: str, tmp_path: Path) -> None:
    records = walks(Experiment(fmu=own, duration=0.5))
    assert len(records) == 4
    for record in records:
        assert {name: record.parameters[name] for name in OWN} == HELD
        assert len(record) == 25
        assert np.ptp(record.signals["theta_hip"]) == 0.0  # slope a1
        assert (record.signals["phi_memory"] == GAIT).all()
        write_report(record, tmp_path)
        shown = json.loads((tmp_path / "summary.json").read_text())["parameters"]
        assert {name: shown[name] for name in OWN} == OWN | {"phi_stored": list(GAIT)}


def test_the_report_tells_which_of_its_values_held(own: str) -> None:
    record = simulate(Experiment(fmu=own, duration=0.1, settings={"a1": 0.2}))
    told = dict(facts(record))
    assert told["FMU"] == own and told["Stored gait"] == "φ 3.1 3.2 0.1 rad at the start"
    assert "robot_weight 60" in told["Start values of the FMU"]
    assert "a1" not in told["Start values of the FMU"]
    assert "FMU" not in dict(facts(simulate(Experiment(duration=0.1))))


def test_what_is_read_back_is_what_an_experiment_set() -> None:
    changes: dict[str, Any] = {"N": 40, "kappa_rule": "printed", "phi_frozen": False, "xi": 0.05}
    for experiment in (Experiment(duration=0.1), Experiment(duration=0.1, settings=changes)):
        for record in walks(experiment):
            assert record.parameters == experiment.parameters()
            assert all(type(v) is type(experiment.parameters()[k]) for k, v in
                       record.parameters.items())  # fmt: skip


def test_another_fmu_in_an_experiment_brings_its_rate_and_method_if_none_is_asked_for(
    own: str,
) -> None:
    usual = Experiment(duration=1.0)
    kept: Any = {"rate": None, "controller": None}
    assert replace(usual, fmu=own, **kept) == Experiment(fmu=own, duration=1.0)
    assert replace(Experiment(fmu=own, duration=1.0), fmu=None, **kept) == usual
    assert starts(replace(usual, fmu=own)) == HELD | {"Ts": 1 / 60, "method": Method.apnc}


def test_what_is_set_wins(own: str) -> None:
    words = ("--set", "a1=0.2", "--set", "robot_weight=50", "--set", "stored=false")
    found = said(
        "--fmu", own, *words, "--set", "phi_stored=[]", "--rate", "60", "--controller", "apnc"
    )
    assert starts(found) == {
        "a1": 0.2, "robot_weight": 50.0, "stored": False, "phi_stored": (), "Ts": 1 / 60,
        "method": Method.apnc,
    }  # fmt: skip
    record = simulate(replace(found, duration=0.1))
    assert record.parameters == found.parameters()


def test_its_method_and_settings_hold_unless_a_controller_is_named() -> None:
    fmu = built({"method": "tegotae", "gamma_tegotae": 0.07})
    found = Experiment(fmu=fmu)
    assert found.controller is None and found.controller_name == "tegotae"
    assert found.parameters()["method"] is Method.tegotae
    assert found.parameters()["gamma_tegotae"] == 0.07
    assert Experiment(fmu=fmu, controller="tegotae").parameters()["gamma_tegotae"] == 0.015
    longer = replace(found, duration=1.0)
    assert longer.parameters() == found.parameters()


def test_a_preset_that_is_named_wins_but_sets_nothing_of_the_run(own: str) -> None:
    for preset in ("paper", "lilibot"):
        found = Experiment(fmu=own, preset=preset)
        assert starts(found) == HELD | {"a1": 0.14}
        assert found.parameters()["xi"] == Experiment(preset=preset).parameters()["xi"]


def test_they_go_before_the_table_of_the_robot_which_fills_in_what_the_fmu_leaves(
    own: str, fmu4: Path
) -> None:
    tuned = replace(load_robot("lilibot"), controller={"a1": 0.21, "xi": 0.07})
    heavy = replace(tuned, trunk=replace(tuned.trunk, mass=2.0))
    found = Experiment(fmu=own, robot=heavy).parameters()
    assert (found["a1"], found["xi"], found["robot_weight"]) == (0.0, 0.07, 60.0)
    # the defaults are no values of an FMU's own: with them the robot walks as with the built FMU
    plain = Experiment(fmu=str(fmu4), robot=heavy).parameters()
    assert plain == Experiment(robot=heavy).parameters()
    assert (plain["a1"], plain["robot_weight"]) == (0.21, heavy.weight)


def test_an_fmu_of_another_robot_with_a_change_keeps_it() -> None:
    hexapod = load_robot("hexapod")
    fmu = built({**hexapod.controller, "robot_weight": hexapod.weight, "a1": 0.0}, legs=6)
    found, usual = (Experiment(robot="hexapod", fmu=f).parameters() for f in (fmu, None))
    assert found == usual | {"a1": 0.0}


@pytest.mark.parametrize(
    "words",
    [(), ("--rate", "60", "--controller", "apnc"), ("--rate", "50"), ("--preset", "paper")],
)
def test_the_command_and_the_data_say_it_again(words: tuple[str, ...], own: str) -> None:
    experiment = said("--fmu", own, *words)
    again = said(*shlex.split(experiment.command())[2:])
    through_json = Experiment.from_dict(json.loads(json.dumps(experiment.to_dict())))
    assert again == through_json == experiment
    assert again.key() == through_json.key() == experiment.key()


def test_the_key_is_that_of_what_it_starts_with(own: str) -> None:
    keys = {Experiment(fmu=own, settings=s).key() for s in ({}, {"a1": 0.14}, {"a1": 0.0})}
    assert len(keys) == 2  # said or of the FMU, a1 = 0 is the same


def test_an_fmu_that_cannot_be_used_is_refused_before_anything_runs(
    fmu6: Path, tmp_path: Path
) -> None:
    with pytest.raises(ValueError, match="is for 6 legs; robot 'lilibot' has 4"):
        Experiment(fmu=str(fmu6))
    with pytest.raises(ValueError, match=r"no\.fmu: no such file"):
        Experiment(fmu=str(tmp_path / "no.fmu"))

"""The examples of the Modelica package run to the end and show what they say."""

from __future__ import annotations

import re

import numpy as np
import pytest
from modelica_runs import ROOT, Run, run

from apnc_core.interface import Parameters

TROT = np.array([np.pi, np.pi, 0.0])


def example(name: str, duration: float, changes: str = "") -> Run:
    return run(f"model Test\n  extends Apnc.Examples.{name}{changes};\nend Test;", duration)


def errors(done: Run) -> np.ndarray:
    """Largest distance of the relative phases to the trot at every tick [rad]."""
    return np.abs(done.at_ticks("phi", 3) - TROT).max(axis=1)


def test_the_stored_gait_comes_back_without_loads() -> None:
    done = example("RecalledGait", 20.0)
    assert done.result.time[-1] == 20.0
    off = errors(done)
    # held in phase for 2 s, then to the stored trot within 7 s, and there to the end
    assert (off[:120] > 3.0).all()
    assert (off[540:] < 0.2).all()
    # the oscillators themselves: diagonals together, sides apart
    o1 = done.at_ticks("o1", 4)[600:]
    correlation = np.corrcoef(o1.T)
    assert correlation[0, 3] > 0.95 and correlation[0, 1] < -0.95


def test_without_memory_the_gait_does_not_come_back() -> None:
    done = example("RecalledGait", 10.0, "(controller(stored=false))")
    assert (errors(done) > 3.0).all()


def test_loads_alone_form_the_trot_and_memory_keeps_it() -> None:
    done = example("FormationWithLoads", 30.0)
    kappa = done.at_ticks("kappa")
    assert 3.0 < np.argmax(kappa > 0) / 60 < 12.0
    assert (errors(done)[600:] < 0.6).all()
    assert done.at_ticks("grf", 4)[-1].tolist() == [0.0] * 4


def test_without_loads_no_trot_forms() -> None:
    done = example("FormationWithLoads", 15.0, "(lost=0.0)")
    assert errors(done)[-1] > 3.0


def test_steering_scales_the_sides_against_each_other() -> None:
    hip = example("Steering", 20.0).at_ticks("theta_hip", 4)
    left, right = hip[13 * 60 : 16 * 60], hip[17 * 60 :]

    def swing(part: np.ndarray) -> np.ndarray:
        return np.asarray(part.max(axis=0) - part.min(axis=0))

    gain = Parameters().turn_gain
    more, less = 1.0 + gain, 1.0 - gain
    for part, shares in ((left, [more, more, less, less]), (right, [less, less, more, more])):
        found, own = swing(part), np.array(shares)
        assert found.max() > 0.1  # rad
        np.testing.assert_allclose(found * own[::-1], found[::-1] * own, rtol=0.05, atol=0.01)


PAGE = (ROOT / "docs" / "modelica.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("code", re.findall(r"^```modelica\n(.*?)^```", PAGE, re.M | re.S))
def test_the_model_in_the_documentation_finds_its_gait(code: str) -> None:
    done = run(code.replace("MyRobot", "Test"), 15.0)
    assert done.at_ticks("kappa")[-1] == 1.0
    assert errors(done)[-1] < 0.6

"""The native controller against the FMU and the reference, and that breaking a block shows."""

from __future__ import annotations

import shutil
from dataclasses import asdict
from pathlib import Path

import numpy as np
import pytest
from fmu_slave import TS, slave
from modelica_runs import LIBRARY, Run, driven, run

from apnc_core.controller import Controller
from apnc_core.enumerations import CouplingSign, ForwardModel, KappaRule, Method, PhaseMeasure
from apnc_core.interface import Inputs, Parameters
from apnc_core.presets import preset
from apnc_core.schema import Causality, Shape
from apnc_core.variables import variables_of

TOLERANCE = 1e-9
TICKS = 400
OUTPUTS = variables_of(Causality.output) + variables_of(Causality.local)

# sigma and hold are such that the couplings switch on early in the run
COUPLED = {"kappa_hold": 10, "sigma": 1.0}
PEAKS = {"phase_measure": PhaseMeasure.peak, **COUPLED}
RADIAL = {"forward_model": ForwardModel.radial_basis, "rbf_rate": 0.1, **COUPLED}
METHODS = {m.name: {"method": m, **COUPLED} for m in Method}
CASES = METHODS | {
    "peak measure": PEAKS,
    "printed kappa rule": {"kappa_rule": KappaRule.printed},
    "live phases": {"phi_frozen": False, **COUPLED},
    "printed sign": {"coupling_sign": CouplingSign.printed, **COUPLED},
    "knee's copy": {"forward_model": ForwardModel.low_pass_knee, **COUPLED},
    "radial basis": RADIAL,
    "bias": {"bias": 0.01, **COUPLED},
    "stored": {"stored": True, "phi_stored": (3.1, 3.2, 0.1)},
}


def literal(value: object) -> str:
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, tuple):
        return "{" + ", ".join(map(literal, value)) + "}"
    if isinstance(value, (Method, ForwardModel, PhaseMeasure, KappaRule, CouplingSign)):
        return f"Apnc.Types.{type(value).__name__}.{value.name}"
    return repr(value)


def modification(changes: dict[str, object]) -> str:
    return ", ".join(f"{name}={literal(value)}" for name, value in changes.items())


def native(changes: dict[str, object], ticks: int, n_legs: int = 4, library: Path = LIBRARY) -> Run:
    done = run(driven(modification(changes), n_legs), (ticks - 0.5) * TS, library)
    assert len(done.first) == ticks
    return done


def outputs(done: Run, n_legs: int = 4) -> dict[str, np.ndarray]:
    return {
        v.name: done.at_ticks(v.name, 0 if v.shape is Shape.scalar else v.count(n_legs))
        for v in OUTPUTS
    }


def inputs(done: Run, n_legs: int = 4) -> list[Inputs]:
    loads = done.at_ticks("grf", n_legs)
    commands = [done.at_ticks(name) for name in ("MI", "turn", "reset")]
    return [
        Inputs(g, float(MI), float(turn), bool(reset))
        for g, MI, turn, reset in zip(loads, *commands, strict=True)
    ]


def of_the_fmu(
    path: Path, changes: dict[str, object], given: list[Inputs]
) -> dict[str, np.ndarray]:
    scalars = {v.name: [v.scalar_name(i) for i in range(v.count(4))] for v in OUTPUTS}
    phi = changes.get("phi_stored", ())
    flat = {k: v for k, v in changes.items() if k != "phi_stored"}
    flat |= {f"phi_stored[{i + 1}]": value for i, value in enumerate(phi)}  # type: ignore[arg-type]
    found: dict[str, list[list[float]]] = {name: [] for name in scalars}
    with slave(path) as fmu:
        fmu.start(**flat)  # type: ignore[arg-type]
        for n, now in enumerate(given):
            fmu.loads(list(now.grf))
            fmu.put("MI", now.MI)
            fmu.put("turn", now.turn)
            fmu.put("reset", now.reset)
            fmu.step(n * TS)
            for name, members in scalars.items():
                found[name].append([fmu.get(member) for member in members])
    values = {v.name: np.array(found[v.name], dtype=float) for v in OUTPUTS}
    alone = [v.name for v in OUTPUTS if v.shape is Shape.scalar]
    return values | {name: values[name][:, 0] for name in alone}


def of_the_reference(
    changes: dict[str, object], given: list[Inputs], n_legs: int = 4
) -> dict[str, np.ndarray]:
    controller = Controller(Parameters(**changes), n_legs)  # type: ignore[arg-type]
    ticks = [controller.tick(now) for now in given]
    return {v.name: np.array([getattr(o, v.name) for o in ticks], dtype=float) for v in OUTPUTS}


def differences(a: dict[str, np.ndarray], b: dict[str, np.ndarray]) -> dict[str, float]:
    """Largest difference per output; a value that is not a number differs."""
    return {k: float(np.nan_to_num(np.abs(a[k] - b[k]), nan=np.inf).max()) for k in a}


ALWAYS = {"apnc", "tegotae", "phase_reset", "peak measure", "radial basis", "stored"}
"""Cases of the default run, in which every block is at work."""


@pytest.mark.parametrize(
    "case",
    [pytest.param(c, marks=[] if c in ALWAYS else [pytest.mark.thorough]) for c in CASES],
)
def test_native_controller_equals_the_fmu(case: str, fmu4: Path) -> None:
    done = native(CASES[case], TICKS)
    got = outputs(done)
    off = differences(got, of_the_fmu(fmu4, CASES[case], inputs(done)))
    assert max(off.values()) <= TOLERANCE, off
    assert got["fault"].any() and not got["fault"].all()
    coupled = "method" not in CASES[case] or case == "apnc"
    assert (np.abs(got["g1"]).max() > 1e-3) == coupled


@pytest.mark.parametrize("n_legs", [2, 6])
def test_other_numbers_of_legs_equal_the_reference(n_legs: int) -> None:
    done = native(COUPLED, 300, n_legs)
    expected = of_the_reference(COUPLED, inputs(done, n_legs), n_legs)
    off = differences(outputs(done, n_legs), expected)
    assert max(off.values()) <= TOLERANCE, off
    assert done.at_ticks("kappa").any()


def test_the_printed_preset_equals_the_reference() -> None:
    source = driven("").replace("Apnc.Blocks.Controller", "Apnc.Presets.Paper")
    done = run(source, 299.5 * TS)
    expected = of_the_reference(asdict(preset("paper")), inputs(done))
    off = differences(outputs(done), expected)
    assert max(off.values()) <= TOLERANCE, off


MUTATIONS: dict[str, tuple[str, str, dict[str, object]]] = {
    "Blocks/Commands.mo": ("pre(tick) + 1", "pre(tick) + 2", {}),
    "Blocks/FootLoad.mo": ("2.0 / robot_weight", "2.0001 / robot_weight", {}),
    "Blocks/Oscillator.mo": ("- f1 + g1", "+ f1 + g1", {}),
    "Blocks/MotorNeurons.mo": ("1.0 - turn_gain", "1.0 + turn_gain", {}),
    "Blocks/SensoryFeedback.mo": ("F * sin(o2)", "F * sin(o1)", {}),
    "Blocks/DualRateLearner.mo": ("F - grf_expected", "F + grf_expected", {}),
    "Blocks/ForwardModel.mo": ("(1.0 - rho)", "(1.0 + rho)", {}),
    "Blocks/TouchDown.mo": ("F >= 0.5", "F >= 0.6", METHODS["phase_reset"]),
    "Blocks/PhaseAcquisition.mo": ("- o1[1] * o2[2:n]", "+ o1[1] * o2[2:n]", {}),
    "Blocks/PhaseEstimation.mo": ("calm >= kappa_hold", "calm > kappa_hold", COUPLED),
    "Blocks/NeuralCoupling.mo": ("xi else -xi", "xi else xi", COUPLED),
    "Blocks/Leg.mo": ("connect(g2, oscillator.g2)", "connect(g1, oscillator.g2)", COUPLED),
    "Blocks/Controller.mo": ("i <= div(n, 2)", "i < div(n, 2)", {}),
    "Functions/couple.mo": ("+ cos(o[k]) * sin", "- cos(o[k]) * sin", COUPLED),
    "Functions/vectorAngles.mo": ("x[r] > 0.0 then atan", "x[r] > 0.0 then -atan", {}),
    "Functions/kernels.mo": ("(o2 - Constants", "(o1 - Constants", RADIAL),
    "Functions/stanceWeights.mo": ("< 0.0", "> 0.0", RADIAL),
    "Functions/wrap.mo": ("then angle[r] + 2.0", "then angle[r] - 2.0", {}),
    "Functions/mean.mo": ("/ size(window, 1)", "/ (size(window, 1) + 1)", {}),
    "Functions/peakTimes.mo": ("before[k] >= o1[k]", "before[k] < o1[k]", PEAKS),
    "Functions/peakAngles.mo": ("t_peak[1] - t_peak", "t_peak[1] + t_peak", PEAKS),
}


@pytest.mark.thorough
@pytest.mark.parametrize("file", MUTATIONS)
def test_breaking_a_block_shows(file: str, tmp_path: Path) -> None:
    good, bad, changes = MUTATIONS[file]
    shutil.copytree(LIBRARY, tmp_path / "modelica")
    broken = tmp_path / "modelica" / "Apnc" / file
    text = broken.read_text()
    assert good in text
    broken.write_text(text.replace(good, bad))
    done = native(changes, 120, library=tmp_path / "modelica")
    off = differences(outputs(done), of_the_reference(changes, inputs(done)))
    assert max(off.values()) > TOLERANCE

"""The FMU against the Python reference, over random loads, and that breaking a block shows."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from hypothesis import Phase, given, settings
from parity import Comparison, Run, compare, drawn_runs, random_inputs, uniform_run

from apnc_core.controller import Controller
from apnc_core.enumerations import ForwardModel, Method, PhaseMeasure
from apnc_core.interface import Parameters
from apnc_core.schema import Causality
from apnc_core.variables import variables_of
from build_fmu import sources
from build_fmu.build import fmu_bytes
from build_fmu.options import BuildOptions, host_platform

TOLERANCE = 1e-9

# sigma and hold are such that the couplings switch on and off in the random run
COUPLED = {"kappa_hold": 10, "sigma": 1.0}
PEAKS = {"phase_measure": PhaseMeasure.peak, **COUPLED}

TICKS = 300
# these seeds meet every rule: each parameter is noticed in one of them
RUNS = [uniform_run(seed) for seed in range(20, 60)]
# without shrinking, which takes a minute; the long form does it
FEW = settings(
    max_examples=8, deadline=None, derandomize=True, database=None, phases=(Phase.generate,)
)


@pytest.fixture(scope="session")
def paths(fmu4: Path, fmu6: Path) -> dict[int, Path]:
    return {4: fmu4, 6: fmu6}


def equal(result: Comparison) -> bool:
    """Bit for bit, but for d: the FMU keeps the sum of Eq. 14 that the reference takes anew."""
    differing = {name for name, off in result.difference.items() if off != 0.0}
    return differing <= {"d"} and result.worst <= TOLERANCE


def check(paths: dict[int, Path], run: Run) -> None:
    n_legs, changes, seed = run
    result = compare(paths[n_legs], changes, n_legs, TICKS, seed)
    assert equal(result), (run, result.difference)


@pytest.mark.parametrize(
    "part",
    [
        pytest.param(slice(10), id="first 10"),
        pytest.param(slice(10, None), id="others", marks=pytest.mark.thorough),
    ],
)
def test_fmu_equals_reference_for_any_parameters(paths: dict[int, Path], part: slice) -> None:
    for run in RUNS[part]:
        check(paths, run)


@FEW
@given(run=drawn_runs())
def test_fmu_equals_reference_at_the_ends_of_ranges(paths: dict[int, Path], run: Run) -> None:
    check(paths, run)


@pytest.mark.slow
@settings(max_examples=2000, deadline=None)
@given(run=drawn_runs())
def test_fmu_equals_reference_for_many_parameters(paths: dict[int, Path], run: Run) -> None:
    check(paths, run)


def outputs(run: Run, ignored: str = "") -> np.ndarray:
    """Outputs of the reference over a drawn run, one parameter left at its default."""
    n_legs, changes, seed = run
    inputs = random_inputs(seed, TICKS, n_legs, float(changes["robot_weight"]))  # type: ignore[arg-type]
    used = {name: value for name, value in changes.items() if name != ignored}
    reference = Controller(Parameters(**used), n_legs)  # type: ignore[arg-type]  # typed per name
    return np.array([
        np.concatenate([out.theta_hip, out.theta_knee, out.gamma, out.phi, [out.d, out.kappa]])
        for out in map(reference.tick, inputs)
    ])  # fmt: skip


@pytest.fixture(scope="session")
def outputs_of_runs() -> list[np.ndarray]:
    return [outputs(run) for run in RUNS]


@pytest.mark.thorough
@pytest.mark.parametrize(
    "name",
    [v.name for v in variables_of(Causality.parameter) if v.name != "Ts"],  # acts on time alone
)
def test_a_parameter_that_one_side_ignores_would_be_noticed(
    name: str, outputs_of_runs: list[np.ndarray]
) -> None:
    assert any(
        np.abs(outputs(run, ignored=name) - expected).max() > TOLERANCE
        for run, expected in zip(RUNS, outputs_of_runs, strict=True)
    )


@pytest.mark.thorough
@pytest.mark.parametrize("n_legs", [4, 6])
def test_fmu_equals_reference_over_minutes(n_legs: int, paths: dict[int, Path]) -> None:
    result = compare(paths[n_legs], COUPLED, n_legs, ticks=10_000)
    assert equal(result), result.difference


def test_comparison_over_half_a_minute_exercises_every_output(fmu4: Path) -> None:
    result = compare(fmu4, COUPLED, 4, ticks=2_000)
    assert equal(result), result.difference
    assert [name for name, value in result.size.items() if value == 0.0] == []


KNEE = {"forward_model": ForwardModel.low_pass_knee}
RADIAL = {"forward_model": ForwardModel.radial_basis}
TEGOTAE, RESET = {"method": Method.tegotae}, {"method": Method.phase_reset}
MUTATIONS: dict[str, tuple[str, str, str, dict[str, object]]] = {
    "load": ("load.h", "2 / robot_weight", "2.0001 / robot_weight", {}),
    "load limit": ("load.h", "F < F_max ? F : F_max", "F", {}),
    "oscillator": ("oscillator.h", "w12 * o2", "1.0001 * w12 * o2", {}),
    "motor neurons": ("motor_neurons.h", "scale * a * o + b", "scale * a * o", {}),
    "sensory feedback": ("sensory_feedback.h", "F * sin_o2", "F * cos_o1", {}),
    "dual-rate learner": ("dual_rate_learner.h", "A * K + B * e", "A * K + B", {}),
    "forward model": ("forward_model.h", "theta <= theta", "theta > theta", {}),
    "knee's copy": ("controller.c", "? out->theta_knee", "? out->theta_hip", KNEE),
    "kernels": ("forward_model.h", "0.5 / APNC", "0.5001 / APNC", RADIAL),
    "learned load": ("forward_model.h", "step * kernel", "1.0001 * step * kernel", RADIAL),
    "phase acquisition": ("phase_acquisition.h", "first1 * o2[r + 1];\n        s", "0.0;\n s", {}),
    "peak measure": ("phase_acquisition.h", "/ s->period", "/ (s->period + 1.0)", PEAKS),
    "phase estimation": ("phase_estimation.h", "1 / N", "1 / (N + 1)", {}),
    "switch": ("phase_estimation.h", "s->calm >= p", "s->calm > p", COUPLED),
    "neural coupling": ("neural_coupling.h", "gain * (", "1.0001 * gain * (", COUPLED),
    "yielding feedback": ("controller.c", "kept * apnc_gain", "kept * 1.001 * apnc_gain", COUPLED),
    "tegotae": (
        "tegotae.h",
        "p->gamma_tegotae",
        "0.9 * p->gamma_tegotae",
        {"method": Method.tegotae},
    ),
    "phase reset": ("phase_reset.h", "F_before < threshold &&", "", RESET),
}


@pytest.mark.thorough
@pytest.mark.parametrize("block", MUTATIONS)
def test_breaking_a_block_shows(block: str, tmp_path: Path) -> None:
    name, good, bad, changes = MUTATIONS[block]
    files = sources.collect()
    text = files[name].decode()
    assert good in text
    # what a mutation leaves unused is no reason to refuse the build
    pragma = "".join(
        f'#pragma GCC diagnostic ignored "-W{w}"\n' for w in ("unused", "unused-parameter")
    )
    files[name] = (pragma + text.replace(good, bad, 1)).encode()
    broken = tmp_path / "Broken.fmu"
    broken.write_bytes(fmu_bytes(BuildOptions(platforms=(host_platform(),)), files=files))
    assert compare(broken, changes, 4, ticks=1_000).worst > TOLERANCE

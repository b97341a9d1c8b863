"""The FMU against the Python reference, over random loads, and that breaking a block shows."""

from __future__ import annotations

from pathlib import Path

import pytest
from parity import compare

from apnc_core.enumerations import CouplingSign, KappaRule, Method, PhaseMeasure
from build_fmu import sources
from build_fmu.build import fmu_bytes
from build_fmu.options import BuildOptions, host_platform

TOLERANCE = 1e-9

# sigma and hold are such that the couplings switch on and off in the random run
COUPLED = {"kappa_hold": 10, "sigma": 1.0}
PEAKS = {"phase_measure": PhaseMeasure.peak, **COUPLED}

CASES: dict[str, dict[str, object]] = {
    "apnc": COUPLED,
    "apc": {"method": Method.apc},
    "tegotae": {"method": Method.tegotae},
    "phase_reset": {"method": Method.phase_reset},
    "peak measure": PEAKS,
    "printed kappa rule": {"kappa_rule": KappaRule.printed},
    "live phases": {"phi_frozen": False, **COUPLED},
    "printed sign": {"coupling_sign": CouplingSign.printed, **COUPLED},
    "MI = 0 runs on": {"MI_zero_resets": False},
    "bias": {"bias": 0.01},
}


@pytest.mark.parametrize("case", CASES)
@pytest.mark.parametrize("n_legs", [4, 6])
def test_fmu_equals_reference(case: str, n_legs: int, fmu4: Path, fmu6: Path) -> None:
    result = compare(fmu4 if n_legs == 4 else fmu6, CASES[case], n_legs, ticks=10_000)
    assert result.worst <= TOLERANCE, result.difference


@pytest.mark.parametrize("n_legs", [4, 6])
def test_fmu_equals_reference_from_a_stored_gait(n_legs: int, fmu4: Path, fmu6: Path) -> None:
    stored = {"stored": True, "phi_stored": tuple(0.5 * k for k in range(1, n_legs))}
    result = compare(fmu4 if n_legs == 4 else fmu6, stored, n_legs, ticks=10_000)
    assert result.worst <= TOLERANCE, result.difference


def test_comparison_exercises_every_output(fmu4: Path) -> None:
    size = compare(fmu4, COUPLED, 4, ticks=2_000).size
    assert [name for name, value in size.items() if value == 0.0] == []


MUTATIONS: dict[str, tuple[str, str, str, dict[str, object]]] = {
    "load": ("load.h", "2.0 / robot_weight", "2.0001 / robot_weight", {}),
    "load limit": ("load.h", "F < F_max ? F : F_max", "F", {}),
    "oscillator": ("oscillator.h", "w12 * o2", "1.0001 * w12 * o2", {}),
    "motor neurons": ("motor_neurons.h", "scale * a * o + b", "scale * a * o", {}),
    "sensory feedback": ("sensory_feedback.h", "F * sin_o2", "F * cos_o1", {}),
    "dual-rate learner": ("dual_rate_learner.h", "A * K + B * e", "A * K + B", {}),
    "forward model": ("forward_model.h", "theta_hip <= theta", "theta_hip > theta", {}),
    "phase acquisition": ("phase_acquisition.h", "o1[0] * o2[r + 1];\n        s", "0.0;\n s", {}),
    "peak measure": ("phase_acquisition.h", "/ s->period", "/ (s->period + 1.0)", PEAKS),
    "phase estimation": ("phase_estimation.h", "1.0 / N", "1.0 / (N + 1)", {}),
    "switch": ("phase_estimation.h", "s->calm >= p", "s->calm > p", COUPLED),
    "neural coupling": ("neural_coupling.h", "gain * (", "1.0001 * gain * (", COUPLED),
    "yielding feedback": ("controller.c", "kept * gamma", "kept * 1.001 * gamma", COUPLED),
    "tegotae": ("tegotae.h", "p->gamma_tegotae", "0.9 * p->gamma_tegotae", CASES["tegotae"]),
    "phase reset": ("phase_reset.h", "F_before < threshold &&", "", CASES["phase_reset"]),
}


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

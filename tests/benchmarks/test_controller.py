"""The benchmark of the controller: what a tick computes, and that the timed loops do it."""

from __future__ import annotations

import ctypes
from pathlib import Path

import pytest

from benchmarks import controller, python_fmu
from benchmarks.core_loops import CoreLoops
from build_fmu import sources
from build_fmu.compile import compile_library
from build_fmu.options import PLATFORMS, BuildOptions, host_platform

COUNTING = """
#include <math.h>
#include "apnc.h"
#include "count.h"
int counted_sin, counted_cos, counted_tanh;
double count_sin(double x) { counted_sin++; return (sin)(x); }
double count_cos(double x) { counted_cos++; return (cos)(x); }
double count_tanh(double x) { counted_tanh++; return (tanh)(x); }
static apnc_data data;
static apnc_state state;
__attribute__((visibility("default"))) void count(int coupled, int ticks, int *result) {
    apnc_defaults(&data);
    data.parameters.stored = coupled;
    apnc_init(&data.parameters, &state, &data.outputs);
    counted_sin = counted_cos = counted_tanh = 0;
    for (int n = 0; n < ticks; n++)
        apnc_tick(&data.parameters, &state, &data.inputs, &data.outputs);
    result[0] = counted_sin + counted_cos;
    result[1] = counted_tanh;
}
"""
REDIRECT = """
double count_sin(double), count_cos(double), count_tanh(double);
"""


def calls_per_tick(legs: int, coupled: bool, folder: Path) -> tuple[int, int]:
    """Sines and cosines, and hyperbolic tangents, of one tick, counted by wrapped functions."""
    files = sources.collect() | {
        "apnc_config.h": sources.config_header(BuildOptions(legs=legs, platforms=()), ""),
        "count.h": REDIRECT.encode(),
        "count.c": COUNTING.encode(),
    }
    wrapped = '#define APNC_LIBM\n#include <math.h>\n#include "count.h"\n'
    wrapped += "".join(f"#define {f}(x) count_{f}(x)\n" for f in ("sin", "cos", "tanh"))
    files["controller.c"] = wrapped.encode() + files["controller.c"]
    for name, text in files.items():
        (folder / name).write_bytes(text)
    platform = PLATFORMS[host_platform()]
    library = folder / f"count{platform.suffix}"
    c_files = ["controller.c", "apnc_variables.c", "count.c"]
    library.write_bytes(compile_library(folder, c_files, platform))
    result = (ctypes.c_int * 2)()
    ctypes.CDLL(str(library)).count(int(coupled), 10, result)
    return result[0] // 10, result[1] // 10


@pytest.mark.parametrize("legs", [4, 16])
@pytest.mark.parametrize("coupled", [True, False])
def test_sines_and_cosines_grow_with_the_legs_not_their_pairs(
    legs: int, coupled: bool, tmp_path: Path
) -> None:
    assert calls_per_tick(legs, coupled, tmp_path) == ((4 if coupled else 2) * legs, 2 * legs)


def test_loops_run_and_take_time() -> None:
    with CoreLoops(4) as loops:
        assert 10 < loops.core(2000) < 1e6
    with CoreLoops(4, libm=True) as loops:
        assert 10 < loops.core(2000) < 1e6


def test_a_failing_step_is_an_error() -> None:
    step = ctypes.CFUNCTYPE(
        ctypes.c_int, ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_int
    )
    with CoreLoops(4) as loops:
        assert loops.steps(step(lambda c, t, h, n: 0), None, 0.0, 1.0, 5) > 0
        with pytest.raises(RuntimeError, match="failed with status 3"):
            loops.steps(step(lambda c, t, h, n: 3), None, 0.0, 1.0, 5)


def test_a_step_is_measured_on_the_coupled_controller() -> None:
    from_c, through_fmpy = controller.steps(20_000, rounds=2)
    assert min(through_fmpy.values) > max(from_c.values) > 0.0
    assert from_c.against == "core" and from_c.least is not None


@pytest.mark.skipif(not python_fmu.available(), reason="pythonfmu is not installed")
def test_the_controller_in_python_is_far_slower() -> None:
    from_c, _ = controller.against_python(20_000, 100, rounds=2)
    assert from_c.ratio is not None and from_c.ratio > 10

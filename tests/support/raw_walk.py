"""A short walk of a raw instance, for tests that compare it with the same walk in other ways."""

from __future__ import annotations

from fmu_slave import SCALARS
from raw_fmu import OK, TS, Instance

from apnc_core.schema import Causality, Type

REAL_OUTPUTS = [
    s.value_reference
    for s in SCALARS.values()
    if s.variable.causality is Causality.output and s.variable.type is Type.real
]
LOADS = [SCALARS[f"leg[{i}].grf"].value_reference for i in range(1, 5)]
TICK = [SCALARS["tick"].value_reference]


def walk(fmu: Instance, ticks: int = 60, start: float = 0.0, step: float = TS) -> list[list[float]]:
    seen = []
    for n in range(ticks):
        fmu.set(LOADS, [3.0 + n % 7, 9.0, 5.0, 8.0 - n % 5])
        assert fmu.step(start + n * step, step) == OK, fmu.messages
        seen.append(fmu.get(REAL_OUTPUTS))
    return seen


def ticks_after(fmu: Instance) -> int:
    return int(fmu.get(TICK, "Integer")[0])

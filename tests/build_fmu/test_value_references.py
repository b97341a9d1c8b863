"""Value references are a contract with importers: none moves, none is used twice."""

from __future__ import annotations

import hashlib

import pytest

from apnc_core.schema import VR_STRIDE, VR_TIME, Causality, Variable
from apnc_core.variable_numbers import VARIABLE_NUMBERS
from apnc_core.variables import TABLE, scalars
from build_fmu import generate

RELEASED = 57
FINGERPRINT = "208f20102477736e"
"""Of the released variables. New ones come after them; then they are pinned as well."""


def fingerprint(n: int) -> str:
    lines = [f"{name} {number}" for name, number in list(VARIABLE_NUMBERS.items())[:n]]
    return hashlib.sha256("\n".join(lines).encode()).hexdigest()[:16]


def test_no_variable_moved() -> None:
    assert fingerprint(RELEASED) == FINGERPRINT


def test_a_few_of_them_as_importers_know_them() -> None:
    found = {s.name: s.value_reference for s in scalars(6)}
    assert found["leg[1].grf"] == 0 and found["leg[6].grf"] == 5 and found["MI"] == 100
    assert found["robot_weight"] == 500
    assert [found[f"leg[{k}].theta_hip"] for k in range(1, 7)] == list(range(3900, 3906))
    assert [found[f"phi[{k}]"] for k in range(1, 6)] == list(range(5000, 5005))


def test_numbers_are_counted_on_and_each_variable_has_one() -> None:
    assert list(VARIABLE_NUMBERS.values()) == list(range(len(VARIABLE_NUMBERS)))
    assert {v.name for v in TABLE} <= set(VARIABLE_NUMBERS)
    assert VR_STRIDE * len(VARIABLE_NUMBERS) <= VR_TIME


NEW = Variable("new", "", "new", Causality.local, "discrete", unit="1", nominal=1.0)


def test_a_variable_put_in_front_gets_the_next_number(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(generate, "TABLE", (NEW, *TABLE))
    assert generate.variable_numbers() == VARIABLE_NUMBERS | {"new": len(VARIABLE_NUMBERS)}
    text = generate.render()
    assert text["fmu_src/core/apnc_variables.c"].rindex('{"new"') > text[
        "fmu_src/core/apnc_variables.c"
    ].index('{"K_s"')
    assert f"| `K_s` | {VR_STRIDE * VARIABLE_NUMBERS['K_s']} |" in text["docs/variables.md"]


def test_a_removed_variable_leaves_its_number_empty(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(generate, "TABLE", tuple(v for v in TABLE if v.name != "bias"))
    assert generate.variable_numbers() == VARIABLE_NUMBERS
    text = generate.render()["fmu_src/core/apnc_variables.c"]
    lines = text[text.index("apnc_variables[APNC_VARIABLES]") :].splitlines()[1:]
    assert lines[VARIABLE_NUMBERS["bias"]].startswith('    {"", "", "", 0, 0,')
    assert lines[VARIABLE_NUMBERS["o1_start"]].startswith('    {"o1_start"')

"""The table of variables and what is generated from it."""

from __future__ import annotations

import re
from dataclasses import fields, replace
from pathlib import Path

import pytest

from apnc_core.interface import Parameters
from apnc_core.presets import preset
from apnc_core.schema import Causality, Type
from apnc_core.variables import TABLE, scalars, variable_named, variables_of
from build_fmu import generate

# FMI 2.0.4, section 2.2.9: the part of the grammar of structured names without quoted names
_STRUCTURED = re.compile(r"^[A-Za-z_]\w*(\[\d+(,\d+)*\])?(\.[A-Za-z_]\w*(\[\d+(,\d+)*\])?)*$")


def test_generated_files_match_the_table() -> None:
    assert generate.outdated(Path(__file__).resolve().parents[2]) == []


def test_drift_is_noticed(tmp_path: Path) -> None:
    for path, text in generate.render().items():
        (tmp_path / path).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / path).write_text(text)
    assert generate.outdated(tmp_path) == []
    changed = tmp_path / "fmu_src/core/apnc_variables.h"
    changed.write_text(changed.read_text().replace("apnc_real MI;", "float MI;"))
    assert generate.outdated(tmp_path) == ["fmu_src/core/apnc_variables.h"]


@pytest.mark.parametrize("n_legs", [2, 4, 6, 64])
@pytest.mark.parametrize("naming", ["structured", "flat"])
def test_scalars_are_unique_and_well_named(n_legs: int, naming: str) -> None:
    members = list(scalars(n_legs, naming))
    assert len({m.name for m in members}) == len(members)
    assert len({m.value_reference for m in members}) == len(members)
    if naming == "structured":
        assert all(_STRUCTURED.match(m.name) for m in members)
    else:
        assert all(m.name.isidentifier() for m in members)


def test_value_references_do_not_depend_on_the_number_of_legs() -> None:
    of4 = {m.name: m.value_reference for m in scalars(4)}
    of6 = {m.name: m.value_reference for m in scalars(6)}
    assert all(of6[name] == reference for name, reference in of4.items())


def test_every_variable_is_complete() -> None:
    for v in TABLE:
        assert v.description
        assert (v.start is None) == (v.causality in (Causality.output, Causality.local))
        if v.type is Type.real:
            assert v.unit and v.nominal
        if v.causality is Causality.parameter and v.type in (Type.real, Type.integer):
            assert v.min is not None and v.max is not None and v.start is not None
            assert v.min <= v.start <= v.max
            assert v.paper is None or v.min <= v.paper <= v.max
        for name in v.initial_from:
            assert variable_named(name).causality is Causality.parameter


def test_parameters_are_those_of_the_table() -> None:
    assert [f.name for f in fields(Parameters)] == [
        v.name for v in variables_of(Causality.parameter)
    ]


def test_preset_paper_has_the_printed_constants() -> None:
    # section 2 of the paper, Eq. 3, 7, 8, 10, 16, 17
    p = preset("paper")
    assert (p.w12_0, p.w11) == (0.21, 1.4)
    assert (p.A_s, p.A_f, p.B_s, p.B_f) == (0.99, 0.57, 0.0002, 0.002)
    assert (p.alpha, p.rho, p.N, p.sigma, p.xi) == (0.9, 0.99, 50, 0.4, 0.01)


def test_unknown_preset_is_named() -> None:
    with pytest.raises(ValueError, match="preset 'cow' is not one of lilibot, paper"):
        preset("cow")


def test_one_run_writes_a_changed_table_everywhere(monkeypatch: pytest.MonkeyPatch) -> None:
    """The single header of the Modelica package holds the table too, and is made from it."""
    changed = replace(variable_named("phase_filter"), start=0.0421)
    table = tuple(changed if v.name == "phase_filter" else v for v in TABLE)
    monkeypatch.setattr(generate, "TABLE", table)
    monkeypatch.setattr(
        generate, "variables_of", lambda of: tuple(v for v in table if v.causality is of)
    )
    files = generate.render()
    for path in ("fmu_src/core/apnc_variables.c", "modelica/Apnc/Resources/Include/apnc_core.h"):
        assert "0.0421" in files[path], path

"""Regression values: rows of commit 92b5ace, before there was one study machine."""

from __future__ import annotations

import pytest

from apnc.studies.engine import grid_of, run_trial
from apnc.studies.rows import Row

ROWS: list[tuple[str, Row, Row]] = [
    (
        "mi",
        {"method": "apnc", "mi": 0.28},
        {
            "convergence_time_s": 1.8833333333333333,
            "convergence_time_authors_s": 0.9166666666666666,
            "path_speed_m_per_s": 0.1462691409499894,
            "balance": 153.4283458674494,
            "cost_of_transport": 1.253751269808672,
            "phi_final_12": 3.1699513665723984,
        },
    ),
    (
        "rate",
        {"method": "tegotae", "rate": 50.0},
        {
            "convergence_time_s": None,
            "convergence_time_authors_s": 40.199999999999996,
            "path_speed_m_per_s": 0.025418126880240803,
            "balance": 118.8471259024792,
            "cost_of_transport": 2.458239234006596,
            "phi_final_12": 1.4563483496516638,
        },
    ),
    (
        "steering",
        {"course": "turns"},
        {
            "yaw_rate_section_2": -0.07617364575596744,
            "yaw_rate_section_3": 0.14308837681244108,
            "convergence_time_s": 3.15,
            "convergence_time_authors_s": 2.533333333333333,
            "path_speed_m_per_s": 0.0896263948779073,
            "balance": 75.02735213880456,
            "cost_of_transport": 1.225524838394476,
            "phi_final_12": 3.1477748760103523,
        },
    ),
    (
        "states",
        {"method": "apc"},
        {
            "state_formation_time_s": 1.7333333333333334,
            "state_front_stopped": True,
            "state_speed_s2": 0.022225318478972817,
            "state_in_phase": True,
            "path_speed_m_per_s": 0.04779583302261049,
            "balance": 147.54531419474216,
            "cost_of_transport": 1.863526515581275,
        },
    ),
]


@pytest.mark.parametrize(("study", "cell", "figures"), ROWS, ids=[row[0] for row in ROWS])
def test_the_row_is_the_same(study: str, cell: Row, figures: Row) -> None:
    (trial,) = [t for t in grid_of(study, 1) if cell.items() <= t.cell.items()]
    row = run_trial(trial)
    # to the last bit where the rows were made; the C libraries of others round otherwise
    assert {name: row[name] for name in figures} == {
        name: value if value is None else pytest.approx(value, rel=1e-6)
        for name, value in figures.items()
    }

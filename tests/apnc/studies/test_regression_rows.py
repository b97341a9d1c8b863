"""Regression values: rows of the commit that brought the searched set with the authors' slopes."""

from __future__ import annotations

import pytest

from apnc.studies.engine import grid_of, run_trial
from apnc.studies.rows import Row

ROWS: list[tuple[str, Row, Row]] = [
    (
        "mi",
        {"method": "apnc", "mi": 0.28},
        {
            "convergence_time_s": 2.0166666666666666,
            "convergence_time_authors_s": 1.1,
            "path_speed_m_per_s": 0.17706823467222724,
            "balance": 145.79033937625812,
            "cost_of_transport": 0.9392067728241537,
            "phi_final_12": 3.2098287537371633,
        },
    ),
    (
        "rate",
        {"method": "tegotae", "rate": 60.0},
        {
            "convergence_time_s": None,
            "convergence_time_authors_s": 46.85,
            "path_speed_m_per_s": 0.03169064986210629,
            "balance": 99.61779421208513,
            "cost_of_transport": 2.4299942842752578,
            "phi_final_12": 1.6027629675190767,
        },
    ),
    (
        "steering",
        {"course": "turns"},
        {
            "yaw_rate_section_2": -0.5157143925191002,
            "yaw_rate_section_3": 0.6673239803771758,
            "convergence_time_s": 1.7833333333333334,
            "convergence_time_authors_s": 0.9999999999999999,
            "path_speed_m_per_s": 0.08806942527088428,
            "balance": 36.161456531919534,
            "cost_of_transport": 1.6880786465746094,
            "phi_final_12": 3.143447442609162,
        },
    ),
    (
        "states",
        {"method": "apc"},
        {
            "state_formation_time_s": 1.3666666666666667,
            "state_front_stopped": True,
            "state_speed_s2": 0.05110609347801487,
            "state_in_phase": True,
            "path_speed_m_per_s": 0.054200517094199166,
            "balance": 73.69835524250414,
            "cost_of_transport": 1.5763071645502635,
        },
    ),
    (
        "terrain",
        {"method": "apnc", "roughness": 1.0},
        {
            "convergence_time_s": 3.5,
            "path_speed_m_per_s": 0.09007608871628076,
            "balance": 60.4938754166766,
            "cost_of_transport": 0.783932386338736,
            "phi_final_12": 3.0932448279850817,
        },
    ),
    (
        "conditions",
        {"method": "apnc", "condition": "C4"},
        {
            "convergence_time_s": 4.1,
            "path_speed_m_per_s": 0.08247629716665057,
            "balance": 68.2493024255382,
            "cost_of_transport": 0.8109660945044259,
            "phi_final_12": 3.1924262895878606,
        },
    ),
    (
        "damage",
        {"method": "phase_reset"},
        {
            "convergence_time_authors_s": 0.7166666666666666,
            "path_speed_m_per_s": 0.059052141723560166,
            "balance": 80.37726626636825,
            "cost_of_transport": 1.6924723574679952,
        },
    ),
    (
        "gait",
        {"mi": 0.4},
        {
            "convergence_time_s": 8.6,
            "lowest_lift_mm": 3.604830326850075,
            "largest_slip_share": 0.14075713850423333,
            "worst_touch_downs": 1.0,
            "late_speed_m_per_s": 0.21644703095871098,
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

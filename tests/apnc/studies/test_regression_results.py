"""Regression values: results of the code, not of theory. Look into what changed before new ones."""

from __future__ import annotations

import pytest

from apnc.studies.results import Result
from apnc.studies.runner import grid_of, run_trial

RESULTS: list[tuple[str, Result, Result]] = [
    (
        "mi",
        {"controller": "apnc", "mi": 0.28},
        {
            "convergence_time_s": 2.033333333333333,
            "convergence_time_authors_s": 0.9166666666666666,
            "path_speed_m_per_s": 0.10325541864293639,
            "balance": 137.9198717754716,
            "cost_of_transport": 1.121636242352737,
            "phi_final_12": 3.167965759653966,
        },
    ),
    (
        "rate",
        {"controller": "tegotae", "rate": 60.0},
        {
            "convergence_time_s": None,
            "convergence_time_authors_s": None,
            "path_speed_m_per_s": 0.03149134513392618,
            "balance": 355.48889989288546,
            "cost_of_transport": 2.187051215701382,
            "phi_final_12": 3.9709488125878885,
        },
    ),
    (
        "steering",
        {"schedule": "turns"},
        {
            "yaw_rate_section_2": -0.42748842847663165,
            "yaw_rate_section_3": 0.4889831059809767,
            "convergence_time_s": 2.1666666666666665,
            "convergence_time_authors_s": 1.5,
            "path_speed_m_per_s": 0.0625437958623035,
            "balance": 45.02484902946311,
            "cost_of_transport": 1.767316335583276,
            "phi_final_12": 3.1320792077670534,
        },
    ),
    (
        "states",
        {"controller": "apc"},
        {
            "state_formation_time_s": 2.55,
            "state_front_stopped": True,
            "state_speed_s2": 0.03174214178060413,
            "state_in_phase": True,
            "path_speed_m_per_s": 0.03354346303399581,
            "balance": 68.46821170515281,
            "cost_of_transport": 1.9159242585604095,
        },
    ),
    (
        "terrain",
        {"controller": "apnc", "roughness": 1.0},
        {
            "convergence_time_s": 2.1,
            "path_speed_m_per_s": 0.06107148582206815,
            "balance": 79.9929692154522,
            "cost_of_transport": 0.9679141196053193,
            "phi_final_12": 3.147472583839095,
        },
    ),
    (
        "conditions",
        {"controller": "apnc", "condition": "C4"},
        {
            "convergence_time_s": 10.183333333333332,
            "path_speed_m_per_s": 0.06133524132123598,
            "balance": 85.66344253007195,
            "cost_of_transport": 0.8751414461910465,
            "phi_final_12": 3.15348112531219,
        },
    ),
    (
        "damage",
        {"controller": "phase_reset"},
        {
            "convergence_time_authors_s": 0.5499999999999999,
            "path_speed_m_per_s": 0.02098828859398628,
            "balance": 100.28288505997429,
            "cost_of_transport": 3.3544506384968713,
        },
    ),
    (
        "gait",
        {"mi": 0.4},
        {
            "convergence_time_s": 5.533333333333333,
            "lowest_lift_mm": 5.372617536806042,
            "largest_slip_share": 0.09779618255087755,
            "worst_touch_downs": 1.0,
            "late_speed_m_per_s": 0.11896740006154148,
        },
    ),
]


@pytest.mark.parametrize(
    ("study", "cell", "figures"), RESULTS, ids=[result[0] for result in RESULTS]
)
def test_the_result_is_the_same(study: str, cell: Result, figures: Result) -> None:
    (trial,) = [t for t in grid_of(study, 1) if cell.items() <= t.cell.items()]
    result = run_trial(trial)
    # the walks have these bits on every machine; figures are rounded otherwise by other numpys
    assert {name: result[name] for name in figures} == {
        name: value if value is None else pytest.approx(value, rel=1e-6)
        for name, value in figures.items()
    }

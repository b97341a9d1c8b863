"""Results of a study as a list, as a table of pandas, and in a notebook."""

from __future__ import annotations

import sys

import pytest
from made_up_results import Result, made_up

from apnc.studies.results import StudyResults, TrialId, id_of


def formed(cell: Result) -> Result:
    never = cell["controller"] == "apc" or cell["seed"] == 0
    return {"convergence_time_s": None if never else 2.0 + cell["seed"], "gait": "trot"}


@pytest.fixture
def results() -> StudyResults:
    return StudyResults(made_up({"mi": (0.1, 0.2)}, formed, ("apnc", "apc"), seeds=3))


def test_the_id_of_a_result_has_study_controller_and_key(results: StudyResults) -> None:
    assert id_of(results[1]) == TrialId(study="mi", controller="apc", key="0000000000000001")


def test_a_data_frame_has_a_line_per_trial_and_a_column_per_entry(results: StudyResults) -> None:
    pytest.importorskip("pandas", reason="the extra study is not installed")
    results[3]["late"] = 0.5
    table = results.to_pandas()
    assert table.shape == (12, len(results[0]) + 1)
    assert list(table["mi"]) == [result["mi"] for result in results]
    assert table["convergence_time_s"].dtype == float
    by_controller = table.groupby("controller")["convergence_time_s"]
    assert by_controller.count().to_dict() == {"apc": 0, "apnc": 4}
    assert by_controller.median()["apnc"] == 3.5
    assert table["late"].count() == 1


def test_no_results_are_an_empty_data_frame() -> None:
    pytest.importorskip("pandas", reason="the extra study is not installed")
    assert StudyResults().to_pandas().empty


def test_without_pandas_the_extra_is_named(
    results: StudyResults, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(ImportError, match=r"'pandas' is not installed: pip install .*\[study\]"):
        results.to_pandas()


def test_a_notebook_shows_a_line_per_controller(results: StudyResults) -> None:
    results[0]["fell"] = True
    results[0]["convergence_time_s"] = 2.0
    shown = results._repr_html_()
    lines = [line.split("</tr>")[0] for line in shown.split("<tbody>")[1].split("<tr>")[1:]]
    cells = [[cell.split("</td>")[0] for cell in line.split("<td>")[1:]] for line in lines]
    assert cells == [
        ["mi", "APNC", "6", "4/6 (22 ... 96 %)", "3.0 (2.0 ... 4.0)", "1"],
        ["mi", "APC alone", "6", "0/6 (0 ... 46 %)", "-", "0"],
    ]

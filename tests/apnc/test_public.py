"""What ``import apnc`` gives: light, documented, typed, and as the documents say."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import pytest

import apnc

HEAVY = ("exudyn", "fmpy", "loky", "numpy", "plotly", "scipy", "typer")


def test_import_takes_nothing_heavy() -> None:
    code = f"import sys, apnc; print([m for m in {HEAVY} if m in sys.modules])"
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout == "[]\n"


@pytest.mark.parametrize("name", sorted(set(apnc.__all__) - {"__version__"}))
def test_every_name_is_there_and_documented(name: str) -> None:
    thing = getattr(apnc, name)
    assert thing.__doc__ and not thing.__doc__.startswith(f"{name}("), name
    assert name in dir(apnc)


def test_an_unknown_name_is_an_attribute_error() -> None:
    with pytest.raises(AttributeError, match="module 'apnc' has no attribute 'cow'"):
        apnc.cow  # noqa: B018


def test_what_a_person_writes(tmp_path: Path) -> None:
    record = apnc.simulate(
        apnc.Experiment(
            robot="lilibot", mi=0.15, duration=2, seed=3, ground=apnc.Obstacles(roughness=0.5)
        )
    )
    summary = apnc.walk_features(record)
    assert (len(record), summary.mi, summary.seed) == (120, 0.15, 3)
    apnc.write_report(record, tmp_path / "walk")
    assert (tmp_path / "walk" / "report.html").stat().st_size > 100_000


def test_a_study_gives_its_results() -> None:
    results = apnc.run_study(
        "terrain", trials=2, controllers=["apnc"], chosen={"roughness": [0.5]}, duration=1.0
    )
    assert isinstance(results, apnc.StudyResults)
    assert [(each["controller"], each["roughness"], each["seed"]) for each in results] == [
        ("apnc", 0.5, 0),
        ("apnc", 0.5, 1),
    ]
    assert all(each["error"] == "" for each in results)


USER = """
import numpy as np
from numpy.typing import NDArray

import apnc

experiment = apnc.Experiment(mi=((0.0, 0.1), (5.0, 0.2)), ground=apnc.Kerb(at=0.3))
key: str = experiment.key()


def walked(record: apnc.Record) -> float:
    x: NDArray[np.float64] = record.signals["position"][:, 0]
    return float(x[-1] - x[0]) if record.end is apnc.End.complete else 0.0


def figures(record: apnc.Record) -> float | None:
    summary: apnc.WalkFeatures = apnc.walk_features(record)
    return summary.path_speed_m_per_s


rows = apnc.run_study("mi", trials=1)
print(rows[0]["key"], walked(apnc.simulate(experiment)))
"""


def test_the_package_says_that_it_has_types() -> None:
    assert (Path(apnc.__file__).parent / "py.typed").is_file()


@pytest.mark.thorough  # mypy reads the whole package and what it imports
@pytest.mark.parametrize(
    ("change", "error"),
    [
        (("", ""), None),
        (("mi=", "nu="), 'Unexpected keyword argument "nu"'),
        (("key: str", "key: int"), "Incompatible types in assignment"),
        (("walked(apnc.simulate(experiment))", "walked(experiment)"), "incompatible type"),
    ],
)
def test_a_users_file_is_checked_with_strict_types(
    change: tuple[str, str],
    error: str | None,
    tmp_path: Path,
    tmp_path_factory: pytest.TempPathFactory,
) -> None:
    pytest.importorskip("mypy")
    # a name of its own: in the shared cache a file of the same size and second counts as unchanged
    name = f"user_{abs(hash(change))}.py"
    (tmp_path / name).write_text(USER.replace(*change) if error else USER)
    cache = tmp_path_factory.getbasetemp() / "mypy"
    done = subprocess.run(
        [sys.executable, "-m", "mypy", "--strict", "--cache-dir", str(cache), name],
        cwd=tmp_path, capture_output=True, text=True, check=False,
    )  # fmt: skip
    if error is None:
        assert done.returncode == 0, done.stdout
    else:
        assert done.returncode == 1 and error in done.stdout, done.stdout

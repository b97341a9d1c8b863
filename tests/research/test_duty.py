"""Bodies with another duty factor: what is walked, and what counts as a clear step."""

from __future__ import annotations

from collections import Counter

import pytest
from made_up_results import Result, made_up

from apnc.studies import gait
from apnc.studies.gains import LATE_SPEED
from apnc.studies.mi import DUTY
from apnc.studies.results import STRICT
from apnc.studies.runner import grid_of
from research import duty
from research.registry import STUDIES

ONE = {"lag": (0.066,), "foot": (2600.0,), "a1": (1.0,), "a2": (0.6, 1.0)}


def test_a_body_has_its_servo_its_feet_and_its_slopes() -> None:
    trials = grid_of("duty", 2, studies=STUDIES)
    slopes = Counter((t.cell["mi"], t.cell["a1"] == t.cell["a2"] == 1.0) for t in trials)
    bodies = 2 * 2 * len(duty.LAGS) * len(duty.FEET)
    assert slopes == {(duty.HIGH, False): 8 * bodies, (duty.HIGH, True): bodies,
                      (duty.LOW, True): bodies}  # fmt: skip
    last = trials[-1]
    body, own = last.experiment.description, duty.LILIBOT
    assert body.servo.damping / body.servo.stiffness == pytest.approx(0.150)
    assert (body.contact.stiffness, body.servo.stiffness) == (20000.0, own.servo.stiffness)
    parameters = duty.experiment("apnc", 0, duty.HIGH, 0.066, 2600.0, 1.0, 1.0).parameters()
    assert last.experiment.settings["a2"] == pytest.approx(1.4 * float(parameters["a2"]))


def results(lift: float, touches: float = 1.0, fallen: int = -1) -> list[Result]:
    """Two bodies with a duty factor of 0.7 and 0.5, the first with this lift [mm]."""

    def figures(cell: Result) -> Result:
        low = cell["a2"] == 0.6
        return {
            STRICT: None if low and cell["seed"] == fallen else 2.0,
            LATE_SPEED: 0.1,
            DUTY: 0.7 if low else 0.5,
            gait.LIFT: lift if low else 9.0,
            gait.TOUCHES: touches if low else 1.0,
            gait.SLIP: 0.2,
        }

    return made_up({"mi": (duty.HIGH,)} | ONE, figures, ("apnc",), 3, "duty")


@pytest.mark.parametrize(
    ("found", "any_lift", "two_mm"),
    [
        (results(2.5), "2 | 1 | 1 | 0.70", "2 | 1 | 1 | 0.70"),
        (results(1.5), "2 | 1 | 1 | 0.70", "1 | 0 | 0 | 0.50"),
        (results(2.5, touches=0.5), "2 | 1 | 1 | 0.70", "1 | 0 | 0 | 0.50"),
        (results(2.5, fallen=2), "1 | 0 | 0 | 0.50", "1 | 0 | 0 | 0.50"),  # no trot with one seed
    ],
)
def test_a_body_counts_if_every_run_trots_and_every_foot_lifts(
    found: list[Result], any_lift: str, two_mm: str
) -> None:
    text = duty.by_lift(found)
    assert f"| any | {any_lift} |" in text and f"| 2 mm | {two_mm} |" in text

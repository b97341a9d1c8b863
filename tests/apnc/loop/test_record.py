"""A record: its parts, and signals that two sides have."""

from __future__ import annotations

import numpy as np
from records import synthetic_record

from apnc.loop.record import merged
from apnc_core.schema import Causality
from apnc_core.variables import TABLE
from apnc_plant.signals import PLANT_SIGNALS


def test_a_part_of_a_record_has_the_samples_of_that_part_in_every_signal() -> None:
    record = synthetic_record(2.0)
    part = record[30:90]
    assert len(part) == 60 and part.experiment is record.experiment
    np.testing.assert_array_equal(part.time, record.time[30:90])
    for name, values in record.signals.items():
        np.testing.assert_array_equal(part.signals[name], values[30:90])
    assert len(record.until(7)) == 7 and len(record[:0]) == 0


def test_the_load_is_the_only_name_that_robot_and_controller_share() -> None:
    """Of another name that both had, one value would be lost."""
    shown = {v.name for v in TABLE if v.causality is not Causality.parameter}
    assert shown & {signal.name for signal in PLANT_SIGNALS} == {"grf"}


def test_merged_takes_the_load_that_reached_the_controller() -> None:
    sent, read = np.zeros((2, 4)), np.ones((2, 4))
    found = merged(plant={"grf": sent, "rpy": sent}, controller={"o1": read, "grf": read})
    assert found["grf"] is read and set(found) == {"grf", "rpy", "o1"}

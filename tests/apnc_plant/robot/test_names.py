"""Names that may stand in files, XML and topics."""

import re

import pytest

from apnc_plant.robot.names import plain_name, plain_names


@pytest.mark.parametrize("name", ["RF", "L1", "front_left", "_x"])
def test_a_plain_name_stays(name: str) -> None:
    assert plain_name(name) == name


@pytest.mark.parametrize("name", ["..", "/etc/x", "a b", 'a,"b"', "<b>", "1", "ü", "", "a-b"])
def test_any_other_becomes_one(name: str) -> None:
    assert re.fullmatch("[A-Za-z_][A-Za-z0-9_]*", plain_name(name))


def test_plain_names_differ() -> None:
    assert plain_names(["a b", "a_b_", "a,b", "a/b"]) == ("a_b", "a_b_", "a_b__", "a_b___")

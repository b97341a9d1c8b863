"""Legs go by the robot's own names, by place, and by names of other robots."""

from __future__ import annotations

import pytest

from apnc_plant.robot import load_robot
from apnc_plant.robot.leg_names import ALIASES, by_place, leg_named, same_legs

OURS = ("RF", "RH", "LF", "LH")
DOG = ("FR", "RR", "FL", "RL")
EIGHT = load_robot("octopod").leg_names


@pytest.mark.parametrize("legs", [OURS, DOG, ("a", "b", "c", "d")])
def test_every_alias_of_a_place_is_the_leg_there(legs: tuple[str, ...]) -> None:
    for place, leg in zip(("right front", "right hind", "left front", "left hind"), legs,
                          strict=True):  # fmt: skip
        for name in (place, *ALIASES[place]):
            for written in (name, name.lower(), name.replace(" ", "_"), name.replace(" ", "-")):
                assert leg_named(written, legs) == leg


def test_no_alias_has_two_places() -> None:
    names = [name for place, others in ALIASES.items() for name in (place, *others)]
    assert len(set(names)) == len(names)


def test_a_name_of_the_robots_own_goes_first() -> None:
    odd = ("LH", "rf", "RF", "front right")  # RF is a left leg, rf a right one
    assert [leg_named(name, odd) for name in odd] == list(odd)
    assert leg_named("FR", odd) == "LH"


def test_middle_legs_and_others_between_have_places_only_among_three() -> None:
    assert leg_named("MR", load_robot("hexapod").leg_names) == "RM"
    assert by_place(EIGHT) == {"right front": "RF", "right hind": "RH", "left front": "LF",
                               "left hind": "LH"}  # fmt: skip
    assert leg_named("R2", EIGHT) == "R2"
    with pytest.raises(ValueError, match=r"^leg 'RM' is not one of RF, R2, R3, RH, LF"):
        leg_named("RM", EIGHT)


def test_the_only_leg_of_a_side_is_its_front_and_its_hind_leg() -> None:
    assert [leg_named(name, ("r", "l")) for name in ("FR", "RR", "left hind")] == ["r", "r", "l"]


def test_an_unknown_name_lists_what_is_allowed() -> None:
    with pytest.raises(ValueError, match=r"^leg 'XX' is not one of FR, RR, FL, RL; nor ") as error:
        leg_named("XX", DOG)
    for name in ("right front, RF, FR, front right", "left hind, LH, HL, RL"):
        assert name in str(error.value)
    assert "middle" not in str(error.value)


def test_same_legs_are_those_at_the_same_places() -> None:
    assert same_legs(OURS, DOG) and same_legs(DOG, OURS)
    assert not same_legs(("LF", "LH", "RF", "RH"), OURS)
    assert not same_legs(OURS, EIGHT)
    assert not same_legs(OURS[:2], OURS)

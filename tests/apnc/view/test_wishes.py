"""What a page may ask for, and nothing else."""

from __future__ import annotations

import math

import pytest

from apnc.view.wishes import Wish, wish_of


@pytest.mark.parametrize(
    ("message", "wish"),
    [
        ('{"push": [0.5, -1]}', Wish(push=(0.5, -1.0))),
        ('{"speed": 0.25}', Wish(speed=0.25)),
        ('{"speed": null}', Wish(speed=math.inf)),
        ('{"pause": true}', Wish(pause=True)),
        (b'{"pause": false}', Wish(pause=False)),
    ],
)
def test_wishes_are_understood(message: str | bytes, wish: Wish) -> None:
    assert wish_of(message, 2.5) == wish


@pytest.mark.parametrize(
    "message",
    [
        *("", "x", "null", "3", "[]", "{}", '{"fly": true}', '{"pause": 1}', '{"pause": null}'),
        *('{"push": [1]}', '{"push": [1, "2"]}', '{"push": [NaN, 0]}', '{"push": [Infinity, 0]}'),
        *('{"push": [4, 4]}', '{"push": [true, 0]}', '{"push": null}', "[" * 900, b"\xff"),
        *('{"speed": 0}', '{"speed": -1}', '{"speed": 1e9}', '{"speed": "1"}', '{"speed": NaN}'),
        '{"pause": true, "speed": 1}',
    ],
)
def test_anything_else_is_refused(message: str | bytes) -> None:
    with pytest.raises(ValueError, match=r"not a wish|allowed"):
        wish_of(message, 2.5)

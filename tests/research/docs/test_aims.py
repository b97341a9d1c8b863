"""The aims of the study of the gait on its page."""

from __future__ import annotations

import pytest

from research.docs.aims import table


def test_only_aims_are_shown_with_their_verdict() -> None:
    claims = (
        "| paper says | where | measured | verdict |\n|---|---|---|---|\n"
        "| it lifts | aim | at 9 of 15 MI; mm: 4.9 at 0.06 | **partly** |\n"
        "| it walks | 3.1 | 0.1 m/s | **reproduced** |\n"
        "| it trots | aim | 5 of 5 | **reproduced** |\n"
    )
    assert table(claims).splitlines()[2:] == [
        "| it lifts | **partly** | at 9 of 15 MI; mm: 4.9 at 0.06 |",
        "| it trots | **yes** | 5 of 5 |",
    ]
    with pytest.raises(ValueError, match="no aims"):
        table("| it walks | 3.1 | 0.1 m/s | **reproduced** |\n")

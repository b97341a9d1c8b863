"""Conditions of a robot that a study sets: payload, damage and broken sensors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import field
from functools import partial
from types import MappingProxyType
from typing import Annotated, Final

from pydantic import AfterValidator, BeforeValidator

from apnc_core.frozen import Frozen
from apnc_core.in_python import in_python
from apnc_plant.files import Number, checked, limits

ALL: Final = "*"
"""Means every leg of a robot."""


Halves = Annotated[Number, limits("1", ge=0.0), BeforeValidator(in_python)]
Stuck = Annotated[Mapping[str, Halves], AfterValidator(Frozen)]


@checked(ValueError)
class Conditions:
    """What is wrong with a robot, or attached to it, on top of its description.

    Args:
        payload: mass of a box on the trunk [kg]; it cannot change once a plant is built.
        grf_noise: standard deviation of noise that is added to the sensors' own, in halves of the
            weight [1].
        damaged: legs whose hip and knee are held at angle 0 of the reference pose.
        stuck: constant value that a stuck sensor reports, in halves of the weight [1], by leg.
        dropout: legs whose sensor reports 0; ``("*",)`` means every leg of any robot.
        held_at: height above its start at which the trunk is held level [m]; None: it is free.

    Raises:
        ValueError: a number that is negative or not finite, or a value of another type.
    """

    payload: Annotated[Number, limits("kg", ge=0.0)] = 0.0
    grf_noise: Halves = 0.0
    damaged: tuple[str, ...] = ()
    stuck: Stuck = field(default_factory=partial(Frozen, {}))
    dropout: tuple[str, ...] = ()
    held_at: Annotated[Number, limits("m", ge=0.0)] | None = None

    def silent(self, legs: tuple[str, ...]) -> tuple[str, ...]:
        """Legs whose sensor reports 0, out of a robot's legs."""
        return legs if self.dropout == (ALL,) else self.dropout

    def check_payload(self, built: float) -> None:
        """Check that the payload is the one a plant was built with.

        Args:
            built: payload of the plant [kg].

        Raises:
            ValueError: it differs.
        """
        if self.payload != built:
            raise ValueError(
                f"payload is {self.payload} kg; allowed: {built} kg, fixed when the plant was built"
            )

    def check_legs(self, legs: tuple[str, ...]) -> None:
        """Check that a robot has all legs that are named.

        Args:
            legs: names of the robot's legs.

        Raises:
            ValueError: a leg is unknown.
        """
        for leg in (*self.damaged, *self.stuck, *self.silent(legs)):
            if leg not in legs:
                raise ValueError(f"leg {leg!r} is not one of {', '.join(legs)}")


PAYLOAD: Final = 1.25
"""Payload of condition C4 [kg]."""

NOISE: Final = 0.2
"""Added noise of condition C2, in halves of the weight. The paper does not give its value."""

CONDITIONS: Final[Mapping[str, Conditions]] = MappingProxyType(
    {
        "C1": Conditions(),
        "C2": Conditions(grf_noise=NOISE),
        "C3": Conditions(damaged=("RF",)),
        "C4": Conditions(payload=PAYLOAD),
        "S1": Conditions(held_at=0.02),
        "S2": Conditions(stuck={"RF": 0.9, "LF": 0.9}),
        "S3": Conditions(dropout=(ALL,)),
    }
)
"""Conditions of the paper by name.

Section 3.1.4: C1 normal, C2 noisy feedback, C3 leg damage, C4 payload. Section 3.2: S1 held in the
air, S2 front sensors stuck, S3 feedback removed.
"""


def named_conditions(name: str) -> Conditions:
    """Conditions of the paper.

    Args:
        name: ``"C1"`` to ``"C4"`` or ``"S1"`` to ``"S3"``.

    Raises:
        ValueError: an unknown name.
    """
    if name not in CONDITIONS:
        raise ValueError(f"conditions {name!r} are not one of {', '.join(CONDITIONS)}")
    return CONDITIONS[name]

"""Conditions of a robot that a study sets: payload, damage and broken sensors."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from functools import partial
from types import MappingProxyType
from typing import TYPE_CHECKING, Annotated, Final

from pydantic import AfterValidator, BeforeValidator

from apnc_core.frozen import Frozen
from apnc_core.in_python import in_python
from apnc_plant.files import Number, checked, limits
from apnc_plant.robot.leg_names import by_place, leg_named
from apnc_plant.robot.size import times_longer

if TYPE_CHECKING:
    from apnc_plant.robot.model import RobotDescription

ALL: Final = "*"
"""Means every leg of a robot."""


Halves = Annotated[Number, limits("1", ge=0.0), BeforeValidator(in_python)]
Stuck = Annotated[Mapping[str, Halves], AfterValidator(Frozen)]


@checked(ValueError)
class Conditions:
    """What is wrong with a robot, or attached to it, on top of its description.

    Legs are named as in :func:`apnc_plant.robot.leg_names.leg_named`.

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

    def of_legs(self, legs: tuple[str, ...]) -> Conditions:
        """The same with the robot's own names of its legs.

        Args:
            legs: names of the robot's legs, in its order.

        Raises:
            ValueError: a leg is unknown, or named twice as stuck.
        """
        stuck: dict[str, float] = {}
        for name, value in self.stuck.items():
            if (leg := leg_named(name, legs)) in stuck:
                raise ValueError(f"leg {leg!r} is stuck twice, also as {name!r}; allowed: once")
            stuck[leg] = value
        dropout = self.dropout
        if dropout != (ALL,):
            dropout = tuple(leg_named(name, legs) for name in dropout)
        damaged = tuple(leg_named(name, legs) for name in self.damaged)
        if (damaged, stuck, dropout) == (self.damaged, self.stuck, self.dropout):
            return self
        return replace(self, damaged=damaged, stuck=stuck, dropout=dropout)


@dataclass(frozen=True)
class PaperCondition:
    """A condition of the paper, for a robot of any size and with any names of its legs.

    Args:
        payload: mass of the box over that of the robot [1].
        grf_noise: as in :class:`Conditions`.
        damaged, stuck, dropout: as in :class:`Conditions`, legs by place.
        held_at: height at which Lilibot is held [m]; that of a robot grows with its legs.
    """

    payload: float = 0.0
    grf_noise: float = 0.0
    damaged: tuple[str, ...] = ()
    stuck: Mapping[str, float] = field(default_factory=partial(Frozen, {}))
    dropout: tuple[str, ...] = ()
    held_at: float | None = None

    def of(self, robot: RobotDescription) -> Conditions:
        """The conditions of a robot.

        Raises:
            ValueError: it has no leg at one of the places.
        """
        held_at = self.held_at
        return Conditions(
            payload=self.payload * robot.mass,
            grf_noise=self.grf_noise,
            damaged=self.damaged,
            stuck=self.stuck,
            dropout=self.dropout,
            held_at=None if held_at is None else held_at * times_longer(robot),
        ).of_legs(robot.leg_names)

    def missing(self, legs: tuple[str, ...]) -> str | None:
        """Place of a leg that the condition names and a robot with these legs lacks."""
        places = by_place(legs)
        return next((leg for leg in (*self.damaged, *self.stuck) if leg not in places), None)


PAYLOAD: Final = 0.5
"""Payload of condition C4 over the mass of the robot [1]: 1.25 kg on Lilibot."""

NOISE: Final = 0.2
"""Added noise of condition C2, in halves of the weight. The paper does not give its value."""

CONDITIONS: Final[Mapping[str, PaperCondition]] = MappingProxyType(
    {
        "C1": PaperCondition(),
        "C2": PaperCondition(grf_noise=NOISE),
        "C3": PaperCondition(damaged=("right front",)),
        "C4": PaperCondition(payload=PAYLOAD),
        "S1": PaperCondition(held_at=0.03),
        "S2": PaperCondition(stuck=Frozen({"right front": 0.9, "left front": 0.9})),
        "S3": PaperCondition(dropout=(ALL,)),
    }
)
"""Conditions of the paper by name.

Section 3.1.4: C1 normal, C2 noisy feedback, C3 leg damage, C4 payload. Section 3.2: S1 held in the
air, S2 front sensors stuck, S3 feedback removed.
"""


def checked_name(name: str) -> str:
    """The name of conditions of the paper.

    Raises:
        ValueError: an unknown name.
    """
    if name not in CONDITIONS:
        raise ValueError(f"{name!r} is not one of {', '.join(CONDITIONS)}")
    return name


def paper_conditions(robot: RobotDescription) -> dict[str, Conditions]:
    """Conditions of the paper by name, for a robot; without those of a leg that it lacks."""
    fitting = {k: each for k, each in CONDITIONS.items() if not each.missing(robot.leg_names)}
    return {name: each.of(robot) for name, each in fitting.items()}


def named_conditions(name: str, robot: RobotDescription) -> Conditions:
    """Conditions of the paper, for a robot.

    Args:
        name: ``"C1"`` to ``"C4"`` or ``"S1"`` to ``"S3"``.
        robot: the robot.

    Raises:
        ValueError: an unknown name, or a leg that the robot lacks.
    """
    return CONDITIONS[checked_name(name)].of(robot)

"""Servos of a robot file: what all joints share, what joints of a kind share, and the rest."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

Joints = Mapping[str, Mapping[str, float]]
"""Numbers of the servo by joint (``abduction``, ``hip``, ``knee``), then by key."""

Value = TypeVar("Value", bound=Hashable)


@dataclass(frozen=True)
class Servos:
    """Servos as a robot file writes them.

    Args:
        common: what holds for all joints, by key.
        kinds: what a joint of all legs has of its own.
        legs: what a joint of a leg has of its own, leg by leg.
    """

    common: dict[str, float]
    kinds: dict[str, dict[str, float]]
    legs: tuple[dict[str, dict[str, float]], ...]


def most_frequent(values: Iterable[Value]) -> Value:
    """The value that occurs most often; of several the first."""
    return Counter(values).most_common(1)[0][0]


def servos_of(legs: Sequence[Joints]) -> Servos:
    """The shortest way to write the servos of all joints.

    Args:
        legs: the servos of every leg; all joints have the same keys.
    """
    joints = tuple(legs[0])
    keys = tuple(legs[0][joints[0]])
    common = {key: most_frequent(leg[j][key] for leg in legs for j in joints) for key in keys}
    kinds: dict[str, dict[str, float]] = {}
    own: list[dict[str, dict[str, float]]] = [{} for _ in legs]
    for joint in joints:
        for key in keys:
            usual = most_frequent(leg[joint][key] for leg in legs)
            if usual != common[key]:
                kinds.setdefault(joint, {})[key] = usual
            for leg, table in zip(legs, own, strict=True):
                if leg[joint][key] != usual:
                    table.setdefault(joint, {})[key] = leg[joint][key]
    return Servos(common, kinds, tuple(own))

"""Which way is forward in a model file, and the model with x turned that way."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from apnc.importing.leg_reading import leg_geometry
from apnc.importing.legs import LegGeometry
from apnc.importing.limbs import Limbs, limbs_of
from apnc.importing.model import Frame, Model, ModelFileError, moved

FORWARD: Final[Mapping[str, tuple[float, float]]] = {
    "x": (1.0, 0.0), "-x": (-1.0, 0.0), "y": (0.0, 1.0), "-y": (0.0, -1.0),
}  # fmt: skip
"""Directions of a model file that can be forward, and their x and y."""

BESIDE: Final = 0.1
"""Least distance of a leg from the middle line, as a share of that of the leg farthest from it."""


@dataclass(frozen=True)
class Faced:
    """A robot whose x axis points forward.

    Args:
        limbs: its trunk and legs.
        legs: their geometry, in the order of ``limbs``.
        forward: the direction of the file that x is, one of ``FORWARD``.
        why: how that is known, in words.
    """

    limbs: Limbs
    legs: tuple[LegGeometry, ...]
    forward: str
    why: str


def faced(model: Model, pose: Mapping[str, float], forward: str | None = None) -> Faced:
    """The robot with x forward.

    Without ``forward`` x of the file is, or else y, whichever the legs can walk along: hips turn
    about an axis across it, and legs with coxae, which show no direction of their own, stand in
    equal numbers to both sides of it.

    Args:
        model: the robot as its file has it.
        pose: as of :func:`apnc.importing.limbs.limbs_of`.
        forward: one of ``FORWARD``.

    Raises:
        ModelFileError: the legs cannot be read, or neither direction is plain.
    """
    if forward is not None:
        if forward not in FORWARD:
            raise ModelFileError(f"forward is {forward!r}; allowed: {', '.join(FORWARD)}")
        return Faced(*_read(model, pose, forward), forward, "as asked for")
    ways: dict[str, tuple[Limbs, tuple[LegGeometry, ...]]] = {}
    refused: dict[str, ModelFileError] = {}
    for axis in ("x", "y"):
        try:
            ways[axis] = _read(model, pose, axis)
        except ModelFileError as error:
            refused[axis] = error
    if not ways:
        raise refused["x"]
    axis, (limbs, legs) = next(iter(ways.items()))
    if refused or not all(leg.has_coxa for leg in legs):
        return Faced(limbs, legs, axis, "hips turn about an axis across it")
    sided = [axis for axis, (_, legs) in ways.items() if _stand_on_two_sides(legs)]
    if not sided:
        raise ModelFileError(
            f"which way is forward is not plain: its {len(legs)} legs stand in equal "
            "numbers to both sides of neither x nor y; allowed: such legs, or a direction by name, "
            f"forward {', '.join(FORWARD)}"
        )
    why = f"half of the legs stand to each side of {' and of '.join(sided)}"
    return Faced(*ways[sided[0]], sided[0], why)


def turned(model: Model, forward: str) -> Model:
    """The model in a frame of its base whose x axis is a direction of the file.

    Args:
        model: the robot as its file has it.
        forward: one of ``FORWARD``.
    """
    if forward == "x":
        return model
    x, y = FORWARD[forward]
    turn = Frame(turn=np.array([[x, y, 0.0], [-y, x, 0.0], [0.0, 0.0, 1.0]]))
    parts = [
        replace(part, frame=turn @ part.frame) if part.parent == 0 else part for part in model.parts
    ]
    base = parts[0]
    parts[0] = replace(
        base,
        body=moved(base.body, turn),
        shapes=tuple(replace(shape, frame=turn @ shape.frame) for shape in base.shapes),
    )
    return replace(model, parts=tuple(parts))


def _read(
    model: Model, pose: Mapping[str, float], forward: str
) -> tuple[Limbs, tuple[LegGeometry, ...]]:
    limbs = limbs_of(turned(model, forward), pose)
    return limbs, tuple(leg_geometry(leg) for leg in limbs.legs)


def _stand_on_two_sides(legs: Sequence[LegGeometry]) -> bool:
    """Whether half of the legs stand to each side of the middle line, none near it."""
    aside = np.array([leg.mount[1] for leg in legs])
    aside -= (aside.min() + aside.max()) / 2.0
    least = BESIDE * np.abs(aside).max()
    sides = int((aside > least).sum()), int((aside < -least).sum())
    return 2 * sides[0] == 2 * sides[1] == len(legs)

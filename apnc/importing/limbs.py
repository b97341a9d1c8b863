"""Which parts of a robot are its trunk and its legs: told from how they hang together alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import Final

import numpy as np

from apnc.importing.model import (
    Frame,
    Joint,
    Model,
    ModelFileError,
    Shape,
    moved,
    rotation,
    together,
)
from apnc_plant.robot import MassProperties

FEWEST: Final = 4
"""Legs of a robot that this controller can walk."""

_STRAY: Final = 1e-6
"""Mass of folded parts from which a table names them [kg]."""


@dataclass(frozen=True)
class Segment:
    """What moves as one: a part with a joint, or the trunk, and all that is fixed to it.

    Args:
        name: of the part.
        joint: how it moves against the segment before it; None for the trunk.
        frame: placement in the frame of the segment before it, with the joint at 0.
        body: mass properties of all its parts.
        shapes, frames: simple shapes of its parts, and frames by name.
    """

    name: str
    joint: Joint | None
    frame: Frame
    body: MassProperties
    shapes: tuple[Shape, ...]
    frames: Mapping[str, Frame]


@dataclass(frozen=True)
class Limbs:
    """A robot as a trunk and chains of segments.

    Args:
        trunk: with all that is not a leg.
        legs: chains of segments, each from the trunk outward.
        folded: joints that are held, each with what moves behind it and its mass, in words.
    """

    trunk: Segment
    legs: tuple[tuple[Segment, ...], ...]
    folded: tuple[str, ...]


def limbs_of(model: Model, pose: Mapping[str, float]) -> Limbs:
    """The trunk and the legs.

    A leg is a chain of at least two moving segments. Of chains of different lengths the most
    frequent one is that of the legs; if an odd number of them is left, those whose axes are not
    those of the others are no legs. All else, arms, sensors and rotors, is held in its pose and
    becomes part of the segment that carries it.

    Args:
        model: the robot.
        pose: angles of held joints [rad]; 0, or the nearest in their range, if left out.

    Raises:
        ModelFileError: there are fewer than ``FEWEST`` legs, or a leg branches.
    """
    tree = _Tree(model, pose)
    chains = [(part, tree.depth(part)) for part in tree.after(0)]
    lengths = Counter(depth for _, depth in chains if depth > 1)
    length, count = max(lengths.items(), key=lambda item: (item[1], -item[0]), default=(0, 0))
    firsts = [part for part, depth in chains if depth == length]
    if count % 2:
        alike = Counter(map(tree.axes, firsts)).most_common(1)[0]
        firsts = [part for part in firsts if tree.axes(part) == alike[0]]
    if len(firsts) < FEWEST:
        found = ", ".join(f"{model.parts[p].name} ({d} joints)" for p, d in chains) or "none"
        raise ModelFileError(
            f"{len(firsts)} legs were found; allowed: {FEWEST} or more chains of the same number "
            f"of joints on the floating base {model.parts[0].name}; chains on it: {found}"
        )
    legs = [tree.chain(part) for part in firsts]
    moving = {part for leg in legs for part in leg}
    trunk = tree.segment(0, moving)
    return Limbs(
        trunk,
        tuple(tuple(tree.segment(part, moving) for part in leg) for leg in legs),
        tuple(tree.folded(moving)),
    )


class _Tree:
    """Parts, by what carries them."""

    def __init__(self, model: Model, pose: Mapping[str, float]) -> None:
        self.parts, self._pose = model.parts, pose
        self._children: list[list[int]] = [[] for _ in model.parts]
        for index, part in enumerate(model.parts[1:], 1):
            self._children[part.parent].append(index)

    def after(self, part: int) -> list[int]:
        """The nearest parts outward that move."""
        found = []
        for child in self._children[part]:
            found += [child] if self.parts[child].joint else self.after(child)
        return found

    def depth(self, part: int) -> int:
        """How many joints there are from here to the end, this one included."""
        return 1 + max(map(self.depth, self.after(part)), default=0)

    def axes(self, part: int) -> tuple[int, ...]:
        """For each joint of a chain the axis of the trunk nearest to its own, all joints at 0."""
        found, frame = [], self._placed(part)
        at: int | None = part
        while at is not None:
            joint = self.parts[at].joint
            assert joint is not None
            found.append(int(np.argmax(np.abs(frame.turn @ joint.axis))))
            nearest = max(self.after(at), key=self.depth, default=None)
            frame = frame if nearest is None else frame @ self._placed(nearest, at)
            at = nearest
        return tuple(found)

    def chain(self, part: int) -> list[int]:
        """The parts of a leg, outward; what is shorter than its longest branch is no part of it."""
        found = [part]
        while outer := self.after(found[-1]):
            deepest = max(map(self.depth, outer))
            longest = [each for each in outer if self.depth(each) == deepest]
            if len(longest) > 1:
                named = ", ".join(self.parts[each].name for each in longest)
                raise ModelFileError(
                    f"leg {self.parts[part].name} branches into {named}; allowed: a chain"
                )
            found += longest
        return found

    def segment(self, start: int, moving: set[int]) -> Segment:
        """A part and all behind it up to the next parts that move."""
        body, shapes, frames = self._gathered(start, Frame(), moving)
        part = self.parts[start]
        frame = self._placed(start) if part.joint else Frame()
        return Segment(part.name, part.joint, frame, body, tuple(shapes), frames)

    def _gathered(
        self, at: int, frame: Frame, moving: set[int]
    ) -> tuple[MassProperties, list[Shape], dict[str, Frame]]:
        part = self.parts[at]
        body = moved(part.body, frame)
        shapes = [Shape(s.name, s.kind, frame @ s.frame, s.half, s.touches) for s in part.shapes]
        frames = {part.name: frame}
        for child in self._children[at]:
            if child not in moving:
                inner = self._gathered(child, frame @ self._held(child), moving)
                body = together(body, inner[0])
                shapes += inner[1]
                frames |= inner[2]
        return body, shapes, frames

    def _held(self, part: int) -> Frame:
        """Placement of a part in its parent's frame, with its joint at the angle of the pose."""
        frame, joint = self.parts[part].frame, self.parts[part].joint
        if joint is None:
            return frame
        angle = min(max(self._pose.get(joint.name, 0.0), joint.lower), joint.upper)
        if joint.kind == "slide":
            return frame @ Frame(joint.axis * angle)
        return frame @ Frame(turn=rotation(joint.axis, angle)) if joint.kind == "hinge" else frame

    def _placed(self, part: int, inside: int = 0) -> Frame:
        """Placement of a part, its joint at 0, in the frame of the moving part that carries it."""
        frame, at = self.parts[part].frame, self.parts[part].parent
        while at > 0 and at != inside and self.parts[at].joint is None:
            frame, at = self._held(at) @ frame, self.parts[at].parent
        return frame

    def folded(self, moving: set[int]) -> Iterable[str]:
        """What became part of another segment although a joint moves it, and fixed masses."""
        fixed, mass = 0, 0.0
        for index, part in enumerate(self.parts[1:], 1):
            held = part.joint is not None and index not in moving
            if held and not self._is_behind(index, moving):
                assert part.joint is not None
                behind = self._gathered(index, Frame(), moving)[0].mass
                carried = f"{part.name} and what it carries, {behind:.3g} kg"
                yield f"joint {part.joint.name} is held; it moves {carried}"
            elif part.joint is None and part.body.mass > _STRAY:
                fixed, mass = fixed + 1, mass + part.body.mass
        if fixed:
            yield f"{fixed} fixed parts, {mass:.3g} kg, belong to what carries them"

    def _is_behind(self, part: int, moving: set[int]) -> bool:
        """True if another held joint lies between a part and the trunk or its leg."""
        at = self.parts[part].parent
        while at > 0 and at not in moving:
            if self.parts[at].joint is not None:
                return True
            at = self.parts[at].parent
        return False

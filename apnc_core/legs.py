"""Names of the legs, in the order of the FMU: the right side first, from front to hind."""

from __future__ import annotations


def leg_names(n_legs: int) -> tuple[str, ...]:
    """``("RF", "RH", "LF", "LH")`` for four legs, with middle legs for six.

    Args:
        n_legs: number of legs. Other numbers give ``R1 ... L1 ...``; an odd last leg is on the
            left, where ``motor_neurons.amplitude_scale`` has it.
    """
    right = n_legs // 2
    sides = {2: ("F", "H"), 3: ("F", "M", "H")}
    if n_legs % 2 == 0 and right in sides:
        return tuple(side + name for side in "RL" for name in sides[right])
    return tuple([f"R{i + 1}" for i in range(right)] + [f"L{i + 1}" for i in range(n_legs - right)])

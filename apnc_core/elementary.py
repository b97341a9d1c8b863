"""Elementary functions by polynomials, with the operations of ``fmu_src/core/elementary.h``.

C and Python evaluate them in the same order. So the reference and the FMU agree bit for bit, and so
do the FMU's binaries for all platforms. The functions of the C libraries differ in the last bits.
The coefficients are minimax fits in z = x^2, made for this project.
"""

from __future__ import annotations

import math
from typing import Final

import numpy as np

from apnc_core.types import Array

TO_WHOLE: Final = 1.5 * 2.0**52
"""Adding and then subtracting it rounds to the nearest integer."""

TAN_PI_8: Final = 0.41421356237309503

MAX_ERROR: Final = {"tanh": 4e-16, "sin": 3e-16, "cos": 3e-16, "angle_of": 4e-16}
"""Largest relative error, measured over the whole range of each."""


def tanh(x: Array) -> Array:
    """Hyperbolic tangent of every entry of ``x``.

    With exp(2 x) = S (1 + T) / (1 - T), S a power of two and T the tangent of the rest u.
    """
    y = np.clip(x, -20.0, 20.0)
    n = (y * 2.8853900817779268 + TO_WHOLE) - TO_WHOLE
    S = np.ldexp(1.0, n.astype(np.int32))
    u = (y - n * 0.3465735900681466) - n * 2.118260682904642e-10
    z = u * u
    zz = z * z
    P = (-0.3333333333333249 + 0.13333333332783764 * z) + zz * (
        (-0.05396825278203011 + 0.02186937071535709 * z)
        + zz * (-0.008857308779414536 + 0.0034448377886585886 * z)
    )
    T = u + u * z * P
    more, less = S + 1.0, S - 1.0
    return np.asarray((less + more * T) / (more + less * T))


def sin_unit(x: Array) -> Array:
    """Sine of every entry of ``x``, at most 1 in size."""
    z = x * x
    zz = z * z
    P = (-0.16666666666666666 + 0.008333333333333134 * z) + zz * (
        (-0.00019841269841099746 + 2.7557319155039287e-06 * z)
        + zz * ((-2.505209341098503e-08 + 1.6057253432310473e-10 * z) + zz * -7.5359841605597e-13)
    )
    return x + x * z * P


def cos_unit(x: Array) -> Array:
    """Cosine of every entry of ``x``, at most 1 in size."""
    z = x * x
    zz = z * z
    P = (0.041666666666665235 + -0.001388888888870282 * z) + zz * (
        (2.4801587210548688e-05 + -2.755729723898453e-07 * z)
        + zz * (2.0873945504611635e-09 + -1.1287949048293017e-11 * z)
    )
    return (1.0 - 0.5 * z) + zz * P


def sin_cos(x: Array) -> tuple[Array, Array]:
    """Sine and cosine of every entry of ``x`` [rad], at most some turns."""
    n = (x * 0.6366197723675814 + TO_WHOLE) - TO_WHOLE
    u = ((x - n * 1.5707963267341256) - n * 6.077100506303966e-11) - n * 2.0222662487959506e-21
    s, c = sin_unit(u), cos_unit(u)
    quarter = n.astype(np.int32) & 3
    sine = np.where(quarter & 1, c, s)
    cosine = np.where(quarter & 1, s, c)
    return np.where(quarter & 2, -sine, sine), np.where((quarter + 1) & 2, -cosine, cosine)


def angle_of(y: Array, x: Array) -> Array:
    """Angle of every vector (x, y) [rad] in [-pi, pi], 0 for the zero vector."""
    ax, ay = np.abs(x), np.abs(y)
    most, least = np.maximum(ax, ay), np.minimum(ax, ay)
    beyond = least > TAN_PI_8 * most
    over = np.where(beyond, least - most, least)
    under = np.where(beyond, least + most, most)
    within = _atan(over / np.where(under > 0.0, under, 1.0))
    eighth = np.where(beyond, 0.25 * math.pi + within, within)
    quarter = np.where(ay > ax, 0.5 * math.pi - eighth, eighth)
    half = np.where(x < 0.0, math.pi - quarter, quarter)
    return np.copysign(half, y)


def _atan(x: Array) -> Array:
    """Arc tangent of every entry of ``x``, at most tan(pi / 8) in size."""
    z = x * x
    zz = z * z
    z4 = zz * zz
    low = (-0.333333333333332 + 0.19999999999953202 * z) + zz * (
        -0.1428571428016196 + 0.11111110781917292 * z
    )
    middle = (-0.09090897718204956 + 0.07692059588503802 * z) + zz * (
        -0.06663097699701188 + 0.05847848063705777 * z
    )
    high = (-0.05039138783370984 + 0.038060800488530354 * z) + zz * -0.017903544269988653
    return x + x * z * (low + z4 * (middle + z4 * high))


def total(x: Array) -> float:
    """Sum of ``x``, shape (n,), by four partial sums: (p0 + p1) + (p2 + p3).

    Entry k is added to the partial sum k modulo 4. The C core adds in the same order, in which a
    compiler can take several entries at once, so both round alike.
    """
    part = [0.0, 0.0, 0.0, 0.0]
    for k, value in enumerate(x.tolist()):
        part[k % 4] += value
    return (part[0] + part[1]) + (part[2] + part[3])


def wrap(angle: Array, low: float = -math.pi) -> Array:
    """Every entry of ``angle`` [rad], at most a turn off, brought into [low, low + 2 pi)."""
    turn = 2.0 * math.pi
    return np.where(angle < low, angle + turn, np.where(angle < low + turn, angle, angle - turn))


def wrap_far(angle: Array, low: float = -math.pi) -> Array:
    """Every entry of ``angle`` [rad], however far off, brought into [low, low + 2 pi)."""
    turns = np.floor((angle - low) / (2.0 * math.pi))
    return angle - 2.0 * math.pi * turns

"""Neural coupling: the stored phase relations act on the oscillators (Eq. 17).

phi_lk = phi_1k - phi_1l, so with x^l = o^l + phi_1l the sum over the legs factors:
sum_k sin(o^l - o^k - phi_lk) = sin(x^l) sum_k cos(x^k) - cos(x^l) sum_k sin(x^k). That takes one
sine and one cosine per leg, not per pair of legs. The C controller computes the same sum in the
same order: under loads that contradict the stored gait the coupled oscillators are chaotic, and
a difference in the last bit would grow.
"""

from __future__ import annotations

import numpy as np

from apnc_core.elementary import cos_unit, sin_cos, sin_unit, total
from apnc_core.types import Array


def couple(o: Array, phi: Array, xi: float) -> Array:
    """Coupling term g_i(n) of one neuron of every leg, shape (n,), before its sign.

    Args:
        o: outputs of neuron i of every leg, shape (n,).
        phi: relations phi_1k [rad], shape (n - 1,).
        xi: gain.

    g^l = xi sum_k sin(o^l - o^k - phi_lk) (Eq. 17). Pitfall: for relations of exactly 0 and pi
    and equal o the sum is zero, so exact relations cannot start recall from identical
    oscillators; measured ones are never exact.
    """
    from_leg_1 = np.concatenate([[0.0], phi])
    sin_phi, cos_phi = sin_cos(from_leg_1)
    sin_o, cos_o = sin_unit(o), cos_unit(o)
    sin_x = sin_o * cos_phi + cos_o * sin_phi
    cos_x = cos_o * cos_phi - sin_o * sin_phi
    return xi * (sin_x * total(cos_x) - cos_x * total(sin_x))

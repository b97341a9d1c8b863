/* Neural coupling: the stored phase relations act on the oscillators (Eq. 17).
 *
 * phi_lk = phi_1k - phi_1l, so with x^l = o^l + phi_1l the sum over the legs factors:
 *   sum_k sin(o^l - o^k - phi_lk) = sin(x^l) sum_k cos(x^k) - cos(x^l) sum_k sin(x^k).
 * It takes one sine and one cosine per leg and neuron, not per pair of legs.
 */
#ifndef APNC_NEURAL_COUPLING_H
#define APNC_NEURAL_COUPLING_H

#include "elementary.h"

/* Sines and cosines of the phases phi_11 = 0, phi_12, phi_13, ... [rad] of all legs. */
static inline void apnc_relation(const apnc_real *phi, apnc_real *sin_phi, apnc_real *cos_phi) {
    sin_phi[0] = 0;
    cos_phi[0] = 1;
    for (int leg = 1; leg < APNC_LEGS; leg++)
        apnc_sin_cos(phi[leg - 1], &sin_phi[leg], &cos_phi[leg]);
}

/* g of one neuron of every leg times gain, from the sines and cosines of its outputs o. */
static inline void apnc_couple(apnc_real gain, const apnc_real *restrict sin_o,
                               const apnc_real *restrict cos_o, const apnc_real *restrict sin_phi,
                               const apnc_real *restrict cos_phi, apnc_real *restrict g) {
    apnc_real sin_x[APNC_LEGS], cos_x[APNC_LEGS];
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        sin_x[leg] = sin_o[leg] * cos_phi[leg] + cos_o[leg] * sin_phi[leg];
        cos_x[leg] = cos_o[leg] * cos_phi[leg] - sin_o[leg] * sin_phi[leg];
    }
    const apnc_real sum_sin = apnc_sum(sin_x, APNC_LEGS), sum_cos = apnc_sum(cos_x, APNC_LEGS);
    for (int leg = 0; leg < APNC_LEGS; leg++)
        g[leg] = gain * (sin_x[leg] * sum_cos - cos_x[leg] * sum_sin);
}

#endif

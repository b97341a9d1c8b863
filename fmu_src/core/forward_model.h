/* Forward model: predicts the load of a foot from the leg's own command (Eq. 10-11). */
#ifndef APNC_FORWARD_MODEL_H
#define APNC_FORWARD_MODEL_H

#include "apnc_variables.h"
#include "elementary.h"

/* G(n): 1 while the command, of the hip or of the knee, does not rise, else 0 (Eq. 11). */
static inline apnc_real apnc_stance_expected(apnc_real theta, apnc_real theta_before) {
    return theta <= theta_before ? 1 : 0;
}

/* F^e(n+1) = alpha (rho G(n) + (1 - rho) F^e(n)) (Eq. 10). */
static inline apnc_real apnc_expect(const apnc_parameters *p, apnc_real grf_expected, apnc_real G) {
    return p->alpha * (p->rho * G + (1 - p->rho) * grf_expected);
}

/* exp(-(d1^2 + d2^2) / width), by tanh. */
static inline apnc_real apnc_kernel(apnc_real d1, apnc_real d2) {
    const apnc_real t = apnc_tanh((d1 * d1 + d2 * d2) * (apnc_real)(0.5 / APNC_KERNEL_WIDTH));
    return (1 - t) / (1 + t);
}

/* Radial basis functions: F^e(n) = sum w_k phi_k from (o1, o2) at n, after which the weights learn
 * from the load F at n. learned: change of the weights since the start. */
static inline apnc_real apnc_expect_learned(const apnc_parameters *p, apnc_real o1, apnc_real o2,
                                            apnc_real F, apnc_real *learned) {
    static const apnc_real centre[APNC_KERNELS][2] = APNC_CENTRES;
    const apnc_real stance = p->alpha / (apnc_real)APNC_OVERLAP;
    apnc_real kernel[APNC_KERNELS], expected = 0;
    for (int k = 0; k < APNC_KERNELS; k++)
        kernel[k] = apnc_kernel(o1 - centre[k][0], o2 - centre[k][1]);
    for (int k = 0; k < APNC_KERNELS; k++)
        expected += ((centre[k][1] < 0 ? stance : 0) + learned[k]) * kernel[k];
    const apnc_real step = p->rbf_rate * (F - expected);
    for (int k = 0; k < APNC_KERNELS; k++) learned[k] += step * kernel[k];
    return expected;
}

#endif

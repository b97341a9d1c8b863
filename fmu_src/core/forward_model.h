/* Forward model: the load that the leg's own motion lets it expect (Eq. 10-11). */
#ifndef APNC_FORWARD_MODEL_H
#define APNC_FORWARD_MODEL_H

#include "apnc_variables.h"

/* G(n): 1 while the hip command does not rise, else 0 (Eq. 11). */
static inline apnc_real apnc_stance_expected(apnc_real theta_hip, apnc_real theta_hip_before) {
    return theta_hip <= theta_hip_before ? 1 : 0;
}

/* F^e(n+1) = alpha (rho G(n) + (1 - rho) F^e(n)) (Eq. 10). */
static inline apnc_real apnc_expect(const apnc_parameters *p, apnc_real grf_expected, apnc_real G) {
    return p->alpha * (p->rho * G + (1 - p->rho) * grf_expected);
}

#endif

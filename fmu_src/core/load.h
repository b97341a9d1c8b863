/* Foot load as the circuits see it (text below Eq. 5). */
#ifndef APNC_LOAD_H
#define APNC_LOAD_H

#include <float.h>

/* Factor from a load [N] to F, the load over half the weight. */
static inline double apnc_load_scale(double robot_weight) { return 2.0 / robot_weight; }

/* F of a load [N]; zero and a fault if the load is not finite or negative. */
static inline double apnc_load(double grf, double scale, int32_t *fault) {
    *fault = !(grf >= 0.0 && grf <= DBL_MAX);
    return *fault ? 0.0 : grf * scale;
}

#endif

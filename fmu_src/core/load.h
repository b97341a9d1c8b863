/* Foot load as the circuits see it (text below Eq. 5). */
#ifndef APNC_LOAD_H
#define APNC_LOAD_H

#include <float.h>

/* Load over half the weight; zero and a fault if it is not finite or negative. */
static inline double apnc_load(double grf, double robot_weight, int32_t *fault) {
    *fault = !(grf >= 0.0 && grf <= DBL_MAX);
    return *fault ? 0.0 : grf / (0.5 * robot_weight);
}

#endif

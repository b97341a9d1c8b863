/* Load of a foot over half the weight, as the circuits receive it (text below Eq. 5). */
#ifndef APNC_LOAD_H
#define APNC_LOAD_H

#include "apnc_variables.h"

/* Loads above this many weights are faults, such as the reading of a sensor with a broken wire. */
#define APNC_MOST_WEIGHTS 1000

/* Factor from a load [N] to F, the load over half the weight. */
static inline apnc_real apnc_load_scale(apnc_real robot_weight) { return 2 / robot_weight; }

/* F of a load [N], at most F_max; zero and a fault if it is not finite, negative or beyond
 * most [N]. */
static inline apnc_real apnc_load(apnc_real grf, apnc_real scale, apnc_real F_max, apnc_real most,
                                  int32_t *fault) {
    *fault = !((grf >= 0) & (grf <= most));
    const apnc_real F = *fault ? 0 : grf * scale;
    return F < F_max ? F : F_max;
}

#endif

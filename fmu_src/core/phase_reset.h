/* Phase-resetting baseline: touch-down restarts the cycle of the leg. */
#ifndef APNC_PHASE_RESET_H
#define APNC_PHASE_RESET_H

#include "apnc_variables.h"

#define APNC_A1_AT_TOUCH_DOWN 1
#define APNC_A2_AT_TOUCH_DOWN 0

/* Whether the load has just risen through grf_reset quarters of the weight. */
static inline int apnc_touched_down(const apnc_parameters *p, apnc_real F, apnc_real F_before) {
    const apnc_real threshold = p->grf_reset / 2;
    return F_before < threshold && threshold <= F;
}

#endif

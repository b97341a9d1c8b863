/* Phase-resetting baseline: touch-down restarts the cycle of the leg. */
#ifndef APNC_PHASE_RESET_H
#define APNC_PHASE_RESET_H

#define APNC_A1_AT_TOUCH_DOWN 1.0
#define APNC_A2_AT_TOUCH_DOWN 0.0

/* Whether the load has just risen through grf_reset quarters of the weight. */
static inline int apnc_touched_down(const apnc_parameters *p, double F, double F_before) {
    const double threshold = 0.5 * p->grf_reset;
    return F_before < threshold && threshold <= F;
}

#endif

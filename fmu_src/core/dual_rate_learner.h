/* Dual-rate learner: tunes the gain of the sensory feedback (Eq. 6-9). */
#ifndef APNC_DUAL_RATE_LEARNER_H
#define APNC_DUAL_RATE_LEARNER_H

#include "apnc_variables.h"

/* Gains below this count as zero; denormal numbers would slow the unloaded controller down. */
#define APNC_FORGOTTEN ((apnc_real)(sizeof(apnc_real) == sizeof(double) ? 1e-200 : 1e-30))

/* Positive part of actual minus expected load (Eq. 6). */
static inline apnc_real apnc_error(apnc_real F, apnc_real grf_expected) {
    const apnc_real e = F - grf_expected;
    return e > 0 ? e : 0;
}

/* K(n+1) = A K(n) + B e(n) (Eq. 7, 8). */
static inline apnc_real apnc_learn(apnc_real A, apnc_real K, apnc_real B, apnc_real e) {
    const apnc_real next = A * K + B * e;
    return next < APNC_FORGOTTEN ? 0 : next;
}

/* gamma = K_f + K_s (Eq. 9). */
static inline apnc_real apnc_gain(apnc_real K_f, apnc_real K_s) { return K_f + K_s; }

#endif

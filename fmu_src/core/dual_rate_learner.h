/* Dual-rate learner: tunes the gain of the sensory feedback (Eq. 6-9). */
#ifndef APNC_DUAL_RATE_LEARNER_H
#define APNC_DUAL_RATE_LEARNER_H

/* Gains below this count as zero; denormal numbers would slow the unloaded controller down. */
#define APNC_FORGOTTEN 1e-200

/* Positive part of actual minus expected load (Eq. 6). */
static inline double apnc_error(double F, double grf_expected) {
    const double e = F - grf_expected;
    return e > 0.0 ? e : 0.0;
}

/* K(n+1) = A K(n) + B e(n) (Eq. 7, 8). */
static inline double apnc_learn(double A, double K, double B, double e) {
    const double next = A * K + B * e;
    return next < APNC_FORGOTTEN ? 0.0 : next;
}

/* gamma = K_f + K_s (Eq. 9). */
static inline double apnc_gain(double K_f, double K_s) { return K_f + K_s; }

#endif

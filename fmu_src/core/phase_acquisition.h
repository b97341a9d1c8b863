/* Acquisition of the phase relations phi_12, phi_13, ... (Eq. 12).
 *
 * phi_lk is positive when leg k leads leg l.
 */
#ifndef APNC_PHASE_ACQUISITION_H
#define APNC_PHASE_ACQUISITION_H

#include <string.h>

#include "angle.h"
#include "apnc.h"

static inline void apnc_acquisition_start(apnc_acquisition *s) {
    memset(s, 0, sizeof *s);
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        s->o1_before[leg] = s->o1_before2[leg] = (apnc_real)INFINITY;
        s->t_peak[leg] = -1;
    }
}

/* Angle between the vectors (o1, o2) of leg 1 and of leg k, low-pass filtered. */
static inline void apnc_acquire_vector(apnc_acquisition *restrict s, apnc_real phase_filter,
                                       const apnc_real *restrict o1, const apnc_real *restrict o2,
                                       apnc_real *restrict angle) {
    const apnc_real first1 = o1[0], first2 = o2[0];
    for (int r = 0; r < APNC_RELATIONS; r++) {
        const apnc_real re = first1 * o1[r + 1] + first2 * o2[r + 1];
        const apnc_real im = first2 * o1[r + 1] - first1 * o2[r + 1];
        s->re[r] += phase_filter * (re - s->re[r]);
        s->im[r] += phase_filter * (im - s->im[r]);
        angle[r] = apnc_angle(s->im[r], s->re[r]);
    }
}

/* Times between the peaks of o1 over the period of leg 1 (Eq. 12). */
static inline void apnc_acquire_peak(apnc_acquisition *s, const apnc_real *o1, apnc_real *angle) {
    const double t = s->now - 1;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        if (s->o1_before2[leg] < s->o1_before[leg] && s->o1_before[leg] >= o1[leg]) {
            if (leg == 0 && s->t_peak[0] >= 0) s->period = t - s->t_peak[0];
            s->t_peak[leg] = t;
        }
        s->o1_before2[leg] = s->o1_before[leg];
        s->o1_before[leg] = o1[leg];
    }
    s->now += 1;
    for (int r = 0; r < APNC_RELATIONS; r++) {
        const int known = s->period > 0 && s->t_peak[r + 1] >= 0;
        const double lag = known ? (s->t_peak[0] - s->t_peak[r + 1]) / s->period : 0;
        angle[r] = apnc_wrap_far(2 * APNC_PI * (apnc_real)lag, -APNC_PI);
    }
}

#endif

/* Decides from the relative phases whether they have settled (Eq. 13-16). */
#ifndef APNC_PHASE_ESTIMATION_H
#define APNC_PHASE_ESTIMATION_H

#include <string.h>

#include "angle.h"
#include "apnc.h"

static inline void apnc_estimation_start(apnc_estimation *s) { memset(s, 0, sizeof *s); }

/* d(n) = |Phi(n) - mean(Phi(n-1) ... Phi(n-N))| (Eq. 13-15). */
static inline apnc_real apnc_distance(apnc_estimation *restrict s, int N,
                                      const apnc_real *restrict angle) {
    const apnc_real share = (apnc_real)1 / N;
    apnc_real square[APNC_RELATIONS];
    apnc_real *oldest = s->window[s->oldest];
    for (int r = 0; r < APNC_RELATIONS; r++) {
        const apnc_real now = s->unwrapped[r] + apnc_wrap(angle[r] - s->angle_before[r], -APNC_PI);
        const apnc_real deviation = now - s->sum[r] * share;
        square[r] = deviation * deviation;
        s->sum[r] += now - oldest[r];
        s->unwrapped[r] = oldest[r] = now;
    }
    memcpy(s->angle_before, angle, sizeof s->angle_before);
    s->oldest = s->oldest + 1 < N ? s->oldest + 1 : 0;
    if (s->oldest == 0) { /* summed anew once per round, so that rounding errors do not grow */
        for (int r = 0; r < APNC_RELATIONS; r++) s->sum[r] = 0;
        for (int i = 0; i < N; i++)
            for (int r = 0; r < APNC_RELATIONS; r++) s->sum[r] += s->window[i][r];
    }
    return apnc_sqrt(apnc_sum(square, APNC_RELATIONS));
}

/* Whether kappa may switch on at this tick (Eq. 16, or armed first and held). */
static inline int apnc_settled(apnc_estimation *s, const apnc_parameters *p, apnc_real d) {
    const int below = d <= p->sigma;
    s->armed = s->armed || !below;
    if (!(s->armed && below))
        s->calm = 0;
    else if (s->calm < INT32_MAX)
        s->calm++;
    return p->kappa_rule == APNC_KAPPA_RULE_PRINTED ? below : s->calm >= p->kappa_hold;
}

#endif

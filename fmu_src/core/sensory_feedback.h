/* Sensory feedback: how the foot load acts on the oscillator (Eq. 5). */
#ifndef APNC_SENSORY_FEEDBACK_H
#define APNC_SENSORY_FEEDBACK_H

#include "apnc_variables.h"

/* f1 = gamma F apnc_cos(o1), f2 = gamma F apnc_sin(o2), from the cosine and sine at hand. */
static inline void apnc_feedback(apnc_real gamma, apnc_real F, apnc_real cos_o1, apnc_real sin_o2,
                                 apnc_real *f1, apnc_real *f2) {
    *f1 = gamma * F * cos_o1;
    *f2 = gamma * F * sin_o2;
}

#endif

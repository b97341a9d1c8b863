/* Sensory feedback: how the foot load acts on the oscillator (Eq. 5). */
#ifndef APNC_SENSORY_FEEDBACK_H
#define APNC_SENSORY_FEEDBACK_H

/* f1 = gamma F cos(o1), f2 = gamma F sin(o2), from the cosine and sine at hand. */
static inline void apnc_feedback(double gamma, double F, double cos_o1, double sin_o2, double *f1,
                                 double *f2) {
    *f1 = gamma * F * cos_o1;
    *f2 = gamma * F * sin_o2;
}

#endif

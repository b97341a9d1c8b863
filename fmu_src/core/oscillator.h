/* SO(2) oscillator: the central pattern generator of one leg (Eq. 1-3). */
#ifndef APNC_OSCILLATOR_H
#define APNC_OSCILLATOR_H

#include <math.h>

/* Recurrent part of the activations a1(n+1), a2(n+1). */
static inline void apnc_activation(const apnc_parameters *p, double MI, double o1, double o2,
                                   double *a1, double *a2) {
    const double w12 = p->w12_0 + MI;
    *a1 = p->w11 * o1 + w12 * o2 + p->bias;
    *a2 = p->w11 * o2 - w12 * o1 + p->bias;
}

/* Neuron output (Eq. 2). */
static inline double apnc_output(double a) { return tanh(a); }

#endif

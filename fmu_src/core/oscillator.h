/* SO(2) oscillator: the central pattern generator of one leg (Eq. 1-3). */
#ifndef APNC_OSCILLATOR_H
#define APNC_OSCILLATOR_H

#include "apnc_variables.h"
#include "elementary.h"

/* Recurrent part of the activations a1(n+1), a2(n+1). */
static inline void apnc_activation(const apnc_parameters *p, apnc_real MI, apnc_real o1,
                                   apnc_real o2, apnc_real *a1, apnc_real *a2) {
    const apnc_real w12 = p->w12_0 + MI;
    *a1 = p->w11 * o1 + w12 * o2 + p->bias;
    *a2 = p->w11 * o2 - w12 * o1 + p->bias;
}

/* Neuron output (Eq. 2). */
static inline apnc_real apnc_output(apnc_real a) { return apnc_tanh(a); }

#endif

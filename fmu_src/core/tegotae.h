/* Tegotae baseline: the feedback of Eq. 5 with a gain that does not learn. */
#ifndef APNC_TEGOTAE_H
#define APNC_TEGOTAE_H

#include "apnc_variables.h"

static inline apnc_real apnc_tegotae_gain(const apnc_parameters *p) { return p->gamma_tegotae; }

#endif

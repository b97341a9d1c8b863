/* The type of all numbers and the elementary functions of it. */
#ifndef APNC_ELEMENTARY_H
#define APNC_ELEMENTARY_H

#include <math.h>

#include "apnc_variables.h"

#ifdef APNC_SINGLE
#define apnc_tanh(x)  tanhf(x)
#define apnc_sin(x)   sinf(x)
#define apnc_cos(x)   cosf(x)
#define apnc_atan(x)  atanf(x)
#define apnc_sqrt(x)  sqrtf(x)
#define apnc_floor(x) floorf(x)
#else
#define apnc_tanh(x)  tanh(x)
#define apnc_sin(x)   sin(x)
#define apnc_cos(x)   cos(x)
#define apnc_atan(x)  atan(x)
#define apnc_sqrt(x)  sqrt(x)
#define apnc_floor(x) floor(x)
#endif

#endif

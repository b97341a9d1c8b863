/* Numbers of the core: double, or float for processors without double arithmetic. */
#ifndef APNC_REAL_H
#define APNC_REAL_H

#include "apnc_config.h"

#ifdef APNC_SINGLE
typedef float apnc_real;
#else
typedef double apnc_real;
#endif

#endif

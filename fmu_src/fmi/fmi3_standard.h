/* The header of the standard, whose callbacks without a prototype newer compilers warn of. */
#ifndef APNC_FMI3_STANDARD_H
#define APNC_FMI3_STANDARD_H

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wstrict-prototypes"
#endif
#include "fmi3Functions.h"
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#endif

#endif

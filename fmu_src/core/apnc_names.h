/* Names that a linker sees carry a prefix, so that two builds in one program share none. */
#ifndef APNC_NAMES_H
#define APNC_NAMES_H

#include "apnc_config.h"

#define APNC_PASTE(a, b) a##b
#define APNC_JOIN(a, b)  APNC_PASTE(a, b)

/* The build of an FMU takes its guid; the core alone its number of legs and of digits. */
#ifndef APNC_PREFIX
#ifdef APNC_SINGLE
#define APNC_PREFIX APNC_JOIN(APNC_JOIN(apnc, APNC_LEGS), f_)
#else
#define APNC_PREFIX APNC_JOIN(APNC_JOIN(apnc, APNC_LEGS), _)
#endif
#endif

#define APNC_NAME(name) APNC_JOIN(APNC_PREFIX, name)

#define apnc_variables APNC_NAME(variables)
#define apnc_defaults  APNC_NAME(defaults)
#define apnc_init      APNC_NAME(init)
#define apnc_reset     APNC_NAME(reset)
#define apnc_tick      APNC_NAME(tick)

#endif

/* What the compiler offers: vectors of GNU C, and instructions beyond the baseline. */
#ifndef PLANT_TARGETS_H
#define PLANT_TARGETS_H

#if defined(__GNUC__) && !defined(PLANT_PLAIN)
#define PLANT_HAS_VECTORS 1
#if defined(__x86_64__)
#define PLANT_HAS_X86 1
#endif
#endif

#endif

/* The legs of one robot side by side. */
#include "targets.h"

#ifdef PLANT_HAS_VECTORS
#define PLANT_KERNEL plant_kernel_legs
#define PLANT_WIDTH  4
#define PLANT_LEGS_ABREAST
#include "kernel.h"
#else
typedef int plant_no_legs; /* a file is not empty */
#endif

/* Robots side by side. */
#include "targets.h"

#ifdef PLANT_HAS_VECTORS
#define PLANT_KERNEL plant_kernel_robots
#define PLANT_WIDTH  4
#include "kernel.h"
#else
typedef int plant_no_robots; /* a file is not empty */
#endif

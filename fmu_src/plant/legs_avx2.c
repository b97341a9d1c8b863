/* The legs of one robot side by side, in AVX2 without fused operations. */
#include "targets.h"

#ifdef PLANT_HAS_X86
#define PLANT_KERNEL plant_kernel_legs_avx2
#define PLANT_WIDTH  4
#define PLANT_LEGS_ABREAST
#define PLANT_TARGET "avx2"
#include "kernel.h"
#else
typedef int plant_no_legs_avx2; /* a file is not empty */
#endif

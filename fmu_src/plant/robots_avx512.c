/* Robots side by side, in AVX-512. */
#include "targets.h"

#ifdef PLANT_HAS_X86
#define PLANT_KERNEL plant_kernel_robots_avx512
#define PLANT_WIDTH  8
#define PLANT_TARGET "avx512f,avx512dq,avx512vl"
#include "kernel.h"
#else
typedef int plant_no_robots_avx512; /* a file is not empty */
#endif

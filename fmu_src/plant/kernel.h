/* A way to compute a plant. The file that includes this one defines its name (PLANT_KERNEL), its
 * width (see lanes.h) and its instruction set (PLANT_TARGET; if it is not defined, the compiler's
 * own). */
#include <float.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include "plant.h"

#if defined(PLANT_TARGET) && defined(__clang__)
#define KERNEL_TEXT(x)   #x
#define KERNEL_PRAGMA(x) _Pragma(KERNEL_TEXT(x))
KERNEL_PRAGMA(clang attribute push(__attribute__((target(PLANT_TARGET))), apply_to = function))
#elif defined(PLANT_TARGET)
#pragma GCC push_options
#define KERNEL_TEXT(x)   #x
#define KERNEL_PRAGMA(x) _Pragma(KERNEL_TEXT(x))
KERNEL_PRAGMA(GCC target(PLANT_TARGET))
#endif

#include "tick.h"

static void advance(void *plant, const plant_ground *const *grounds, double duration, double step) {
    advance_tick(plant, grounds, duration, step);
}

const plant_kernel PLANT_KERNEL = {PLANT_WIDTH, PLANT_ROBOTS_ABREAST, advance};

#if defined(PLANT_TARGET) && defined(__clang__)
#pragma clang attribute pop
#elif defined(PLANT_TARGET)
#pragma GCC pop_options
#endif

/* Which instruction sets this machine has. The processor is asked directly, because the built-in
 * query of some compilers always answers no. */
#include "plant.h"
#include "targets.h"

#ifdef PLANT_HAS_X86
#include <cpuid.h>

/* Registers that the operating system saves when it switches threads. */
static uint64_t saved_by_system(void) {
    uint32_t low, high;
    __asm__("xgetbv" : "=a"(low), "=d"(high) : "c"(0));
    return ((uint64_t)high << 32) | low;
}

int32_t plant_best_level(void) {
    uint32_t a, b, c, d;
    if (!__get_cpuid(1, &a, &b, &c, &d)) return PLANT_BASELINE;
    const uint32_t avx_and_xgetbv = (1u << 27) | (1u << 28);
    if ((c & avx_and_xgetbv) != avx_and_xgetbv) return PLANT_BASELINE;
    if (!__get_cpuid_count(7, 0, &a, &b, &c, &d)) return PLANT_BASELINE;
    const uint64_t saved = saved_by_system();
    const uint32_t avx512 = (1u << 16) | (1u << 17) | (1u << 31); /* F, DQ, VL */
    if ((saved & 0xE6) == 0xE6 && (b & avx512) == avx512) return PLANT_AVX512;
    if ((saved & 0x06) == 0x06 && (b & (1u << 5))) return PLANT_AVX2;
    return PLANT_BASELINE;
}
#else
int32_t plant_best_level(void) { return PLANT_BASELINE; }
#endif

/* Elementary functions of single numbers, with the same bits on every platform. */
#ifndef PLANT_FUNCTIONS_H
#define PLANT_FUNCTIONS_H

#include <stdint.h>
#include <string.h>

/* Natural logarithm of a normal number above 0: ln(m 2^k) with m near 1 by the series of the
 * inverse hyperbolic tangent. */
static inline double plant_log(double x) {
    uint64_t bits;
    memcpy(&bits, &x, sizeof bits);
    /* halved until m lies between sqrt(1/2) and sqrt(2) */
    const int64_t k = (int64_t)((bits + UINT64_C(0x00095F619980C433)) >> 52) - 1023;
    bits -= (uint64_t)k << 52;
    double m;
    memcpy(&m, &bits, sizeof m);
    const double s = (m - 1.0) / (m + 1.0), z = s * s;
    double series = 1.0 / 21.0;
    for (int n = 19; n >= 3; n -= 2) series = 1.0 / n + z * series;
    return (double)k * 0.6931471803691238 +
           ((double)k * 1.9082149292705877e-10 + 2.0 * (s + s * z * series));
}

/* 1 - exp(-x) for x >= 0: a series for x / 1024, then ten times e^2a - 1 = (e^a - 1) (e^a + 1). */
static inline double plant_decay(double x) {
    if (x > 40.0) return 1.0;
    const double r = x / -1024.0;
    double e = 1.0;
    for (int n = 9; n >= 2; n--) e = 1.0 + r / n * e;
    e *= r;
    for (int i = 0; i < 10; i++) e *= e + 2.0;
    return -e;
}

#endif

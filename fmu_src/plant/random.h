/* Random numbers that depend only on seed, purpose and index; the bits are the same everywhere.
 *
 * Philox 4x32-10, a counter-based generator: J. K. Salmon et al., Parallel random numbers: as easy
 * as 1, 2, 3, SC 2011. Key: the seed. Counter: index, purpose. */
#ifndef PLANT_RANDOM_H
#define PLANT_RANDOM_H

#include <stdint.h>

#include "functions.h"
#include "lanes.h"

/* Ten rounds on a counter of four words under a key of two. */
static inline void random_philox(uint32_t counter[4], uint32_t k0, uint32_t k1) {
    for (int round = 0; round < 10; round++) {
        const uint64_t a = (uint64_t)counter[0] * 0xD2511F53u;
        const uint64_t b = (uint64_t)counter[2] * 0xCD9E8D57u;
        const uint32_t c1 = counter[1], c3 = counter[3];
        counter[0] = (uint32_t)(b >> 32) ^ c1 ^ k0;
        counter[1] = (uint32_t)b;
        counter[2] = (uint32_t)(a >> 32) ^ c3 ^ k1;
        counter[3] = (uint32_t)a;
        k0 += 0x9E3779B9u;
        k1 += 0xBB67AE85u;
    }
}

/* Two numbers in [0, 1), with 53 random bits each. */
static inline void random_pair(uint64_t seed, uint32_t purpose, uint64_t index, double pair[2]) {
    uint32_t counter[4] = {(uint32_t)index, (uint32_t)(index >> 32), purpose, 0};
    random_philox(counter, (uint32_t)seed, (uint32_t)(seed >> 32));
    for (int i = 0; i < 2; i++) {
        const uint64_t bits = ((uint64_t)counter[2 * i + 1] << 32) | counter[2 * i];
        pair[i] = (double)(bits >> 11) * 0x1p-53;
    }
}

/* Two numbers of the standard normal distribution, by Box and Muller (1958). */
static inline void random_normal_pair(uint64_t seed, uint32_t purpose, uint64_t index,
                                      double pair[2]) {
    double u[2], sine, cosine;
    random_pair(seed, purpose, index, u);
    const double length = s_sqrt(-2.0 * plant_log(1.0 - u[0]));
    s_sin_cos(6.283185307179586 * u[1], &sine, &cosine);
    pair[0] = length * cosine;
    pair[1] = length * sine;
}

static inline double random_uniform(uint64_t seed, uint32_t purpose, uint64_t index) {
    double pair[2];
    random_pair(seed, purpose, index / 2, pair);
    return pair[index % 2];
}

static inline double random_normal(uint64_t seed, uint32_t purpose, uint64_t index) {
    double pair[2];
    random_normal_pair(seed, purpose, index / 2, pair);
    return pair[index % 2];
}

#endif

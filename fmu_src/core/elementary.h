/* Elementary functions by polynomials: the same bits on every platform, and without branches, so
 * that a compiler takes several legs at once.
 *
 * apnc_core/elementary.py has the same operations in the same order, and says how far they are off.
 * Coefficients are minimax fits in z = x^2, made for this file. No multiplication may be fused with
 * an addition (-ffp-contract=off). In single precision, and for comparison with APNC_LIBM, the
 * functions are those of the C library.
 */
#ifndef APNC_ELEMENTARY_H
#define APNC_ELEMENTARY_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#include "apnc_real.h"

#if defined(APNC_SINGLE)
#define apnc_tanh(x)        tanhf(x)
#define apnc_sin_unit(x)    sinf(x)
#define apnc_cos_unit(x)    cosf(x)
#define apnc_atan(x)        atanf(x)
#define apnc_sqrt(x)        sqrtf(x)
#define apnc_floor(x)       floorf(x)
#define apnc_abs(x)         fabsf(x)
#define apnc_copysign(x, y) copysignf(x, y)
#else
#define apnc_sqrt(x)        sqrt(x)
#define apnc_floor(x)       floor(x)
#define apnc_abs(x)         fabs(x)
#define apnc_copysign(x, y) copysign(x, y)
#endif

#if defined(APNC_LIBM) && !defined(APNC_SINGLE)
#define apnc_tanh(x)     tanh(x)
#define apnc_sin_unit(x) sin(x)
#define apnc_cos_unit(x) cos(x)
#define apnc_atan(x)     atan(x)
#endif

#if defined(APNC_LIBM) || defined(APNC_SINGLE)

static inline void apnc_sin_cos(apnc_real x, apnc_real *sine, apnc_real *cosine) {
    *sine = apnc_sin_unit(x);
    *cosine = apnc_cos_unit(x);
}

#else

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif

#define APNC_TO_WHOLE 6755399441055744.0 /* 1.5 * 2^52: adding it rounds to the nearest integer */

/* 2^n of a number n to which APNC_TO_WHOLE has been added, |n| < 1000. */
static inline double apnc_power_of_two(double shifted) {
    uint64_t bits;
    memcpy(&bits, &shifted, sizeof bits);
    bits = (bits + 1023) << 52;
    memcpy(&shifted, &bits, sizeof bits);
    return shifted;
}

/* Hyperbolic tangent. With exp(2 x) = S (1 + T) / (1 - T), S a power of two and T the tangent of
 * the rest u, it takes one division. */
static inline double apnc_tanh(double x) {
    const double below = x < 20.0 ? x : 20.0;
    const double y = below > -20.0 ? below : -20.0;
    const double shifted = y * 2.8853900817779268 + APNC_TO_WHOLE;
    const double n = shifted - APNC_TO_WHOLE;
    const double S = apnc_power_of_two(shifted);
    const double u = (y - n * 0.3465735900681466) - n * 2.118260682904642e-10;
    const double z = u * u, zz = z * z;
    const double P = (-0.3333333333333249 + 0.13333333332783764 * z) +
                     zz * ((-0.05396825278203011 + 0.02186937071535709 * z) +
                           zz * (-0.008857308779414536 + 0.0034448377886585886 * z));
    const double T = u + u * z * P;
    const double more = S + 1.0, less = S - 1.0;
    return (less + more * T) / (more + less * T);
}

/* Sine for |x| <= 1. */
static inline double apnc_sin_unit(double x) {
    const double z = x * x, zz = z * z;
    const double P = (-0.16666666666666666 + 0.008333333333333134 * z) +
                     zz * ((-0.00019841269841099746 + 2.7557319155039287e-06 * z) +
                           zz * ((-2.505209341098503e-08 + 1.6057253432310473e-10 * z) +
                                 zz * -7.5359841605597e-13));
    return x + x * z * P;
}

/* Cosine for |x| <= 1. */
static inline double apnc_cos_unit(double x) {
    const double z = x * x, zz = z * z;
    const double P = (0.041666666666665235 + -0.001388888888870282 * z) +
                     zz * ((2.4801587210548688e-05 + -2.755729723898453e-07 * z) +
                           zz * (2.0873945504611635e-09 + -1.1287949048293017e-11 * z));
    return (1.0 - 0.5 * z) + zz * P;
}

/* Sine and cosine of an angle of some turns [rad]; pi / 2 in three parts, so that their zeros are
 * where they should be. */
static inline void apnc_sin_cos(double x, double *sine, double *cosine) {
    const double shifted = x * 0.6366197723675814 + APNC_TO_WHOLE;
    const double n = shifted - APNC_TO_WHOLE;
    const double u =
        ((x - n * 1.5707963267341256) - n * 6.077100506303966e-11) - n * 2.0222662487959506e-21;
    const double s = apnc_sin_unit(u), c = apnc_cos_unit(u);
    uint64_t quarter; /* its last two bits, those of n */
    memcpy(&quarter, &shifted, sizeof quarter);
    *sine = quarter & 1 ? c : s;
    *cosine = quarter & 1 ? s : c;
    if (quarter & 2) *sine = -*sine;
    if ((quarter + 1) & 2) *cosine = -*cosine;
}

/* Arc tangent for |x| <= tan(pi / 8). */
static inline double apnc_atan(double x) {
    const double z = x * x, zz = z * z, z4 = zz * zz;
    const double low = (-0.333333333333332 + 0.19999999999953202 * z) +
                       zz * (-0.1428571428016196 + 0.11111110781917292 * z);
    const double middle = (-0.09090897718204956 + 0.07692059588503802 * z) +
                          zz * (-0.06663097699701188 + 0.05847848063705777 * z);
    const double high =
        (-0.05039138783370984 + 0.038060800488530354 * z) + zz * -0.017903544269988653;
    return x + x * z * (low + z4 * (middle + z4 * high));
}

#endif

/* Sum of n numbers in four parts, so that four additions can go on at a time; the order is fixed.
 */
static inline apnc_real apnc_sum(const apnc_real *x, int n) {
    apnc_real part[4] = {0, 0, 0, 0};
    int k = 0;
    for (; k + 4 <= n; k += 4)
        for (int i = 0; i < 4; i++) part[i] += x[k + i];
    for (int i = 0; k + i < n; i++) part[i] += x[k + i];
    return (part[0] + part[1]) + (part[2] + part[3]);
}

#endif

/* Numbers side by side. V: one number per leg or per robot; B: one number per robot.
 *
 * The file that includes this one defines PLANT_WIDTH, the number of lanes (1: plain C11 without
 * vectors), and PLANT_LEGS_ABREAST if the lanes are the legs of one robot. Every function does the
 * same operations in the same order at every width, so a lane has the bits of the plain program.
 * The compiler must not fuse a product and a sum into one operation (-ffp-contract=off).
 */
#ifndef PLANT_LANES_H
#define PLANT_LANES_H

#include <math.h>
#include <stdint.h>
#include <string.h>

#ifndef PLANT_WIDTH
#define PLANT_WIDTH 1
#endif

#if defined(__clang__)
#pragma STDC FP_CONTRACT OFF
#endif
#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wpsabi" /* every function that takes vectors is inlined */
#endif

#if defined(__GNUC__)
#define INL         static inline __attribute__((always_inline, unused))
#define OUT_OF_LINE static __attribute__((noinline, unused))
#else
#define INL         static inline
#define OUT_OF_LINE static
#endif

#define LANES_TO_WHOLE 6755399441055744.0 /* 1.5 * 2^52: adding it rounds to a whole number */

/* Sine and cosine on [-pi / 4, pi / 4]; T is the type of the numbers. */
#define LANES_SINE_COSINE(T, u, s, c)                                                              \
    const T z = (u) * (u), zz = z * z;                                                             \
    const T P = (-0.16666666666666666 + 0.008333333333333134 * z) +                                \
                zz * ((-0.00019841269841099746 + 2.7557319155039287e-06 * z) +                     \
                      zz * ((-2.505209341098503e-08 + 1.6057253432310473e-10 * z) +                \
                            zz * -7.5359841605597e-13));                                           \
    const T Q = (0.041666666666665235 + -0.001388888888870282 * z) +                               \
                zz * ((2.4801587210548688e-05 + -2.755729723898453e-07 * z) +                      \
                      zz * (2.0873945504611635e-09 + -1.1287949048293017e-11 * z));                \
    const T s = (u) + (u) * z * P;                                                                 \
    const T c = (1.0 - 0.5 * z) + zz * Q;

/* An angle minus the nearest multiple of pi / 2 [rad], which is subtracted in three parts. */
#define LANES_REST(x, n)                                                                           \
    ((((x) - (n) * 1.5707963267341256) - (n) * 6.077100506303966e-11) -                            \
     (n) * 2.0222662487959506e-21)

/* Single numbers. */
INL double s_select(int m, double a, double b) { return m ? a : b; }
INL double s_min(double a, double b) { return a < b ? a : b; }
INL double s_max(double a, double b) { return a > b ? a : b; }
INL double s_abs(double a) { return a < 0 ? -a : a; }
INL double s_sqrt(double a) { return sqrt(a); }

INL void s_sin_cos(double x, double *sine, double *cosine) {
    const double shifted = x * 0.6366197723675814 + LANES_TO_WHOLE, n = shifted - LANES_TO_WHOLE;
    const double u = LANES_REST(x, n);
    LANES_SINE_COSINE(double, u, s, c)
    uint64_t quarter; /* its last two bits are those of n */
    memcpy(&quarter, &shifted, sizeof quarter);
    const double a = quarter & 1 ? c : s, b = quarter & 1 ? s : c;
    *sine = quarter & 2 ? -a : a;
    *cosine = (quarter + 1) & 2 ? -b : b;
}

#if PLANT_WIDTH == 1

typedef double V;
#define v_select   s_select
#define v_min      s_min
#define v_max      s_max
#define v_abs      s_abs
#define v_sqrt     s_sqrt
#define v_sin_cos  s_sin_cos
#define v_all(x)   (x)
#define V_AT(v, i) ((&(v))[0 * (i)])

#else

typedef double V __attribute__((vector_size(PLANT_WIDTH * sizeof(double))));
typedef int64_t V_mask __attribute__((vector_size(PLANT_WIDTH * sizeof(double))));
#define V_AT(v, i) ((v)[i])

INL V v_all(double x) { return x - (V){0}; } /* a sum with 0 would lose the sign of -0 */
INL V v_select(V_mask m, V a, V b) { return (V)((m & (V_mask)a) | (~m & (V_mask)b)); }
INL V v_min(V a, V b) { return v_select(a < b, a, b); }
INL V v_max(V a, V b) { return v_select(a > b, a, b); }
INL V v_abs(V a) { return v_select(a < 0, -a, a); }

INL V v_sqrt(V a) {
#if defined(__has_builtin)
#if __has_builtin(__builtin_elementwise_sqrt)
#define LANES_SQRT 1
#endif
#endif
#ifdef LANES_SQRT
    return __builtin_elementwise_sqrt(a);
#else
    V b = a;
    for (int i = 0; i < PLANT_WIDTH; i++) b[i] = sqrt(a[i]);
    return b;
#endif
}

INL void v_sin_cos(V x, V *sine, V *cosine) {
    const V shifted = x * 0.6366197723675814 + LANES_TO_WHOLE, n = shifted - LANES_TO_WHOLE;
    const V u = LANES_REST(x, n);
    LANES_SINE_COSINE(V, u, s, c)
    const V_mask quarter = (V_mask)shifted, odd = -(quarter & 1);
    const V a = v_select(odd, c, s), b = v_select(odd, s, c);
    *sine = (V)((V_mask)a ^ ((quarter & 2) << 62));
    *cosine = (V)((V_mask)b ^ (((quarter + 1) & 2) << 62));
}

#endif

/* Numbers of a robot: single if the lanes are its legs, else as wide as all others. */
#ifdef PLANT_LEGS_ABREAST
typedef double B;
#define PLANT_ROBOTS_ABREAST 1
#define b_select             s_select
#define b_min                s_min
#define b_max                s_max
#define b_abs                s_abs
#define b_sqrt               s_sqrt
#define b_sin_cos            s_sin_cos
#define b_all(x)             (x)
#define B_AT(b, i)           ((&(b))[0 * (i)])
#define wide(b)              v_all(b)
#else
typedef V B;
#define PLANT_ROBOTS_ABREAST PLANT_WIDTH
#define b_select             v_select
#define b_min                v_min
#define b_max                v_max
#define b_abs                v_abs
#define b_sqrt               v_sqrt
#define b_sin_cos            v_sin_cos
#define b_all(x)             v_all(x)
#define B_AT(b, i)           V_AT(b, i)
#define wide(b)              (b)
#endif

#endif

/* The C core of the controller in one file.
 *
 * Generated from fmu_src/core by `python -m build_fmu.generate`; do not edit.
 */
#ifndef APNC_CORE_H
#define APNC_CORE_H

/* The controller: one tick of all blocks, in the order of the paper. */
#include <string.h>

/* Angles brought into a range. */
#ifndef APNC_ANGLE_H
#define APNC_ANGLE_H

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

/* Numbers of the core: double, or float for processors without double arithmetic. */
#ifndef APNC_REAL_H
#define APNC_REAL_H

/* Build-time choices. The build writes its own version of this file beside the sources. */
#ifndef APNC_CONFIG_H
#define APNC_CONFIG_H

#ifndef APNC_LEGS
#define APNC_LEGS 4 /* number of legs, the right ones first */
#endif

/* Define APNC_SINGLE for numbers of type float: processors without double arithmetic. */
/* Own start values: #define APNC_DEFAULTS(p) (p)->robot_weight = 60.0; (p)->xi = 0.03; */

#endif

#ifdef APNC_SINGLE
typedef float apnc_real;
#else
typedef double apnc_real;
#endif

#endif

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

#define APNC_PI       ((apnc_real)3.14159265358979323846)
#define APNC_TAN_PI_8 ((apnc_real)0.41421356237309503)

/* angle [rad], however far off, brought into [low, low + 2 pi). */
static inline apnc_real apnc_wrap_far(apnc_real angle, apnc_real low) {
    return angle - 2 * APNC_PI * apnc_floor((angle - low) / (2 * APNC_PI));
}

/* angle [rad] from [low - 2 pi, low + 4 pi) brought into [low, low + 2 pi). */
static inline apnc_real apnc_wrap(apnc_real angle, apnc_real low) {
    const apnc_real down = angle < low + 2 * APNC_PI ? angle : angle - 2 * APNC_PI;
    return angle < low ? angle + 2 * APNC_PI : down;
}

/* Angle of the vector (x, y) [rad], 0 for the zero vector; without branches. */
static inline apnc_real apnc_angle(apnc_real y, apnc_real x) {
    const apnc_real ax = apnc_abs(x), ay = apnc_abs(y);
    const apnc_real most = ax > ay ? ax : ay, least = ay < ax ? ay : ax;
    const int beyond = least > APNC_TAN_PI_8 * most; /* then the angle against the diagonal */
    const apnc_real over = beyond ? least - most : least;
    const apnc_real under = beyond ? least + most : most;
    const apnc_real within = apnc_atan(over / (under > 0 ? under : 1));
    const apnc_real eighth = beyond ? APNC_PI / 4 + within : within;
    const apnc_real quarter = ay > ax ? APNC_PI / 2 - eighth : eighth;
    const apnc_real half = x < 0 ? APNC_PI - quarter : quarter;
    return apnc_copysign(half, y);
}

#endif
/* Adaptive neural controller of a legged robot (Sun, Dai & Manoonpong 2023), pure core.
 *
 * No allocation, no globals, no FMI types: call apnc_init once, then apnc_tick every Ts seconds.
 * Legs are ordered right side first (quadruped: RF, RH, LF, LH).
 */
#ifndef APNC_H
#define APNC_H

/* Variables of the controller: structs, one field per variable of the table.
 *
 * Generated from apnc_core/variables.py by `python -m build_fmu.generate`; do not edit.
 */
#ifndef APNC_VARIABLES_H
#define APNC_VARIABLES_H

/* How a variable of the controller or of the robot is reached, named and checked.
 *
 * Generated from apnc_core/schema.py by `python -m build_fmu.generate`; do not edit.
 */
#ifndef APNC_VARIABLE_H
#define APNC_VARIABLE_H

#include <stddef.h>
#include <stdint.h>

/* Names that a linker sees carry a prefix, so that two builds in one program share none. */
#ifndef APNC_NAMES_H
#define APNC_NAMES_H


#define APNC_PASTE(a, b) a##b
#define APNC_JOIN(a, b)  APNC_PASTE(a, b)

/* The build of an FMU takes its guid; the core alone its number of legs and of digits. */
#ifndef APNC_PREFIX
#ifdef APNC_SINGLE
#define APNC_PREFIX APNC_JOIN(APNC_JOIN(apnc, APNC_LEGS), f_)
#else
#define APNC_PREFIX APNC_JOIN(APNC_JOIN(apnc, APNC_LEGS), _)
#endif
#endif

#define APNC_NAME(name) APNC_JOIN(APNC_PREFIX, name)

#define apnc_variables APNC_NAME(variables)
#define apnc_defaults  APNC_NAME(defaults)
#define apnc_init      APNC_NAME(init)
#define apnc_reset     APNC_NAME(reset)
#define apnc_tick      APNC_NAME(tick)

#endif

#if APNC_LEGS < 2 || APNC_LEGS > 64
#error "APNC_LEGS must be 2 to 64"
#endif

#define APNC_VR_STRIDE 100u  /* value reference = stride * number + element */
#define APNC_VR_TIME   9900u /* of the independent variable in FMI 3.0 */

typedef enum { APNC_REAL, APNC_INTEGER, APNC_BOOLEAN, APNC_ENUMERATION } apnc_type;

typedef enum { APNC_INPUT, APNC_OUTPUT, APNC_LOCAL, APNC_FIXED, APNC_TUNABLE } apnc_role;

typedef struct {
    const char *name;
    const char *before; /* scalar name = before + index + after; before alone if count is 1 */
    const char *after;
    size_t offset; /* of the first entry in the values of all variables [bytes] */
    int count;
    apnc_type type;
    apnc_role role;
    apnc_real start;
    apnc_real min; /* inclusive; min > max: no range */
    apnc_real max;
} apnc_variable;

#endif

#define APNC_RELATIONS (APNC_LEGS - 1) /* phase relations phi_1k, k = 2 ... APNC_LEGS */
#define APNC_WINDOW_MAX 256 /* largest N of Eq. 14 */
#define APNC_KERNELS 20 /* radial basis functions of the forward model */
#define APNC_KERNEL_WIDTH 0.04 /* distance squared at which they fall to 1/e */
#define APNC_OVERLAP 1.15 /* mean of their sum over the angle of the cycle */
#define APNC_CENTRES {{0.85, 0.0}, {0.87, 0.28}, {0.88, 0.64}, {0.57, 0.79}, {0.27, 0.83}, {0.0, 0.85}, {-0.28, 0.87}, {-0.64, 0.88}, {-0.79, 0.57}, {-0.83, 0.27}, {-0.85, 0.0}, {-0.87, -0.28}, {-0.88, -0.64}, {-0.57, -0.79}, {-0.27, -0.83}, {0.0, -0.85}, {0.28, -0.87}, {0.64, -0.88}, {0.79, -0.57}, {0.83, -0.27}}
#define APNC_VARIABLES 59

#define APNC_MI_START 0.08
#define APNC_MI_MIN (0.0)
#define APNC_MI_MAX 1.0
#define APNC_TURN_START 0.0
#define APNC_TURN_MIN (-1.0)
#define APNC_TURN_MAX 1.0

typedef enum {
    APNC_METHOD_APNC = 1, /* adaptive physical and neural communication, Eq. 1-18 */
    APNC_METHOD_APC = 2, /* adaptive physical communication only, Eq. 1-11 */
    APNC_METHOD_TEGOTAE = 3, /* Tegotae baseline: Eq. 5 with a fixed gain */
    APNC_METHOD_PHASE_RESET = 4, /* phase-resetting baseline: activations set to (1, 0) at touch-down */
} apnc_method;

typedef enum {
    APNC_FORWARD_MODEL_LOW_PASS_HIP = 1, /* low-pass filter of the stance of the hip command, Eq. 10-11 as printed */
    APNC_FORWARD_MODEL_LOW_PASS_KNEE = 2, /* Eq. 10-11 with the knee command, as the text of section 2.1.2 has it */
    APNC_FORWARD_MODEL_RADIAL_BASIS = 3, /* radial basis functions of (o1, o2) that learn the load */
} apnc_forward_model;

typedef enum {
    APNC_PHASE_MEASURE_VECTOR = 1, /* angle between the vectors (o1, o2) of two legs, low-pass filtered */
    APNC_PHASE_MEASURE_PEAK = 2, /* times of the peaks of o1, Eq. 12 */
} apnc_phase_measure;

typedef enum {
    APNC_KAPPA_RULE_ARMED = 1, /* on after d has exceeded sigma and then stayed at or below it for kappa_hold ticks */
    APNC_KAPPA_RULE_PRINTED = 2, /* Eq. 16 as printed: on whenever d is at or below sigma */
} apnc_kappa_rule;

typedef enum {
    APNC_COUPLING_SIGN_REVERSED = 1, /* g subtracted: recovers the stored gait */
    APNC_COUPLING_SIGN_PRINTED = 2, /* g added, as printed in Eq. 18 */
} apnc_coupling_sign;

/* Parameters. */
typedef struct {
    apnc_real Ts; /* [s] time between two ticks of the controller */
    apnc_real robot_weight; /* [N] Eq. 5: weight of the robot; half of it normalises the load */
    apnc_real F_max; /* [1] Eq. 5: limit of the load over half the weight; a higher load, as in an impact or under a payload, counts as this value */
    int32_t method; /* controller that runs */
    apnc_real w11; /* [1] Eq. 3: self-weight of both neurons, w11 = w22 */
    apnc_real w12_0; /* [1] Eq. 3: cross-weight at MI = 0: w12 = w12_0 + MI, w21 = -w12 */
    apnc_real bias; /* [1] Eq. 1: bias added to both activations; the paper has none */
    apnc_real o1_start; /* [1] Eq. 2: start output of neuron N1, the same for every leg */
    apnc_real o2_start; /* [1] Eq. 2: start output of neuron N2, the same for every leg */
    apnc_real a1; /* [rad] Eq. 4: slope of the motor neuron of the hip */
    apnc_real a2; /* [rad] Eq. 4: slope of the motor neuron of the knee */
    apnc_real b1; /* [rad] Eq. 4: offset of the motor neuron of the hip */
    apnc_real b2; /* [rad] Eq. 4: offset of the motor neuron of the knee */
    apnc_real turn_gain; /* [1] Eq. 4: relative change of the amplitudes at full steering */
    apnc_real A_f; /* [1] Eq. 7: retention of the fast learner */
    apnc_real B_f; /* [1] Eq. 7: learning rate of the fast learner */
    apnc_real A_s; /* [1] Eq. 8: retention of the slow learner */
    apnc_real B_s; /* [1] Eq. 8: learning rate of the slow learner */
    apnc_real alpha; /* [1] Eq. 10: scale of the expected load */
    apnc_real rho; /* [1] Eq. 10: shape of the expected load */
    int32_t forward_model; /* Eq. 10, 11: how the expected load is computed */
    apnc_real rbf_rate; /* [1] Eq. 10: learning rate of the radial-basis forward model */
    int32_t phase_measure; /* Eq. 12: how the relative phases are measured; the paper prints peak */
    apnc_real phase_filter; /* [1] Eq. 12: share of the new value per tick in the low-pass filter of the vector phase measure */
    int32_t N; /* Eq. 14: ticks in the mean of the relative phases */
    apnc_real sigma; /* [rad] Eq. 16: threshold of d below which the phases count as stable */
    int32_t kappa_rule; /* Eq. 16: when the couplings switch on; the paper prints Eq. 16 */
    int32_t kappa_hold; /* Eq. 16: ticks that d stays at or below sigma before kappa switches on */
    apnc_real xi; /* [1] Eq. 17: gain of the neural communication */
    apnc_real feedback_kept; /* [1] Eq. 5: share of the sensory feedback that remains while the couplings are on; the equations have 1 */
    int32_t coupling_sign; /* Eq. 18: sign of the coupling term; the paper prints plus */
    int32_t phi_frozen; /* Eq. 17: true: the couplings use the phases measured when kappa switched on; false: the phases measured now, as printed in Eq. 17 */
    int32_t MI_zero_resets; /* Eq. 3: true: MI = 0 acts as reset; false: the oscillators keep running with w12 = w12_0, as printed in Eq. 3 */
    int32_t stored; /* Eq. 17: true: start with the stored gait phi_stored and the couplings on */
    apnc_real phi_stored[APNC_RELATIONS]; /* [rad] Eq. 17: stored gait at the start: relative phase phi_1k, used if stored is true */
    apnc_real gamma_tegotae; /* [1] Eq. 5: fixed feedback gain of the Tegotae baseline */
    apnc_real grf_reset; /* [1] load over a quarter of the weight at which a rising load resets the phase (phase-resetting baseline) */
} apnc_parameters;

/* Inputs of one tick. */
typedef struct {
    apnc_real grf[APNC_LEGS]; /* [N] Eq. 5: load on the foot; a value that is not finite, negative or above 1000 weights counts as zero and raises fault */
    apnc_real MI; /* [1] Eq. 3: modulatory input: sets the stepping frequency; limited to its range */
    apnc_real turn; /* [1] Eq. 4: steering, positive turns left: scales the amplitudes of the right legs up and of the left legs down; limited to its range */
    int32_t reset; /* while true, oscillators, learners and forward models stay at their start state; the stored gait is kept */
} apnc_inputs;

/* Outputs and local variables of one tick. */
typedef struct {
    apnc_real theta_hip[APNC_LEGS]; /* [rad] Eq. 4: command of the hip joint, relative to the reference pose */
    apnc_real theta_knee[APNC_LEGS]; /* [rad] Eq. 4: command of the knee joint, relative to the reference pose */
    apnc_real o1[APNC_LEGS]; /* [1] Eq. 2: output of neuron N1 */
    apnc_real o2[APNC_LEGS]; /* [1] Eq. 2: output of neuron N2 */
    apnc_real gamma[APNC_LEGS]; /* [1] Eq. 5, 9: gain of the sensory feedback as it acts in Eq. 5: K_f + K_s (Eq. 9), times feedback_kept while the couplings are on; gamma_tegotae or 0 in the baselines */
    apnc_real grf_expected[APNC_LEGS]; /* [1] Eq. 10: expected load over half the weight */
    apnc_real f1[APNC_LEGS]; /* [1] Eq. 5: sensory feedback to neuron N1 */
    apnc_real f2[APNC_LEGS]; /* [1] Eq. 5: sensory feedback to neuron N2 */
    apnc_real g1[APNC_LEGS]; /* [1] Eq. 17: neural coupling to neuron N1, as added to its activation */
    apnc_real g2[APNC_LEGS]; /* [1] Eq. 17: neural coupling to neuron N2, as added to its activation */
    int32_t fault[APNC_LEGS]; /* true while the load input of the leg cannot be used */
    apnc_real phi[APNC_RELATIONS]; /* [rad] Eq. 12: relative phase phi_1k of legs 1 and k = index + 1, in [-pi/2, 3 pi/2) */
    apnc_real phi_memory[APNC_RELATIONS]; /* [rad] Eq. 17: stored gait that is held now: relative phase phi_1k; zero while no gait is stored */
    apnc_real d; /* [rad] Eq. 15: distance of the relative phases from their mean */
    apnc_real kappa; /* [1] Eq. 16: 1 while the neural couplings are on, else 0 */
    int32_t tick; /* Eq. 1: number of ticks run since the start */
    apnc_real K_f[APNC_LEGS]; /* [1] Eq. 7: state of the fast learner */
    apnc_real K_s[APNC_LEGS]; /* [1] Eq. 8: state of the slow learner */
} apnc_outputs;

/* Everything an importer can see, in one block. */
typedef struct {
    apnc_parameters parameters;
    apnc_inputs inputs;
    apnc_outputs outputs;
} apnc_data;

#ifdef __cplusplus
extern "C" {
#endif
static const apnc_variable apnc_variables[APNC_VARIABLES];
#ifdef __cplusplus
}
#endif

#endif

#ifdef __cplusplus
extern "C" {
#endif

/* Oscillators, learners and forward models of all legs. */
typedef struct {
    apnc_real o1[APNC_LEGS];                    /* [1] neuron outputs at n, Eq. 2 */
    apnc_real o2[APNC_LEGS];                    /* [1] */
    apnc_real K_f[APNC_LEGS];                   /* [1] fast learner, Eq. 7 */
    apnc_real K_s[APNC_LEGS];                   /* [1] slow learner, Eq. 8 */
    apnc_real grf_expected[APNC_LEGS];          /* [1] expected load over half the weight, Eq. 10 */
    apnc_real theta_before[APNC_LEGS];          /* [rad] command that is copied, at n - 1 */
    apnc_real F_before[APNC_LEGS];              /* [1] load over half the weight at n - 1 */
    apnc_real learned[APNC_LEGS][APNC_KERNELS]; /* [1] by the kernels of the forward model */
} apnc_circuits;

/* Acquisition of the phase relations, Eq. 12. */
typedef struct {
    apnc_real
        re[APNC_RELATIONS]; /* [1] low-passed product of the vectors (o1, o2) of legs 1 and k */
    apnc_real im[APNC_RELATIONS];    /* [1] */
    apnc_real o1_before[APNC_LEGS];  /* [1] o1 at n - 1 */
    apnc_real o1_before2[APNC_LEGS]; /* [1] o1 at n - 2 */
    /* double in every build: float counts ticks for three days only */
    double t_peak[APNC_LEGS]; /* [ticks] last peak of o1, negative: none yet */
    double period;            /* [ticks] between the last two peaks of leg 1, 0: unknown */
    double now;               /* [ticks] since the circuits started */
} apnc_acquisition;

/* Estimation of the phase relations, Eq. 13-16. */
typedef struct {
    apnc_real angle_before[APNC_RELATIONS]; /* [rad] angles at n - 1 */
    apnc_real unwrapped[APNC_RELATIONS];    /* [rad] relative phases at n */
    apnc_real window[APNC_WINDOW_MAX]
                    [APNC_RELATIONS]; /* [rad] relative phases at n - 1 ... n - N */
    apnc_real sum[APNC_RELATIONS];    /* [rad] over the window */
    int32_t oldest;                   /* place in the window that is replaced next */
    int32_t armed;                    /* d has exceeded sigma */
    int32_t calm;                     /* [ticks] with d at or below sigma since */
} apnc_estimation;

/* The stored gait. */
typedef struct {
    apnc_real phi[APNC_RELATIONS]; /* [rad] stored relations phi_1k */
    apnc_real sin_phi[APNC_LEGS];  /* [1] of phi_11 = 0, phi_12, phi_13, ... */
    apnc_real cos_phi[APNC_LEGS];  /* [1] */
    int32_t on;                    /* there are stored relations and kappa is 1 */
    int32_t unused;
} apnc_stored_gait;

typedef struct {
    apnc_circuits circuits;
    apnc_acquisition acquisition;
    apnc_estimation estimation;
    apnc_stored_gait stored;
    apnc_real MI;   /* [1] last usable value of the input */
    apnc_real turn; /* [1] last usable value of the input */
    int64_t ticks;  /* run since the start */
} apnc_state;

/* Parameters and inputs at their start values. */
static void apnc_defaults(apnc_data *data);

/* Fresh controller: circuits at their start state, the stored gait of the parameters; fills out. */
static void apnc_init(const apnc_parameters *p, apnc_state *state, apnc_outputs *out);

/* Circuits back to their start state; the stored gait stays. */
static void apnc_reset(const apnc_parameters *p, apnc_state *state);

/* Tick n: outputs at n from the state and the inputs at n, then the state at n + 1. */
static void apnc_tick(const apnc_parameters *p, apnc_state *state, const apnc_inputs *in,
               apnc_outputs *out);

#ifdef __cplusplus
}
#endif

#endif
/* Dual-rate learner: tunes the gain of the sensory feedback (Eq. 6-9). */
#ifndef APNC_DUAL_RATE_LEARNER_H
#define APNC_DUAL_RATE_LEARNER_H


/* Gains below this count as zero; denormal numbers would slow the unloaded controller down. */
#define APNC_FORGOTTEN ((apnc_real)(sizeof(apnc_real) == sizeof(double) ? 1e-200 : 1e-30))

/* Positive part of actual minus expected load (Eq. 6). */
static inline apnc_real apnc_error(apnc_real F, apnc_real grf_expected) {
    const apnc_real e = F - grf_expected;
    return e > 0 ? e : 0;
}

/* K(n+1) = A K(n) + B e(n) (Eq. 7, 8). */
static inline apnc_real apnc_learn(apnc_real A, apnc_real K, apnc_real B, apnc_real e) {
    const apnc_real next = A * K + B * e;
    return next < APNC_FORGOTTEN ? 0 : next;
}

/* gamma = K_f + K_s (Eq. 9). */
static inline apnc_real apnc_gain(apnc_real K_f, apnc_real K_s) { return K_f + K_s; }

#endif
/* Forward model: predicts the load of a foot from the leg's own command (Eq. 10-11). */
#ifndef APNC_FORWARD_MODEL_H
#define APNC_FORWARD_MODEL_H


/* G(n): 1 while the command, of the hip or of the knee, does not rise, else 0 (Eq. 11). */
static inline apnc_real apnc_stance_expected(apnc_real theta, apnc_real theta_before) {
    return theta <= theta_before ? 1 : 0;
}

/* F^e(n+1) = alpha (rho G(n) + (1 - rho) F^e(n)) (Eq. 10). */
static inline apnc_real apnc_expect(const apnc_parameters *p, apnc_real grf_expected, apnc_real G) {
    return p->alpha * (p->rho * G + (1 - p->rho) * grf_expected);
}

/* exp(-(d1^2 + d2^2) / width), by tanh. */
static inline apnc_real apnc_kernel(apnc_real d1, apnc_real d2) {
    const apnc_real t = apnc_tanh((d1 * d1 + d2 * d2) * (apnc_real)(0.5 / APNC_KERNEL_WIDTH));
    return (1 - t) / (1 + t);
}

/* Radial basis functions: F^e(n) = sum w_k phi_k from (o1, o2) at n, after which the weights learn
 * from the load F at n. learned: change of the weights since the start. */
static inline apnc_real apnc_expect_learned(const apnc_parameters *p, apnc_real o1, apnc_real o2,
                                            apnc_real F, apnc_real *learned) {
    static const apnc_real centre[APNC_KERNELS][2] = APNC_CENTRES;
    const apnc_real stance = p->alpha / (apnc_real)APNC_OVERLAP;
    apnc_real kernel[APNC_KERNELS], expected = 0;
    for (int k = 0; k < APNC_KERNELS; k++)
        kernel[k] = apnc_kernel(o1 - centre[k][0], o2 - centre[k][1]);
    for (int k = 0; k < APNC_KERNELS; k++)
        expected += ((centre[k][1] < 0 ? stance : 0) + learned[k]) * kernel[k];
    const apnc_real step = p->rbf_rate * (F - expected);
    for (int k = 0; k < APNC_KERNELS; k++) learned[k] += step * kernel[k];
    return expected;
}

#endif
/* Load of a foot over half the weight, as the circuits receive it (text below Eq. 5). */
#ifndef APNC_LOAD_H
#define APNC_LOAD_H


/* Loads above this many weights are faults, such as the reading of a sensor with a broken wire. */
#define APNC_MOST_WEIGHTS 1000

/* Factor from a load [N] to F, the load over half the weight. */
static inline apnc_real apnc_load_scale(apnc_real robot_weight) { return 2 / robot_weight; }

/* F of a load [N], at most F_max; zero and a fault if it is not finite, negative or beyond
 * most [N]. */
static inline apnc_real apnc_load(apnc_real grf, apnc_real scale, apnc_real F_max, apnc_real most,
                                  int32_t *fault) {
    *fault = !((grf >= 0) & (grf <= most));
    const apnc_real F = *fault ? 0 : grf * scale;
    return F < F_max ? F : F_max;
}

#endif
/* Motor neurons: from oscillator outputs to joint commands (Eq. 4). */
#ifndef APNC_MOTOR_NEURONS_H
#define APNC_MOTOR_NEURONS_H


/* Factor on the slopes of a leg: up on the right, down on the left when turning left. */
static inline apnc_real apnc_amplitude_scale(const apnc_parameters *p, apnc_real turn, int leg) {
    const apnc_real change = p->turn_gain * turn;
    return leg < APNC_LEGS / 2 ? 1 + change : 1 - change;
}

/* Joint command theta_i = a_i o_i + b_i [rad]. */
static inline apnc_real apnc_command(apnc_real scale, apnc_real a, apnc_real o, apnc_real b) {
    return scale * a * o + b;
}

#endif
/* Neural coupling: the stored phase relations act on the oscillators (Eq. 17).
 *
 * phi_lk = phi_1k - phi_1l, so with x^l = o^l + phi_1l the sum over the legs factors:
 *   sum_k sin(o^l - o^k - phi_lk) = sin(x^l) sum_k cos(x^k) - cos(x^l) sum_k sin(x^k).
 * It takes one sine and one cosine per leg and neuron, not per pair of legs.
 */
#ifndef APNC_NEURAL_COUPLING_H
#define APNC_NEURAL_COUPLING_H


/* Sines and cosines of the phases phi_11 = 0, phi_12, phi_13, ... [rad] of all legs. */
static inline void apnc_relation(const apnc_real *phi, apnc_real *sin_phi, apnc_real *cos_phi) {
    sin_phi[0] = 0;
    cos_phi[0] = 1;
    for (int leg = 1; leg < APNC_LEGS; leg++)
        apnc_sin_cos(phi[leg - 1], &sin_phi[leg], &cos_phi[leg]);
}

/* g of one neuron of every leg times gain, from the sines and cosines of its outputs o. */
static inline void apnc_couple(apnc_real gain, const apnc_real *restrict sin_o,
                               const apnc_real *restrict cos_o, const apnc_real *restrict sin_phi,
                               const apnc_real *restrict cos_phi, apnc_real *restrict g) {
    apnc_real sin_x[APNC_LEGS], cos_x[APNC_LEGS];
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        sin_x[leg] = sin_o[leg] * cos_phi[leg] + cos_o[leg] * sin_phi[leg];
        cos_x[leg] = cos_o[leg] * cos_phi[leg] - sin_o[leg] * sin_phi[leg];
    }
    const apnc_real sum_sin = apnc_sum(sin_x, APNC_LEGS), sum_cos = apnc_sum(cos_x, APNC_LEGS);
    for (int leg = 0; leg < APNC_LEGS; leg++)
        g[leg] = gain * (sin_x[leg] * sum_cos - cos_x[leg] * sum_sin);
}

#endif
/* SO(2) oscillator: the central pattern generator of one leg (Eq. 1-3). */
#ifndef APNC_OSCILLATOR_H
#define APNC_OSCILLATOR_H


/* Recurrent part of the activations a1(n+1), a2(n+1). */
static inline void apnc_activation(const apnc_parameters *p, apnc_real MI, apnc_real o1,
                                   apnc_real o2, apnc_real *a1, apnc_real *a2) {
    const apnc_real w12 = p->w12_0 + MI;
    *a1 = p->w11 * o1 + w12 * o2 + p->bias;
    *a2 = p->w11 * o2 - w12 * o1 + p->bias;
}

/* Neuron output (Eq. 2). */
static inline apnc_real apnc_output(apnc_real a) { return apnc_tanh(a); }

#endif
/* Acquisition of the phase relations phi_12, phi_13, ... (Eq. 12).
 *
 * phi_lk is positive when leg k leads leg l.
 */
#ifndef APNC_PHASE_ACQUISITION_H
#define APNC_PHASE_ACQUISITION_H

#include <string.h>


static inline void apnc_acquisition_start(apnc_acquisition *s) {
    memset(s, 0, sizeof *s);
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        s->o1_before[leg] = s->o1_before2[leg] = (apnc_real)INFINITY;
        s->t_peak[leg] = -1;
    }
}

/* Angle between the vectors (o1, o2) of leg 1 and of leg k, low-pass filtered. */
static inline void apnc_acquire_vector(apnc_acquisition *restrict s, apnc_real phase_filter,
                                       const apnc_real *restrict o1, const apnc_real *restrict o2,
                                       apnc_real *restrict angle) {
    const apnc_real first1 = o1[0], first2 = o2[0];
    for (int r = 0; r < APNC_RELATIONS; r++) {
        const apnc_real re = first1 * o1[r + 1] + first2 * o2[r + 1];
        const apnc_real im = first2 * o1[r + 1] - first1 * o2[r + 1];
        s->re[r] += phase_filter * (re - s->re[r]);
        s->im[r] += phase_filter * (im - s->im[r]);
        angle[r] = apnc_angle(s->im[r], s->re[r]);
    }
}

/* Times between the peaks of o1 over the period of leg 1 (Eq. 12). */
static inline void apnc_acquire_peak(apnc_acquisition *s, const apnc_real *o1, apnc_real *angle) {
    const double t = s->now - 1;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        if (s->o1_before2[leg] < s->o1_before[leg] && s->o1_before[leg] >= o1[leg]) {
            if (leg == 0 && s->t_peak[0] >= 0) s->period = t - s->t_peak[0];
            s->t_peak[leg] = t;
        }
        s->o1_before2[leg] = s->o1_before[leg];
        s->o1_before[leg] = o1[leg];
    }
    s->now += 1;
    for (int r = 0; r < APNC_RELATIONS; r++) {
        const int known = s->period > 0 && s->t_peak[r + 1] >= 0;
        const double lag = known ? (s->t_peak[0] - s->t_peak[r + 1]) / s->period : 0;
        angle[r] = apnc_wrap_far(2 * APNC_PI * (apnc_real)lag, -APNC_PI);
    }
}

#endif
/* Decides from the relative phases whether they have settled (Eq. 13-16). */
#ifndef APNC_PHASE_ESTIMATION_H
#define APNC_PHASE_ESTIMATION_H

#include <string.h>


static inline void apnc_estimation_start(apnc_estimation *s) { memset(s, 0, sizeof *s); }

/* d(n) = |Phi(n) - mean(Phi(n-1) ... Phi(n-N))| (Eq. 13-15). */
static inline apnc_real apnc_distance(apnc_estimation *restrict s, int N,
                                      const apnc_real *restrict angle) {
    const apnc_real share = (apnc_real)1 / N;
    apnc_real square[APNC_RELATIONS];
    apnc_real *oldest = s->window[s->oldest];
    for (int r = 0; r < APNC_RELATIONS; r++) {
        const apnc_real now = s->unwrapped[r] + apnc_wrap(angle[r] - s->angle_before[r], -APNC_PI);
        const apnc_real deviation = now - s->sum[r] * share;
        square[r] = deviation * deviation;
        s->sum[r] += now - oldest[r];
        s->unwrapped[r] = oldest[r] = now;
    }
    memcpy(s->angle_before, angle, sizeof s->angle_before);
    s->oldest = s->oldest + 1 < N ? s->oldest + 1 : 0;
    if (s->oldest == 0) { /* summed anew once per round, so that rounding errors do not grow */
        for (int r = 0; r < APNC_RELATIONS; r++) s->sum[r] = 0;
        for (int i = 0; i < N; i++)
            for (int r = 0; r < APNC_RELATIONS; r++) s->sum[r] += s->window[i][r];
    }
    return apnc_sqrt(apnc_sum(square, APNC_RELATIONS));
}

/* Whether kappa may switch on at this tick (Eq. 16, or armed first and held). */
static inline int apnc_settled(apnc_estimation *s, const apnc_parameters *p, apnc_real d) {
    const int below = d <= p->sigma;
    s->armed = s->armed || !below;
    if (!(s->armed && below))
        s->calm = 0;
    else if (s->calm < INT32_MAX)
        s->calm++;
    return p->kappa_rule == APNC_KAPPA_RULE_PRINTED ? below : s->calm >= p->kappa_hold;
}

#endif
/* Phase-resetting baseline: touch-down restarts the cycle of the leg. */
#ifndef APNC_PHASE_RESET_H
#define APNC_PHASE_RESET_H


#define APNC_A1_AT_TOUCH_DOWN 1
#define APNC_A2_AT_TOUCH_DOWN 0

/* Whether the load has just risen through grf_reset quarters of the weight. */
static inline int apnc_touched_down(const apnc_parameters *p, apnc_real F, apnc_real F_before) {
    const apnc_real threshold = p->grf_reset / 2;
    return F_before < threshold && threshold <= F;
}

#endif
/* Sensory feedback: how the foot load acts on the oscillator (Eq. 5). */
#ifndef APNC_SENSORY_FEEDBACK_H
#define APNC_SENSORY_FEEDBACK_H


/* f1 = gamma F apnc_cos(o1), f2 = gamma F apnc_sin(o2), from the cosine and sine at hand. */
static inline void apnc_feedback(apnc_real gamma, apnc_real F, apnc_real cos_o1, apnc_real sin_o2,
                                 apnc_real *f1, apnc_real *f2) {
    *f1 = gamma * F * cos_o1;
    *f2 = gamma * F * sin_o2;
}

#endif
/* Tegotae baseline: the feedback of Eq. 5 with a gain that does not learn. */
#ifndef APNC_TEGOTAE_H
#define APNC_TEGOTAE_H


static inline apnc_real apnc_tegotae_gain(const apnc_parameters *p) { return p->gamma_tegotae; }

#endif

#define PHI_LOW (-APNC_PI / 2) /* phi is shown in [-pi/2, 3 pi/2): 0 and pi lie inside */

static void apnc_defaults(apnc_data *data) {
    memset(data, 0, sizeof *data);
    for (int i = 0; i < APNC_VARIABLES; i++) {
        const apnc_variable *variable = &apnc_variables[i];
        char *at = (char *)data + variable->offset;
        for (int k = 0; k < variable->count; k++) {
            if (variable->type == APNC_REAL)
                ((apnc_real *)at)[k] = variable->start;
            else
                ((int32_t *)at)[k] = (int32_t)variable->start;
        }
    }
#ifdef APNC_DEFAULTS
    APNC_DEFAULTS(&data->parameters)
#endif
}

static void apnc_reset(const apnc_parameters *p, apnc_state *state) {
    apnc_circuits *c = &state->circuits;
    memset(c, 0, sizeof *c);
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        c->o1[leg] = p->o1_start;
        c->o2[leg] = p->o2_start;
        c->theta_before[leg] = (apnc_real)INFINITY;
        c->F_before[leg] =
            (apnc_real)INFINITY; /* a robot that already stands does not touch down */
    }
    apnc_acquisition_start(&state->acquisition);
    apnc_estimation_start(&state->estimation);
}

/* Value within its range; what was held before if it is not a number. */
static apnc_real limited(apnc_real value, apnc_real low, apnc_real high, apnc_real held) {
    if (!isfinite(value)) return held;
    return value < low ? low : value > high ? high : value;
}

static void store(apnc_stored_gait *stored, const apnc_real *phi) {
    memcpy(stored->phi, phi, sizeof stored->phi);
    apnc_relation(phi, stored->sin_phi, stored->cos_phi);
    stored->on = 1;
}

static int couplings_on(const apnc_parameters *p, const apnc_state *state) {
    return p->method == APNC_METHOD_APNC && state->stored.on;
}

/* Outputs that follow from the circuits' state alone. */
static void observe(const apnc_parameters *restrict p, const apnc_state *restrict state,
                    apnc_outputs *restrict out) {
    const apnc_circuits *c = &state->circuits;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        const apnc_real scale = apnc_amplitude_scale(p, state->turn, leg);
        out->theta_hip[leg] = apnc_command(scale, p->a1, c->o1[leg], p->b1);
        out->theta_knee[leg] = apnc_command(scale, p->a2, c->o2[leg], p->b2);
        out->o1[leg] = c->o1[leg];
        out->o2[leg] = c->o2[leg];
        out->K_f[leg] = c->K_f[leg];
        out->K_s[leg] = c->K_s[leg];
        out->grf_expected[leg] = c->grf_expected[leg];
    }
}

/* Outputs while the circuits are held at their start state. */
static void observe_rest(const apnc_parameters *p, const apnc_state *state, apnc_outputs *out) {
    memset(out, 0, sizeof *out);
    observe(p, state, out);
    memcpy(out->phi_memory, state->stored.phi, sizeof out->phi_memory);
    out->kappa = couplings_on(p, state) ? 1 : 0;
}

static void apnc_init(const apnc_parameters *p, apnc_state *state, apnc_outputs *out) {
    memset(state, 0, sizeof *state);
    state->MI = APNC_MI_START;
    state->turn = APNC_TURN_START;
    apnc_reset(p, state);
    if (p->stored) store(&state->stored, p->phi_stored);
    observe_rest(p, state, out);
}

/* Phases, their stability and kappa at n; the angles [rad] are returned for live coupling. */
static void communicate(const apnc_parameters *restrict p, apnc_state *restrict state,
                        apnc_real *restrict angle, apnc_outputs *restrict out) {
    const apnc_circuits *c = &state->circuits;
    apnc_stored_gait *stored = &state->stored;
    if (p->phase_measure == APNC_PHASE_MEASURE_PEAK)
        apnc_acquire_peak(&state->acquisition, c->o1, angle);
    else
        apnc_acquire_vector(&state->acquisition, p->phase_filter, c->o1, c->o2, angle);
    out->d = apnc_distance(&state->estimation, p->N, angle);
    for (int r = 0; r < APNC_RELATIONS; r++) out->phi[r] = apnc_wrap(angle[r], PHI_LOW);

    const int settled = apnc_settled(&state->estimation, p, out->d);
    if (p->method == APNC_METHOD_APNC) {
        if (settled && !stored->on) store(stored, out->phi);
        if (p->kappa_rule == APNC_KAPPA_RULE_PRINTED) stored->on = settled;
    }
    memcpy(out->phi_memory, stored->phi, sizeof out->phi_memory);
    out->kappa = couplings_on(p, state) ? 1 : 0;
}

/* Sines and cosines of the neuron outputs: of those that the feedback takes, or of all. */
typedef struct {
    apnc_real sin_o1[APNC_LEGS], cos_o1[APNC_LEGS], sin_o2[APNC_LEGS], cos_o2[APNC_LEGS];
} trigonometry;

static void evaluate(const apnc_circuits *restrict c, int coupled, trigonometry *restrict t) {
#ifdef APNC_LIBM /* sine and cosine of one number side by side are computed at once */
    for (int leg = 0; coupled && leg < APNC_LEGS; leg++) {
        t->sin_o1[leg] = apnc_sin_unit(c->o1[leg]);
        t->cos_o1[leg] = apnc_cos_unit(c->o1[leg]);
        t->sin_o2[leg] = apnc_sin_unit(c->o2[leg]);
        t->cos_o2[leg] = apnc_cos_unit(c->o2[leg]);
    }
    if (coupled) return;
#endif
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        t->cos_o1[leg] = apnc_cos_unit(c->o1[leg]);
        t->sin_o2[leg] = apnc_sin_unit(c->o2[leg]);
    }
    if (!coupled) return;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        t->sin_o1[leg] = apnc_sin_unit(c->o1[leg]);
        t->cos_o2[leg] = apnc_cos_unit(c->o2[leg]);
    }
}

static void feed_back(const apnc_parameters *restrict p, const apnc_circuits *restrict c,
                      const apnc_real *restrict F, const trigonometry *restrict t,
                      apnc_outputs *restrict out) {
    const int learns = p->method == APNC_METHOD_APNC || p->method == APNC_METHOD_APC;
    const apnc_real kept = out->kappa > 0 ? p->feedback_kept : 1;
    const apnc_real fixed = p->method == APNC_METHOD_TEGOTAE ? apnc_tegotae_gain(p) : 0;
    for (int leg = 0; leg < APNC_LEGS; leg++) out->gamma[leg] = fixed;
    for (int leg = 0; learns && leg < APNC_LEGS; leg++)
        out->gamma[leg] = kept * apnc_gain(c->K_f[leg], c->K_s[leg]);
    for (int leg = 0; leg < APNC_LEGS; leg++)
        apnc_feedback(out->gamma[leg], F[leg], t->cos_o1[leg], t->sin_o2[leg], &out->f1[leg],
                      &out->f2[leg]);
    memset(out->g1, 0, sizeof out->g1);
    memset(out->g2, 0, sizeof out->g2);
}

static void couple(const apnc_parameters *p, const apnc_stored_gait *stored, const apnc_real *angle,
                   const trigonometry *t, apnc_outputs *out) {
    const apnc_real gain = p->coupling_sign == APNC_COUPLING_SIGN_PRINTED ? p->xi : -p->xi;
    apnc_real sin_phi[APNC_LEGS], cos_phi[APNC_LEGS];
    memcpy(sin_phi, stored->sin_phi, sizeof sin_phi);
    memcpy(cos_phi, stored->cos_phi, sizeof cos_phi);
    if (!p->phi_frozen) apnc_relation(angle, sin_phi, cos_phi);
    apnc_couple(gain, t->sin_o1, t->cos_o1, sin_phi, cos_phi, out->g1);
    apnc_couple(gain, t->sin_o2, t->cos_o2, sin_phi, cos_phi, out->g2);
}

static void learn(const apnc_parameters *restrict p, apnc_circuits *restrict c,
                  const apnc_real *restrict F) {
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        const apnc_real e = apnc_error(F[leg], c->grf_expected[leg]);
        c->K_f[leg] = apnc_learn(p->A_f, c->K_f[leg], p->B_f, e);
        c->K_s[leg] = apnc_learn(p->A_s, c->K_s[leg], p->B_s, e);
    }
}

/* theta: the commands that are copied [rad]. */
static void expect(const apnc_parameters *restrict p, apnc_circuits *restrict c,
                   const apnc_real *restrict theta) {
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        const apnc_real G = apnc_stance_expected(theta[leg], c->theta_before[leg]);
        c->grf_expected[leg] = apnc_expect(p, c->grf_expected[leg], G);
        c->theta_before[leg] = theta[leg];
    }
}

static void expect_learned(const apnc_parameters *restrict p, apnc_circuits *restrict c,
                           const apnc_real *restrict F) {
    for (int leg = 0; leg < APNC_LEGS; leg++)
        c->grf_expected[leg] =
            apnc_expect_learned(p, c->o1[leg], c->o2[leg], F[leg], c->learned[leg]);
}

static void restart_at_touch_down(const apnc_parameters *p, const apnc_circuits *c,
                                  const apnc_real *F, apnc_real *a1, apnc_real *a2) {
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        if (!apnc_touched_down(p, F[leg], c->F_before[leg])) continue;
        a1[leg] = APNC_A1_AT_TOUCH_DOWN;
        a2[leg] = APNC_A2_AT_TOUCH_DOWN;
    }
}

/* State at n + 1. F: loads over half the weight at n. One loop per block, so that the compiler
 * takes several legs at once. */
static void advance(const apnc_parameters *restrict p, apnc_state *restrict state,
                    const apnc_real *restrict F, const apnc_outputs *restrict out) {
    apnc_circuits *c = &state->circuits;
    apnc_real a1[APNC_LEGS], a2[APNC_LEGS];
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        apnc_activation(p, state->MI, c->o1[leg], c->o2[leg], &a1[leg], &a2[leg]);
        a1[leg] = a1[leg] - out->f1[leg] + out->g1[leg];
        a2[leg] = a2[leg] - out->f2[leg] + out->g2[leg];
    }
    if (p->method == APNC_METHOD_PHASE_RESET) restart_at_touch_down(p, c, F, a1, a2);
    if (p->method == APNC_METHOD_APNC || p->method == APNC_METHOD_APC) learn(p, c, F);
    if (p->forward_model != APNC_FORWARD_MODEL_RADIAL_BASIS)
        expect(p, c,
               p->forward_model == APNC_FORWARD_MODEL_LOW_PASS_KNEE ? out->theta_knee
                                                                    : out->theta_hip);
    memcpy(c->F_before, F, sizeof c->F_before);
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        c->o1[leg] = apnc_output(a1[leg]);
        c->o2[leg] = apnc_output(a2[leg]);
    }
}

static void apnc_tick(const apnc_parameters *p, apnc_state *state, const apnc_inputs *in,
               apnc_outputs *out) {
    apnc_real F[APNC_LEGS], angle[APNC_RELATIONS];
    trigonometry t;
    int32_t fault[APNC_LEGS];
    const apnc_circuits *c = &state->circuits;

    state->MI = limited(in->MI, APNC_MI_MIN, APNC_MI_MAX, state->MI);
    state->turn = limited(in->turn, APNC_TURN_MIN, APNC_TURN_MAX, state->turn);
    state->ticks++;
    const apnc_real scale = apnc_load_scale(p->robot_weight);
    const apnc_real most = APNC_MOST_WEIGHTS * p->robot_weight;
    for (int leg = 0; leg < APNC_LEGS; leg++)
        F[leg] = apnc_load(in->grf[leg], scale, p->F_max, most, &fault[leg]);

    if (in->reset || (p->MI_zero_resets && state->MI == 0)) {
        apnc_reset(p, state);
        observe_rest(p, state, out);
    } else {
        if (p->forward_model == APNC_FORWARD_MODEL_RADIAL_BASIS)
            expect_learned(p, &state->circuits, F);
        observe(p, state, out);
        communicate(p, state, angle, out);
        evaluate(c, out->kappa > 0, &t);
        feed_back(p, c, F, &t, out);
        if (out->kappa > 0) couple(p, &state->stored, angle, &t, out);
        advance(p, state, F, out);
    }
    memcpy(out->fault, fault, sizeof fault);
    out->tick = state->ticks < INT32_MAX ? (int32_t)state->ticks : INT32_MAX;
}
/* All variables, for access by value reference.
 *
 * Generated from apnc_core/variables.py by `python -m build_fmu.generate`; do not edit.
 */

#ifdef APNC_NAMING_FLAT
#define LEG(name) "leg", "_" name
#define RELATION(name) name, ""
#else
#define LEG(name) "leg[", "]." name
#define RELATION(name) name "[", "]"
#endif
#define AT(group, field) offsetof(apnc_data, group.field)

static const apnc_variable apnc_variables[APNC_VARIABLES] = {
    {"grf", LEG("grf"), AT(inputs, grf), APNC_LEGS, APNC_REAL, APNC_INPUT, 0.0, 1.0, -1.0},
    {"MI", "MI", "", AT(inputs, MI), 1, APNC_REAL, APNC_INPUT, 0.08, 0.0, 1.0},
    {"turn", "turn", "", AT(inputs, turn), 1, APNC_REAL, APNC_INPUT, 0.0, -1.0, 1.0},
    {"reset", "reset", "", AT(inputs, reset), 1, APNC_BOOLEAN, APNC_INPUT, 0.0, 0.0, 1.0},
    {"Ts", "Ts", "", AT(parameters, Ts), 1, APNC_REAL, APNC_FIXED, 0.016666666666666666, 0.0001, 1.0},
    {"robot_weight", "robot_weight", "", AT(parameters, robot_weight), 1, APNC_REAL, APNC_TUNABLE, 24.525, 0.001, 1000000.0},
    {"F_max", "F_max", "", AT(parameters, F_max), 1, APNC_REAL, APNC_TUNABLE, 1.0, 0.0, 2000.0},
    {"method", "method", "", AT(parameters, method), 1, APNC_ENUMERATION, APNC_TUNABLE, 1.0, 1.0, 4.0},
    {"w11", "w11", "", AT(parameters, w11), 1, APNC_REAL, APNC_TUNABLE, 1.4, 0.0, 5.0},
    {"w12_0", "w12_0", "", AT(parameters, w12_0), 1, APNC_REAL, APNC_TUNABLE, 0.21, 0.0, 2.0},
    {"bias", "bias", "", AT(parameters, bias), 1, APNC_REAL, APNC_TUNABLE, 0.0, -1.0, 1.0},
    {"o1_start", "o1_start", "", AT(parameters, o1_start), 1, APNC_REAL, APNC_FIXED, 0.01, -1.0, 1.0},
    {"o2_start", "o2_start", "", AT(parameters, o2_start), 1, APNC_REAL, APNC_FIXED, 0.01, -1.0, 1.0},
    {"a1", "a1", "", AT(parameters, a1), 1, APNC_REAL, APNC_TUNABLE, 0.14, 0.0, 1.6},
    {"a2", "a2", "", AT(parameters, a2), 1, APNC_REAL, APNC_TUNABLE, 0.15, 0.0, 1.6},
    {"b1", "b1", "", AT(parameters, b1), 1, APNC_REAL, APNC_TUNABLE, -0.2, -1.6, 1.6},
    {"b2", "b2", "", AT(parameters, b2), 1, APNC_REAL, APNC_TUNABLE, -0.2, -1.6, 1.6},
    {"turn_gain", "turn_gain", "", AT(parameters, turn_gain), 1, APNC_REAL, APNC_TUNABLE, 1.0, 0.0, 1.0},
    {"A_f", "A_f", "", AT(parameters, A_f), 1, APNC_REAL, APNC_TUNABLE, 0.57, 0.0, 1.0},
    {"B_f", "B_f", "", AT(parameters, B_f), 1, APNC_REAL, APNC_TUNABLE, 0.17, 0.0, 1.0},
    {"A_s", "A_s", "", AT(parameters, A_s), 1, APNC_REAL, APNC_TUNABLE, 0.99, 0.0, 1.0},
    {"B_s", "B_s", "", AT(parameters, B_s), 1, APNC_REAL, APNC_TUNABLE, 0.0002, 0.0, 1.0},
    {"alpha", "alpha", "", AT(parameters, alpha), 1, APNC_REAL, APNC_TUNABLE, 0.9, 0.0, 1.0},
    {"rho", "rho", "", AT(parameters, rho), 1, APNC_REAL, APNC_TUNABLE, 0.99, 0.0, 1.0},
    {"phase_measure", "phase_measure", "", AT(parameters, phase_measure), 1, APNC_ENUMERATION, APNC_FIXED, 1.0, 1.0, 2.0},
    {"phase_filter", "phase_filter", "", AT(parameters, phase_filter), 1, APNC_REAL, APNC_TUNABLE, 0.05, 0.0001, 1.0},
    {"N", "N", "", AT(parameters, N), 1, APNC_INTEGER, APNC_FIXED, 50.0, 1.0, 256.0},
    {"sigma", "sigma", "", AT(parameters, sigma), 1, APNC_REAL, APNC_TUNABLE, 0.4, 0.0, 10.0},
    {"kappa_rule", "kappa_rule", "", AT(parameters, kappa_rule), 1, APNC_ENUMERATION, APNC_TUNABLE, 1.0, 1.0, 2.0},
    {"kappa_hold", "kappa_hold", "", AT(parameters, kappa_hold), 1, APNC_INTEGER, APNC_TUNABLE, 200.0, 1.0, 1000000.0},
    {"xi", "xi", "", AT(parameters, xi), 1, APNC_REAL, APNC_TUNABLE, 0.01, 0.0, 1.0},
    {"feedback_kept", "feedback_kept", "", AT(parameters, feedback_kept), 1, APNC_REAL, APNC_TUNABLE, 0.1, 0.0, 1.0},
    {"coupling_sign", "coupling_sign", "", AT(parameters, coupling_sign), 1, APNC_ENUMERATION, APNC_TUNABLE, 1.0, 1.0, 2.0},
    {"phi_frozen", "phi_frozen", "", AT(parameters, phi_frozen), 1, APNC_BOOLEAN, APNC_TUNABLE, 1.0, 0.0, 1.0},
    {"MI_zero_resets", "MI_zero_resets", "", AT(parameters, MI_zero_resets), 1, APNC_BOOLEAN, APNC_TUNABLE, 1.0, 0.0, 1.0},
    {"stored", "stored", "", AT(parameters, stored), 1, APNC_BOOLEAN, APNC_FIXED, 0.0, 0.0, 1.0},
    {"phi_stored", RELATION("phi_stored"), AT(parameters, phi_stored), APNC_RELATIONS, APNC_REAL, APNC_FIXED, 0.0, -7.0, 7.0},
    {"gamma_tegotae", "gamma_tegotae", "", AT(parameters, gamma_tegotae), 1, APNC_REAL, APNC_TUNABLE, 0.015, 0.0, 10.0},
    {"grf_reset", "grf_reset", "", AT(parameters, grf_reset), 1, APNC_REAL, APNC_TUNABLE, 0.4, 0.0, 10.0},
    {"theta_hip", LEG("theta_hip"), AT(outputs, theta_hip), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"theta_knee", LEG("theta_knee"), AT(outputs, theta_knee), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"o1", LEG("o1"), AT(outputs, o1), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, -1.0, 1.0},
    {"o2", LEG("o2"), AT(outputs, o2), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, -1.0, 1.0},
    {"gamma", LEG("gamma"), AT(outputs, gamma), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"grf_expected", LEG("grf_expected"), AT(outputs, grf_expected), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"f1", LEG("f1"), AT(outputs, f1), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"f2", LEG("f2"), AT(outputs, f2), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"g1", LEG("g1"), AT(outputs, g1), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"g2", LEG("g2"), AT(outputs, g2), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"fault", LEG("fault"), AT(outputs, fault), APNC_LEGS, APNC_BOOLEAN, APNC_OUTPUT, 0.0, 0.0, 1.0},
    {"phi", RELATION("phi"), AT(outputs, phi), APNC_RELATIONS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"phi_memory", RELATION("phi_memory"), AT(outputs, phi_memory), APNC_RELATIONS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"d", "d", "", AT(outputs, d), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"kappa", "kappa", "", AT(outputs, kappa), 1, APNC_REAL, APNC_OUTPUT, 0.0, 0.0, 1.0},
    {"tick", "tick", "", AT(outputs, tick), 1, APNC_INTEGER, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"K_f", LEG("K_f"), AT(outputs, K_f), APNC_LEGS, APNC_REAL, APNC_LOCAL, 0.0, 1.0, -1.0},
    {"K_s", LEG("K_s"), AT(outputs, K_s), APNC_LEGS, APNC_REAL, APNC_LOCAL, 0.0, 1.0, -1.0},
    {"forward_model", "forward_model", "", AT(parameters, forward_model), 1, APNC_ENUMERATION, APNC_FIXED, 1.0, 1.0, 3.0},
    {"rbf_rate", "rbf_rate", "", AT(parameters, rbf_rate), 1, APNC_REAL, APNC_TUNABLE, 0.02, 0.0, 1.0},
};

#endif

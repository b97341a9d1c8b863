/* The C core of the controller in one file.
 *
 * Generated from fmu_src/core by `python -m build_fmu.generate`; do not edit.
 */
#ifndef APNC_CORE_H
#define APNC_CORE_H

/* The controller: one tick of all blocks, in the order of the paper. */
#include <float.h>
#include <math.h>
#include <string.h>

/* Angles brought into a range. */
#ifndef APNC_ANGLE_H
#define APNC_ANGLE_H

#include <math.h>

#define APNC_PI 3.14159265358979323846

/* angle [rad], however far off, brought into [low, low + 2 pi). */
static inline double apnc_wrap_far(double angle, double low) {
    return angle - 2.0 * APNC_PI * floor((angle - low) / (2.0 * APNC_PI));
}

/* angle [rad] from [low - 2 pi, low + 4 pi) brought into [low, low + 2 pi). */
static inline double apnc_wrap(double angle, double low) {
    if (angle < low) return angle + 2.0 * APNC_PI;
    return angle < low + 2.0 * APNC_PI ? angle : angle - 2.0 * APNC_PI;
}

/* Angle of the vector (x, y) [rad], 0 for the zero vector. atan2 takes twice as long for signed
 * zeros and infinities, which do not occur here. */
static inline double apnc_angle(double y, double x) {
    if (x > 0.0) return atan(y / x);
    if (x < 0.0) return atan(y / x) + (y < 0.0 ? -APNC_PI : APNC_PI);
    return y > 0.0 ? 0.5 * APNC_PI : y < 0.0 ? -0.5 * APNC_PI : 0.0;
}

#endif
/* Adaptive neural controller of a legged robot (Sun, Dai & Manoonpong 2023), pure core.
 *
 * No allocation, no globals, no FMI types: call apnc_init once, then apnc_tick every Ts seconds.
 * Legs are ordered right side first (quadruped: RF, RH, LF, LH).
 */
#ifndef APNC_H
#define APNC_H

/* Variables of the controller: structs, one field per row of the table.
 *
 * Generated from apnc_core/variables.py by `python -m build_fmu.generate`; do not edit.
 */
#ifndef APNC_VARIABLES_H
#define APNC_VARIABLES_H

#include <stddef.h>
#include <stdint.h>

/* Build-time choices. The build writes its own version of this file beside the sources. */
#ifndef APNC_CONFIG_H
#define APNC_CONFIG_H

#ifndef APNC_LEGS
#define APNC_LEGS 4 /* number of legs, the right ones first */
#endif

#endif

#if APNC_LEGS < 2 || APNC_LEGS > 64
#error "APNC_LEGS must be 2 to 64"
#endif

#define APNC_RELATIONS (APNC_LEGS - 1) /* phase relations phi_1k, k = 2 ... APNC_LEGS */
#define APNC_WINDOW_MAX 256 /* largest N of Eq. 14 */
#define APNC_VR_STRIDE 100u /* value reference = stride * row + element */
#define APNC_VR_TIME 9900u /* of the independent variable in FMI 3.0 */
#define APNC_ROWS 57

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
    APNC_PHASE_MEASURE_VECTOR = 1, /* low-passed angle between the vectors (o1, o2) of two legs */
    APNC_PHASE_MEASURE_PEAK = 2, /* times of the peaks of o1, Eq. 12 */
} apnc_phase_measure;

typedef enum {
    APNC_KAPPA_RULE_ARMED = 1, /* armed once d has exceeded sigma, on after kappa_hold ticks at or below it, then kept */
    APNC_KAPPA_RULE_PRINTED = 2, /* Eq. 16 as printed: on whenever d is at or below sigma */
} apnc_kappa_rule;

typedef enum {
    APNC_COUPLING_SIGN_REVERSED = 1, /* g subtracted: recovers the stored gait */
    APNC_COUPLING_SIGN_PRINTED = 2, /* g added, as printed in Eq. 18 */
} apnc_coupling_sign;

/* Parameters. */
typedef struct {
    double Ts; /* [s] time between two ticks of the controller */
    double robot_weight; /* [N] Eq. 5: weight of the robot; half of it normalises the load */
    double F_max; /* [1] Eq. 5: largest load over half the weight that the circuits see; a higher one, as in an impact or under a payload, counts as this */
    int32_t method; /* which controller runs */
    double w11; /* [1] Eq. 3: self-weight of both neurons, w11 = w22 */
    double w12_0; /* [1] Eq. 3: cross-weight at MI = 0: w12 = w12_0 + MI, w21 = -w12 */
    double bias; /* [1] Eq. 1: bias added to both activations; the paper has none */
    double o1_start; /* [1] Eq. 2: start output of neuron N1, the same for every leg */
    double o2_start; /* [1] Eq. 2: start output of neuron N2, the same for every leg */
    double a1; /* [rad] Eq. 4: slope of the motor neuron of the hip */
    double a2; /* [rad] Eq. 4: slope of the motor neuron of the knee */
    double b1; /* [rad] Eq. 4: offset of the motor neuron of the hip */
    double b2; /* [rad] Eq. 4: offset of the motor neuron of the knee */
    double turn_gain; /* [1] Eq. 4: relative change of the amplitudes at full steering */
    double A_f; /* [1] Eq. 7: retention of the fast learner */
    double B_f; /* [1] Eq. 7: learning rate of the fast learner */
    double A_s; /* [1] Eq. 8: retention of the slow learner */
    double B_s; /* [1] Eq. 8: learning rate of the slow learner */
    double alpha; /* [1] Eq. 10: scale of the expected load */
    double rho; /* [1] Eq. 10: shape of the expected load */
    int32_t phase_measure; /* Eq. 12: how the relative phases are measured; the paper prints peak */
    double phase_filter; /* [1] Eq. 12: new part per tick in the low-pass of the vector phase measure */
    int32_t N; /* Eq. 14: ticks in the mean of the relative phases */
    double sigma; /* [rad] Eq. 16: threshold of d below which the phases count as stable */
    int32_t kappa_rule; /* Eq. 16: when the couplings switch on; the paper prints Eq. 16 */
    int32_t kappa_hold; /* Eq. 16: ticks that d stays at or below sigma before kappa switches on */
    double xi; /* [1] Eq. 17: gain of the neural communication */
    double feedback_kept; /* [1] Eq. 5: share of the sensory feedback that stays while the couplings are on; 1 as in the equations */
    int32_t coupling_sign; /* Eq. 18: sign of the coupling term; the paper prints plus */
    int32_t phi_frozen; /* Eq. 17: true: the couplings hold the phases measured when kappa switched on; false: the phases measured now, as Eq. 17 reads */
    int32_t MI_zero_resets; /* Eq. 3: true: MI = 0 acts as reset; false: the oscillators run on at w12 = w12_0, as Eq. 3 reads */
    int32_t stored; /* Eq. 17: true: start with the relations phi_stored learned and the couplings on */
    double phi_stored[APNC_RELATIONS]; /* [rad] Eq. 17: phase relation phi_1k that a start with stored = true holds */
    double gamma_tegotae; /* [1] Eq. 5: fixed feedback gain of the Tegotae baseline */
    double grf_reset; /* [1] load, over a quarter of the weight, that resets the phase when crossed upwards (phase-resetting baseline) */
} apnc_parameters;

/* Inputs of one tick. */
typedef struct {
    double grf[APNC_LEGS]; /* [N] Eq. 5: load on the foot; not finite, negative or above 1000 weights counts as zero and raises fault */
    double MI; /* [1] Eq. 3: modulatory input: sets the stepping frequency; limited to its range */
    double turn; /* [1] Eq. 4: steering, positive turns left: scales the amplitudes of the right legs up and of the left legs down; limited to its range */
    int32_t reset; /* while true, oscillators, learners and forward models are held at their start state; the stored phase relations are kept */
} apnc_inputs;

/* Outputs and local variables of one tick. */
typedef struct {
    double theta_hip[APNC_LEGS]; /* [rad] Eq. 4: command of the hip joint, relative to the reference pose */
    double theta_knee[APNC_LEGS]; /* [rad] Eq. 4: command of the knee joint, relative to the reference pose */
    double o1[APNC_LEGS]; /* [1] Eq. 2: output of neuron N1 */
    double o2[APNC_LEGS]; /* [1] Eq. 2: output of neuron N2 */
    double gamma[APNC_LEGS]; /* [1] Eq. 9: gain of the sensory feedback */
    double grf_expected[APNC_LEGS]; /* [1] Eq. 10: expected load over half the weight */
    double f1[APNC_LEGS]; /* [1] Eq. 5: sensory feedback to neuron N1 */
    double f2[APNC_LEGS]; /* [1] Eq. 5: sensory feedback to neuron N2 */
    double g1[APNC_LEGS]; /* [1] Eq. 17: neural coupling to neuron N1, as added to its activation */
    double g2[APNC_LEGS]; /* [1] Eq. 17: neural coupling to neuron N2, as added to its activation */
    int32_t fault[APNC_LEGS]; /* true while the load input of the leg is unusable */
    double phi[APNC_RELATIONS]; /* [rad] Eq. 12: relative phase phi_1k of legs 1 and k = index + 1, in [-pi/2, 3 pi/2) */
    double phi_memory[APNC_RELATIONS]; /* [rad] Eq. 17: phase relation phi_1k stored in the couplings; zero while there is none */
    double d; /* [rad] Eq. 15: distance of the relative phases from their mean */
    double kappa; /* [1] Eq. 16: 1 while the neural couplings are on, else 0 */
    int32_t tick; /* Eq. 1: number of ticks run since the start */
    double K_f[APNC_LEGS]; /* [1] Eq. 7: state of the fast learner */
    double K_s[APNC_LEGS]; /* [1] Eq. 8: state of the slow learner */
} apnc_outputs;

/* Everything an importer can see, in one block. */
typedef struct {
    apnc_parameters parameters;
    apnc_inputs inputs;
    apnc_outputs outputs;
} apnc_data;

typedef enum { APNC_REAL, APNC_INTEGER, APNC_BOOLEAN, APNC_ENUMERATION } apnc_type;

typedef enum { APNC_INPUT, APNC_OUTPUT, APNC_LOCAL, APNC_FIXED, APNC_TUNABLE } apnc_role;

/* How to reach, name and check one row. */
typedef struct {
    const char *name;
    const char *before; /* scalar name = before + index + after; before alone if count is 1 */
    const char *after;
    size_t offset; /* of the first entry in apnc_data [bytes] */
    int count;
    apnc_type type;
    apnc_role role;
    double start;
    double min; /* inclusive; min > max: no range */
    double max;
} apnc_row;

static const apnc_row apnc_rows[APNC_ROWS];

#endif

/* Oscillators, learners and forward models of all legs. */
typedef struct {
    double o1[APNC_LEGS];               /* [1] neuron outputs at n, Eq. 2 */
    double o2[APNC_LEGS];               /* [1] */
    double K_f[APNC_LEGS];              /* [1] fast learner, Eq. 7 */
    double K_s[APNC_LEGS];              /* [1] slow learner, Eq. 8 */
    double grf_expected[APNC_LEGS];     /* [1] expected load over half the weight, Eq. 10 */
    double theta_hip_before[APNC_LEGS]; /* [rad] hip command at n - 1 */
    double F_before[APNC_LEGS];         /* [1] load over half the weight at n - 1 */
} apnc_circuits;

/* Acquisition of the phase relations, Eq. 12. */
typedef struct {
    double re[APNC_RELATIONS]; /* [1] low-passed product of the vectors (o1, o2) of legs 1 and k */
    double im[APNC_RELATIONS]; /* [1] */
    double o1_before[APNC_LEGS];  /* [1] o1 at n - 1 */
    double o1_before2[APNC_LEGS]; /* [1] o1 at n - 2 */
    double t_peak[APNC_LEGS];     /* [ticks] last peak of o1, negative: none yet */
    double period;                /* [ticks] between the last two peaks of leg 1, 0: unknown */
    double now;                   /* [ticks] since the circuits started */
} apnc_acquisition;

/* Estimation of the phase relations, Eq. 13-16. */
typedef struct {
    double angle_before[APNC_RELATIONS];            /* [rad] angles at n - 1 */
    double unwrapped[APNC_RELATIONS];               /* [rad] relative phases at n */
    double window[APNC_WINDOW_MAX][APNC_RELATIONS]; /* [rad] relative phases at n - 1 ... n - N */
    double sum[APNC_RELATIONS];                     /* [rad] over the window */
    int32_t oldest;                                 /* row of the window to be replaced next */
    int32_t armed;                                  /* d has exceeded sigma */
    int32_t calm;                                   /* [ticks] with d at or below sigma since */
} apnc_estimation;

/* What the neural couplings hold. */
typedef struct {
    double phi[APNC_RELATIONS]; /* [rad] stored relations phi_1k */
    double sin_phi[APNC_LEGS];  /* [1] of phi_11 = 0, phi_12, phi_13, ... */
    double cos_phi[APNC_LEGS];  /* [1] */
    int32_t on;                 /* there are stored relations and kappa is 1 */
    int32_t unused;
} apnc_memory;

typedef struct {
    apnc_circuits circuits;
    apnc_acquisition acquisition;
    apnc_estimation estimation;
    apnc_memory memory;
    double MI;     /* [1] last usable value of the input */
    double turn;   /* [1] last usable value of the input */
    int64_t ticks; /* run since the start */
} apnc_state;

/* Parameters and inputs at their start values. */
static void apnc_defaults(apnc_data *data);

/* Fresh controller: circuits at their start state, memory as the parameters say; fills out. */
static void apnc_init(const apnc_parameters *p, apnc_state *state, apnc_outputs *out);

/* Circuits back to their start state; the memory stays. */
static void apnc_reset(const apnc_parameters *p, apnc_state *state);

/* Tick n: outputs at n from the state and the inputs at n, then the state at n + 1. */
static void apnc_tick(const apnc_parameters *p, apnc_state *state, const apnc_inputs *in,
               apnc_outputs *out);

#endif
/* Dual-rate learner: tunes the gain of the sensory feedback (Eq. 6-9). */
#ifndef APNC_DUAL_RATE_LEARNER_H
#define APNC_DUAL_RATE_LEARNER_H

/* Gains below this count as zero; denormal numbers would slow the unloaded controller down. */
#define APNC_FORGOTTEN 1e-200

/* Positive part of actual minus expected load (Eq. 6). */
static inline double apnc_error(double F, double grf_expected) {
    const double e = F - grf_expected;
    return e > 0.0 ? e : 0.0;
}

/* K(n+1) = A K(n) + B e(n) (Eq. 7, 8). */
static inline double apnc_learn(double A, double K, double B, double e) {
    const double next = A * K + B * e;
    return next < APNC_FORGOTTEN ? 0.0 : next;
}

/* gamma = K_f + K_s (Eq. 9). */
static inline double apnc_gain(double K_f, double K_s) { return K_f + K_s; }

#endif
/* Forward model: the load that the leg's own motion lets it expect (Eq. 10-11). */
#ifndef APNC_FORWARD_MODEL_H
#define APNC_FORWARD_MODEL_H

/* G(n): 1 while the hip command does not rise, else 0 (Eq. 11). */
static inline double apnc_stance_expected(double theta_hip, double theta_hip_before) {
    return theta_hip <= theta_hip_before ? 1.0 : 0.0;
}

/* F^e(n+1) = alpha (rho G(n) + (1 - rho) F^e(n)) (Eq. 10). */
static inline double apnc_expect(const apnc_parameters *p, double grf_expected, double G) {
    return p->alpha * (p->rho * G + (1.0 - p->rho) * grf_expected);
}

#endif
/* Foot load as the circuits see it (text below Eq. 5). */
#ifndef APNC_LOAD_H
#define APNC_LOAD_H

/* A load above so many times the weight is no load: a sensor shows it when its wire breaks. */
#define APNC_MOST_WEIGHTS 1000.0

/* Factor from a load [N] to F, the load over half the weight. */
static inline double apnc_load_scale(double robot_weight) { return 2.0 / robot_weight; }

/* F of a load [N], at most F_max; zero and a fault if it is not finite, negative or beyond
 * most [N]. */
static inline double apnc_load(double grf, double scale, double F_max, double most,
                               int32_t *fault) {
    *fault = !(grf >= 0.0 && grf <= most);
    const double F = *fault ? 0.0 : grf * scale;
    return F < F_max ? F : F_max;
}

#endif
/* Motor neurons: from oscillator outputs to joint commands (Eq. 4). */
#ifndef APNC_MOTOR_NEURONS_H
#define APNC_MOTOR_NEURONS_H

/* Factor on the slopes of a leg: up on the right, down on the left when turning left. */
static inline double apnc_amplitude_scale(const apnc_parameters *p, double turn, int leg) {
    const double change = p->turn_gain * turn;
    return leg < APNC_LEGS / 2 ? 1.0 + change : 1.0 - change;
}

/* Joint command theta_i = a_i o_i + b_i [rad]. */
static inline double apnc_command(double scale, double a, double o, double b) {
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

#include <math.h>

/* Sines and cosines of the phases phi_11 = 0, phi_12, phi_13, ... [rad] of all legs. */
static inline void apnc_relation(const double *phi, double *sin_phi, double *cos_phi) {
    sin_phi[0] = 0.0;
    cos_phi[0] = 1.0;
    for (int leg = 1; leg < APNC_LEGS; leg++) {
        sin_phi[leg] = sin(phi[leg - 1]);
        cos_phi[leg] = cos(phi[leg - 1]);
    }
}

/* g of one neuron of every leg times gain, from the sines and cosines of its outputs o. */
static inline void apnc_couple(double gain, const double *sin_o, const double *cos_o,
                               const double *sin_phi, const double *cos_phi, double *g) {
    double sin_x[APNC_LEGS], cos_x[APNC_LEGS];
    double sum_sin = 0.0, sum_cos = 0.0;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        sin_x[leg] = sin_o[leg] * cos_phi[leg] + cos_o[leg] * sin_phi[leg];
        cos_x[leg] = cos_o[leg] * cos_phi[leg] - sin_o[leg] * sin_phi[leg];
        sum_sin += sin_x[leg];
        sum_cos += cos_x[leg];
    }
    for (int leg = 0; leg < APNC_LEGS; leg++)
        g[leg] = gain * (sin_x[leg] * sum_cos - cos_x[leg] * sum_sin);
}

#endif
/* SO(2) oscillator: the central pattern generator of one leg (Eq. 1-3). */
#ifndef APNC_OSCILLATOR_H
#define APNC_OSCILLATOR_H

#include <math.h>

/* Recurrent part of the activations a1(n+1), a2(n+1). */
static inline void apnc_activation(const apnc_parameters *p, double MI, double o1, double o2,
                                   double *a1, double *a2) {
    const double w12 = p->w12_0 + MI;
    *a1 = p->w11 * o1 + w12 * o2 + p->bias;
    *a2 = p->w11 * o2 - w12 * o1 + p->bias;
}

/* Neuron output (Eq. 2). */
static inline double apnc_output(double a) { return tanh(a); }

#endif
/* Acquisition of the phase relations phi_12, phi_13, ... (Eq. 12).
 *
 * phi_lk is positive when leg k leads leg l.
 */
#ifndef APNC_PHASE_ACQUISITION_H
#define APNC_PHASE_ACQUISITION_H

#include <math.h>
#include <string.h>


static inline void apnc_acquisition_start(apnc_acquisition *s) {
    memset(s, 0, sizeof *s);
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        s->o1_before[leg] = s->o1_before2[leg] = HUGE_VAL;
        s->t_peak[leg] = -1.0;
    }
}

/* Low-passed angle between the vectors (o1, o2) of leg 1 and of leg k. */
static inline void apnc_acquire_vector(apnc_acquisition *s, double phase_filter, const double *o1,
                                       const double *o2, double *angle) {
    for (int r = 0; r < APNC_RELATIONS; r++) {
        const double re = o1[0] * o1[r + 1] + o2[0] * o2[r + 1];
        const double im = o2[0] * o1[r + 1] - o1[0] * o2[r + 1];
        s->re[r] += phase_filter * (re - s->re[r]);
        s->im[r] += phase_filter * (im - s->im[r]);
        angle[r] = apnc_angle(s->im[r], s->re[r]);
    }
}

/* Times between the peaks of o1 over the period of leg 1 (Eq. 12). */
static inline void apnc_acquire_peak(apnc_acquisition *s, const double *o1, double *angle) {
    const double t = s->now - 1.0;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        if (s->o1_before2[leg] < s->o1_before[leg] && s->o1_before[leg] >= o1[leg]) {
            if (leg == 0 && s->t_peak[0] >= 0.0) s->period = t - s->t_peak[0];
            s->t_peak[leg] = t;
        }
        s->o1_before2[leg] = s->o1_before[leg];
        s->o1_before[leg] = o1[leg];
    }
    s->now += 1.0;
    for (int r = 0; r < APNC_RELATIONS; r++) {
        const int known = s->period > 0.0 && s->t_peak[r + 1] >= 0.0;
        const double lag = known ? (s->t_peak[0] - s->t_peak[r + 1]) / s->period : 0.0;
        angle[r] = apnc_wrap_far(2.0 * APNC_PI * lag, -APNC_PI);
    }
}

#endif
/* Estimation of the phase relations: are they settled? (Eq. 13-16). */
#ifndef APNC_PHASE_ESTIMATION_H
#define APNC_PHASE_ESTIMATION_H

#include <math.h>
#include <string.h>


static inline void apnc_estimation_start(apnc_estimation *s) { memset(s, 0, sizeof *s); }

/* d(n) = |Phi(n) - mean(Phi(n-1) ... Phi(n-N))| (Eq. 13-15). */
static inline double apnc_distance(apnc_estimation *s, int N, const double *angle) {
    const double share = 1.0 / N;
    double squares = 0.0;
    double *row = s->window[s->oldest];
    for (int r = 0; r < APNC_RELATIONS; r++) {
        s->unwrapped[r] += apnc_wrap(angle[r] - s->angle_before[r], -APNC_PI);
        s->angle_before[r] = angle[r];
        const double deviation = s->unwrapped[r] - s->sum[r] * share;
        squares += deviation * deviation;
        s->sum[r] += s->unwrapped[r] - row[r];
        row[r] = s->unwrapped[r];
    }
    s->oldest = s->oldest + 1 < N ? s->oldest + 1 : 0;
    if (s->oldest == 0) { /* summed anew once per round, so that rounding does not pile up */
        for (int r = 0; r < APNC_RELATIONS; r++) s->sum[r] = 0.0;
        for (int i = 0; i < N; i++)
            for (int r = 0; r < APNC_RELATIONS; r++) s->sum[r] += s->window[i][r];
    }
    return sqrt(squares);
}

/* Whether kappa may switch on at this tick (Eq. 16, or armed first and held). */
static inline int apnc_settled(apnc_estimation *s, const apnc_parameters *p, double d) {
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

#define APNC_A1_AT_TOUCH_DOWN 1.0
#define APNC_A2_AT_TOUCH_DOWN 0.0

/* Whether the load has just risen through grf_reset quarters of the weight. */
static inline int apnc_touched_down(const apnc_parameters *p, double F, double F_before) {
    const double threshold = 0.5 * p->grf_reset;
    return F_before < threshold && threshold <= F;
}

#endif
/* Sensory feedback: how the foot load acts on the oscillator (Eq. 5). */
#ifndef APNC_SENSORY_FEEDBACK_H
#define APNC_SENSORY_FEEDBACK_H

/* f1 = gamma F cos(o1), f2 = gamma F sin(o2), from the cosine and sine at hand. */
static inline void apnc_feedback(double gamma, double F, double cos_o1, double sin_o2, double *f1,
                                 double *f2) {
    *f1 = gamma * F * cos_o1;
    *f2 = gamma * F * sin_o2;
}

#endif
/* Tegotae baseline: the feedback of Eq. 5 with a gain that does not learn. */
#ifndef APNC_TEGOTAE_H
#define APNC_TEGOTAE_H

static inline double apnc_tegotae_gain(const apnc_parameters *p) { return p->gamma_tegotae; }

#endif

#define PHI_LOW (-0.5 * APNC_PI) /* phi is shown in [-pi/2, 3 pi/2): 0 and pi lie inside */

static void apnc_defaults(apnc_data *data) {
    memset(data, 0, sizeof *data);
    for (int i = 0; i < APNC_ROWS; i++) {
        const apnc_row *row = &apnc_rows[i];
        char *at = (char *)data + row->offset;
        for (int k = 0; k < row->count; k++) {
            if (row->type == APNC_REAL)
                ((double *)at)[k] = row->start;
            else
                ((int32_t *)at)[k] = (int32_t)row->start;
        }
    }
}

static void apnc_reset(const apnc_parameters *p, apnc_state *state) {
    apnc_circuits *c = &state->circuits;
    memset(c, 0, sizeof *c);
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        c->o1[leg] = p->o1_start;
        c->o2[leg] = p->o2_start;
        c->theta_hip_before[leg] = HUGE_VAL;
        c->F_before[leg] = HUGE_VAL; /* a robot that already stands does not touch down */
    }
    apnc_acquisition_start(&state->acquisition);
    apnc_estimation_start(&state->estimation);
}

/* Value within its range; what was held before if it is not a number. */
static double limited(double value, double low, double high, double held) {
    if (!(fabs(value) <= DBL_MAX)) return held;
    return value < low ? low : value > high ? high : value;
}

static void store(apnc_memory *memory, const double *phi) {
    memcpy(memory->phi, phi, sizeof memory->phi);
    apnc_relation(phi, memory->sin_phi, memory->cos_phi);
    memory->on = 1;
}

static int couplings_on(const apnc_parameters *p, const apnc_state *state) {
    return p->method == APNC_METHOD_APNC && state->memory.on;
}

/* Outputs that follow from the circuits' state alone. */
static void observe(const apnc_parameters *p, const apnc_state *state, apnc_outputs *out) {
    const apnc_circuits *c = &state->circuits;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        const double scale = apnc_amplitude_scale(p, state->turn, leg);
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
    memcpy(out->phi_memory, state->memory.phi, sizeof out->phi_memory);
    out->kappa = couplings_on(p, state) ? 1.0 : 0.0;
}

static void apnc_init(const apnc_parameters *p, apnc_state *state, apnc_outputs *out) {
    memset(state, 0, sizeof *state);
    state->MI = APNC_MI_START;
    state->turn = APNC_TURN_START;
    apnc_reset(p, state);
    if (p->stored) store(&state->memory, p->phi_stored);
    observe_rest(p, state, out);
}

static double feedback_gain(const apnc_parameters *p, double K_f, double K_s, double kappa) {
    if (p->method == APNC_METHOD_TEGOTAE) return apnc_tegotae_gain(p);
    if (p->method == APNC_METHOD_PHASE_RESET) return 0.0;
    const double gamma = apnc_gain(K_f, K_s);
    return kappa > 0.0 ? p->feedback_kept * gamma : gamma;
}

/* Phases, their stability and kappa at n; the angles [rad] are returned for live coupling. */
static void communicate(const apnc_parameters *p, apnc_state *state, double *angle,
                        apnc_outputs *out) {
    const apnc_circuits *c = &state->circuits;
    apnc_memory *memory = &state->memory;
    if (p->phase_measure == APNC_PHASE_MEASURE_PEAK)
        apnc_acquire_peak(&state->acquisition, c->o1, angle);
    else
        apnc_acquire_vector(&state->acquisition, p->phase_filter, c->o1, c->o2, angle);
    out->d = apnc_distance(&state->estimation, p->N, angle);
    for (int r = 0; r < APNC_RELATIONS; r++) out->phi[r] = apnc_wrap(angle[r], PHI_LOW);

    const int settled = apnc_settled(&state->estimation, p, out->d);
    if (p->method == APNC_METHOD_APNC) {
        if (settled && !memory->on) store(memory, out->phi);
        if (p->kappa_rule == APNC_KAPPA_RULE_PRINTED) memory->on = settled;
    }
    memcpy(out->phi_memory, memory->phi, sizeof out->phi_memory);
    out->kappa = couplings_on(p, state) ? 1.0 : 0.0;
}

/* Sines and cosines of the neuron outputs: of those that the feedback takes, or of all. */
typedef struct {
    double sin_o1[APNC_LEGS], cos_o1[APNC_LEGS], sin_o2[APNC_LEGS], cos_o2[APNC_LEGS];
} trigonometry;

static void evaluate(const apnc_circuits *c, int coupled, trigonometry *t) {
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        const double o1 = c->o1[leg], o2 = c->o2[leg];
        if (coupled) { /* side by side, so that the compiler takes sine and cosine at once */
            t->sin_o1[leg] = sin(o1);
            t->cos_o1[leg] = cos(o1);
            t->sin_o2[leg] = sin(o2);
            t->cos_o2[leg] = cos(o2);
        } else {
            t->cos_o1[leg] = cos(o1);
            t->sin_o2[leg] = sin(o2);
        }
    }
}

static void feed_back(const apnc_parameters *p, const apnc_circuits *c, const double *F,
                      const trigonometry *t, apnc_outputs *out) {
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        out->gamma[leg] = feedback_gain(p, c->K_f[leg], c->K_s[leg], out->kappa);
        apnc_feedback(out->gamma[leg], F[leg], t->cos_o1[leg], t->sin_o2[leg], &out->f1[leg],
                      &out->f2[leg]);
        out->g1[leg] = out->g2[leg] = 0.0;
    }
}

static void couple(const apnc_parameters *p, const apnc_memory *memory, const double *angle,
                   const trigonometry *t, apnc_outputs *out) {
    const double *sin_phi = memory->sin_phi, *cos_phi = memory->cos_phi;
    const double gain = p->coupling_sign == APNC_COUPLING_SIGN_PRINTED ? p->xi : -p->xi;
    double sin_now[APNC_LEGS], cos_now[APNC_LEGS];
    if (!p->phi_frozen) {
        apnc_relation(angle, sin_now, cos_now);
        sin_phi = sin_now;
        cos_phi = cos_now;
    }
    apnc_couple(gain, t->sin_o1, t->cos_o1, sin_phi, cos_phi, out->g1);
    apnc_couple(gain, t->sin_o2, t->cos_o2, sin_phi, cos_phi, out->g2);
}

/* State at n + 1. F: loads over half the weight at n. */
static void advance(const apnc_parameters *p, apnc_state *state, const double *F,
                    const apnc_outputs *out) {
    apnc_circuits *c = &state->circuits;
    const int learns = p->method == APNC_METHOD_APNC || p->method == APNC_METHOD_APC;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        double a1, a2;
        apnc_activation(p, state->MI, c->o1[leg], c->o2[leg], &a1, &a2);
        a1 = a1 - out->f1[leg] + out->g1[leg];
        a2 = a2 - out->f2[leg] + out->g2[leg];
        if (p->method == APNC_METHOD_PHASE_RESET &&
            apnc_touched_down(p, F[leg], c->F_before[leg])) {
            a1 = APNC_A1_AT_TOUCH_DOWN;
            a2 = APNC_A2_AT_TOUCH_DOWN;
        }
        if (learns) {
            const double e = apnc_error(F[leg], c->grf_expected[leg]);
            c->K_f[leg] = apnc_learn(p->A_f, c->K_f[leg], p->B_f, e);
            c->K_s[leg] = apnc_learn(p->A_s, c->K_s[leg], p->B_s, e);
        }
        const double G = apnc_stance_expected(out->theta_hip[leg], c->theta_hip_before[leg]);
        c->grf_expected[leg] = apnc_expect(p, c->grf_expected[leg], G);
        c->theta_hip_before[leg] = out->theta_hip[leg];
        c->F_before[leg] = F[leg];
        c->o1[leg] = apnc_output(a1);
        c->o2[leg] = apnc_output(a2);
    }
}

static void apnc_tick(const apnc_parameters *p, apnc_state *state, const apnc_inputs *in,
               apnc_outputs *out) {
    double F[APNC_LEGS], angle[APNC_RELATIONS];
    trigonometry t;
    int32_t fault[APNC_LEGS];
    const apnc_circuits *c = &state->circuits;

    state->MI = limited(in->MI, APNC_MI_MIN, APNC_MI_MAX, state->MI);
    state->turn = limited(in->turn, APNC_TURN_MIN, APNC_TURN_MAX, state->turn);
    state->ticks++;
    const double scale = apnc_load_scale(p->robot_weight);
    const double most = APNC_MOST_WEIGHTS * p->robot_weight;
    for (int leg = 0; leg < APNC_LEGS; leg++)
        F[leg] = apnc_load(in->grf[leg], scale, p->F_max, most, &fault[leg]);

    if (in->reset || (p->MI_zero_resets && state->MI == 0.0)) {
        apnc_reset(p, state);
        observe_rest(p, state, out);
    } else {
        observe(p, state, out);
        communicate(p, state, angle, out);
        evaluate(c, out->kappa > 0.0, &t);
        feed_back(p, c, F, &t, out);
        if (out->kappa > 0.0) couple(p, &state->memory, angle, &t, out);
        advance(p, state, F, out);
    }
    memcpy(out->fault, fault, sizeof fault);
    out->tick = state->ticks < INT32_MAX ? (int32_t)state->ticks : INT32_MAX;
}
/* The rows of the table of variables, for access by value reference.
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

static const apnc_row apnc_rows[APNC_ROWS] = {
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
    {"o1_start", "o1_start", "", AT(parameters, o1_start), 1, APNC_REAL, APNC_FIXED, 0.1, -1.0, 1.0},
    {"o2_start", "o2_start", "", AT(parameters, o2_start), 1, APNC_REAL, APNC_FIXED, 0.1, -1.0, 1.0},
    {"a1", "a1", "", AT(parameters, a1), 1, APNC_REAL, APNC_TUNABLE, 0.141, 0.0, 1.6},
    {"a2", "a2", "", AT(parameters, a2), 1, APNC_REAL, APNC_TUNABLE, 0.094, 0.0, 1.6},
    {"b1", "b1", "", AT(parameters, b1), 1, APNC_REAL, APNC_TUNABLE, -0.35, -1.6, 1.6},
    {"b2", "b2", "", AT(parameters, b2), 1, APNC_REAL, APNC_TUNABLE, 0.052, -1.6, 1.6},
    {"turn_gain", "turn_gain", "", AT(parameters, turn_gain), 1, APNC_REAL, APNC_TUNABLE, 0.5, 0.0, 1.0},
    {"A_f", "A_f", "", AT(parameters, A_f), 1, APNC_REAL, APNC_TUNABLE, 0.57, 0.0, 1.0},
    {"B_f", "B_f", "", AT(parameters, B_f), 1, APNC_REAL, APNC_TUNABLE, 0.182, 0.0, 1.0},
    {"A_s", "A_s", "", AT(parameters, A_s), 1, APNC_REAL, APNC_TUNABLE, 0.99, 0.0, 1.0},
    {"B_s", "B_s", "", AT(parameters, B_s), 1, APNC_REAL, APNC_TUNABLE, 0.00045, 0.0, 1.0},
    {"alpha", "alpha", "", AT(parameters, alpha), 1, APNC_REAL, APNC_TUNABLE, 0.9, 0.0, 1.0},
    {"rho", "rho", "", AT(parameters, rho), 1, APNC_REAL, APNC_TUNABLE, 0.99, 0.0, 1.0},
    {"phase_measure", "phase_measure", "", AT(parameters, phase_measure), 1, APNC_ENUMERATION, APNC_FIXED, 1.0, 1.0, 2.0},
    {"phase_filter", "phase_filter", "", AT(parameters, phase_filter), 1, APNC_REAL, APNC_TUNABLE, 0.02, 0.0001, 1.0},
    {"N", "N", "", AT(parameters, N), 1, APNC_INTEGER, APNC_FIXED, 50.0, 1.0, 256.0},
    {"sigma", "sigma", "", AT(parameters, sigma), 1, APNC_REAL, APNC_TUNABLE, 0.4, 0.0, 10.0},
    {"kappa_rule", "kappa_rule", "", AT(parameters, kappa_rule), 1, APNC_ENUMERATION, APNC_TUNABLE, 1.0, 1.0, 2.0},
    {"kappa_hold", "kappa_hold", "", AT(parameters, kappa_hold), 1, APNC_INTEGER, APNC_TUNABLE, 100.0, 1.0, 1000000.0},
    {"xi", "xi", "", AT(parameters, xi), 1, APNC_REAL, APNC_TUNABLE, 0.025, 0.0, 1.0},
    {"feedback_kept", "feedback_kept", "", AT(parameters, feedback_kept), 1, APNC_REAL, APNC_TUNABLE, 0.2, 0.0, 1.0},
    {"coupling_sign", "coupling_sign", "", AT(parameters, coupling_sign), 1, APNC_ENUMERATION, APNC_TUNABLE, 1.0, 1.0, 2.0},
    {"phi_frozen", "phi_frozen", "", AT(parameters, phi_frozen), 1, APNC_BOOLEAN, APNC_TUNABLE, 1.0, 0.0, 1.0},
    {"MI_zero_resets", "MI_zero_resets", "", AT(parameters, MI_zero_resets), 1, APNC_BOOLEAN, APNC_TUNABLE, 1.0, 0.0, 1.0},
    {"stored", "stored", "", AT(parameters, stored), 1, APNC_BOOLEAN, APNC_FIXED, 0.0, 0.0, 1.0},
    {"phi_stored", RELATION("phi_stored"), AT(parameters, phi_stored), APNC_RELATIONS, APNC_REAL, APNC_FIXED, 0.0, -7.0, 7.0},
    {"gamma_tegotae", "gamma_tegotae", "", AT(parameters, gamma_tegotae), 1, APNC_REAL, APNC_TUNABLE, 0.03, 0.0, 10.0},
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
};

#endif

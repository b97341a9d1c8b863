/* Variables of the controller: structs, one field per variable of the table.
 *
 * Generated from apnc_core/variables.py by `python -m build_fmu.generate`; do not edit.
 */
#ifndef APNC_VARIABLES_H
#define APNC_VARIABLES_H

#include "apnc_variable.h"

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
extern const apnc_variable apnc_variables[APNC_VARIABLES];
#ifdef __cplusplus
}
#endif

#endif

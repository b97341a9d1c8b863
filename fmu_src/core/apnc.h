/* Adaptive neural controller of a legged robot (Sun, Dai & Manoonpong 2023), pure core.
 *
 * No allocation, no globals, no FMI types: call apnc_init once, then apnc_tick every Ts seconds.
 * Legs are ordered right side first (quadruped: RF, RH, LF, LH).
 */
#ifndef APNC_H
#define APNC_H

#include "apnc_variables.h"

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
void apnc_defaults(apnc_data *data);

/* Fresh controller: circuits at their start state, the stored gait of the parameters; fills out. */
void apnc_init(const apnc_parameters *p, apnc_state *state, apnc_outputs *out);

/* Circuits back to their start state; the stored gait stays. */
void apnc_reset(const apnc_parameters *p, apnc_state *state);

/* Tick n: outputs at n from the state and the inputs at n, then the state at n + 1. */
void apnc_tick(const apnc_parameters *p, apnc_state *state, const apnc_inputs *in,
               apnc_outputs *out);

#ifdef __cplusplus
}
#endif

#endif

/* The controller: one tick of all blocks, in the order of the paper. */
#include <string.h>

#include "angle.h"
#include "apnc.h"
#include "dual_rate_learner.h"
#include "forward_model.h"
#include "load.h"
#include "motor_neurons.h"
#include "neural_coupling.h"
#include "oscillator.h"
#include "phase_acquisition.h"
#include "phase_estimation.h"
#include "phase_reset.h"
#include "sensory_feedback.h"
#include "tegotae.h"

#define PHI_LOW (-APNC_PI / 2) /* phi is shown in [-pi/2, 3 pi/2): 0 and pi lie inside */

void apnc_defaults(apnc_data *data) {
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

void apnc_reset(const apnc_parameters *p, apnc_state *state) {
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

void apnc_init(const apnc_parameters *p, apnc_state *state, apnc_outputs *out) {
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

void apnc_tick(const apnc_parameters *p, apnc_state *state, const apnc_inputs *in,
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

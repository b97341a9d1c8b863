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
    for (int i = 0; i < APNC_ROWS; i++) {
        const apnc_row *row = &apnc_rows[i];
        char *at = (char *)data + row->offset;
        for (int k = 0; k < row->count; k++) {
            if (row->type == APNC_REAL)
                ((apnc_real *)at)[k] = row->start;
            else
                ((int32_t *)at)[k] = (int32_t)row->start;
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
        c->theta_hip_before[leg] = (apnc_real)INFINITY;
        c->F_before[leg] = (apnc_real)INFINITY; /* a robot that already stands does not touch down */
    }
    apnc_acquisition_start(&state->acquisition);
    apnc_estimation_start(&state->estimation);
}

/* Value within its range; what was held before if it is not a number. */
static apnc_real limited(apnc_real value, apnc_real low, apnc_real high, apnc_real held) {
    if (!isfinite(value)) return held;
    return value < low ? low : value > high ? high : value;
}

static void store(apnc_memory *memory, const apnc_real *phi) {
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
    memcpy(out->phi_memory, state->memory.phi, sizeof out->phi_memory);
    out->kappa = couplings_on(p, state) ? 1 : 0;
}

void apnc_init(const apnc_parameters *p, apnc_state *state, apnc_outputs *out) {
    memset(state, 0, sizeof *state);
    state->MI = APNC_MI_START;
    state->turn = APNC_TURN_START;
    apnc_reset(p, state);
    if (p->stored) store(&state->memory, p->phi_stored);
    observe_rest(p, state, out);
}

static apnc_real feedback_gain(const apnc_parameters *p, apnc_real K_f, apnc_real K_s,
                               apnc_real kappa) {
    if (p->method == APNC_METHOD_TEGOTAE) return apnc_tegotae_gain(p);
    if (p->method == APNC_METHOD_PHASE_RESET) return 0;
    const apnc_real gamma = apnc_gain(K_f, K_s);
    return kappa > 0 ? p->feedback_kept * gamma : gamma;
}

/* Phases, their stability and kappa at n; the angles [rad] are returned for live coupling. */
static void communicate(const apnc_parameters *p, apnc_state *state, apnc_real *angle,
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
    out->kappa = couplings_on(p, state) ? 1 : 0;
}

/* Sines and cosines of the neuron outputs: of those that the feedback takes, or of all. */
typedef struct {
    apnc_real sin_o1[APNC_LEGS], cos_o1[APNC_LEGS], sin_o2[APNC_LEGS], cos_o2[APNC_LEGS];
} trigonometry;

static void evaluate(const apnc_circuits *c, int coupled, trigonometry *t) {
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        const apnc_real o1 = c->o1[leg], o2 = c->o2[leg];
        if (coupled) { /* side by side, so that the compiler takes sine and cosine at once */
            t->sin_o1[leg] = apnc_sin(o1);
            t->cos_o1[leg] = apnc_cos(o1);
            t->sin_o2[leg] = apnc_sin(o2);
            t->cos_o2[leg] = apnc_cos(o2);
        } else {
            t->cos_o1[leg] = apnc_cos(o1);
            t->sin_o2[leg] = apnc_sin(o2);
        }
    }
}

static void feed_back(const apnc_parameters *p, const apnc_circuits *c, const apnc_real *F,
                      const trigonometry *t, apnc_outputs *out) {
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        out->gamma[leg] = feedback_gain(p, c->K_f[leg], c->K_s[leg], out->kappa);
        apnc_feedback(out->gamma[leg], F[leg], t->cos_o1[leg], t->sin_o2[leg], &out->f1[leg],
                      &out->f2[leg]);
        out->g1[leg] = out->g2[leg] = 0;
    }
}

static void couple(const apnc_parameters *p, const apnc_memory *memory, const apnc_real *angle,
                   const trigonometry *t, apnc_outputs *out) {
    const apnc_real *sin_phi = memory->sin_phi, *cos_phi = memory->cos_phi;
    const apnc_real gain = p->coupling_sign == APNC_COUPLING_SIGN_PRINTED ? p->xi : -p->xi;
    apnc_real sin_now[APNC_LEGS], cos_now[APNC_LEGS];
    if (!p->phi_frozen) {
        apnc_relation(angle, sin_now, cos_now);
        sin_phi = sin_now;
        cos_phi = cos_now;
    }
    apnc_couple(gain, t->sin_o1, t->cos_o1, sin_phi, cos_phi, out->g1);
    apnc_couple(gain, t->sin_o2, t->cos_o2, sin_phi, cos_phi, out->g2);
}

/* State at n + 1. F: loads over half the weight at n. */
static void advance(const apnc_parameters *p, apnc_state *state, const apnc_real *F,
                    const apnc_outputs *out) {
    apnc_circuits *c = &state->circuits;
    const int learns = p->method == APNC_METHOD_APNC || p->method == APNC_METHOD_APC;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        apnc_real a1, a2;
        apnc_activation(p, state->MI, c->o1[leg], c->o2[leg], &a1, &a2);
        a1 = a1 - out->f1[leg] + out->g1[leg];
        a2 = a2 - out->f2[leg] + out->g2[leg];
        if (p->method == APNC_METHOD_PHASE_RESET &&
            apnc_touched_down(p, F[leg], c->F_before[leg])) {
            a1 = APNC_A1_AT_TOUCH_DOWN;
            a2 = APNC_A2_AT_TOUCH_DOWN;
        }
        if (learns) {
            const apnc_real e = apnc_error(F[leg], c->grf_expected[leg]);
            c->K_f[leg] = apnc_learn(p->A_f, c->K_f[leg], p->B_f, e);
            c->K_s[leg] = apnc_learn(p->A_s, c->K_s[leg], p->B_s, e);
        }
        const apnc_real G = apnc_stance_expected(out->theta_hip[leg], c->theta_hip_before[leg]);
        c->grf_expected[leg] = apnc_expect(p, c->grf_expected[leg], G);
        c->theta_hip_before[leg] = out->theta_hip[leg];
        c->F_before[leg] = F[leg];
        c->o1[leg] = apnc_output(a1);
        c->o2[leg] = apnc_output(a2);
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
        observe(p, state, out);
        communicate(p, state, angle, out);
        evaluate(c, out->kappa > 0, &t);
        feed_back(p, c, F, &t, out);
        if (out->kappa > 0) couple(p, &state->memory, angle, &t, out);
        advance(p, state, F, out);
    }
    memcpy(out->fault, fault, sizeof fault);
    out->tick = state->ticks < INT32_MAX ? (int32_t)state->ticks : INT32_MAX;
}

/* The controller: one tick of all blocks, in the order of the paper. */
#include <math.h>
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

#define PHI_LOW (-0.5 * APNC_PI) /* phi is shown in [-pi/2, 3 pi/2): 0 and pi lie inside */

void apnc_defaults(apnc_data *data) {
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

void apnc_reset(const apnc_parameters *p, apnc_state *state) {
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

void apnc_init(const apnc_parameters *p, apnc_state *state, apnc_outputs *out) {
    memset(state, 0, sizeof *state);
    state->MI = APNC_MI_START;
    state->turn = APNC_TURN_START;
    apnc_reset(p, state);
    state->memory.on = p->stored;
    if (p->stored) memcpy(state->memory.phi, p->phi_stored, sizeof state->memory.phi);
    observe_rest(p, state, out);
}

static double feedback_gain(const apnc_parameters *p, double K_f, double K_s) {
    if (p->method == APNC_METHOD_TEGOTAE) return apnc_tegotae_gain(p);
    if (p->method == APNC_METHOD_PHASE_RESET) return 0.0;
    return apnc_gain(K_f, K_s);
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
        if (settled && !memory->on) {
            memcpy(memory->phi, out->phi, sizeof memory->phi);
            memory->on = 1;
        }
        if (p->kappa_rule == APNC_KAPPA_RULE_PRINTED) memory->on = settled;
    }
    memcpy(out->phi_memory, memory->phi, sizeof out->phi_memory);
    out->kappa = couplings_on(p, state) ? 1.0 : 0.0;
}

static void couple(const apnc_parameters *p, const apnc_state *state, const double *angle,
                   const double *cos_o1, const double *sin_o2, apnc_outputs *out) {
    const apnc_circuits *c = &state->circuits;
    const double *phi = p->phi_frozen ? state->memory.phi : angle;
    const double gain = p->coupling_sign == APNC_COUPLING_SIGN_PRINTED ? p->xi : -p->xi;
    double sin_o1[APNC_LEGS], cos_o2[APNC_LEGS], sin_phi[APNC_LEGS], cos_phi[APNC_LEGS];
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        sin_o1[leg] = sin(c->o1[leg]);
        cos_o2[leg] = cos(c->o2[leg]);
        sin_phi[leg] = leg ? sin(phi[leg - 1]) : 0.0;
        cos_phi[leg] = leg ? cos(phi[leg - 1]) : 1.0;
    }
    apnc_couple(gain, sin_o1, cos_o1, sin_phi, cos_phi, out->g1);
    apnc_couple(gain, sin_o2, cos_o2, sin_phi, cos_phi, out->g2);
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

void apnc_tick(const apnc_parameters *p, apnc_state *state, const apnc_inputs *in,
               apnc_outputs *out) {
    double F[APNC_LEGS], angle[APNC_RELATIONS];
    double cos_o1[APNC_LEGS], sin_o2[APNC_LEGS];
    int32_t fault[APNC_LEGS];
    const apnc_circuits *c = &state->circuits;

    state->MI = limited(in->MI, APNC_MI_MIN, APNC_MI_MAX, state->MI);
    state->turn = limited(in->turn, APNC_TURN_MIN, APNC_TURN_MAX, state->turn);
    state->ticks++;
    for (int leg = 0; leg < APNC_LEGS; leg++)
        F[leg] = apnc_load(in->grf[leg], p->robot_weight, &fault[leg]);

    if (in->reset || (p->MI_zero_resets && state->MI == 0.0)) {
        apnc_reset(p, state);
        observe_rest(p, state, out);
    } else {
        observe(p, state, out);
        for (int leg = 0; leg < APNC_LEGS; leg++) {
            out->gamma[leg] = feedback_gain(p, c->K_f[leg], c->K_s[leg]);
            cos_o1[leg] = cos(c->o1[leg]);
            sin_o2[leg] = sin(c->o2[leg]);
            apnc_feedback(out->gamma[leg], F[leg], cos_o1[leg], sin_o2[leg], &out->f1[leg],
                          &out->f2[leg]);
            out->g1[leg] = out->g2[leg] = 0.0;
        }
        communicate(p, state, angle, out);
        if (out->kappa > 0.0) couple(p, state, angle, cos_o1, sin_o2, out);
        advance(p, state, F, out);
    }
    memcpy(out->fault, fault, sizeof fault);
    out->tick = state->ticks < INT32_MAX ? (int32_t)state->ticks : INT32_MAX;
}

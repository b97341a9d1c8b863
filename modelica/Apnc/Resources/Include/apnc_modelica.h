/* The C core as an external object of Modelica.
 *
 * Generated from apnc_core/variables.py by `python -m build_fmu.generate`; do not edit.
 * The tool brings ModelicaUtilities.h. Everything is static: nothing is linked, and the header may
 * be included in several translation units of one model.
 */
#ifndef APNC_MODELICA_H
#define APNC_MODELICA_H

#include <stdlib.h>
#include <string.h>

#include "ModelicaUtilities.h"
#include "apnc_core.h"

typedef struct {
    apnc_data data;
    apnc_state state;  /* after tick k */
    apnc_state before; /* at tick k, for running it again */
    int k;             /* last tick run */
} apnc_modelica;

/* Stops the model with one line if a parameter is outside its range: tools need not check it. */
static void apnc_modelica_check(const apnc_data *data) {
    for (int i = 0; i < APNC_VARIABLES; i++) {
        const apnc_variable *variable = &apnc_variables[i];
        if ((variable->role != APNC_FIXED && variable->role != APNC_TUNABLE) || variable->min > variable->max) continue;
        const char *at = (const char *)data + variable->offset;
        for (int j = 0; j < variable->count; j++) {
            const double value =
                variable->type == APNC_REAL ? ((const double *)at)[j] : ((const int32_t *)at)[j];
            if (!(value >= variable->min && value <= variable->max))
                ModelicaFormatError("Apnc: %s = %g is not in %g ... %g", variable->name, value, variable->min,
                                    variable->max);
        }
    }
}

static void *apnc_modelica_new(
    int n,
    double Ts,
    double robot_weight,
    double F_max,
    int method,
    double w11,
    double w12_0,
    double bias,
    double o1_start,
    double o2_start,
    double a1,
    double a2,
    double b1,
    double b2,
    double turn_gain,
    double A_f,
    double B_f,
    double A_s,
    double B_s,
    double alpha,
    double rho,
    int forward_model,
    double rbf_rate,
    int phase_measure,
    double phase_filter,
    int N,
    double sigma,
    int kappa_rule,
    int kappa_hold,
    double xi,
    double feedback_kept,
    int coupling_sign,
    int phi_frozen,
    int MI_zero_resets,
    int stored,
    const double *phi_stored,
    double gamma_tegotae,
    double grf_reset) {
    if (n != APNC_LEGS)
        ModelicaFormatError("Apnc: n = %d, but the C core is compiled for %d legs (APNC_LEGS)", n,
                            APNC_LEGS);
    apnc_modelica *object = (apnc_modelica *)calloc(1, sizeof *object);
    if (object == NULL) ModelicaError("Apnc: no memory for the state of the controller");
    apnc_parameters *p = &object->data.parameters;
    p->Ts = Ts;
    p->robot_weight = robot_weight;
    p->F_max = F_max;
    p->method = method;
    p->w11 = w11;
    p->w12_0 = w12_0;
    p->bias = bias;
    p->o1_start = o1_start;
    p->o2_start = o2_start;
    p->a1 = a1;
    p->a2 = a2;
    p->b1 = b1;
    p->b2 = b2;
    p->turn_gain = turn_gain;
    p->A_f = A_f;
    p->B_f = B_f;
    p->A_s = A_s;
    p->B_s = B_s;
    p->alpha = alpha;
    p->rho = rho;
    p->forward_model = forward_model;
    p->rbf_rate = rbf_rate;
    p->phase_measure = phase_measure;
    p->phase_filter = phase_filter;
    p->N = N;
    p->sigma = sigma;
    p->kappa_rule = kappa_rule;
    p->kappa_hold = kappa_hold;
    p->xi = xi;
    p->feedback_kept = feedback_kept;
    p->coupling_sign = coupling_sign;
    p->phi_frozen = phi_frozen;
    p->MI_zero_resets = MI_zero_resets;
    p->stored = stored;
    memcpy(p->phi_stored, phi_stored, sizeof p->phi_stored);
    p->gamma_tegotae = gamma_tegotae;
    p->grf_reset = grf_reset;
    apnc_modelica_check(&object->data);
    apnc_init(p, &object->state, &object->data.outputs);
    return object;
}

static void apnc_modelica_free(void *object) { free(object); }

/* Tick k: the next one, or the last one again. */
static void apnc_modelica_step(
    void *memory,
    int k,
    const double *grf,
    double MI,
    double turn,
    int reset,
    double *theta_hip,
    double *theta_knee,
    double *o1,
    double *o2,
    double *gamma,
    double *grf_expected,
    double *f1,
    double *f2,
    double *g1,
    double *g2,
    int *fault,
    double *phi,
    double *phi_memory,
    double *d,
    double *kappa,
    double *K_f,
    double *K_s) {
    apnc_modelica *object = (apnc_modelica *)memory;
    if (k == object->k)
        object->state = object->before;
    else
        object->before = object->state;
    object->k = k;
    apnc_inputs *in = &object->data.inputs;
    memcpy(in->grf, grf, sizeof in->grf);
    in->MI = MI;
    in->turn = turn;
    in->reset = reset;
    apnc_outputs *out = &object->data.outputs;
    apnc_tick(&object->data.parameters, &object->state, in, out);
    memcpy(theta_hip, out->theta_hip, sizeof out->theta_hip);
    memcpy(theta_knee, out->theta_knee, sizeof out->theta_knee);
    memcpy(o1, out->o1, sizeof out->o1);
    memcpy(o2, out->o2, sizeof out->o2);
    memcpy(gamma, out->gamma, sizeof out->gamma);
    memcpy(grf_expected, out->grf_expected, sizeof out->grf_expected);
    memcpy(f1, out->f1, sizeof out->f1);
    memcpy(f2, out->f2, sizeof out->f2);
    memcpy(g1, out->g1, sizeof out->g1);
    memcpy(g2, out->g2, sizeof out->g2);
    memcpy(fault, out->fault, sizeof out->fault);
    memcpy(phi, out->phi, sizeof out->phi);
    memcpy(phi_memory, out->phi_memory, sizeof out->phi_memory);
    *d = out->d;
    *kappa = out->kappa;
    memcpy(K_f, out->K_f, sizeof out->K_f);
    memcpy(K_s, out->K_s, sizeof out->K_s);
}

#endif

/* The controller behind the shell: ticks on a grid of their own, faults and limits reported. */
#include <stdint.h>
#include <string.h>

#include "apnc.h"
#include "model.h"

/* Part of Ts by which a step may miss a tick without losing or doubling it. Importers that count
 * in nanoseconds, or add up an inexact Ts, stay within it for minutes. */
#define TICK_TOLERANCE 1e-4
#define MAX_TICK       (INT64_C(1) << 53) /* the largest that is still exact as a double */

typedef struct {
    apnc_state controller;
    int64_t next_tick;  /* number of the next tick, due at start_time + next_tick Ts */
    int32_t limited_MI; /* the value of MI was last found unusable or out of its range */
    int32_t limited_turn;
    int32_t held; /* a step was longer than a tick, and it was said */
    int32_t unused;
} controller_state;

const int apnc_variable_count = APNC_VARIABLES;

size_t apnc_values_size(void) { return sizeof(apnc_data); }

size_t apnc_state_size(void) { return sizeof(controller_state); }

void apnc_model_defaults(void *values) { apnc_defaults(values); }

double apnc_model_tick(const apnc_instance *instance) {
    const apnc_data *data = instance->values;
    return data->parameters.Ts;
}

apnc_status apnc_model_refresh(apnc_instance *instance) {
    apnc_data *data = instance->values;
    controller_state *state = instance->state;
    apnc_init(&data->parameters, &state->controller, &data->outputs);
    return APNC_OK;
}

apnc_status apnc_model_accepts(apnc_instance *instance, const apnc_variable *variable,
                               double value) {
    (void)instance;
    (void)variable;
    (void)value;
    return APNC_OK;
}

apnc_status apnc_model_start(apnc_instance *instance) {
    const apnc_data *data = instance->values;
    controller_state *state = instance->state;
    state->next_tick = 0;
    return apnc_report(instance, APNC_OK, APNC_LOG_EVENTS, "started at %g s: %d legs, Ts = %g s",
                       instance->run->start_time, APNC_LEGS, data->parameters.Ts);
}

/* A command outside its range is used limited, and reported once when that begins. */
static apnc_status note_limited(apnc_instance *instance, const char *name, double value, double low,
                                double high, int32_t *noted) {
    const int outside = !(value >= low && value <= high);
    const int begins = outside && !*noted;
    *noted = outside;
    if (!begins) return APNC_OK;
    return apnc_report(instance, APNC_WARNING, APNC_LOG_WARNING,
                       "%s = %g at %g s is not in %g ... %g: the nearest, or if it is not a number "
                       "the last usable value counts",
                       name, value, instance->run->time, low, high);
}

static apnc_status note_faults(apnc_instance *instance, const int32_t *before) {
    apnc_status status = APNC_OK;
    const apnc_data *data = instance->values;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        if (!data->outputs.fault[leg] || before[leg]) continue;
        status =
            apnc_report(instance, APNC_WARNING, APNC_LOG_WARNING,
                        "%s = %g N at %g s is not finite, negative or too large: it counts as zero",
                        apnc_scalar_name(&apnc_variables[0], leg).text, data->inputs.grf[leg],
                        instance->run->time);
    }
    return status;
}

static apnc_status tick(apnc_instance *instance) {
    apnc_data *data = instance->values;
    controller_state *state = instance->state;
    int32_t fault_before[APNC_LEGS];
    apnc_status status = APNC_OK;
    memcpy(fault_before, data->outputs.fault, sizeof fault_before);
    if (note_limited(instance, "MI", data->inputs.MI, APNC_MI_MIN, APNC_MI_MAX,
                     &state->limited_MI) != APNC_OK)
        status = APNC_WARNING;
    if (note_limited(instance, "turn", data->inputs.turn, APNC_TURN_MIN, APNC_TURN_MAX,
                     &state->limited_turn) != APNC_OK)
        status = APNC_WARNING;
    apnc_tick(&data->parameters, &state->controller, &data->inputs, &data->outputs);
    if (note_faults(instance, fault_before) != APNC_OK) status = APNC_WARNING;
    return status;
}

/* Importers choose their own step, some without a word: the first step longer than a tick is
 * reported. */
static void note_long_step(apnc_instance *instance, double t, double h) {
    const apnc_data *data = instance->values;
    controller_state *state = instance->state;
    const double Ts = data->parameters.Ts;
    if (state->held || h <= (1.0 + TICK_TOLERANCE) * Ts) return;
    state->held = 1;
    apnc_report(instance, APNC_WARNING, APNC_LOG_WARNING,
                "the step of %g s from %g s is longer than a tick, %g s: inputs are held, and "
                "loads arrive late",
                h, t, Ts);
}

/* Run every tick with t <= start_time + k Ts < t + h. */
apnc_status apnc_model_step(apnc_instance *instance, double t, double h) {
    const apnc_data *data = instance->values;
    apnc_run *run = instance->run;
    controller_state *state = instance->state;
    const double Ts = data->parameters.Ts;
    const double due_before = t + h - TICK_TOLERANCE * Ts;
    apnc_status status = APNC_OK;

    if ((due_before - run->start_time) / Ts - (double)state->next_tick > APNC_MAX_TICKS_PER_STEP)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "step by %g s has more than %g ticks of %g s", h,
                           APNC_MAX_TICKS_PER_STEP, Ts);
    note_long_step(instance, t, h);
    while (run->start_time + (double)state->next_tick * Ts < due_before) {
        run->time = run->start_time + (double)state->next_tick * Ts;
        state->next_tick++;
        if (tick(instance) != APNC_OK) status = APNC_WARNING;
    }
    return status;
}

void apnc_model_pack(void *state) { (void)state; }

apnc_status apnc_model_unpack(apnc_instance *instance) {
    (void)instance;
    return APNC_OK;
}

int apnc_model_sound(const void *values, const apnc_run *run, const void *state) {
    const apnc_data *data = values;
    const controller_state *own = state;
    const int32_t oldest = own->controller.estimation.oldest;
    if (own->next_tick < 0 || own->next_tick > MAX_TICK) return 0;
    if (own->controller.ticks < 0 || own->controller.ticks > MAX_TICK) return 0;
    if (oldest < 0 || oldest >= APNC_WINDOW_MAX) return 0;
    return run->phase != APNC_STEPPING || oldest < data->parameters.N;
}

void apnc_model_leave(apnc_instance *instance) { (void)instance; }

#include "instance.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

/* Part of Ts by which a step may miss a tick without losing or doubling it. Importers that count
 * in nanoseconds, or add up an inexact Ts, stay within it for minutes. */
#define TICK_TOLERANCE 1e-4
/* Part of Ts by which a step may start away from the end of the one before. */
#define GAP_TOLERANCE 0.5
/* Part of Ts by which the last step may end after the stop time, as a rounded one does. */
#define STOP_TOLERANCE 0.5
/* Longer steps are taken for a mistake [ticks]. */
#define MAX_TICKS_PER_STEP 10000000.0

const char *const apnc_log_names[APNC_LOG_CATEGORIES] = {"logStatusWarning", "logStatusError",
                                                         "logEvents"};

apnc_status apnc_report(apnc_instance *instance, apnc_status status, apnc_log category,
                        const char *format, ...) {
    char message[512];
    va_list arguments;
    if (!instance->emit || !instance->logging[category]) return status;
    va_start(arguments, format);
    vsnprintf(message, sizeof message, format, arguments);
    va_end(arguments);
    instance->emit(instance, status, category, message);
    return status;
}

apnc_status apnc_refuse(apnc_instance *instance, const char *function, const char *why) {
    return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "%s: %s", function, why);
}

int apnc_allowed(apnc_instance *instance, int phases, const char *function) {
    if (!instance) return 0;
    if (instance->run.phase & phases) return 1;
    apnc_refuse(instance, function, "not allowed in this state of the FMU");
    return 0;
}

apnc_status apnc_choose_logging(apnc_instance *instance, const char *function, int on, size_t n,
                                const char *const categories[]) {
    int chosen[APNC_LOG_CATEGORIES] = {0};
    if (n && !categories) return apnc_refuse(instance, function, "categories is NULL");
    for (size_t i = 0; i < n; i++) {
        int known = 0;
        for (int k = 0; categories[i] && k < APNC_LOG_CATEGORIES; k++)
            if (strcmp(categories[i], apnc_log_names[k]) == 0) known = chosen[k] = 1;
        if (!known) return apnc_refuse(instance, function, "a category is not of this FMU");
    }
    for (int k = 0; k < APNC_LOG_CATEGORIES; k++)
        instance->logging[k] = on && (n == 0 || chosen[k]);
    return APNC_OK;
}

void apnc_run_clear(apnc_run *run) {
    memset(run, 0, sizeof *run);
    apnc_defaults(&run->data);
    run->stop_time = INFINITY;
    run->phase = APNC_INSTANTIATED;
    run->outdated = 1;
}

apnc_status apnc_set_times(apnc_instance *instance, const char *function, double start_time,
                           int stop_defined, double stop_time) {
    apnc_run *run = &instance->run;
    if (!isfinite(start_time)) return apnc_refuse(instance, function, "start time is not finite");
    if (stop_defined && !(stop_time >= start_time))
        return apnc_refuse(instance, function, "stop time is before start time");
    run->start_time = run->time = start_time;
    run->stop_time = stop_defined ? stop_time : INFINITY;
    return APNC_OK;
}

/* "leg[2].grf" */
typedef struct {
    char text[64];
} scalar_name;

static scalar_name name_of(const apnc_row *row, int element) {
    scalar_name name;
    if (row->count == 1 && row->after[0] == '\0')
        snprintf(name.text, sizeof name.text, "%s", row->before);
    else
        snprintf(name.text, sizeof name.text, "%s%d%s", row->before, element + 1, row->after);
    return name;
}

static const char *type_name(apnc_type type) {
    static const char *const names[] = {"Real", "Integer", "Boolean", "Enumeration"};
    return names[type];
}

/* Row and place of a value reference; NULL with a message if there is none of that type. */
static const apnc_row *find(apnc_instance *instance, uint32_t value_reference, apnc_type wanted,
                            void **at, int *element) {
    const uint32_t number = value_reference / APNC_VR_STRIDE;
    const uint32_t entry = value_reference % APNC_VR_STRIDE;
    if (number >= APNC_ROWS || entry >= (uint32_t)apnc_rows[number].count) {
        apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "no variable has value reference %lu",
                    (unsigned long)value_reference);
        return NULL;
    }
    const apnc_row *row = &apnc_rows[number];
    const size_t size = row->type == APNC_REAL ? sizeof(double) : sizeof(int32_t);
    *at = (char *)&instance->run.data + row->offset + entry * size;
    *element = (int)entry;
    if (row->type == wanted || (row->type == APNC_ENUMERATION && wanted == APNC_INTEGER))
        return row;
    apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "%s is of type %s, not %s",
                name_of(row, *element).text, type_name(row->type), type_name(wanted));
    return NULL;
}

static void refresh(apnc_instance *instance) {
    apnc_run *run = &instance->run;
    if (!run->outdated) return;
    apnc_init(&run->data.parameters, &run->state, &run->data.outputs);
    run->outdated = 0;
}

apnc_status apnc_get(apnc_instance *instance, uint32_t value_reference, apnc_type wanted,
                     void *value) {
    void *at;
    int element;
    const apnc_row *row = find(instance, value_reference, wanted, &at, &element);
    if (!row) return APNC_ERROR;
    if (row->role == APNC_OUTPUT || row->role == APNC_LOCAL) {
        if (instance->run.phase == APNC_INSTANTIATED)
            return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                               "%s is an output: it has no value before initialization",
                               name_of(row, element).text);
        refresh(instance);
    }
    memcpy(value, at, row->type == APNC_REAL ? sizeof(double) : sizeof(int32_t));
    return APNC_OK;
}

static int in_range(const apnc_row *row, double value) {
    return row->min > row->max ? fabs(value) <= DBL_MAX : value >= row->min && value <= row->max;
}

static apnc_status report_range(apnc_instance *instance, const apnc_row *row, int element,
                                double value) {
    return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                       "%s = %g is out of range: %g ... %g is allowed", name_of(row, element).text,
                       value, row->min, row->max);
}

static double number_at(const apnc_row *row, const void *at) {
    double number;
    int32_t integer;
    if (row->type == APNC_REAL) {
        memcpy(&number, at, sizeof number);
        return number;
    }
    memcpy(&integer, at, sizeof integer);
    return integer;
}

apnc_status apnc_set(apnc_instance *instance, uint32_t value_reference, apnc_type wanted,
                     const void *value) {
    void *at;
    int element;
    const int stepping = instance->run.phase == APNC_STEPPING;
    const apnc_row *row = find(instance, value_reference, wanted, &at, &element);
    if (!row) return APNC_ERROR;
    if (row->role == APNC_OUTPUT || row->role == APNC_LOCAL)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "%s is an output: it can't be set",
                           name_of(row, element).text);
    if (stepping && row->role == APNC_FIXED)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "%s is fixed: it can only be set before the first step",
                           name_of(row, element).text);
    if (stepping && row->role == APNC_TUNABLE && !in_range(row, number_at(row, value)))
        return report_range(instance, row, element, number_at(row, value));
    if (row->type == APNC_REAL) {
        memcpy(at, value, sizeof(double));
    } else {
        int32_t integer = (int32_t)number_at(row, value);
        if (row->type == APNC_BOOLEAN) integer = integer != 0;
        memcpy(at, &integer, sizeof integer);
    }
    if (!stepping) instance->run.outdated = 1;
    return APNC_OK;
}

/* Value of an entry of a row. */
static double value_of(const apnc_data *data, const apnc_row *row, int element) {
    const size_t size = row->type == APNC_REAL ? sizeof(double) : sizeof(int32_t);
    return number_at(row, (const char *)data + row->offset + (size_t)element * size);
}

static int is_parameter(const apnc_row *row) {
    return row->role == APNC_FIXED || row->role == APNC_TUNABLE;
}

int apnc_parameters_in_range(const apnc_data *data) {
    for (int i = 0; i < APNC_ROWS; i++)
        for (int k = 0; is_parameter(&apnc_rows[i]) && k < apnc_rows[i].count; k++)
            if (!in_range(&apnc_rows[i], value_of(data, &apnc_rows[i], k))) return 0;
    return 1;
}

static apnc_status report_parameters(apnc_instance *instance) {
    apnc_status status = APNC_OK;
    for (int i = 0; i < APNC_ROWS; i++) {
        const apnc_row *row = &apnc_rows[i];
        for (int k = 0; is_parameter(row) && k < row->count; k++) {
            const double value = value_of(&instance->run.data, row, k);
            if (!in_range(row, value)) status = report_range(instance, row, k, value);
        }
    }
    return status;
}

apnc_status apnc_start(apnc_instance *instance) {
    apnc_run *run = &instance->run;
    if (report_parameters(instance) != APNC_OK) return APNC_ERROR;
    refresh(instance);
    run->time = run->start_time;
    run->next_tick = 0;
    run->phase = APNC_STEPPING;
    return apnc_report(instance, APNC_OK, APNC_LOG_EVENTS, "started at %g s: %d legs, Ts = %g s",
                       run->start_time, APNC_LEGS, run->data.parameters.Ts);
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
                       name, value, instance->run.time, low, high);
}

static apnc_status note_faults(apnc_instance *instance, const int32_t *before) {
    apnc_status status = APNC_OK;
    const apnc_data *data = &instance->run.data;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        if (!data->outputs.fault[leg] || before[leg]) continue;
        status = apnc_report(
            instance, APNC_WARNING, APNC_LOG_WARNING,
            "%s = %g N at %g s is not finite, negative or too large: it counts as zero",
            name_of(&apnc_rows[0], leg).text, data->inputs.grf[leg], instance->run.time);
    }
    return status;
}

static apnc_status tick(apnc_instance *instance) {
    apnc_run *run = &instance->run;
    apnc_data *data = &run->data;
    int32_t fault_before[APNC_LEGS];
    apnc_status status = APNC_OK;
    memcpy(fault_before, data->outputs.fault, sizeof fault_before);
    if (note_limited(instance, "MI", data->inputs.MI, APNC_MI_MIN, APNC_MI_MAX, &run->limited_MI) !=
        APNC_OK)
        status = APNC_WARNING;
    if (note_limited(instance, "turn", data->inputs.turn, APNC_TURN_MIN, APNC_TURN_MAX,
                     &run->limited_turn) != APNC_OK)
        status = APNC_WARNING;
    apnc_tick(&data->parameters, &run->state, &data->inputs, &data->outputs);
    if (note_faults(instance, fault_before) != APNC_OK) status = APNC_WARNING;
    return status;
}

apnc_status apnc_step(apnc_instance *instance, double t, double h) {
    apnc_run *run = &instance->run;
    const double Ts = run->data.parameters.Ts;
    const double end = t + h;
    const double due_before = end - TICK_TOLERANCE * Ts;
    apnc_status status = APNC_OK;

    if (!(fabs(end) <= DBL_MAX) || !(h >= 0.0))
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "step from %g s by %g s: both must be finite, the step not negative", t,
                           h);
    if (fabs(t - run->time) > GAP_TOLERANCE * Ts)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "step starts at %.9g s, but the one before ended at %.9g s", t,
                           run->time);
    if (end > run->stop_time + STOP_TOLERANCE * Ts)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "step to %.9g s goes beyond the stop time, %.9g s", end, run->stop_time);
    if ((due_before - run->start_time) / Ts - (double)run->next_tick > MAX_TICKS_PER_STEP)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "step by %g s has more than %g ticks of %g s", h, MAX_TICKS_PER_STEP,
                           Ts);
    while (run->start_time + (double)run->next_tick * Ts < due_before) {
        run->time = run->start_time + (double)run->next_tick * Ts;
        run->next_tick++;
        if (tick(instance) != APNC_OK) status = APNC_WARNING;
    }
    run->time = end;
    return status;
}

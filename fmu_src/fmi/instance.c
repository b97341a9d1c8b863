#include "instance.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "model.h"

/* Parts of a block, and the block itself, begin at a multiple of this [bytes]. */
#define ALIGNMENT ((size_t)64)

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
    if (instance->run->phase & phases) return 1;
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

static size_t aligned(size_t size) { return (size + ALIGNMENT - 1) / ALIGNMENT * ALIGNMENT; }

size_t apnc_run_at(void) { return aligned(apnc_values_size()); }

size_t apnc_state_at(void) { return apnc_run_at() + aligned(sizeof(apnc_run)); }

size_t apnc_saved_size(void) { return apnc_state_at() + apnc_state_size(); }

size_t apnc_instance_room(void) { return apnc_saved_size() + ALIGNMENT; }

void apnc_instance_settle(apnc_instance *instance, void *room) {
    char *block = (char *)room + (ALIGNMENT - (uintptr_t)room % ALIGNMENT) % ALIGNMENT;
    instance->values = block;
    instance->run = (apnc_run *)(void *)(block + apnc_run_at());
    instance->state = block + apnc_state_at();
    apnc_clear(instance);
}

void apnc_instance_leave(apnc_instance *instance) { apnc_model_leave(instance); }

void apnc_clear(apnc_instance *instance) {
    memset(instance->values, 0, apnc_saved_size());
    apnc_model_defaults(instance->values);
    instance->run->stop_time = INFINITY;
    instance->run->phase = APNC_INSTANTIATED;
    instance->run->outdated = 1;
}

void apnc_save(const apnc_instance *instance, void *saved) {
    memcpy(saved, instance->values, apnc_saved_size());
    apnc_model_pack((char *)saved + apnc_state_at());
}

apnc_status apnc_restore(apnc_instance *instance, const void *saved) {
    memcpy(instance->values, saved, apnc_saved_size());
    if (apnc_model_unpack(instance) == APNC_OK) return APNC_OK;
    apnc_clear(instance);
    return APNC_ERROR;
}

apnc_status apnc_set_times(apnc_instance *instance, const char *function, double start_time,
                           int stop_defined, double stop_time) {
    apnc_run *run = instance->run;
    if (!isfinite(start_time)) return apnc_refuse(instance, function, "start time is not finite");
    if (stop_defined && !(stop_time >= start_time))
        return apnc_refuse(instance, function, "stop time is before start time");
    run->start_time = run->time = start_time;
    run->stop_time = stop_defined ? stop_time : INFINITY;
    return APNC_OK;
}

apnc_name apnc_scalar_name(const apnc_variable *variable, int element) {
    apnc_name name;
    if (variable->count == 1 && variable->after[0] == '\0')
        snprintf(name.text, sizeof name.text, "%s", variable->before);
    else
        snprintf(name.text, sizeof name.text, "%s%d%s", variable->before, element + 1,
                 variable->after);
    return name;
}

static const char *type_name(apnc_type type) {
    static const char *const names[] = {"Real", "Integer", "Boolean", "Enumeration"};
    return names[type];
}

int apnc_shown_as(const apnc_variable *variable, apnc_type type) {
#ifdef APNC_REALS
    (void)variable;
    return type == APNC_REAL;
#else
    return type == variable->type;
#endif
}

static size_t size_of(const apnc_variable *variable) {
    return variable->type == APNC_REAL ? sizeof(double) : sizeof(int32_t);
}

/* Variable and place of a value reference; NULL with a message if there is none of that type. */
static const apnc_variable *find(apnc_instance *instance, uint32_t value_reference,
                                 apnc_type wanted, void **at, int *element) {
    const uint32_t number = value_reference / APNC_VR_STRIDE;
    const uint32_t entry = value_reference % APNC_VR_STRIDE;
    if (number >= (uint32_t)apnc_variable_count ||
        entry >= (uint32_t)apnc_variables[number].count) {
        apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "no variable has value reference %lu",
                    (unsigned long)value_reference);
        return NULL;
    }
    const apnc_variable *variable = &apnc_variables[number];
    *at = (char *)instance->values + variable->offset + entry * size_of(variable);
    *element = (int)entry;
    if (apnc_shown_as(variable, wanted) ||
        (apnc_shown_as(variable, APNC_ENUMERATION) && wanted == APNC_INTEGER))
        return variable;
    apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "%s is of type %s, not %s",
                apnc_scalar_name(variable, *element).text,
                type_name(apnc_shown_as(variable, APNC_REAL) ? APNC_REAL : variable->type),
                type_name(wanted));
    return NULL;
}

static apnc_status refresh(apnc_instance *instance) {
    if (!instance->run->outdated) return APNC_OK;
    const apnc_status status = apnc_model_refresh(instance);
    if (status == APNC_OK) instance->run->outdated = 0;
    return status;
}

/* Number stored as a type: a Real is a double, every other type an int32_t. */
static double number_at(const void *at, apnc_type type) {
    double number;
    int32_t integer;
    if (type == APNC_REAL) {
        memcpy(&number, at, sizeof number);
        return number;
    }
    memcpy(&integer, at, sizeof integer);
    return integer;
}

apnc_status apnc_get(apnc_instance *instance, uint32_t value_reference, apnc_type wanted,
                     void *value) {
    void *at;
    int element;
    const apnc_variable *variable = find(instance, value_reference, wanted, &at, &element);
    if (!variable) return APNC_ERROR;
    if (variable->role == APNC_OUTPUT || variable->role == APNC_LOCAL) {
        if (instance->run->phase == APNC_INSTANTIATED)
            return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                               "%s is an output: it has no value before initialization",
                               apnc_scalar_name(variable, element).text);
        if (refresh(instance) != APNC_OK) return APNC_ERROR;
    }
    if (wanted == APNC_REAL) {
        const double number = number_at(at, variable->type);
        memcpy(value, &number, sizeof number);
    } else {
        memcpy(value, at, sizeof(int32_t));
    }
    return APNC_OK;
}

static int in_range(const apnc_variable *variable, double value) {
    return variable->min > variable->max ? fabs(value) <= DBL_MAX
                                         : value >= variable->min && value <= variable->max;
}

static apnc_status report_range(apnc_instance *instance, const apnc_variable *variable, int element,
                                double value) {
    return apnc_report(
        instance, APNC_ERROR, APNC_LOG_ERROR, "%s = %g is out of range: %g ... %g is allowed",
        apnc_scalar_name(variable, element).text, value, variable->min, variable->max);
}

/* Whether a parameter may have a value; logs if not. */
static apnc_status may_be(apnc_instance *instance, const apnc_variable *variable, int element,
                          double value) {
    if (!in_range(variable, value)) return report_range(instance, variable, element, value);
    return apnc_model_accepts(instance, variable, value);
}

/* Store a number as the type of a variable; an error if it cannot be stored so. */
static apnc_status store(apnc_instance *instance, const apnc_variable *variable, int element,
                         double number, void *at) {
    int32_t integer;
    if (variable->type == APNC_REAL) {
        memcpy(at, &number, sizeof number);
        return APNC_OK;
    }
    if (!(number >= INT32_MIN && number <= INT32_MAX) || number != floor(number))
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "%s = %g is not a whole number",
                           apnc_scalar_name(variable, element).text, number);
    integer = variable->type == APNC_BOOLEAN ? number != 0 : (int32_t)number;
    memcpy(at, &integer, sizeof integer);
    return APNC_OK;
}

apnc_status apnc_set(apnc_instance *instance, uint32_t value_reference, apnc_type wanted,
                     const void *value) {
    void *at;
    int element;
    const int stepping = instance->run->phase == APNC_STEPPING;
    const apnc_variable *variable = find(instance, value_reference, wanted, &at, &element);
    const double number = number_at(value, wanted);
    if (!variable) return APNC_ERROR;
    if (variable->role == APNC_OUTPUT || variable->role == APNC_LOCAL)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "%s is an output: it can't be set",
                           apnc_scalar_name(variable, element).text);
    if (stepping && variable->role == APNC_FIXED)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "%s is fixed: it can only be set before the first step",
                           apnc_scalar_name(variable, element).text);
    if (stepping && variable->role == APNC_TUNABLE) {
        if (may_be(instance, variable, element, number) != APNC_OK) return APNC_ERROR;
        instance->run->tuned = 1;
    }
    if (store(instance, variable, element, number, at) != APNC_OK) return APNC_ERROR;
    if (!stepping) instance->run->outdated = 1;
    return APNC_OK;
}

/* Value of an entry of a variable. */
static double value_of(const void *values, const apnc_variable *variable, int element) {
    const char *at = (const char *)values + variable->offset;
    return number_at(at + (size_t)element * size_of(variable), variable->type);
}

static int is_parameter(const apnc_variable *variable) {
    return variable->role == APNC_FIXED || variable->role == APNC_TUNABLE;
}

int apnc_parameters_in_range(const void *values) {
    for (int i = 0; i < apnc_variable_count; i++)
        for (int k = 0; is_parameter(&apnc_variables[i]) && k < apnc_variables[i].count; k++)
            if (!in_range(&apnc_variables[i], value_of(values, &apnc_variables[i], k))) return 0;
    return 1;
}

apnc_status apnc_report_parameters(apnc_instance *instance) {
    apnc_status status = APNC_OK;
    for (int i = 0; i < apnc_variable_count; i++) {
        const apnc_variable *variable = &apnc_variables[i];
        for (int k = 0; is_parameter(variable) && k < variable->count; k++)
            if (may_be(instance, variable, k, value_of(instance->values, variable, k)) != APNC_OK)
                status = APNC_ERROR;
    }
    return status;
}

apnc_status apnc_start(apnc_instance *instance) {
    apnc_run *run = instance->run;
    if (apnc_report_parameters(instance) != APNC_OK) return APNC_ERROR;
    if (refresh(instance) != APNC_OK) return APNC_ERROR;
    run->time = run->start_time;
    run->phase = APNC_STEPPING;
    return apnc_model_start(instance);
}

apnc_status apnc_step(apnc_instance *instance, double t, double h) {
    apnc_run *run = instance->run;
    const double tick = apnc_model_tick(instance);
    const double end = t + h;

    if (!(fabs(end) <= DBL_MAX) || !(h >= 0.0))
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "step from %g s by %g s: both must be finite, the step not negative", t,
                           h);
    if (fabs(t - run->time) > APNC_GAP_TOLERANCE * tick)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "step starts at %.9g s, but the one before ended at %.9g s", t,
                           run->time);
    if (end > run->stop_time + APNC_STOP_TOLERANCE * tick)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "step to %.9g s goes beyond the stop time, %.9g s", end, run->stop_time);
    const apnc_status status = apnc_model_step(instance, t, h);
    if (status != APNC_ERROR) run->time = end;
    return status;
}

/* FMI 3.0 co-simulation interface: life cycle, arrays and types of the standard.
 *
 * A variable with several entries is an array, and its value reference is that of its first entry.
 * In a build with flat names every entry is a scalar of its own instead.
 */
#include <stdlib.h>
#include <string.h>

#include "fmi3_standard.h"
#include "instance.h"
#include "model.h"

#ifndef APNC_GUID
#error "APNC_GUID must be the instantiation token of the model description"
#endif

typedef struct {
    apnc_instance base; /* first, so that both pointers are one */
    fmi3InstanceEnvironment environment;
    fmi3LogMessageCallback log_message;
} fmu;

static fmi3Status fail(fmu *f, const char *function, const char *why) {
    return (fmi3Status)apnc_refuse(&f->base, function, why);
}

static int allowed(fmu *f, int phases, const char *function) {
    return apnc_allowed((apnc_instance *)f, phases, function);
}

static void emit(apnc_instance *instance, apnc_status status, apnc_log category,
                 const char *message) {
    fmu *f = (fmu *)instance;
    f->log_message(f->environment, (fmi3Status)status, apnc_log_names[category], message);
}

static void *allocate_for(apnc_instance *instance, size_t size) {
    (void)instance;
    return calloc(1, size);
}

static void release_for(apnc_instance *instance, void *memory) {
    (void)instance;
    free(memory);
}

const char *fmi3GetVersion(void) { return fmi3Version; }

fmi3Status fmi3SetDebugLogging(fmi3Instance instance, fmi3Boolean loggingOn, size_t nCategories,
                               const fmi3String categories[]) {
    if (!allowed((fmu *)instance, APNC_ANY, "fmi3SetDebugLogging")) return fmi3Error;
    return (fmi3Status)apnc_choose_logging((apnc_instance *)instance, "fmi3SetDebugLogging",
                                           loggingOn, nCategories, categories);
}

fmi3Instance fmi3InstantiateCoSimulation(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
    fmi3Boolean visible, fmi3Boolean loggingOn, fmi3Boolean eventModeUsed,
    fmi3Boolean earlyReturnAllowed, const fmi3ValueReference requiredIntermediateVariables[],
    size_t nRequiredIntermediateVariables, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage, fmi3IntermediateUpdateCallback intermediateUpdate) {
    const char *why = NULL;
    (void)resourcePath;
    (void)visible;
    (void)earlyReturnAllowed;
    (void)requiredIntermediateVariables;
    (void)intermediateUpdate;
    if (!instanceName || !*instanceName) why = "instance name is missing";
    if (!instantiationToken || strcmp(instantiationToken, APNC_GUID) != 0)
        why = "token is not the one of this FMU: model description and binary do not match";
    if (eventModeUsed) why = "this FMU has no event mode";
    if (nRequiredIntermediateVariables) why = "this FMU has no intermediate variables";
    if (why) {
        if (logMessage)
            logMessage(instanceEnvironment, fmi3Error, apnc_log_names[APNC_LOG_ERROR], why);
        return NULL;
    }
    fmu *f = calloc(1, sizeof *f + apnc_instance_room());
    if (!f) return NULL;
    f->environment = instanceEnvironment;
    f->log_message = logMessage;
    if (logMessage) f->base.emit = emit;
    f->base.allocate = allocate_for;
    f->base.release = release_for;
    for (int k = 0; k < APNC_LOG_CATEGORIES; k++) f->base.logging[k] = loggingOn;
    apnc_instance_settle(&f->base, f + 1);
    return f;
}

void fmi3FreeInstance(fmi3Instance instance) {
    if (!instance) return;
    apnc_instance_leave((apnc_instance *)instance);
    free(instance);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance instance, fmi3Boolean toleranceDefined,
                                       fmi3Float64 tolerance, fmi3Float64 startTime,
                                       fmi3Boolean stopTimeDefined, fmi3Float64 stopTime) {
    fmu *f = (fmu *)instance;
    (void)toleranceDefined;
    (void)tolerance;
    if (!allowed(f, APNC_INSTANTIATED, "fmi3EnterInitializationMode")) return fmi3Error;
    if (apnc_set_times(&f->base, "fmi3EnterInitializationMode", startTime, stopTimeDefined,
                       stopTime) != APNC_OK)
        return fmi3Error;
    f->base.run->phase = APNC_INITIALIZATION;
    return fmi3OK;
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance instance) {
    fmu *f = (fmu *)instance;
    if (!allowed(f, APNC_INITIALIZATION, "fmi3ExitInitializationMode")) return fmi3Error;
    return (fmi3Status)apnc_start(&f->base);
}

fmi3Status fmi3Terminate(fmi3Instance instance) {
    fmu *f = (fmu *)instance;
    if (!allowed(f, APNC_STEPPING, "fmi3Terminate")) return fmi3Error;
    f->base.run->phase = APNC_TERMINATED;
    return fmi3OK;
}

fmi3Status fmi3Reset(fmi3Instance instance) {
    fmu *f = (fmu *)instance;
    if (!allowed(f, APNC_ANY, "fmi3Reset")) return fmi3Error;
    apnc_clear(&f->base);
    return fmi3OK;
}

/* Number of values at a value reference; 0 if no variable has it. */
static size_t values_at(fmi3ValueReference vr) {
    const uint32_t number = vr / APNC_VR_STRIDE, entry = vr % APNC_VR_STRIDE;
    if (number >= (uint32_t)apnc_variable_count) return 0;
#ifdef APNC_NAMING_FLAT
    return entry < (uint32_t)apnc_variables[number].count;
#else
    return entry ? 0 : (size_t)apnc_variables[number].count;
#endif
}

/* Number of values of a variable of that type; 0 with a message if there is none. */
static size_t entries(fmu *f, const char *function, fmi3ValueReference vr, apnc_type type) {
    const size_t count = values_at(vr);
    if (vr == APNC_VR_TIME && type == APNC_REAL) return 1;
    if (!count || !apnc_shown_as(&apnc_variables[vr / APNC_VR_STRIDE], type)) {
        apnc_report(&f->base, APNC_ERROR, APNC_LOG_ERROR,
                    "%s: no variable of this type has value reference %lu", function,
                    (unsigned long)vr);
        return 0;
    }
    return count;
}

static fmi3Status check_access(fmu *f, int phases, const char *function,
                               const fmi3ValueReference vr[], size_t nvr, const void *values) {
    if (!allowed(f, phases, function)) return fmi3Error;
    if (nvr && (!vr || !values)) return fail(f, function, "a pointer is NULL");
    return fmi3OK;
}

/* The values of all variables follow one another; every one must have its place. */
#define EACH_VALUE(function, type, body)                                                           \
    size_t next = 0;                                                                               \
    for (size_t i = 0; i < nvr && status == fmi3OK; i++) {                                         \
        const size_t n = entries(f, function, vr[i], type);                                        \
        if (!n) return fmi3Error;                                                                  \
        if (n > nValues - next) return fail(f, function, "too few values");                        \
        for (size_t k = 0; k < n && status == fmi3OK; k++, next++) {                               \
            const fmi3ValueReference at = vr[i] + (fmi3ValueReference)k;                           \
            body                                                                                   \
        }                                                                                          \
    }                                                                                              \
    if (status == fmi3OK && next != nValues) return fail(f, function, "too many values");          \
    return status;

#define GETTER(name, fmi_type, c_type, type)                                                       \
    fmi3Status name(fmi3Instance instance, const fmi3ValueReference vr[], size_t nvr,              \
                    fmi_type values[], size_t nValues) {                                           \
        fmu *f = (fmu *)instance;                                                                  \
        fmi3Status status = check_access(f, APNC_ANY, #name, vr, nvr, values);                     \
        EACH_VALUE(#name, type, {                                                                  \
            c_type value;                                                                          \
            status = (fmi3Status)apnc_get(&f->base, at, type, &value);                             \
            if (status == fmi3OK) values[next] = (fmi_type)value;                                  \
        })                                                                                         \
    }

#define SETTER(name, fmi_type, c_type, type, converted)                                            \
    fmi3Status name(fmi3Instance instance, const fmi3ValueReference vr[], size_t nvr,              \
                    const fmi_type values[], size_t nValues) {                                     \
        fmu *f = (fmu *)instance;                                                                  \
        fmi3Status status = check_access(f, APNC_WRITABLE, #name, vr, nvr, values);                \
        EACH_VALUE(#name, type, {                                                                  \
            const c_type value = converted(values[next]);                                          \
            status = (fmi3Status)apnc_set(&f->base, at, type, &value);                             \
        })                                                                                         \
    }

static double as_is(double value) { return value; }
static int32_t as_integer(fmi3Int32 value) { return value; }
static int32_t as_flag(fmi3Boolean value) { return value; }

/* An enumeration value beyond 32 bits stays out of range. */
static int32_t as_item(fmi3Int64 value) {
    return value < INT32_MIN ? INT32_MIN : value > INT32_MAX ? INT32_MAX : (int32_t)value;
}

GETTER(fmi3GetInt32, fmi3Int32, int32_t, APNC_INTEGER)
GETTER(fmi3GetInt64, fmi3Int64, int32_t, APNC_ENUMERATION)
GETTER(fmi3GetBoolean, fmi3Boolean, int32_t, APNC_BOOLEAN)
SETTER(fmi3SetFloat64, fmi3Float64, double, APNC_REAL, as_is)
SETTER(fmi3SetInt32, fmi3Int32, int32_t, APNC_INTEGER, as_integer)
SETTER(fmi3SetInt64, fmi3Int64, int32_t, APNC_ENUMERATION, as_item)
SETTER(fmi3SetBoolean, fmi3Boolean, int32_t, APNC_BOOLEAN, as_flag)

fmi3Status fmi3GetFloat64(fmi3Instance instance, const fmi3ValueReference vr[], size_t nvr,
                          fmi3Float64 values[], size_t nValues) {
    fmu *f = (fmu *)instance;
    fmi3Status status = check_access(f, APNC_ANY, "fmi3GetFloat64", vr, nvr, values);
    EACH_VALUE("fmi3GetFloat64", APNC_REAL, {
        if (at == APNC_VR_TIME)
            values[next] = f->base.run->time;
        else
            status = (fmi3Status)apnc_get(&f->base, at, APNC_REAL, &values[next]);
    })
}

fmi3Status fmi3GetFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    fmu *f = (fmu *)instance;
    if (!allowed(f, APNC_ANY, "fmi3GetFMUState")) return fmi3Error;
    if (!FMUState) return fail(f, "fmi3GetFMUState", "FMUState is NULL");
    if (!*FMUState) *FMUState = malloc(apnc_saved_size());
    if (!*FMUState) return fail(f, "fmi3GetFMUState", "out of memory");
    apnc_save(&f->base, *FMUState);
    return fmi3OK;
}

fmi3Status fmi3SetFMUState(fmi3Instance instance, fmi3FMUState FMUState) {
    fmu *f = (fmu *)instance;
    if (!allowed(f, APNC_ANY, "fmi3SetFMUState")) return fmi3Error;
    if (!FMUState) return fail(f, "fmi3SetFMUState", "FMUState is NULL");
    return (fmi3Status)apnc_restore(&f->base, FMUState);
}

fmi3Status fmi3FreeFMUState(fmi3Instance instance, fmi3FMUState *FMUState) {
    fmu *f = (fmu *)instance;
    if (!allowed(f, APNC_ANY, "fmi3FreeFMUState")) return fmi3Error;
    if (!FMUState) return fmi3OK;
    free(*FMUState);
    *FMUState = NULL;
    return fmi3OK;
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance instance, fmi3FMUState FMUState, size_t *size) {
    fmu *f = (fmu *)instance;
    if (!allowed(f, APNC_ANY, "fmi3SerializedFMUStateSize")) return fmi3Error;
    if (!FMUState || !size) return fail(f, "fmi3SerializedFMUStateSize", "a pointer is NULL");
    *size = apnc_blob_size();
    return fmi3OK;
}

fmi3Status fmi3SerializeFMUState(fmi3Instance instance, fmi3FMUState FMUState,
                                 fmi3Byte serializedState[], size_t size) {
    fmu *f = (fmu *)instance;
    if (!allowed(f, APNC_ANY, "fmi3SerializeFMUState")) return fmi3Error;
    if (!FMUState || !serializedState) return fail(f, "fmi3SerializeFMUState", "a pointer is NULL");
    if (size < apnc_blob_size()) return fail(f, "fmi3SerializeFMUState", "buffer is too small");
    apnc_blob_write(FMUState, serializedState);
    return fmi3OK;
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance instance, const fmi3Byte serializedState[],
                                   size_t size, fmi3FMUState *FMUState) {
    fmu *f = (fmu *)instance;
    if (!allowed(f, APNC_ANY, "fmi3DeserializeFMUState")) return fmi3Error;
    if (!serializedState || !FMUState)
        return fail(f, "fmi3DeserializeFMUState", "a pointer is NULL");
    void *saved = malloc(apnc_saved_size());
    if (!saved) return fail(f, "fmi3DeserializeFMUState", "out of memory");
    if (apnc_blob_read(&f->base, serializedState, size, saved) != APNC_OK) {
        free(saved);
        return fmi3Error;
    }
    if (!*FMUState) {
        *FMUState = saved;
        return fmi3OK;
    }
    memcpy(*FMUState, saved, apnc_saved_size());
    free(saved);
    return fmi3OK;
}

fmi3Status fmi3DoStep(fmi3Instance instance, fmi3Float64 currentCommunicationPoint,
                      fmi3Float64 communicationStepSize,
                      fmi3Boolean noSetFMUStatePriorToCurrentPoint,
                      fmi3Boolean *eventHandlingNeeded, fmi3Boolean *terminateSimulation,
                      fmi3Boolean *earlyReturn, fmi3Float64 *lastSuccessfulTime) {
    fmu *f = (fmu *)instance;
    (void)noSetFMUStatePriorToCurrentPoint;
    if (!allowed(f, APNC_STEPPING, "fmi3DoStep")) return fmi3Error;
    if (!eventHandlingNeeded || !terminateSimulation || !earlyReturn || !lastSuccessfulTime)
        return fail(f, "fmi3DoStep", "a pointer is NULL");
    *eventHandlingNeeded = *terminateSimulation = *earlyReturn = fmi3False;
    const apnc_status status =
        apnc_step(&f->base, currentCommunicationPoint, communicationStepSize);
    *lastSuccessfulTime = f->base.run->time;
    return (fmi3Status)status;
}

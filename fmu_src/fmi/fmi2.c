/* FMI 2.0 co-simulation interface: life cycle, pointers and types of the standard. */
#include <stdlib.h>
#include <string.h>

#include "fmi2_standard.h"
#include "instance.h"

#ifndef APNC_GUID
#error "APNC_GUID must be the guid of the model description"
#endif

typedef struct {
    apnc_instance base; /* first, so that both pointers are one */
    char *name;
    fmi2CallbackFunctions callbacks;
} fmu;

static fmi2Status fail(fmu *f, const char *function, const char *why) {
    return (fmi2Status)apnc_refuse(&f->base, function, why);
}

static int allowed(fmu *f, int phases, const char *function) {
    return apnc_allowed((apnc_instance *)f, phases, function);
}

static void emit(apnc_instance *instance, apnc_status status, apnc_log category,
                 const char *message) {
    fmu *f = (fmu *)instance;
    f->callbacks.logger(f->callbacks.componentEnvironment, f->name, (fmi2Status)status,
                        apnc_log_names[category], message);
}

static void *allocate(const fmi2CallbackFunctions *callbacks, size_t size) {
    if (callbacks->allocateMemory && callbacks->freeMemory)
        return callbacks->allocateMemory(1, size);
    return calloc(1, size);
}

static void release(const fmi2CallbackFunctions *callbacks, void *memory) {
    if (callbacks->allocateMemory && callbacks->freeMemory)
        callbacks->freeMemory(memory);
    else
        free(memory);
}

static void *allocate_for(apnc_instance *instance, size_t size) {
    return allocate(&((fmu *)instance)->callbacks, size);
}

static void release_for(apnc_instance *instance, void *memory) {
    release(&((fmu *)instance)->callbacks, memory);
}

const char *fmi2GetTypesPlatform(void) { return fmi2TypesPlatform; }

const char *fmi2GetVersion(void) { return fmi2Version; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean loggingOn, size_t nCategories,
                               const fmi2String categories[]) {
    if (!allowed((fmu *)c, APNC_ANY, "fmi2SetDebugLogging")) return fmi2Error;
    return (fmi2Status)apnc_choose_logging((apnc_instance *)c, "fmi2SetDebugLogging", loggingOn,
                                           nCategories, categories);
}

/* Why an instance cannot be made, or NULL. */
static const char *obstacle(fmi2String name, fmi2Type type, fmi2String guid) {
    if (!name || !*name) return "instance name is missing";
    if (type != fmi2CoSimulation) return "this FMU is for co-simulation only";
    if (!guid || strcmp(guid, APNC_GUID) != 0)
        return "guid is not the one of this FMU: model description and binary do not match";
    return NULL;
}

fmi2Component fmi2Instantiate(fmi2String instanceName, fmi2Type fmuType, fmi2String fmuGUID,
                              fmi2String fmuResourceLocation,
                              const fmi2CallbackFunctions *functions, fmi2Boolean visible,
                              fmi2Boolean loggingOn) {
    static const fmi2CallbackFunctions none = {NULL, NULL, NULL, NULL, NULL};
    const fmi2CallbackFunctions *callbacks = functions ? functions : &none;
    const char *why = obstacle(instanceName, fmuType, fmuGUID);
    (void)fmuResourceLocation;
    (void)visible;
    if (why) {
        if (callbacks->logger)
            callbacks->logger(callbacks->componentEnvironment, instanceName ? instanceName : "",
                              fmi2Error, apnc_log_names[APNC_LOG_ERROR], why);
        return NULL;
    }
    const size_t length = strlen(instanceName) + 1;
    fmu *f = allocate(callbacks, sizeof *f + apnc_instance_room());
    if (!f) return NULL;
    memset(f, 0, sizeof *f); /* an importer's allocateMemory may forget to */
    f->name = allocate(callbacks, length);
    if (!f->name) {
        release(callbacks, f);
        return NULL;
    }
    memcpy(f->name, instanceName, length);
    f->callbacks = *callbacks;
    if (callbacks->logger) f->base.emit = emit;
    f->base.allocate = allocate_for;
    f->base.release = release_for;
    for (int k = 0; k < APNC_LOG_CATEGORIES; k++) f->base.logging[k] = loggingOn != fmi2False;
    apnc_instance_settle(&f->base, f + 1);
    return f;
}

void fmi2FreeInstance(fmi2Component c) {
    fmu *f = (fmu *)c;
    if (!f) return;
    const fmi2CallbackFunctions callbacks = f->callbacks;
    apnc_instance_leave(&f->base);
    release(&callbacks, f->name);
    release(&callbacks, f);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean toleranceDefined, fmi2Real tolerance,
                               fmi2Real startTime, fmi2Boolean stopTimeDefined, fmi2Real stopTime) {
    fmu *f = (fmu *)c;
    (void)toleranceDefined;
    (void)tolerance;
    if (!allowed(f, APNC_INSTANTIATED, "fmi2SetupExperiment")) return fmi2Error;
    return (fmi2Status)apnc_set_times(&f->base, "fmi2SetupExperiment", startTime, stopTimeDefined,
                                      stopTime);
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
    fmu *f = (fmu *)c;
    if (!allowed(f, APNC_INSTANTIATED, "fmi2EnterInitializationMode")) return fmi2Error;
    f->base.run->phase = APNC_INITIALIZATION;
    return fmi2OK;
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
    fmu *f = (fmu *)c;
    if (!allowed(f, APNC_INITIALIZATION, "fmi2ExitInitializationMode")) return fmi2Error;
    return (fmi2Status)apnc_start(&f->base);
}

fmi2Status fmi2Terminate(fmi2Component c) {
    fmu *f = (fmu *)c;
    if (!allowed(f, APNC_STEPPING, "fmi2Terminate")) return fmi2Error;
    f->base.run->phase = APNC_TERMINATED;
    return fmi2OK;
}

fmi2Status fmi2Reset(fmi2Component c) {
    fmu *f = (fmu *)c;
    if (!allowed(f, APNC_ANY, "fmi2Reset")) return fmi2Error;
    apnc_clear(&f->base);
    return fmi2OK;
}

/* Common part of all access to values; nvr values, or none at all. */
static fmi2Status access(fmu *f, int phases, const char *function, const fmi2ValueReference vr[],
                         size_t nvr, const void *value) {
    if (!allowed(f, phases, function)) return fmi2Error;
    if (nvr && (!vr || !value)) return fail(f, function, "a pointer is NULL");
    return fmi2OK;
}

#define GETTER(function, fmi_type, type)                                                           \
    fmi2Status function(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,                \
                        fmi_type value[]) {                                                        \
        fmi2Status status = access((fmu *)c, APNC_READABLE, #function, vr, nvr, value);            \
        for (size_t i = 0; i < nvr && status == fmi2OK; i++)                                       \
            status = (fmi2Status)apnc_get((apnc_instance *)c, vr[i], type, &value[i]);             \
        return status;                                                                             \
    }

#define SETTER(function, fmi_type, type)                                                           \
    fmi2Status function(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,                \
                        const fmi_type value[]) {                                                  \
        fmi2Status status = access((fmu *)c, APNC_WRITABLE, #function, vr, nvr, value);            \
        for (size_t i = 0; i < nvr && status == fmi2OK; i++)                                       \
            status = (fmi2Status)apnc_set((apnc_instance *)c, vr[i], type, &value[i]);             \
        return status;                                                                             \
    }

GETTER(fmi2GetReal, fmi2Real, APNC_REAL)
GETTER(fmi2GetInteger, fmi2Integer, APNC_INTEGER)
GETTER(fmi2GetBoolean, fmi2Boolean, APNC_BOOLEAN)
SETTER(fmi2SetReal, fmi2Real, APNC_REAL)
SETTER(fmi2SetInteger, fmi2Integer, APNC_INTEGER)
SETTER(fmi2SetBoolean, fmi2Boolean, APNC_BOOLEAN)

static fmi2Status no_strings(fmu *f, int phases, const char *function, size_t nvr) {
    if (!allowed(f, phases, function)) return fmi2Error;
    return nvr ? fail(f, function, "this FMU has no String variables") : fmi2OK;
}

fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         fmi2String value[]) {
    (void)vr;
    (void)value;
    return no_strings((fmu *)c, APNC_READABLE, "fmi2GetString", nvr);
}

fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                         const fmi2String value[]) {
    (void)vr;
    (void)value;
    return no_strings((fmu *)c, APNC_WRITABLE, "fmi2SetString", nvr);
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    fmu *f = (fmu *)c;
    if (!allowed(f, APNC_ANY, "fmi2GetFMUstate")) return fmi2Error;
    if (!FMUstate) return fail(f, "fmi2GetFMUstate", "FMUstate is NULL");
    if (!*FMUstate) *FMUstate = allocate(&f->callbacks, apnc_saved_size());
    if (!*FMUstate) return fail(f, "fmi2GetFMUstate", "out of memory");
    apnc_save(&f->base, *FMUstate);
    return fmi2OK;
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate FMUstate) {
    fmu *f = (fmu *)c;
    if (!allowed(f, APNC_ANY, "fmi2SetFMUstate")) return fmi2Error;
    if (!FMUstate) return fail(f, "fmi2SetFMUstate", "FMUstate is NULL");
    return (fmi2Status)apnc_restore(&f->base, FMUstate);
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate *FMUstate) {
    fmu *f = (fmu *)c;
    if (!allowed(f, APNC_ANY, "fmi2FreeFMUstate")) return fmi2Error;
    if (!FMUstate || !*FMUstate) return fmi2OK;
    release(&f->callbacks, *FMUstate);
    *FMUstate = NULL;
    return fmi2OK;
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate FMUstate, size_t *size) {
    fmu *f = (fmu *)c;
    if (!allowed(f, APNC_ANY, "fmi2SerializedFMUstateSize")) return fmi2Error;
    if (!FMUstate || !size) return fail(f, "fmi2SerializedFMUstateSize", "a pointer is NULL");
    *size = apnc_blob_size();
    return fmi2OK;
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate FMUstate, fmi2Byte serializedState[],
                                 size_t size) {
    fmu *f = (fmu *)c;
    if (!allowed(f, APNC_ANY, "fmi2SerializeFMUstate")) return fmi2Error;
    if (!FMUstate || !serializedState) return fail(f, "fmi2SerializeFMUstate", "a pointer is NULL");
    if (size < apnc_blob_size()) return fail(f, "fmi2SerializeFMUstate", "buffer is too small");
    apnc_blob_write(FMUstate, (unsigned char *)serializedState);
    return fmi2OK;
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte serializedState[], size_t size,
                                   fmi2FMUstate *FMUstate) {
    fmu *f = (fmu *)c;
    if (!allowed(f, APNC_ANY, "fmi2DeSerializeFMUstate")) return fmi2Error;
    if (!serializedState || !FMUstate)
        return fail(f, "fmi2DeSerializeFMUstate", "a pointer is NULL");
    void *saved = allocate(&f->callbacks, apnc_saved_size());
    if (!saved) return fail(f, "fmi2DeSerializeFMUstate", "out of memory");
    if (apnc_blob_read(&f->base, (const unsigned char *)serializedState, size, saved) != APNC_OK) {
        release(&f->callbacks, saved);
        return fmi2Error;
    }
    if (!*FMUstate) {
        *FMUstate = saved;
        return fmi2OK;
    }
    memcpy(*FMUstate, saved, apnc_saved_size());
    release(&f->callbacks, saved);
    return fmi2OK;
}

fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference vUnknown_ref[],
                                        size_t nUnknown, const fmi2ValueReference vKnown_ref[],
                                        size_t nKnown, const fmi2Real dvKnown[],
                                        fmi2Real dvUnknown[]) {
    fmu *f = (fmu *)c;
    (void)vUnknown_ref;
    (void)nUnknown;
    (void)vKnown_ref;
    (void)nKnown;
    (void)dvKnown;
    (void)dvUnknown;
    return f ? fail(f, "fmi2GetDirectionalDerivative", "not offered by this FMU") : fmi2Error;
}

fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                       const fmi2Integer order[], const fmi2Real value[]) {
    fmu *f = (fmu *)c;
    (void)vr;
    (void)order;
    (void)value;
    if (!allowed(f, APNC_INITIALIZATION | APNC_STEPPING, "fmi2SetRealInputDerivatives"))
        return fmi2Error;
    return nvr ? fail(f, "fmi2SetRealInputDerivatives", "inputs are held between ticks") : fmi2OK;
}

fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference vr[], size_t nvr,
                                        const fmi2Integer order[], fmi2Real value[]) {
    fmu *f = (fmu *)c;
    (void)vr;
    (void)order;
    (void)value;
    if (!allowed(f, APNC_STEPPING | APNC_TERMINATED, "fmi2GetRealOutputDerivatives"))
        return fmi2Error;
    return nvr ? fail(f, "fmi2GetRealOutputDerivatives", "outputs are held between ticks") : fmi2OK;
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real currentCommunicationPoint,
                      fmi2Real communicationStepSize,
                      fmi2Boolean noSetFMUStatePriorToCurrentPoint) {
    fmu *f = (fmu *)c;
    (void)noSetFMUStatePriorToCurrentPoint;
    if (!allowed(f, APNC_STEPPING, "fmi2DoStep")) return fmi2Error;
    return (fmi2Status)apnc_step(&f->base, currentCommunicationPoint, communicationStepSize);
}

fmi2Status fmi2CancelStep(fmi2Component c) {
    fmu *f = (fmu *)c;
    return f ? fail(f, "fmi2CancelStep", "steps are never pending") : fmi2Error;
}

/* Steps never stay pending, so of the status questions only two have an answer. */
static fmi2Status status_of(fmu *f, const char *function, const void *value, int answered) {
    if (!allowed(f, APNC_STEPPING | APNC_TERMINATED, function)) return fmi2Error;
    if (!value) return fail(f, function, "value is NULL");
    return answered ? fmi2OK : fmi2Discard;
}

fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind s, fmi2Status *value) {
    (void)s;
    return status_of((fmu *)c, "fmi2GetStatus", value, 0);
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind s, fmi2Real *value) {
    fmu *f = (fmu *)c;
    const fmi2Status status = status_of(f, "fmi2GetRealStatus", value, s == fmi2LastSuccessfulTime);
    if (status == fmi2OK) *value = f->base.run->time;
    return status;
}

fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind s, fmi2Integer *value) {
    (void)s;
    return status_of((fmu *)c, "fmi2GetIntegerStatus", value, 0);
}

fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind s, fmi2Boolean *value) {
    const fmi2Status status =
        status_of((fmu *)c, "fmi2GetBooleanStatus", value, s == fmi2Terminated);
    if (status == fmi2OK) *value = fmi2False;
    return status;
}

fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind s, fmi2String *value) {
    (void)s;
    return status_of((fmu *)c, "fmi2GetStringStatus", value, 0);
}

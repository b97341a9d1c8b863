/* Functions of FMI 3.0 that this FMU does not offer. Importers look for all of them. */
#include "fmi3_standard.h"
#include "instance.h"

#if defined(__GNUC__)
#pragma GCC diagnostic ignored "-Wunused-parameter" /* a refusal looks at no argument */
#endif

static fmi3Status refuse(fmi3Instance instance, const char *function) {
    if (!instance) return fmi3Error;
    return (fmi3Status)apnc_report((apnc_instance *)instance, APNC_ERROR, APNC_LOG_ERROR,
                                   "%s: not offered by this FMU", function);
}

#define NOT_OFFERED(name, ...)                                                                     \
    fmi3Status name(fmi3Instance instance, __VA_ARGS__) { return refuse(instance, #name); }

#define NOT_OFFERED_PLAIN(name)                                                                    \
    fmi3Status name(fmi3Instance instance) { return refuse(instance, #name); }

/* No variable has this type. */
#define NO_SUCH_TYPE(type)                                                                         \
    NOT_OFFERED(fmi3Get##type, const fmi3ValueReference vr[], size_t nvr, fmi3##type values[],     \
                size_t nValues)                                                                    \
    NOT_OFFERED(fmi3Set##type, const fmi3ValueReference vr[], size_t nvr,                          \
                const fmi3##type values[], size_t nValues)

NO_SUCH_TYPE(Float32)
NO_SUCH_TYPE(Int8)
NO_SUCH_TYPE(UInt8)
NO_SUCH_TYPE(Int16)
NO_SUCH_TYPE(UInt16)
NO_SUCH_TYPE(UInt32)
NO_SUCH_TYPE(UInt64)
NO_SUCH_TYPE(String)

NOT_OFFERED(fmi3GetBinary, const fmi3ValueReference vr[], size_t nvr, size_t sizes[],
            fmi3Binary values[], size_t nValues)
NOT_OFFERED(fmi3SetBinary, const fmi3ValueReference vr[], size_t nvr, const size_t sizes[],
            const fmi3Binary values[], size_t nValues)

/* Clocks. */
NOT_OFFERED(fmi3GetClock, const fmi3ValueReference vr[], size_t nvr, fmi3Clock values[])
NOT_OFFERED(fmi3SetClock, const fmi3ValueReference vr[], size_t nvr, const fmi3Clock values[])
NOT_OFFERED(fmi3GetIntervalDecimal, const fmi3ValueReference vr[], size_t nvr,
            fmi3Float64 intervals[], fmi3IntervalQualifier qualifiers[])
NOT_OFFERED(fmi3GetIntervalFraction, const fmi3ValueReference vr[], size_t nvr,
            fmi3UInt64 counters[], fmi3UInt64 resolutions[], fmi3IntervalQualifier qualifiers[])
NOT_OFFERED(fmi3GetShiftDecimal, const fmi3ValueReference vr[], size_t nvr, fmi3Float64 shifts[])
NOT_OFFERED(fmi3GetShiftFraction, const fmi3ValueReference vr[], size_t nvr, fmi3UInt64 counters[],
            fmi3UInt64 resolutions[])
NOT_OFFERED(fmi3SetIntervalDecimal, const fmi3ValueReference vr[], size_t nvr,
            const fmi3Float64 intervals[])
NOT_OFFERED(fmi3SetIntervalFraction, const fmi3ValueReference vr[], size_t nvr,
            const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
NOT_OFFERED(fmi3SetShiftDecimal, const fmi3ValueReference vr[], size_t nvr,
            const fmi3Float64 shifts[])
NOT_OFFERED(fmi3SetShiftFraction, const fmi3ValueReference vr[], size_t nvr,
            const fmi3UInt64 counters[], const fmi3UInt64 resolutions[])
NOT_OFFERED(fmi3ActivateModelPartition, fmi3ValueReference clock, fmi3Float64 time)

/* Events and configuration. */
NOT_OFFERED_PLAIN(fmi3EnterEventMode)
NOT_OFFERED_PLAIN(fmi3EnterStepMode)
NOT_OFFERED_PLAIN(fmi3EnterConfigurationMode)
NOT_OFFERED_PLAIN(fmi3ExitConfigurationMode)
NOT_OFFERED_PLAIN(fmi3EvaluateDiscreteStates)
NOT_OFFERED(fmi3UpdateDiscreteStates, fmi3Boolean *needUpdate, fmi3Boolean *terminate,
            fmi3Boolean *nominalsChanged, fmi3Boolean *valuesChanged, fmi3Boolean *timeDefined,
            fmi3Float64 *nextEventTime)

/* Derivatives and dependencies. */
NOT_OFFERED(fmi3GetNumberOfVariableDependencies, fmi3ValueReference vr, size_t *nDependencies)
NOT_OFFERED(fmi3GetVariableDependencies, fmi3ValueReference dependent, size_t dependentElements[],
            fmi3ValueReference independents[], size_t independentElements[],
            fmi3DependencyKind kinds[], size_t nDependencies)
NOT_OFFERED(fmi3GetDirectionalDerivative, const fmi3ValueReference unknowns[], size_t nUnknowns,
            const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
            size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)
NOT_OFFERED(fmi3GetAdjointDerivative, const fmi3ValueReference unknowns[], size_t nUnknowns,
            const fmi3ValueReference knowns[], size_t nKnowns, const fmi3Float64 seed[],
            size_t nSeed, fmi3Float64 sensitivity[], size_t nSensitivity)
NOT_OFFERED(fmi3GetOutputDerivatives, const fmi3ValueReference vr[], size_t nvr,
            const fmi3Int32 orders[], fmi3Float64 values[], size_t nValues)

/* Model exchange. */
NOT_OFFERED_PLAIN(fmi3EnterContinuousTimeMode)
NOT_OFFERED(fmi3CompletedIntegratorStep, fmi3Boolean noSet, fmi3Boolean *enterEventMode,
            fmi3Boolean *terminate)
NOT_OFFERED(fmi3SetTime, fmi3Float64 time)
NOT_OFFERED(fmi3SetContinuousStates, const fmi3Float64 states[], size_t n)
NOT_OFFERED(fmi3GetContinuousStateDerivatives, fmi3Float64 derivatives[], size_t n)
NOT_OFFERED(fmi3GetEventIndicators, fmi3Float64 indicators[], size_t n)
NOT_OFFERED(fmi3GetContinuousStates, fmi3Float64 states[], size_t n)
NOT_OFFERED(fmi3GetNominalsOfContinuousStates, fmi3Float64 nominals[], size_t n)
NOT_OFFERED(fmi3GetNumberOfEventIndicators, size_t *n)
NOT_OFFERED(fmi3GetNumberOfContinuousStates, size_t *n)

fmi3Instance fmi3InstantiateModelExchange(fmi3String instanceName, fmi3String instantiationToken,
                                          fmi3String resourcePath, fmi3Boolean visible,
                                          fmi3Boolean loggingOn,
                                          fmi3InstanceEnvironment instanceEnvironment,
                                          fmi3LogMessageCallback logMessage) {
    if (logMessage)
        logMessage(instanceEnvironment, fmi3Error, apnc_log_names[APNC_LOG_ERROR],
                   "this FMU is for co-simulation only");
    return NULL;
}

fmi3Instance fmi3InstantiateScheduledExecution(
    fmi3String instanceName, fmi3String instantiationToken, fmi3String resourcePath,
    fmi3Boolean visible, fmi3Boolean loggingOn, fmi3InstanceEnvironment instanceEnvironment,
    fmi3LogMessageCallback logMessage, fmi3ClockUpdateCallback clockUpdate,
    fmi3LockPreemptionCallback lockPreemption, fmi3UnlockPreemptionCallback unlockPreemption) {
    if (logMessage)
        logMessage(instanceEnvironment, fmi3Error, apnc_log_names[APNC_LOG_ERROR],
                   "this FMU is for co-simulation only");
    return NULL;
}

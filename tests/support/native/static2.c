/* Steps a statically linked FMI 2.0 build, whose functions carry FMI2_FUNCTION_PREFIX, over the
 * loads of importer.h and prints the bits of its first outputs. Compiled once per build. */
#include "importer.h"

#include "fmi2_standard.h"
#include "instance.h"

#define RUN_JOINED(prefix) prefix##run
#define RUN(prefix)        RUN_JOINED(prefix)

int RUN(FMI2_FUNCTION_PREFIX)(long ticks, unsigned hip) {
    fmi2ValueReference in[APNC_LEGS], out[APNC_LEGS];
    fmi2Real values[APNC_LEGS];
    uint64_t seed = 1;
    const fmi2CallbackFunctions callbacks = {NULL, NULL, NULL, NULL, NULL};
    for (unsigned i = 0; i < APNC_LEGS; i++) {
        in[i] = i;
        out[i] = hip + i;
    }
    fmi2Component c =
        fmi2Instantiate("static", fmi2CoSimulation, APNC_GUID, NULL, &callbacks, 0, 0);
    if (!c || fmi2SetupExperiment(c, 0, 0.0, 0.0, 0, 0.0) || fmi2EnterInitializationMode(c) ||
        fmi2ExitInitializationMode(c))
        return 1;
    for (long tick = 0; tick < ticks; tick++) {
        for (int i = 0; i < APNC_LEGS; i++) values[i] = load(&seed, tick, i);
        if (fmi2SetReal(c, in, APNC_LEGS, values)) return 2;
        if (fmi2DoStep(c, (double)tick * TS, TS, fmi2True)) return 3;
        if (fmi2GetReal(c, out, APNC_LEGS, values)) return 4;
        show(values, APNC_LEGS);
    }
    fmi2FreeInstance(c);
    return 0;
}

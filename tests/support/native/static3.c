/* As static2.c for a build of FMI 3.0. */
#include "importer.h"

#include "fmi3_standard.h"
#include "instance.h"

#define RUN_JOINED(prefix) prefix##run
#define RUN(prefix)        RUN_JOINED(prefix)

int RUN(FMI3_FUNCTION_PREFIX)(long ticks, unsigned hip) {
    const fmi3ValueReference in = 0, out = hip;
    fmi3Float64 values[APNC_LEGS], last;
    fmi3Boolean event, terminate, early;
    uint64_t seed = 1;
    fmi3Instance c = fmi3InstantiateCoSimulation("static", APNC_GUID, NULL, 0, 0, 0, 0, NULL, 0,
                                                 NULL, NULL, NULL);
    if (!c || fmi3EnterInitializationMode(c, 0, 0.0, 0.0, 0, 0.0) || fmi3ExitInitializationMode(c))
        return 1;
    for (long tick = 0; tick < ticks; tick++) {
        for (int i = 0; i < APNC_LEGS; i++) values[i] = load(&seed, tick, i);
        if (fmi3SetFloat64(c, &in, 1, values, APNC_LEGS)) return 2;
        if (fmi3DoStep(c, (double)tick * TS, TS, fmi3True, &event, &terminate, &early, &last))
            return 3;
        if (fmi3GetFloat64(c, &out, 1, values, APNC_LEGS)) return 4;
        show(values, APNC_LEGS);
    }
    fmi3FreeInstance(c);
    return 0;
}

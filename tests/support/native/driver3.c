/* As driver.c, for a library of FMI 3.0, whose variables are arrays.
 *
 * driver3 LIBRARY TOKEN TICKS LOADS LEGS VALUES M (REFERENCE VALUE)*M OUTPUT...
 * with the reference of the loads and their number, the number of values of all outputs together,
 * M enumerations set in initialization mode, and the outputs to print, all by value reference.
 */
/* The standard's header declares functions without a prototype. */
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wstrict-prototypes"
#include "fmi3FunctionTypes.h"
#pragma GCC diagnostic pop

#include "importer.h"

static void check(fmi3Status status, const char *what) {
    if (status <= fmi3Warning) return;
    fprintf(stderr, "%s returned %d\n", what, (int)status);
    exit(1);
}

static void log_message(fmi3InstanceEnvironment environment, fmi3Status status, fmi3String category,
                        fmi3String message) {
    (void)environment;
    (void)status;
    fprintf(stderr, "[%s] %s\n", category, message);
}

int main(int argc, char **argv) {
    fmi3ValueReference setting[MOST], out[MOST];
    fmi3Int64 chosen[MOST];
    fmi3Float64 loads[MOST], values[MOST], last;
    fmi3Boolean event, terminate, early;
    uint64_t seed = 1;
    size_t n_out = 0;
    if (argc < 8) return 2;
    next = argv + 3;
    const long ticks = (long)number();
    const fmi3ValueReference in = (fmi3ValueReference)number();
    const size_t legs = count(), n_values = count(), n_settings = count();
    for (size_t i = 0; i < n_settings; i++) {
        setting[i] = (fmi3ValueReference)number();
        chosen[i] = (fmi3Int64)number();
    }
    while (*next && n_out < MOST) out[n_out++] = (fmi3ValueReference)number();

    open_or_exit(argv[1]);
#define GET(name) name##TYPE *name = (name##TYPE *)(uintptr_t)function(#name)
    GET(fmi3InstantiateCoSimulation);
    GET(fmi3EnterInitializationMode);
    GET(fmi3SetInt64);
    GET(fmi3ExitInitializationMode);
    GET(fmi3SetFloat64);
    GET(fmi3DoStep);
    GET(fmi3GetFloat64);
    GET(fmi3Terminate);
    GET(fmi3FreeInstance);

    fmi3Instance c =
        fmi3InstantiateCoSimulation("driver", argv[2], NULL, fmi3False, fmi3False, fmi3False,
                                    fmi3False, NULL, 0, NULL, log_message, NULL);
    if (!c) return 1;
    check(fmi3EnterInitializationMode(c, fmi3False, 0.0, 0.0, fmi3False, 0.0),
          "fmi3EnterInitializationMode");
    check(fmi3SetInt64(c, setting, n_settings, chosen, n_settings), "fmi3SetInt64");
    check(fmi3ExitInitializationMode(c), "fmi3ExitInitializationMode");
    for (long tick = 0; tick < ticks; tick++) {
        for (size_t i = 0; i < legs; i++) loads[i] = load(&seed, tick, (int)i);
        check(fmi3SetFloat64(c, &in, 1, loads, legs), "fmi3SetFloat64");
        check(fmi3DoStep(c, (double)tick * TS, TS, fmi3True, &event, &terminate, &early, &last),
              "fmi3DoStep");
        check(fmi3GetFloat64(c, out, n_out, values, n_values), "fmi3GetFloat64");
        show(values, n_values);
    }
    check(fmi3Terminate(c), "fmi3Terminate");
    fmi3FreeInstance(c);
    return 0;
}

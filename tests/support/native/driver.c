/* Loads an FMI 2.0 library as an importer does, steps it over loads that are the same everywhere
 * and prints the bits of every output after every tick.
 *
 * driver LIBRARY GUID TICKS MI N INPUT*N M (REFERENCE VALUE)*M OUTPUT...
 * with MI in thousandths, N inputs for loads and MI as the one after them, M integers set in
 * initialization mode, and the outputs to print, all by value reference.
 */
#include "fmi2FunctionTypes.h"
#include "importer.h"

#ifndef SCALE
#define SCALE 1.0 /* of the inputs */
#endif

static void check(fmi2Status status, const char *what) {
    if (status <= fmi2Warning) return;
    fprintf(stderr, "%s returned %d\n", what, (int)status);
    exit(1);
}

static void log_message(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                        fmi2String category, fmi2String message, ...) {
    (void)environment;
    (void)status;
    fprintf(stderr, "%s [%s] %s\n", name, category, message);
}

int main(int argc, char **argv) {
    fmi2ValueReference in[MOST], integer[MOST], out[MOST];
    fmi2Integer setting[MOST];
    fmi2Real loads[MOST], values[MOST];
    uint64_t seed = 1;
    size_t n_out = 0;
    if (argc < 8) return 2;
    next = argv + 3;
    const long ticks = (long)number();
    const fmi2Real MI = (double)number() / 1000.0;
    const size_t n_in = count();
    for (size_t i = 0; i <= n_in; i++) in[i] = (fmi2ValueReference)number();
    const size_t n_integer = count();
    for (size_t i = 0; i < n_integer; i++) {
        integer[i] = (fmi2ValueReference)number();
        setting[i] = (fmi2Integer)number();
    }
    while (*next && n_out < MOST) out[n_out++] = (fmi2ValueReference)number();

    open_or_exit(argv[1]);
#define GET(name) name##TYPE *name = (name##TYPE *)(uintptr_t)function(#name)
    GET(fmi2Instantiate);
    GET(fmi2SetupExperiment);
    GET(fmi2EnterInitializationMode);
    GET(fmi2SetInteger);
    GET(fmi2ExitInitializationMode);
    GET(fmi2SetReal);
    GET(fmi2DoStep);
    GET(fmi2GetReal);
    GET(fmi2Terminate);
    GET(fmi2FreeInstance);

    fmi2CallbackFunctions callbacks = {log_message, calloc, free, NULL, NULL};
    fmi2Component c = fmi2Instantiate("driver", fmi2CoSimulation, argv[2], NULL, &callbacks,
                                      fmi2False, fmi2False);
    if (!c) return 1;
    check(fmi2SetupExperiment(c, fmi2False, 0.0, 0.0, fmi2False, 0.0), "fmi2SetupExperiment");
    check(fmi2EnterInitializationMode(c), "fmi2EnterInitializationMode");
    check(fmi2SetInteger(c, integer, n_integer, setting), "fmi2SetInteger");
    check(fmi2ExitInitializationMode(c), "fmi2ExitInitializationMode");
    for (long tick = 0; tick < ticks; tick++) {
        for (size_t i = 0; i < n_in; i++) loads[i] = SCALE * load(&seed, tick, (int)i);
        loads[n_in] = MI;
        check(fmi2SetReal(c, in, n_in + 1, loads), "fmi2SetReal");
        check(fmi2DoStep(c, (double)tick * TS, TS, fmi2True), "fmi2DoStep");
        check(fmi2GetReal(c, out, n_out, values), "fmi2GetReal");
        show(values, n_out);
    }
    check(fmi2Terminate(c), "fmi2Terminate");
    fmi2FreeInstance(c);
    return 0;
}

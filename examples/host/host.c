/* Walks a robot with nothing but the C library: loads both FMUs that `apnc build-system` made,
 * steps them in a loop, and prints a line per tick: time [s], place [m], # for a foot on the
 * ground.
 *
 * host FOLDER SECONDS, where FOLDER is the system's, with each FMU unpacked in its place.
 */
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "fmi2FunctionTypes.h" /* of the standard: in the folder sources of every FMU */
#include "system.h"            /* of this system: apnc build-system wrote it */

#ifdef _WIN32
#include <windows.h>
#define OPEN(path)          LoadLibraryA(path)
#define FIND(library, name) GetProcAddress(library, name)
#else
#include <dlfcn.h>
#define OPEN(path)          dlopen(path, RTLD_NOW)
#define FIND(library, name) dlsym(library, name)
#endif
#define CALL(fmu, name)    ((name##TYPE *)must((uintptr_t)FIND((fmu)->library, #name), #name))
#define DO(fmu, name, ...) check(CALL(fmu, name)((fmu)->it, __VA_ARGS__), #name)

typedef struct {
    void *library;
    fmi2Component it;
} fmu;

static uintptr_t must(uintptr_t there, const char *what) {
    if (!there) fprintf(stderr, "host: %s failed\n", what), exit(1);
    return there;
}

static void check(fmi2Status status, const char *what) { must(status <= fmi2Warning, what); }

static void say(fmi2ComponentEnvironment environment, fmi2String name, fmi2Status status,
                fmi2String category, fmi2String message, ...) {
    (void)environment;
    if (status != fmi2OK) fprintf(stderr, "%s [%s] %s\n", name, category, message);
}

static void start(fmu *f, const char *folder, const struct system_fmu *s) {
    static const fmi2CallbackFunctions functions = {say, calloc, free, NULL, NULL};
    char path[4096];
    snprintf(path, sizeof path, SYSTEM_LIBRARY, folder, s->model, s->model);
    f->library = OPEN(path);
    must((uintptr_t)f->library, path);
    f->it = CALL(f, fmi2Instantiate)(s->model, fmi2CoSimulation, s->guid, NULL, &functions, 0, 0);
    must((uintptr_t)f->it, s->model);
    DO(f, fmi2SetupExperiment, 0, 0.0, 0.0, 0, 0.0);
    DO(f, fmi2SetReal, s->real, s->reals, s->real_values);
    DO(f, fmi2SetInteger, s->integer, s->integers, s->integer_values);
    DO(f, fmi2SetBoolean, s->boolean, s->booleans, s->boolean_values);
    check(CALL(f, fmi2EnterInitializationMode)(f->it), "fmi2EnterInitializationMode");
    check(CALL(f, fmi2ExitInitializationMode)(f->it), "fmi2ExitInitializationMode");
}

int main(int argc, char **argv) {
    const fmi2ValueReference place = plant_position_x;
    fmi2Real values[2 * SYSTEM_LEGS], x;
    fmu fmus[2];
    if (argc != 3) return fprintf(stderr, "host FOLDER SECONDS\n"), 2;
    for (int k = 0; k < 2; k++) start(&fmus[k], argv[1], &system_fmus[k]);
    const long ticks = (long)(atof(argv[2]) / SYSTEM_STEP + 0.5);
    printf("%9s %23s", "s", "m");
    for (int leg = 0; leg < SYSTEM_LEGS; leg++) printf(" %s", system_legs[leg]);
    for (long n = 0; n < ticks; n++) {
        for (int k = 0; k < 2; k++) {
            const struct system_fmu *s = &system_fmus[k];
            fmu *f = &fmus[k], *other = &fmus[1 - k];
            DO(other, fmi2GetReal, s->from, s->inputs, values);
            DO(f, fmi2SetReal, s->to, s->inputs, values);
            if (k == CONTROLLER) {
                DO(other, fmi2GetReal, &place, 1, &x);
                printf("\n%9.4f %23.17g", (double)n * SYSTEM_STEP, x);
                for (int leg = 0; leg < SYSTEM_LEGS; leg++)
                    printf(" %2s", values[leg] > 1.0 ? "#" : ".");
            }
            DO(f, fmi2DoStep, (double)n * SYSTEM_STEP, SYSTEM_STEP, fmi2True);
        }
    }
    printf("\n");
    return 0;
}

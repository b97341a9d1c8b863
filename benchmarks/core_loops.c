/* Loops that benchmarks/controller.py times: the core and any FMU's fmi2DoStep.
 *
 * Compiled with the controller's sources for one number of legs. Every loop returns something
 * that depends on all its results, so that none of it can be left out.
 */
#include <string.h>

#include "apnc.h"

#if defined(_WIN32)
#define EXPORT __declspec(dllexport)
#else
#define EXPORT __attribute__((visibility("default")))
#endif

typedef int (*do_step)(void *component, double t, double h, int no_set_state_prior);

static apnc_data data;
static apnc_state state;

/* Constant loads like those of standing legs; coupled: with a stored gait and kappa = 1. */
EXPORT void bench_start(int coupled) {
    apnc_defaults(&data);
    data.parameters.stored = coupled;
    for (int leg = 0; leg < APNC_LEGS; leg++)
        data.inputs.grf[leg] = data.parameters.robot_weight / APNC_LEGS * (0.8 + 0.01 * leg);
    for (int r = 0; r < APNC_RELATIONS; r++) data.parameters.phi_stored[r] = r % 2 ? 0.1 : 3.0;
    apnc_init(&data.parameters, &state, &data.outputs);
}

EXPORT double bench_core(int ticks) {
    double sum = 0.0;
    for (int n = 0; n < ticks; n++) {
        apnc_tick(&data.parameters, &state, &data.inputs, &data.outputs);
        sum += data.outputs.theta_hip[0];
    }
    return sum;
}

EXPORT int bench_steps(do_step step, void *component, double t, double h, int steps) {
    int worst = 0;
    for (int n = 0; n < steps; n++) {
        const int status = step(component, t + n * h, h, 1);
        if (status > worst) worst = status;
    }
    return worst;
}

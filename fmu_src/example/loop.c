/* The controller in a loop at its own rate on Linux; prints how late its ticks began.
 *
 * loop TICKS. Build: cc -O2 -I../core loop.c ../core/controller.c ../core/apnc_variables.c -lm
 * Replace read_loads and write_angles by the robot's own.
 */
#define _POSIX_C_SOURCE 200809L
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "apnc.h"

#define NANOSECONDS 1000000000L

/* Loads on the feet [N], RF, RH, LF, LH; NAN for a sensor that does not answer. */
static void read_loads(apnc_real *grf) {
    for (int leg = 0; leg < APNC_LEGS; leg++) grf[leg] = 6;
}

/* Joint commands relative to the robot's reference pose [rad]. */
static void write_angles(const apnc_real *theta_hip, const apnc_real *theta_knee) {
    (void)theta_hip;
    (void)theta_knee;
}

static struct timespec later(struct timespec t, long nanoseconds) {
    t.tv_nsec += nanoseconds;
    for (; t.tv_nsec >= NANOSECONDS; t.tv_nsec -= NANOSECONDS) t.tv_sec++;
    return t;
}

static double microseconds_since(struct timespec t) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)(now.tv_sec - t.tv_sec) * 1e6 + (double)(now.tv_nsec - t.tv_nsec) / 1e3;
}

int main(int argc, char **argv) {
    static apnc_data data;
    static apnc_state state;
    const long ticks = argc > 1 ? strtol(argv[1], NULL, 10) : 600;
    double sum = 0, most = 0, longest = 0;
    struct timespec due;

    apnc_defaults(&data);
    data.inputs.MI = (apnc_real)0.08;
    apnc_init(&data.parameters, &state, &data.outputs);
    clock_gettime(CLOCK_MONOTONIC, &due);
    for (long n = 0; n < ticks; n++) {
        due = later(due, (long)(data.parameters.Ts * NANOSECONDS));
        /* an absolute time: a late tick does not shift those after it */
        while (clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &due, NULL) == EINTR) continue;
        const double late = microseconds_since(due);
        read_loads(data.inputs.grf);
        apnc_tick(&data.parameters, &state, &data.inputs, &data.outputs);
        write_angles(data.outputs.theta_hip, data.outputs.theta_knee);
        const double took = microseconds_since(due) - late;
        sum += late;
        if (late > most) most = late;
        if (took > longest) longest = took;
    }
    printf("%ld ticks, late by %.0f us on average, %.0f us at most; a tick took %.0f us at most\n",
           (long)data.outputs.tick, ticks ? sum / (double)ticks : 0, most, longest);
    return 0;
}

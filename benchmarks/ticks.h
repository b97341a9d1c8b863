/* Python reads this header as it is, after plant.h. */
#ifndef TICKS_H
#define TICKS_H

#include "plant.h"

/* plant_command and plant_advance of the library that is timed. */
typedef void bench_command(void *plant, int32_t lane, const double *hip, const double *knee);
typedef void bench_advance(void *plant, const plant_ground *const *grounds, double duration,
                           double step);

/* Advance a plant; all of its lanes get the commands (legs numbers each) of every tick in turn.
 *
 * hip, knee: [rad], ticks times legs numbers; Ts: time of a tick [s]; step: longest integration
 * step [s]. */
void bench_ticks(bench_command *command, bench_advance *advance, void *plant, int32_t lanes,
                 int32_t legs, const plant_ground *const *grounds, const double *hip,
                 const double *knee, int32_t ticks, double Ts, double step);

#endif

/* Ticks of plants one after the other: a loop in Python would cost more than the plants do. */
#include "ticks.h"

void bench_ticks(bench_command *command, bench_advance *advance, void *plant, int32_t lanes,
                 int32_t legs, const plant_ground *const *grounds, const double *hip,
                 const double *knee, int32_t ticks, double Ts, double step) {
    for (int32_t n = 0; n < ticks; n++, hip += legs, knee += legs) {
        for (int32_t lane = 0; lane < lanes; lane++) command(plant, lane, hip, knee);
        advance(plant, grounds, Ts, step);
    }
}

/* Load cells in the feet, with delay, low-pass and noise, for any number of lanes.
 *
 * The load is read once per tick and arrives `delay` later. Between two readings it is interpolated
 * linearly; before the first it is zero. It then passes a first-order low-pass,
 * y += (1 - exp(-dt/T)) (x - y), which is the same filter at every tick length. Normally
 * distributed white noise is added. A load cell under a foot cannot pull, so the result is cut off
 * at zero. */
#ifndef PLANT_SENSOR_H
#define PLANT_SENSOR_H

#include "layout.h"
#include "random.h"

/* Store the newest loads of all legs in a ring buffer. */
INL void keep_loads(plant_header *h, const plant_parts *p, double *spans, const V *load,
                    double duration) {
    h->loads_last = (h->loads_last + 1) % h->history;
    if (h->loads_count < h->history) h->loads_count++;
    spans[h->loads_last] = duration;
    for (int32_t g = 0; g < p->groups; g++) p->loads[h->loads_last * p->groups + g] = load[g];
}

/* The newest entry that is at least as old as the delay, the next newer one, and the weight of the
 * latter in the interpolation between them [1]. */
INL double age_of_delay(const plant_header *h, const double *spans, int32_t *older,
                        int32_t *newer) {
    double left = h->delay;
    int32_t at = h->loads_last, count = h->loads_count;
    while (count > 1 && spans[at] <= left) {
        left -= spans[at];
        at = (at + h->history - 1) % h->history;
        count--;
    }
    *newer = at;
    *older = count > 1 ? (at + h->history - 1) % h->history : at;
    return count > 1 ? (spans[at] - left) / spans[at] : 1.0;
}

/* Share of the new value in the low-pass for ticks of this length [1]. */
INL void find_share(robot_numbers *n, double duration) {
    for (int robot = 0; robot < PLANT_ROBOTS_ABREAST; robot++) {
        if (B_AT(n->share_of, robot) == duration) continue;
        const double T = B_AT(n->time_constant, robot);
        B_AT(n->share_of, robot) = duration;
        B_AT(n->share, robot) = T > 0.0 ? plant_decay(duration / T) : 1.0;
    }
}

/* Noise of the sensors of a group of legs [1], standard normal. */
INL V noise_of(const plant_header *h, const plant_parts *p, int32_t group, V *second) {
    V first = v_all(0.0);
    double pair[2];
#ifdef PLANT_LEGS_ABREAST
    (void)second;
    for (int leg = 0; leg < legs_in(p, group); leg += 2) {
        const uint64_t index = h->readings[0] * 32u + (uint64_t)(group * PLANT_WIDTH + leg) / 2;
        random_normal_pair(h->seed[0], PLANT_RANDOM_SENSOR, index, pair);
        first[leg] = pair[0];
        first[leg + 1] = pair[1];
    }
#else
    (void)p;
    for (int robot = 0; robot < PLANT_ROBOTS_ABREAST; robot++) {
        const uint64_t index = h->readings[robot] * 32u + (uint64_t)group / 2;
        random_normal_pair(h->seed[robot], PLANT_RANDOM_SENSOR, index, pair);
        V_AT(first, robot) = pair[0];
        V_AT(*second, robot) = pair[1];
    }
#endif
    return first;
}

/* Read the loads at the end of a tick. */
INL void read_sensors(plant_header *h, const plant_parts *p, double *spans, const V *load,
                      double duration) {
    const V zero = v_all(0.0);
    int32_t older, newer;
    find_share(p->robot, duration);
    keep_loads(h, p, spans, load, duration);
    const double part = age_of_delay(h, spans, &older, &newer);
    const V share = wide(p->robot->share), deviation = wide(p->robot->deviation);
    V second = zero;
    for (int32_t g = 0; g < p->groups; g++) {
        leg_state *s = &p->state[g];
        const V before = p->loads[older * p->groups + g], after = p->loads[newer * p->groups + g];
        const V late = before + (after - before) * part;
        s->filtered += share * (late - s->filtered);
#ifdef PLANT_LEGS_ABREAST
        const V noise = noise_of(h, p, g, &second);
#else
        const V noise = g % 2 ? second : noise_of(h, p, g, &second);
#endif
        const V reading = v_max(zero, s->filtered + deviation * noise);
        s->reading = v_select(s->stuck == s->stuck, s->stuck, reading);
    }
    for (int robot = 0; robot < PLANT_ROBOTS_ABREAST; robot++) h->readings[robot]++;
}

#endif

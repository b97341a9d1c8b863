/* One control tick of a plant, for any number of lanes: commands, steps, sensors, fall. */
#ifndef PLANT_TICK_H
#define PLANT_TICK_H

#include "fall.h"
#include "sensor.h"

#define TICK_WILD 1e8  /* [m^2/s^2, rad^2/s^2] sum of squared speeds that means divergence */
#define TICK_NOW  1e-6 /* part of a tick within which two moments count as one */

/* Velocity Verlet: half a kick, a drift, accelerations, half a kick. */
INL void kick(const plant_parts *p, double h) {
    trunk_state *s = p->trunk;
    s->xd = b_add(s->xd, b_scale(b_all(h), s->xdd));
    s->yawd += h * s->yawdd;
    s->pitchd += h * s->pitchdd;
    s->rolld += h * s->rolldd;
    for (int32_t g = 0; g < p->groups; g++)
        for (int j = 0; j < 3; j++) p->state[g].qd[j] += h * p->state[g].qdd[j];
}

INL void drift(const plant_parts *p, double h) {
    trunk_state *s = p->trunk;
    s->x = b_add(s->x, b_scale(b_all(h), s->xd));
    s->yaw += h * s->yawd;
    s->pitch += h * s->pitchd;
    s->roll += h * s->rolld;
    for (int32_t g = 0; g < p->groups; g++)
        for (int j = 0; j < 3; j++) p->state[g].q[j] += h * p->state[g].qd[j];
}

/* Number of equal steps of at most `step` in a time. */
INL int64_t steps_in(double duration, double step) {
    const double wanted = ceil(duration / step - TICK_NOW);
    return wanted > 1.0 ? (int64_t)wanted : 1;
}

INL void integrate(const plant_parts *p, const plant_ground *const *grounds, double duration,
                   double step, double *last) {
    const int64_t steps = steps_in(duration, step);
    const double h = duration / (double)steps;
    for (int64_t i = 0; i < steps; i++) {
        kick(p, 0.5 * h);
        drift(p, h);
        accelerate(p, grounds, h);
        kick(p, 0.5 * h);
    }
    *last = h;
}

/* Make a command the target of the servos. */
INL void follow(const plant_parts *p, const V *targets) {
    for (int32_t g = 0; g < p->groups; g++)
        for (int j = 0; j < 3; j++) p->state[g].target[j] = targets[3 * g + j];
}

/* Integrate a tick; the commands whose latency has passed reach the servos. */
INL void integrate_tick(plant_header *h, const plant_parts *p, const plant_ground *const *grounds,
                        double *waits, double duration, double step, double *last) {
    double done = 0.0;
    while (h->coming_count && waits[h->coming_first] < duration * (1.0 - TICK_NOW)) {
        const int32_t first = h->coming_first;
        if (waits[first] > done + TICK_NOW * duration) {
            integrate(p, grounds, waits[first] - done, step, last);
            done = waits[first];
        }
        follow(p, p->coming + (size_t)first * 3 * (size_t)p->groups);
        h->coming_first = (first + 1) % h->history;
        h->coming_count--;
    }
    integrate(p, grounds, duration - done, step, last);
    for (int32_t i = 0; i < h->coming_count; i++)
        waits[(h->coming_first + i) % h->history] -= duration;
}

/* Send the command of this tick: 0 for damaged legs, changed no faster than the slew rate. */
INL void send_command(plant_header *h, const plant_parts *p, double *waits, double duration) {
    const V zero = v_all(0.0), slew = wide(p->robot->slew_rate), reach = slew * duration;
    if (h->coming_count == h->history) { /* the ticks are shorter than the plant was made for */
        follow(p, p->coming + (size_t)h->coming_first * 3 * (size_t)p->groups);
        h->coming_first = (h->coming_first + 1) % h->history;
        h->coming_count--;
    }
    const int32_t entry = (h->coming_first + h->coming_count) % h->history;
    V *sent = p->coming + (size_t)entry * 3 * (size_t)p->groups;
    for (int32_t g = 0; g < p->groups; g++) {
        leg_state *s = &p->state[g];
        for (int j = 0; j < 3; j++) {
            const V before = s->commanded[j], wanted = v_select(s->sound > zero, s->asked[j], zero);
            const V within = v_min(v_max(wanted, before - reach), before + reach);
            s->commanded[j] = v_select(slew > zero, within, wanted);
            sent[3 * g + j] = s->commanded[j];
        }
    }
    waits[entry] = h->latency;
    h->coming_count++;
}

/* Store torques, feet and forces at the present coordinates and speeds. */
INL void measure(const plant_parts *p, const plant_ground *const *grounds, const trunk_motion *t,
                 double dt, V *load) {
    const v3 w = wide3(t->w), v = wide3(t->v), x = wide3(p->trunk->x);
    const V norm = wide(p->robot->norm);
    const B stopping = dt * p->robot->per_foot_mass;
    for (int32_t g = 0; g < p->groups; g++) {
        leg_state *s = &p->state[g];
        const leg_motion m = leg_moves(p->any_axes, &p->leg[g], s->q, s->qd, w, v);
        const push ground = push_of_ground(p, grounds, t, &p->leg[g], &m, g, stopping);
        for (int j = 0; j < 3; j++)
            s->torque[j] =
                servo_torque(&p->leg[g].joint[j].servo, s->target[j] - s->q[j], s->qd[j]);
        s->foot = v_add(x, v_turn(&t->turn, m.foot));
        s->force = v_turn(&t->turn, about_x(m.c1, m.s1, ground.force));
        s->load = ground.load;
        const V length = v_sqrt(v_dot(s->force, s->force));
        load[g] = v_select(norm > 0.0, length, s->load);
    }
}

/* Whether a motion has diverged: its speeds are too high or not a number. */
INL B speeds_squared(const plant_parts *p) {
    const trunk_state *s = p->trunk;
    const B zero = b_all(0.0);
    B sum = b_dot(s->xd, s->xd) + s->yawd * s->yawd + s->pitchd * s->pitchd + s->rolld * s->rolld;
    sum += zero * (s->x.x + s->x.y + s->x.z + s->yaw + s->pitch + s->roll);
    for (int32_t g = 0; g < p->groups; g++) {
        const leg_state *l = &p->state[g];
        V part = v_all(0.0);
        for (int j = 0; j < 3; j++) part += l->qd[j] * l->qd[j] + 0.0 * l->q[j];
        add_up(p, g, &sum, &part, 1);
    }
    return sum;
}

INL void advance_tick(void *plant, const plant_ground *const *grounds, double duration,
                      double step) {
    plant_header *h = (plant_header *)plant;
    const plant_parts p = parts_of(plant);
    double *waits = (double *)((char *)plant + h->waits);
    double *spans = (double *)((char *)plant + h->spans);
    V load[64];
    double last = step;
    send_command(h, &p, waits, duration);
    integrate_tick(h, &p, grounds, waits, duration, step, &last);
    const trunk_motion t = trunk_moves(&p);
    measure(&p, grounds, &t, last, load);
    read_sensors(h, &p, spans, load, duration);
    const B speeds = speeds_squared(&p);
    for (int robot = 0; robot < PLANT_ROBOTS_ABREAST; robot++) {
        if (h->fares[robot] == PLANT_DIVERGED) continue;
        if (!(B_AT(speeds, robot) < TICK_WILD))
            h->fares[robot] = PLANT_DIVERGED;
        else if (h->fares[robot] == PLANT_WALKS && fallen(&p, grounds[robot], &t, robot))
            h->fares[robot] = PLANT_FELL;
    }
}

#endif

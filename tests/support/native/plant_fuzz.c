/* Random robots, grounds, commands, faults and ticks, senseless ones included.
 *
 * plant_fuzz SEED TICKS: prints how many ticks were taken and how robots ended. Built together with
 * the sources of the plant under AddressSanitizer and UBSan, which end the program on the first
 * fault. Every plant has a shadow: the robot of one of its lanes alone, in plain C, to which the
 * same is done; they must agree to the last bit. Pointers that are not valid, and numbers of legs
 * and entries that the plant was not made for, are left out. */
#include <stdio.h>

#include "plant_case.h"

enum { LANES = 8, ROOM = 1 << 23, CONTACTS = 64 };

/* One of the lanes, as the caller sees it. */
typedef struct {
    plant_robot robot;
    plant_leg leg[CASE_LEGS];
    case_ground ground;
    int placed; /* a robot is there */
    int tame;   /* its numbers are those of a robot */
    int32_t state;
} lane_case;

static long ticks, places, tunes, fell, diverged, walked, restored, damaged_bytes, refused;
static lane_case lane_of[LANES];
static const plant_ground *ground_of[LANES], *ground_of_shadow[1];

/* Where a round begins and what it is made of. */
typedef struct {
    int32_t kind, level, legs, contacts, history, lanes;
    int32_t shadowed; /* the lane that the shadow has, too */
    double latency, delay, Ts;
    size_t size, size_of_shadow;
    unsigned char *memory, *shadow;
} round_case;

static void fault(const char *what, const round_case *r, int32_t lane) {
    fprintf(stderr, "after %ld ticks: %s; kind %d level %d legs %d lane %d\n", ticks, what,
            (int)r->kind, (int)r->level, (int)r->legs, (int)lane);
    abort();
}

static double strange(void) {
    static const double numbers[] = {0.0,    -0.0,    NAN,  INFINITY, -INFINITY, 1e300, -1e300,
                                     1e-310, -5e-324, 1e16, -1e9,     1e6,       -1.0,  1e-9};
    return numbers[draw(sizeof numbers / sizeof *numbers)];
}

/* A ground of one's own with nonsense here and there; the same at the same place. */
static int32_t strange_touch(double x, double y, double z, double radius, const double *reals,
                             const int64_t *integers, double *found) {
    (void)integers;
    const uint64_t before = case_state;
    memcpy(&case_state, &x, sizeof case_state);
    const int32_t count = z < radius + reals[0] ? (int32_t)draw(5) : 0;
    for (int32_t i = 0; i < 4 * count; i++)
        found[i] = one_in(50) ? strange() : i % 4 == 2 ? 1.0 : 0.001 * (x + y);
    case_state = before;
    return count;
}

static void spoil(double *numbers, size_t bytes) {
    numbers[draw((uint32_t)(bytes / sizeof(double)))] = strange();
}

/* Make one or two numbers of a robot senseless; what the plant was made for stays. */
static void spoil_robot(plant_robot *robot, plant_leg *leg) {
    switch (draw(7)) {
    case 0:
        spoil(&robot->trunk.mass, sizeof robot->trunk);
        break;
    case 1:
        spoil(&robot->servo.stiffness, 5 * sizeof(double));
        break;
    case 2:
        spoil(&robot->contact.foot_radius, sizeof robot->contact);
        break;
    case 3:
        spoil(&robot->suspension.stiffness, sizeof robot->suspension);
        break;
    case 4:
        spoil(leg[draw((uint32_t)robot->legs)].mount, sizeof *leg);
        break;
    case 5:
        robot->gravity = strange();
        robot->sensor.time_constant = strange();
        break;
    default:
        robot->servo.slew_rate = strange();
        robot->sensor.noise = strange();
        robot->weight = strange();
    }
}

static void random_ground(case_ground *g, const round_case *r) {
    static const double soft = 0.004;
    const int32_t kind = r->contacts ? (int32_t)draw(5) : PLANT_PLANE;
    case_ground_of(g, kind == PLANT_OWN ? PLANT_PLANE : kind);
    if (kind == PLANT_OWN) {
        g->ground.kind = PLANT_OWN;
        g->ground.contacts = 4;
        g->ground.top = g->reals[0] = soft;
        g->ground.touch = strange_touch;
    }
    if (one_in(20)) g->ground.slope = strange();
}

/* Do something to the lane, and to the shadow if it has that lane. */
#define BOTH(r, lane, call)                                                                        \
    do {                                                                                           \
        void *at = (r)->memory;                                                                    \
        int32_t k = (lane);                                                                        \
        call;                                                                                      \
        if ((lane) == (r)->shadowed) {                                                             \
            at = (r)->shadow;                                                                      \
            k = 0;                                                                                 \
            call;                                                                                  \
        }                                                                                          \
    } while (0)

static void place(round_case *r, int32_t lane) {
    lane_case *l = &lane_of[lane];
    double start[6 + 3 * CASE_LEGS], found[4 * CONTACTS];
    const double angles[3] = {0.0, between(-0.2, 0.2), between(-0.2, 0.2)};
    case_robot(&l->robot, l->leg, r->legs, r->latency, r->delay);
    random_ground(&l->ground, r);
    if (l->ground.ground.contacts > CONTACTS) abort();
    l->tame = !one_in(3) && l->ground.ground.kind != PLANT_OWN &&
              l->ground.ground.slope * l->ground.ground.slope < 1.0;
    plant_start(&l->robot, &l->ground.ground, angles, between(-0.01, 0.05), found, start);
    if (!l->tame) spoil_robot(&l->robot, l->leg);
    if (!l->tame && r->lanes == 1 && one_in(5)) {
        l->robot.servo.latency = strange();
        l->robot.sensor.delay = strange();
    }
    if (!l->tame && one_in(5)) spoil(start, (size_t)(6 + 3 * r->legs) * sizeof *start);
    const uint64_t seed = ((uint64_t)draw(1u << 31) << 33) + draw(1000);
    const double height = one_in(5) ? 0.05 : 0.0;
    ground_of[lane] = &l->ground.ground;
    if (lane == r->shadowed) ground_of_shadow[0] = ground_of[lane];
    BOTH(r, lane, plant_place(at, k, &l->robot, ground_of[lane], seed, start, height, r->Ts));
    l->placed = 1;
    l->state = plant_state_of(r->memory, lane);
    places++;
}

static void tune(round_case *r, int32_t lane) {
    lane_case *l = &lane_of[lane];
    plant_leg leg[CASE_LEGS];
    plant_robot other;
    case_robot(&other, leg, r->legs, r->latency, r->delay);
    if (one_in(2)) {
        spoil_robot(&other, leg);
        l->tame = 0;
    }
    if (r->lanes == 1 && one_in(3)) {
        other.servo.latency = one_in(2) ? strange() : between(0.0, 0.2);
        other.sensor.delay = one_in(2) ? strange() : between(0.0, 0.2);
        l->tame = 0;
    }
    BOTH(r, lane, plant_tune(at, k, &other));
    tunes++;
}

static void set_conditions(round_case *r, int32_t lane) {
    uint8_t broken[CASE_LEGS];
    double stuck[CASE_LEGS];
    for (int32_t i = 0; i < r->legs; i++) {
        broken[i] = (uint8_t)one_in(4);
        stuck[i] = one_in(4) ? between(0.0, 10.0) : one_in(20) ? INFINITY : NAN;
    }
    plant_conditions c = {one_in(3) ? between(0.0, 0.5) : 0.0, one_in(4), between(0.0, 0.1),
                          one_in(2) ? broken : NULL, one_in(2) ? stuck : NULL};
    if (one_in(20)) c.grf_noise = strange();
    if (one_in(20)) c.held_at = strange();
    for (int32_t i = 0; c.stuck && i < r->legs; i++)
        if (isinf(stuck[i])) lane_of[lane].tame = 0;
    if (!(fabs(c.grf_noise) < 1.0 && fabs(c.held_at) < 1.0)) lane_of[lane].tame = 0;
    BOTH(r, lane, plant_set_conditions(at, k, &c));
}

static void command(round_case *r, int32_t lane, int tick) {
    double hip[CASE_LEGS], knee[CASE_LEGS];
    case_trot(r->legs, tick, 0.2, hip, knee);
    if (one_in(50)) hip[draw((uint32_t)r->legs)] = strange();
    if (one_in(50)) knee[draw((uint32_t)r->legs)] = strange();
    BOTH(r, lane, plant_command(at, k, hip, knee));
}

static int finite_to(const double *numbers, int32_t count, double most) {
    for (int32_t i = 0; i < count; i++)
        if (!(fabs(numbers[i]) <= most)) return 0;
    return 1;
}

static int same_bits(const double *a, const double *b, int32_t count) {
    for (int32_t i = 0; i < count; i++)
        if (memcmp(&a[i], &b[i], sizeof *a) != 0 && (a[i] == a[i] || b[i] == b[i])) return 0;
    return 1;
}

static void look_at(const round_case *r, int32_t lane) {
    lane_case *l = &lane_of[lane];
    double row[9 + 19 * CASE_LEGS], other[9 + 19 * CASE_LEGS], grf[CASE_LEGS];
    const int32_t state = plant_state_of(r->memory, lane), n = plant_sample_size(r->legs);
    plant_sample(r->memory, lane, row);
    plant_loads(r->memory, lane, grf);
    if (state < PLANT_WALKS || state > PLANT_DIVERGED) fault("no such state", r, lane);
    if (state < l->state) fault("a robot got up again", r, lane);
    if (state == PLANT_WALKS && !finite_to(row, 9 + 6 * r->legs, 1e300))
        fault("it walks without numbers", r, lane);
    if (state != PLANT_DIVERGED && !finite_to(row + 6, 3, 1e4)) fault("wild speed", r, lane);
    if (l->tame && state == PLANT_WALKS && !finite_to(row, n, 1e7))
        fault("a sensible robot has wild numbers", r, lane);
    for (int32_t i = 0; i < r->legs; i++)
        if (grf[i] < 0.0) fault("a load that pulls", r, lane);
    if (!same_bits(grf, row + 9 + 18 * r->legs, r->legs)) fault("two loads", r, lane);
    if (lane == r->shadowed) {
        plant_sample(r->shadow, 0, other);
        if (!same_bits(row, other, n) || plant_state_of(r->shadow, 0) != state)
            fault("a lane is not what it is alone", r, lane);
        plant_accelerations(r->memory, lane, row);
        plant_accelerations(r->shadow, 0, other);
        if (!same_bits(row, other, 6 + 3 * r->legs)) fault("two accelerations", r, lane);
    }
    if (state != l->state && state == PLANT_FELL) fell++;
    if (state != l->state && state == PLANT_DIVERGED) diverged++;
    walked += state == PLANT_WALKS;
    l->state = state;
}

/* Bytes that were stored, changed and put back are refused, or can be walked on with. */
static void damage(round_case *r) {
    unsigned char *copy = aligned_alloc(64, (r->size + 63) / 64 * 64);
    memcpy(copy, r->memory, r->size);
    const uint32_t header = 384, size = (uint32_t)(r->size < ROOM ? r->size : ROOM);
    for (int i = 0; i < 4; i++) copy[draw(one_in(2) ? header : size)] ^= (unsigned char)draw(256);
    if (plant_intact(copy, r->kind, r->level, r->legs, r->contacts, r->history)) {
        for (int i = 0; i < 3; i++) plant_advance(copy, ground_of, 0.01, 0.002);
        damaged_bytes++;
    } else {
        refused++;
    }
    free(copy);
}

/* The laws that other engines call, at coordinates by chance; and the load cells alone. */
static void call_the_laws(const round_case *r) {
    const lane_case *l = &lane_of[r->shadowed];
    double q[6 + 3 * CASE_LEGS], v[6 + 3 * CASE_LEGS], target[3 * CASE_LEGS], held[6];
    double work[3 * CASE_LEGS] = {0.0}, found[4 * CONTACTS];
    double out[6 + 13 * CASE_LEGS + 4 * CONTACTS], grf[CASE_LEGS];
    const int32_t size = 6 + 3 * r->legs;
    vector_between(q, size, -0.3, 0.3);
    vector_between(v, size, -3.0, 3.0);
    vector_between(target, size - 6, -0.3, 0.3);
    vector_between(held, 6, -0.1, 0.1);
    if (one_in(2)) spoil(one_in(2) ? q : v, (size_t)size * sizeof *q);
    plant_forces(&l->robot, &l->ground.ground, q, v, target, one_in(2) ? held : NULL, 0.1, 1e-3,
                 work, out);
    const int32_t fallen = plant_fallen(&l->robot, &l->ground.ground, q, found);
    if (fallen != 0 && fallen != 1) fault("neither fallen nor not", r, r->shadowed);
    void *memory = aligned_alloc(64, (plant_sensor_size(r->legs, r->history) + 63) / 64 * 64);
    plant_sensor_start(memory, r->legs, r->history, &l->robot.sensor, l->robot.weight, 1);
    for (int i = 0; i < 20; i++) plant_sensor_read(memory, between(1e-6, 0.1), target, grf);
    free(memory);
}

static void advance(round_case *r) {
    double duration = r->Ts, step = r->Ts / 16.0;
    if (one_in(4)) duration = between(1e-4, 0.05);
    if (one_in(50)) duration = between(1e-9, 1e-6);
    if (one_in(4)) step = between(5e-4, 0.05);
    plant_advance(r->memory, ground_of, duration, step);
    plant_advance(r->shadow, ground_of_shadow, duration, step);
    ticks++;
}

static round_case begin(void) {
    static const int32_t legs[] = {2, 3, 4, 5, 6, 8, 9, 64};
    round_case r;
    memset(&r, 0, sizeof r);
    r.kind = (int32_t)draw(3);
    r.level = (int32_t)draw((uint32_t)plant_best_level() + 1);
    r.legs = legs[draw(one_in(20) ? 8 : 7)];
    r.contacts = one_in(3) ? 0 : CONTACTS;
    r.Ts = 1.0 / 60.0;
    r.latency = one_in(2) ? 0.0 : between(0.0, 0.1);
    r.delay = one_in(2) ? 0.0 : between(0.0, 0.1);
    r.history = plant_history(r.latency, r.delay, r.Ts);
    r.lanes = plant_lanes(r.kind, r.level);
    r.shadowed = (int32_t)draw((uint32_t)r.lanes);
    r.size = plant_size(r.kind, r.level, r.legs, r.contacts, r.history);
    r.size_of_shadow = plant_size(PLANT_SCALAR, 0, r.legs, r.contacts, r.history);
    r.memory = aligned_alloc(64, (r.size + 63) / 64 * 64);
    r.shadow = aligned_alloc(64, (r.size_of_shadow + 63) / 64 * 64);
    plant_create(r.memory, r.kind, r.level, r.legs, r.contacts, r.history);
    plant_create(r.shadow, PLANT_SCALAR, 0, r.legs, r.contacts, r.history);
    for (int32_t lane = 0; lane < LANES; lane++) {
        lane_of[lane].placed = 0;
        ground_of[lane] = NULL;
    }
    return r;
}

static void do_round(void) {
    round_case r = begin();
    const int last = 20 + (int)draw(60);
    for (int tick = 0; tick < last; tick++) {
        for (int32_t lane = 0; lane < r.lanes; lane++) {
            if (tick ? one_in(60) : lane == r.shadowed || one_in(2)) place(&r, lane);
            if (!lane_of[lane].placed) continue;
            if (one_in(30)) tune(&r, lane);
            if (one_in(30)) set_conditions(&r, lane);
            if (!one_in(10)) command(&r, lane, tick);
        }
        if (one_in(20)) { /* elsewhere, as a caller that stores its bytes does */
            unsigned char *copy = aligned_alloc(64, (r.size + 63) / 64 * 64);
            memcpy(copy, r.memory, r.size);
            memset(r.memory, 0xff, r.size);
            free(r.memory);
            r.memory = copy;
            restored++;
        }
        advance(&r);
        for (int32_t lane = 0; lane < r.lanes; lane++)
            if (lane_of[lane].placed) look_at(&r, lane);
    }
    if (!plant_intact(r.memory, r.kind, r.level, r.legs, r.contacts, r.history))
        fault("own bytes are refused", &r, 0);
    damage(&r);
    call_the_laws(&r);
    free(r.memory);
    free(r.shadow);
}

int main(int argc, char **argv) {
    const long wanted = argc > 2 ? atol(argv[2]) : 0;
    case_state = argc > 1 ? strtoull(argv[1], NULL, 10) : 1;
    for (int i = 0; i < 10; i++) draw(2);
    while (ticks < wanted) do_round();
    printf("%ld ticks, %ld places, %ld tunes, %ld walked, %ld fell, %ld diverged, %ld restored, "
           "%ld damaged, %ld refused\n",
           ticks, places, tunes, walked, fell, diverged, restored, damaged_bytes, refused);
    return 0;
}

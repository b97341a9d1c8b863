/* Plants of all kinds: their memory, functions to put in and read out robots, and the plain way to
 * compute them. */
#define PLANT_KERNEL plant_kernel_scalar
#define PLANT_WIDTH  1
#include "kernel.h"

#include "foot_mass.h"
#include "numbers.h"
#include "step.h"
#include "targets.h"

static const plant_kernel *kernel_of(int32_t kind, int32_t level) {
#ifdef PLANT_ONE_ROBOT
    if (kind == PLANT_ROBOTS) return NULL;
#elif defined(PLANT_HAS_X86)
    if (kind == PLANT_ROBOTS && level == PLANT_AVX512) return &plant_kernel_robots_avx512;
    if (kind == PLANT_ROBOTS && level == PLANT_AVX2) return &plant_kernel_robots_avx2;
#endif
#ifdef PLANT_HAS_X86
    if (kind == PLANT_LEGS && level >= PLANT_AVX2) return &plant_kernel_legs_avx2;
#endif
#if defined(PLANT_HAS_VECTORS) && !defined(PLANT_ONE_ROBOT)
    if (kind == PLANT_ROBOTS) return &plant_kernel_robots;
#endif
#ifdef PLANT_HAS_VECTORS
    if (kind == PLANT_LEGS) return &plant_kernel_legs;
#endif
    (void)level;
    return kind >= PLANT_SCALAR && kind <= PLANT_ROBOTS ? &plant_kernel_scalar : NULL;
}

int32_t plant_lanes(int32_t kind, int32_t level) {
    const plant_kernel *kernel = kernel_of(kind, level);
    return kernel ? kernel->robots : 0;
}

const char *plant_level_name(int32_t level) {
    static const char *const names[] = {"baseline", "avx2", "avx512"};
    return level >= PLANT_BASELINE && level <= PLANT_AVX512 ? names[level] : "unknown";
}

static size_t aligned(size_t size) {
    return (size + PLANT_ALIGNMENT - 1) / PLANT_ALIGNMENT * PLANT_ALIGNMENT;
}

/* Offsets of the parts. The scratch memory of a kind with several lanes holds a plant of one robot.
 */
static plant_header layout(int32_t kind, int32_t level, int32_t legs, int32_t contacts,
                           int32_t history) {
    plant_header h;
    const plant_kernel *kernel = kernel_of(kind, level);
    memset(&h, 0, sizeof h);
    if (!kernel || legs < 2 || legs > 64 || contacts < 0 || history < 1) return h;
    h.kind = kind;
    h.level = level;
    h.legs = legs;
    h.contacts = contacts;
    h.history = history;
    h.width = kernel->width;
    h.robots = kernel->robots;
    h.groups = h.robots == h.width ? legs : (legs + h.width - 1) / h.width;
    const size_t width = (size_t)h.width, robots = (size_t)h.robots, groups = (size_t)h.groups;
    size_t at = aligned(sizeof h);
    const struct {
        size_t *place, size;
    } parts[] = {
        {&h.robot, robots * sizeof(robot_numbers)},
        {&h.leg, width * groups * sizeof(leg_numbers)},
        {&h.trunk, robots * sizeof(trunk_state)},
        {&h.state, width * groups * sizeof(leg_state)},
        {&h.kept, width * groups * sizeof(leg_kept)},
        {&h.coming, width * groups * 3 * (size_t)history * sizeof(double)},
        {&h.loads, width * groups * (size_t)history * sizeof(double)},
        {&h.found, width * 4 * (size_t)contacts * sizeof(double)},
        {&h.waits, (size_t)history * sizeof(double)},
        {&h.spans, (size_t)history * sizeof(double)},
    };
    for (size_t i = 0; i < sizeof parts / sizeof *parts; i++) {
        *parts[i].place = at;
        at = aligned(at + parts[i].size);
    }
    h.scratch = at;
    if (h.width > 1) at += layout(PLANT_SCALAR, PLANT_BASELINE, legs, contacts, 1).end;
    h.end = at;
    return h;
}

size_t plant_size(int32_t kind, int32_t level, int32_t legs, int32_t contacts, int32_t history) {
    return layout(kind, level, legs, contacts, history).end;
}

int32_t plant_history(double latency, double delay, double Ts) {
    const double entries = ceil((latency > delay ? latency : delay) / Ts) + 3.0;
    return entries < PLANT_MOST_ENTRIES ? (int32_t)entries : PLANT_MOST_ENTRIES;
}

void plant_create(void *memory, int32_t kind, int32_t level, int32_t legs, int32_t contacts,
                  int32_t history) {
    const plant_header h = layout(kind, level, legs, contacts, history);
    memset(memory, 0, h.end);
    memcpy(memory, &h, sizeof h);
    for (int32_t robot = 0; robot < h.robots; robot++)
        ((plant_header *)memory)->fares[robot] = PLANT_DIVERGED; /* the lane is empty */
    if (h.width > 1)
        plant_create((char *)memory + h.scratch, PLANT_SCALAR, PLANT_BASELINE, legs, contacts, 1);
}

void plant_use_level(void *plant, int32_t level) {
    plant_header *h = (plant_header *)plant;
    const plant_kernel *now = kernel_of(h->kind, h->level), *then = kernel_of(h->kind, level);
    if (now && then && now->width == then->width) h->level = level;
}

int32_t plant_intact(const void *memory, int32_t kind, int32_t level, int32_t legs,
                     int32_t contacts, int32_t history) {
    const plant_header own = layout(kind, level, legs, contacts, history);
    plant_header h;
    memcpy(&h, memory, sizeof h);
    if (h.coming_first < 0 || h.coming_first >= history) return 0;
    if (h.coming_count < 0 || h.coming_count > history) return 0;
    if (h.loads_last < 0 || h.loads_last >= history) return 0;
    if (h.loads_count < 1 || h.loads_count > history) return 0;
    if (h.any_axes != 0 && h.any_axes != 1) return 0;
    for (int32_t robot = 0; robot < own.robots; robot++)
        if (h.fares[robot] < PLANT_WALKS || h.fares[robot] > PLANT_DIVERGED) return 0;
    /* all other fields must be those of this layout */
    h.coming_first = h.coming_count = h.loads_last = h.loads_count = h.any_axes = 0;
    h.latency = h.delay = 0.0;
    memset(h.fares, 0, sizeof h.fares);
    memset(h.seed, 0, sizeof h.seed);
    memset(h.readings, 0, sizeof h.readings);
    return own.end && memcmp(&h, &own, sizeof h) == 0;
}

/* Number i of the struct of B at `part`, for a lane. */
static double *of_robot(void *plant, size_t part, size_t i, int32_t lane) {
    const plant_header *h = (const plant_header *)plant;
    return (double *)((char *)plant + part) + i * (size_t)h->robots + (size_t)lane;
}

/* First number of the struct of `count` numbers of V at `part`, for a leg of a lane. The other
 * numbers follow at a distance of `width`. */
static double *leg_at(void *plant, size_t part, size_t count, int32_t leg, int32_t lane) {
    const plant_header *h = (const plant_header *)plant;
    const int abreast = h->robots != h->width; /* the lanes are its legs */
    const int32_t group = abreast ? leg / h->width : leg, at = abreast ? leg % h->width : lane;
    return (double *)((char *)plant + part) + (size_t)group * count * (size_t)h->width + (size_t)at;
}

/* Number i of such a struct. */
static double *of_leg(void *plant, size_t part, size_t count, size_t i, int32_t leg, int32_t lane) {
    return leg_at(plant, part, count, leg, lane) + i * (size_t)((plant_header *)plant)->width;
}

#define PLACE_OF(type, field) (offsetof(type, field) / sizeof(double))
#define ROBOT(plant, field, lane)                                                                  \
    of_robot(plant, ((plant_header *)(plant))->robot, PLACE_OF(robot_numbers, field), lane)
#define TRUNK(plant, field, lane)                                                                  \
    of_robot(plant, ((plant_header *)(plant))->trunk, PLACE_OF(trunk_state, field), lane)
#define LEG(plant, field, leg, lane)                                                               \
    of_leg(plant, ((plant_header *)(plant))->state, NUMBERS_OF(leg_state),                         \
           PLACE_OF(leg_state, field), leg, lane)
#define NUMBER(plant, field, leg, lane)                                                            \
    of_leg(plant, ((plant_header *)(plant))->leg, NUMBERS_OF(leg_numbers),                         \
           PLACE_OF(leg_numbers, field), leg, lane)

/* Copy the robot of a plant with one lane into a lane of another plant. */
static void put(void *plant, int32_t lane, void *single) {
    const plant_header *h = (const plant_header *)plant, *s = (const plant_header *)single;
    const struct {
        size_t from, to, count;
    } once[] = {{s->robot, h->robot, NUMBERS_OF(robot_numbers)},
                {s->trunk, h->trunk, NUMBERS_OF(trunk_state)}},
      each[] = {{s->leg, h->leg, NUMBERS_OF(leg_numbers)},
                {s->state, h->state, NUMBERS_OF(leg_state)}};
    for (int k = 0; k < 2; k++)
        for (size_t i = 0; i < once[k].count; i++)
            *of_robot(plant, once[k].to, i, lane) = *of_robot(single, once[k].from, i, 0);
    /* lanes without a leg repeat the first leg and are not summed */
    const int32_t places = h->robots == h->width ? h->legs : h->groups * h->width;
    for (int k = 0; k < 2; k++)
        for (int32_t leg = 0; leg < places; leg++)
            for (size_t i = 0; i < each[k].count; i++)
                *of_leg(plant, each[k].to, each[k].count, i, leg, lane) =
                    *of_leg(single, each[k].from, each[k].count, i, leg < h->legs ? leg : 0, 0);
}

/* Which joint angle a joint has; a number of stored bytes may be any. */
static int angle_of(double number) { return number == 1.0 ? 1 : number == 2.0 ? 2 : 0; }

static int32_t places_of(const plant_header *h) {
    return h->robots == h->width ? h->legs : h->groups * h->width;
}

/* Fill the waiting commands with the start pose, one per tick, and the waiting readings with 0. */
static void start_under_way(void *plant, int32_t lane, double latency, double delay, double Ts) {
    plant_header *h = (plant_header *)plant;
    double *waits = (double *)((char *)plant + h->waits);
    if (h->latency != latency || h->delay != delay || !h->loads_count) {
        h->latency = latency;
        h->delay = delay;
        h->loads_last = 0;
        h->loads_count = 1;
        h->coming_first = h->coming_count = 0;
        double wait = latency - Ts;
        int32_t before = 0;
        for (; wait > TICK_NOW * Ts && before < h->history - 1; wait -= Ts) before++;
        wait = latency;
        for (int32_t i = before - 1; i >= 0; i--) waits[i] = (wait -= Ts);
        h->coming_count = before;
    }
    for (int32_t entry = 0; entry < h->history; entry++) {
        const size_t commands =
            h->coming + (size_t)entry * 3 * (size_t)h->groups * (size_t)h->width * sizeof(double);
        const size_t loads =
            h->loads + (size_t)entry * (size_t)h->groups * (size_t)h->width * sizeof(double);
        for (int32_t leg = 0; leg < places_of(h); leg++) {
            const int32_t real = leg < h->legs ? leg : 0;
            for (size_t j = 0; j < 3; j++)
                *of_leg(plant, commands, 3, j, leg, lane) = *LEG(plant, target[j], real, lane);
            *of_leg(plant, loads, 1, 0, leg, lane) = 0.0;
        }
    }
}

void plant_place(void *plant, int32_t lane, const plant_robot *robot, const plant_ground *ground,
                 uint64_t seed, const double *coordinates, double height, double Ts) {
    plant_header *h = (plant_header *)plant;
    void *single = h->width > 1 ? (char *)plant + h->scratch : plant;
    ((plant_header *)single)->any_axes = has_any_axes(robot);
    const plant_parts p = parts_of(single);
    V load[64];
    memset(p.robot, 0, sizeof *p.robot);
    memset(p.trunk, 0, sizeof *p.trunk);
    memset(p.state, 0, (size_t)p.groups * sizeof *p.state);
    set_robot(p.robot, robot, ground);
    for (int32_t leg = 0; leg < p.legs; leg++) set_leg(&p.leg[leg], robot, leg);
    set_start(&p, coordinates, height);
    p.robot->per_foot_mass = 1.0 / least_foot_mass(&p);
    accelerate(&p, &ground, 0.0);
    const trunk_motion t = trunk_moves(&p);
    measure(&p, &ground, &t, 0.0, load);
    if (single != plant) put(plant, lane, single);
    h->any_axes = p.any_axes || (h->robots > 1 && h->any_axes);
    start_under_way(plant, lane, robot->servo.latency, robot->sensor.delay, Ts);
    h->fares[lane] = fallen(&p, ground, &t, 0) ? PLANT_FELL : PLANT_WALKS;
    h->seed[lane] = seed;
    h->readings[lane] = 0;
}

void plant_tune(void *plant, int32_t lane, const plant_robot *robot) {
    plant_header *h = (plant_header *)plant;
    robot_numbers n;
    set_servo(&n, robot);
    n.contact = contact_of(&robot->contact);
    const double added = *ROBOT(plant, added, lane);
    n.half_weight = *ROBOT(plant, half_weight, lane);
    set_sensor(&n, &robot->sensor);
    n.deviation = s_sqrt(n.noise * n.noise + added * added);
#define TAKE(field) *ROBOT(plant, field, lane) = n.field
    TAKE(slew_rate);
    TAKE(passive);
    TAKE(contact.stiffness);
    TAKE(contact.damping);
    TAKE(contact.per_depth);
    TAKE(contact.friction);
    TAKE(contact.slow);
    TAKE(noise);
    TAKE(deviation);
    TAKE(norm);
    TAKE(time_constant);
#undef TAKE
    *ROBOT(plant, share_of, lane) = 0.0;
    for (int32_t place = 0; place < places_of(h); place++) {
        leg_numbers leg;
        set_leg(&leg, robot, place < h->legs ? place : 0);
        for (size_t i = PLACE_OF(leg_numbers, joint); i < NUMBERS_OF(leg_numbers); i++)
            *of_leg(plant, h->leg, NUMBERS_OF(leg_numbers), i, place, lane) =
                ((const double *)(const void *)&leg)[i];
    }
    h->latency = robot->servo.latency;
    h->delay = robot->sensor.delay;
}

void plant_set_conditions(void *plant, int32_t lane, const plant_conditions *conditions) {
    const plant_header *h = (const plant_header *)plant;
    const double half = *ROBOT(plant, half_weight, lane), own = *ROBOT(plant, noise, lane);
    const double added = conditions->grf_noise * half;
    *ROBOT(plant, added, lane) = added;
    *ROBOT(plant, deviation, lane) = s_sqrt(own * own + added * added);
    *TRUNK(plant, held, lane) = conditions->held ? 1.0 : 0.0;
    /* the trunk is held where it is now, but level and at a height above its start */
    for (size_t i = 0; i < 6; i++) *TRUNK(plant, pose[i], lane) = *TRUNK(plant, start[i], lane);
    *TRUNK(plant, pose[0], lane) = *TRUNK(plant, x.x, lane);
    *TRUNK(plant, pose[1], lane) = *TRUNK(plant, x.y, lane);
    *TRUNK(plant, pose[3], lane) = *TRUNK(plant, yaw, lane);
    *TRUNK(plant, pose[2], lane) += conditions->held_at;
    for (int32_t place = 0; place < places_of(h); place++) {
        const int32_t leg = place < h->legs ? place : 0;
        *LEG(plant, sound, place, lane) =
            conditions->damaged && conditions->damaged[leg] ? 0.0 : 1.0;
        *LEG(plant, stuck, place, lane) = conditions->stuck ? conditions->stuck[leg] : NAN;
    }
}

void plant_command(void *plant, int32_t lane, const double *hip, const double *knee) {
    const plant_header *h = (const plant_header *)plant;
    for (int32_t leg = 0; leg < h->legs; leg++) {
        const double angles[3] = {0.0, hip[leg], knee[leg]};
        for (size_t j = 0; j < 3; j++)
            *LEG(plant, asked[j], leg, lane) =
                *NUMBER(plant, sign[j], leg, lane) *
                angles[angle_of(*NUMBER(plant, angle[j], leg, lane))];
    }
}

void plant_shift_velocity(void *plant, int32_t lane, double x, double y) {
    *TRUNK(plant, xd.x, lane) += x;
    *TRUNK(plant, xd.y, lane) += y;
}

/* Longest stable step of the robot in a lane, in its reference pose on a level plane. */
static double stable_step_in(void *plant, int32_t lane) {
    const plant_header *h = (const plant_header *)plant;
    plant_parts p = parts_of(h->width > 1 ? (char *)plant + h->scratch : (char *)plant);
    robot_numbers robot;
    trunk_state upright;
    for (size_t i = 0; i < NUMBERS_OF(robot_numbers); i++)
        ((double *)(void *)&robot)[i] = *of_robot(plant, h->robot, i, lane);
    for (int32_t leg = 0; leg < h->legs; leg++)
        for (size_t i = 0; i < NUMBERS_OF(leg_numbers); i++)
            ((double *)(void *)&p.leg[leg])[i] =
                *of_leg(plant, h->leg, NUMBERS_OF(leg_numbers), i, leg, lane);
    memset(&upright, 0, sizeof upright);
    robot.ground = (rotation){{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    p.robot = &robot;
    p.trunk = &upright;
    p.contacts = 0;
    p.any_axes = h->any_axes;
    return step_of_springs(&p);
}

void plant_advance(void *plant, const plant_ground *const *grounds, double duration, double step) {
    plant_header *h = (plant_header *)plant;
    int32_t before[PLANT_MOST_LANES];
    memcpy(before, h->fares, sizeof before);
    kernel_of(h->kind, h->level)->advance(plant, grounds, duration, step);
    const double taken = duration / (double)steps_in(duration, step);
    for (int32_t lane = 0; lane < h->robots; lane++)
        if (before[lane] == PLANT_WALKS && h->fares[lane] == PLANT_FELL &&
            !(taken <= stable_step_in(plant, lane)))
            h->fares[lane] = PLANT_DIVERGED; /* it was thrown over by growing vibrations */
}

int32_t plant_state_of(const void *plant, int32_t lane) {
    return ((const plant_header *)plant)->fares[lane];
}

int32_t plant_sample_size(int32_t legs) { return 9 + 19 * legs; }

void plant_loads(const void *plant, int32_t lane, double *grf) {
    void *p = (void *)(uintptr_t)plant;
    for (int32_t leg = 0; leg < ((const plant_header *)plant)->legs; leg++)
        grf[leg] = *LEG(p, reading, leg, lane);
}

void plant_sample(const void *plant, int32_t lane, double *sample) {
    void *p = (void *)(uintptr_t)plant;
    const plant_header *h = (const plant_header *)plant;
    const int32_t legs = h->legs;
    const size_t width = (size_t)h->width, each = 3 * (size_t)legs;
    const double trunk[9] = {*TRUNK(p, x.x, lane),  *TRUNK(p, x.y, lane),   *TRUNK(p, x.z, lane),
                             *TRUNK(p, roll, lane), *TRUNK(p, pitch, lane), *TRUNK(p, yaw, lane),
                             *TRUNK(p, xd.x, lane), *TRUNK(p, xd.y, lane),  *TRUNK(p, xd.z, lane)};
    memcpy(sample, trunk, sizeof trunk);
    sample += 9;
    /* joints may turn the other way and stand in another order in the tree */
    static const struct {
        size_t place;
        int turns, each; /* 1: changes sign with the joint, has a number per joint */
    } channel[6] = {{PLACE_OF(leg_state, q), 1, 1},      {PLACE_OF(leg_state, qd), 1, 1},
                    {PLACE_OF(leg_state, torque), 1, 1}, {PLACE_OF(leg_state, work), 0, 1},
                    {PLACE_OF(leg_state, foot), 0, 0},   {PLACE_OF(leg_state, force), 0, 0}};
    for (int32_t leg = 0; leg < legs; leg++) {
        const double *first = leg_at(p, h->state, NUMBERS_OF(leg_state), leg, lane);
        const double *sign = NUMBER(p, sign, leg, lane), *angle = NUMBER(p, angle, leg, lane);
        for (size_t k = 0; k < 6; k++) {
            const double *from = first + channel[k].place * width;
            double *to = sample + k * each + 3 * (size_t)leg;
            for (size_t j = 0; j < 3; j++)
                to[channel[k].each ? angle_of(angle[j * width]) : (int)j] =
                    (channel[k].turns ? sign[j * width] : 1.0) * from[j * width];
        }
        sample[6 * each + (size_t)leg] = first[PLACE_OF(leg_state, reading) * width];
    }
}

void plant_accelerations(const void *plant, int32_t lane, double *accelerations) {
    void *p = (void *)(uintptr_t)plant;
    const double trunk[6] = {*TRUNK(p, xdd.x, lane),   *TRUNK(p, xdd.y, lane),
                             *TRUNK(p, xdd.z, lane),   *TRUNK(p, yawdd, lane),
                             *TRUNK(p, pitchdd, lane), *TRUNK(p, rolldd, lane)};
    memcpy(accelerations, trunk, sizeof trunk);
    for (int32_t leg = 0; leg < ((const plant_header *)plant)->legs; leg++)
        for (size_t j = 0; j < 3; j++)
            accelerations[6 + 3 * leg + angle_of(*NUMBER(p, angle[j], leg, lane))] =
                *NUMBER(p, sign[j], leg, lane) * *LEG(p, qdd[j], leg, lane);
}

double plant_foot_mass(const void *plant, int32_t lane) {
    return 1.0 / *ROBOT((void *)(uintptr_t)plant, per_foot_mass, lane);
}

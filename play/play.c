/* Closed loop of controller and robot for the page: what JavaScript calls and where it reads.
 *
 * One robot in static memory. A walk that nothing is changed in is that of `apnc.simulate` with the
 * same seed: the order of a tick is that of fmu_src/loop/loop.c. What a robot on the page can
 * suffer beyond plant.h (a push, a payload or a slope that changes as it walks) is done here on the
 * state of the plant between two ticks.
 */
#define PLANT_WIDTH 1
#include "layout.h"
#include "numbers.h"

#include "apnc.h"
#include "play.h"

#define EXPORT(name) __attribute__((export_name(#name)))

#define MOST_BYTES    (1 << 16) /* of a plant */
#define MOST_REALS    (1 << 13) /* of a field of obstacles */
#define MOST_INTEGERS (1 << 16)
#define CONTACTS      32   /* places at which a foot touches obstacles at most */
#define SLOPE_RATE    0.12 /* [rad/s] by which the ground tilts */
#define ROUGH_RATE    0.5  /* [1/s] by which obstacles rise */
#define PUSH_SECONDS  0.1  /* that a push lasts */

_Static_assert(sizeof(play_numbers) == PLAY_NUMBERS_SIZE, "Python lays the numbers out alike");

static play_numbers numbers;
static plant_ground ground;
static double field_reals[MOST_REALS];
static int64_t field_integers[MOST_INTEGERS];
static _Alignas(PLANT_ALIGNMENT) unsigned char plant[MOST_BYTES], scratch[MOST_BYTES];
static apnc_data data;
static apnc_state state;
static double sample[9 + 19 * APNC_LEGS];
static double stuck[APNC_LEGS];    /* [N] what a sensor delivers; not a number: it works */
static double slope, roughness;    /* [rad], [1] where the ground is going */
static double rough_now;           /* [1] where it is */
static double push[2];             /* [N s] forward and to the left, in the world */
static int32_t push_ticks;         /* [ticks] that a push lasts */
static int32_t push_left;          /* [ticks] of it */
static double payload, total_mass; /* [kg] */
static uint64_t seed;

EXPORT(numbers_at) void *play_numbers_at(void) { return &numbers; }
EXPORT(sample_at) void *play_sample_at(void) { return sample; }
EXPORT(stuck_at) void *play_stuck_at(void) { return stuck; }
EXPORT(balls_at) void *play_balls_at(void) { return field_reals + 2; }
EXPORT(variable_at) void *play_variable_at(int32_t index) {
    return (char *)&data + apnc_variables[index].offset;
}
EXPORT(slope_now) double play_slope_now(void) { return ground.slope; }
EXPORT(rough_now) double play_rough_now(void) { return rough_now; }
EXPORT(mass) double play_mass(void) { return total_mass; }

/* The robot with its payload and the error of its centre of mass, as a robot's FMU makes it. */
static void load_trunk(void) {
    const play_numbers *n = &numbers;
    const double off = plant_side_offset(seed, n->com_side_offset);
    const double own[3] = {n->trunk_com[0], n->trunk_com[1] + off, n->trunk_com[2]};
    const double *c = n->robot.trunk_center;
    const double top[3] = {c[0], c[1], c[2] + (n->robot.trunk_size[2] + n->payload_size[2]) / 2.0};
    plant_body box, trunk = {n->trunk_mass, {own[0], own[1], own[2]}, {0}};
    memcpy(trunk.inertia, n->trunk_inertia, sizeof trunk.inertia);
    plant_box(payload, n->payload_size, top, &box);
    plant_join(&trunk, &box, &numbers.robot.trunk);
    numbers.robot.leg = numbers.leg;
    total_mass = numbers.robot.trunk.mass;
    for (int leg = 0; leg < APNC_LEGS; leg++)
        for (int link = 0; link < 3; link++) total_mass += numbers.leg[leg].link[link].mass;
}

/* Obstacles that stand out by a part of their full height; a flat field touches as a plane. */
static void raise_obstacles(double part) {
    rough_now = part;
    ground.top = part * numbers.field.height;
    ground.kind = part > 0.0 ? PLANT_OBSTACLES : PLANT_PLANE;
    for (int64_t i = 0; i < numbers.field.balls; i++) {
        double *ball = field_reals + 2 + 4 * i;
        ball[2] = ground.top - ball[3];
    }
    parts_of(plant).robot->top = ground.top;
}

EXPORT(set_conditions) void play_set_conditions(void) {
    const plant_conditions conditions = {0.0, 0, 0.0, NULL, stuck};
    plant_set_conditions(plant, 0, &conditions);
}

/* Numbers that do not fit: 0; else 1. The controller is as it was; see renew. */
EXPORT(place) int32_t play_place(double number, double at_slope, double at_roughness, double kg) {
    const plant_robot *r = &numbers.robot;
    const int32_t history = plant_history(r->servo.latency, r->sensor.delay, numbers.Ts);
    double found[4 * CONTACTS], coordinates[6 + 3 * APNC_LEGS];
    seed = numbers.field.seed = (uint64_t)number;
    if (plant_size(PLANT_SCALAR, 0, APNC_LEGS, CONTACTS, history) > MOST_BYTES ||
        plant_field_reals(&numbers.field) > MOST_REALS ||
        plant_field_integers(&numbers.field) > MOST_INTEGERS ||
        plant_field_fill(&numbers.field, field_reals, field_integers) > CONTACTS)
        return 0;
    payload = kg;
    slope = at_slope;
    roughness = at_roughness;
    push_left = 0;
    ground = (plant_ground){PLANT_PLANE, CONTACTS, slope, 0.0, field_reals, field_integers, NULL};
    load_trunk();
    plant_create(scratch, PLANT_SCALAR, 0, APNC_LEGS, CONTACTS, history);
    plant_create(plant, PLANT_SCALAR, 0, APNC_LEGS, CONTACTS, history);
    raise_obstacles(roughness);
    plant_start(r, &ground, numbers.start, numbers.clearance, found, coordinates);
    plant_place(plant, 0, r, &ground, seed, coordinates, 0.0, numbers.Ts);
    play_set_conditions();
    plant_sample(plant, 0, sample);
    return 1;
}

/* A controller that has learned nothing yet; its parameters are set by variable_at before. */
EXPORT(renew) void play_renew(void) { apnc_init(&data.parameters, &state, &data.outputs); }

EXPORT(defaults) void play_defaults(void) { apnc_defaults(&data); }

/* Another payload while it walks: the numbers of a robot that is placed with it elsewhere. */
EXPORT(load) void play_load(double kg) {
    const plant_ground level = {.kind = PLANT_PLANE, .contacts = CONTACTS, .slope = ground.slope};
    double coordinates[6 + 3 * APNC_LEGS], found[4 * CONTACTS];
    payload = kg;
    load_trunk();
    plant_start(&numbers.robot, &level, numbers.start, numbers.clearance, found, coordinates);
    plant_place(scratch, 0, &numbers.robot, &level, seed, coordinates, 0.0, numbers.Ts);
    *parts_of(plant).robot = *parts_of(scratch).robot;
    parts_of(plant).robot->top = ground.top;
    play_set_conditions();
}

EXPORT(go_to_ground) void play_go_to_ground(double to_slope, double to_roughness) {
    slope = to_slope;
    roughness = to_roughness;
}

/* An impulse [N s] that all bodies share, so that none moves against another. */
EXPORT(push) void play_push(double x, double y) {
    push[0] = x;
    push[1] = y;
    push_ticks = (int32_t)(PUSH_SECONDS / numbers.Ts + 0.5);
    push_left = push_ticks;
}

static double towards(double now, double then, double most) {
    return then > now + most ? now + most : then < now - most ? now - most : then;
}

/* Tilt the ground about the world's y axis, and the robot with it: in the frame of the ground only
 * the direction of gravity changes. To first order in the angle for the trunk's direction. */
static void tilt(double by) {
    trunk_state *t = parts_of(plant).trunk;
    double s, c, sine, cosine;
    s_sin_cos(by, &s, &c);
    t->x = (b3){c * t->x.x - s * t->x.z, t->x.y, s * t->x.x + c * t->x.z};
    t->xd = (b3){c * t->xd.x - s * t->xd.z, t->xd.y, s * t->xd.x + c * t->xd.z};
    s_sin_cos(t->yaw, &sine, &cosine);
    double pitch_sine, pitch_cosine;
    s_sin_cos(t->pitch, &pitch_sine, &pitch_cosine);
    const double roll = -by * sine / pitch_cosine;
    t->yaw += roll * pitch_sine;
    t->pitch -= by * cosine;
    t->roll += roll;
    ground.slope += by;
    parts_of(plant).robot->ground = rotation_of(&ground);
}

static void move_ground(void) {
    if (ground.slope != slope) {
        const double next = towards(ground.slope, slope, SLOPE_RATE * numbers.Ts);
        tilt(next - ground.slope);
        ground.slope = next;
    }
    if (rough_now != roughness)
        raise_obstacles(towards(rough_now, roughness, ROUGH_RATE * numbers.Ts));
}

static void be_pushed(void) {
    if (!push_left) return;
    const double share = 1.0 / (push_ticks * total_mass);
    push_left--;
    plant_shift_velocity(plant, 0, share * push[0], share * push[1]);
}

/* One tick; how the robot fares: PLANT_WALKS, PLANT_FELL, PLANT_DIVERGED. The sample is that of
 * the begin of the tick, as in a record. */
EXPORT(tick) int32_t play_tick(void) {
    const plant_ground *at = &ground;
    plant_loads(plant, 0, data.inputs.grf);
    apnc_tick(&data.parameters, &state, &data.inputs, &data.outputs);
    plant_sample(plant, 0, sample);
    plant_command(plant, 0, data.outputs.theta_hip, data.outputs.theta_knee);
    be_pushed();
    move_ground();
    plant_advance(plant, &at, numbers.Ts, numbers.step);
    return plant_state_of(plant, 0);
}

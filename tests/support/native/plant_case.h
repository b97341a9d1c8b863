/* Robots, grounds and commands by chance: the same numbers on every machine. */
#ifndef PLANT_CASE_H
#define PLANT_CASE_H

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "plant.h"

enum { CASE_LEGS = 64, CASE_REALS = 1024, CASE_INTEGERS = 8192 };

static uint64_t case_state = 1;

static uint32_t draw(uint32_t below) {
    case_state = case_state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (uint32_t)((case_state >> 33) % below);
}

static int one_in(uint32_t n) { return draw(n) == 0; }

/* Between two numbers, in steps of a millionth. */
static double between(double low, double high) {
    return low + (high - low) * ((double)draw(1000000) / 1e6);
}

static void vector_between(double *x, int count, double low, double high) {
    for (int i = 0; i < count; i++) x[i] = between(low, high);
}

/* A body of three pairs of masses on axes of its own, and some moments off the diagonal. */
static void case_body(plant_body *body, double mass, double size) {
    const double s = mass * size * size;
    body->mass = mass;
    vector_between(body->com, 3, -0.3 * size, 0.3 * size);
    vector_between(body->inertia, 3, 0.08 * s, 0.12 * s);
    vector_between(body->inertia + 3, 3, -0.02 * s, 0.02 * s);
}

/* A joint, in half of all cases with nothing of its own. */
static void case_joint(plant_joint *joint) {
    *joint = (plant_joint){NAN, NAN, NAN, NAN, NAN, 0.0, 0.0, 0.1, -INFINITY, INFINITY, 0.0, 0.0};
    if (one_in(2)) return;
    joint->stiffness = between(20, 60);
    joint->damping = between(0.5, 2.0);
    joint->stall_torque = between(3, 5);
    joint->no_load_speed = between(4, 8);
    joint->reflected_inertia = between(0.008, 0.012);
    joint->joint_damping = between(0.0, 0.2);
    joint->dry_friction = between(0.0, 0.2);
    if (one_in(2)) joint->low = between(-0.5, -0.05);
    if (one_in(2)) joint->high = between(0.05, 0.5);
    joint->stop_stiffness = between(100, 200);
    joint->stop_damping = between(0.5, 2.0);
}

static void case_leg(plant_leg *leg, int32_t index, int32_t legs) {
    const double along = legs > 2 ? (double)(index / 2) / (double)((legs - 1) / 2) - 0.5 : 0.0;
    leg->mount[0] = 0.2 * along + between(-0.01, 0.01);
    leg->mount[1] = (index % 2 ? 0.08 : -0.08) + between(-0.01, 0.01);
    leg->mount[2] = between(-0.01, 0.01);
    vector_between(leg->hip, 3, -0.02, 0.02);
    leg->femur = between(0.06, 0.08);
    leg->tibia = between(0.07, 0.09);
    leg->femur_angle = between(0.5, 0.8);
    leg->tibia_angle = between(1.2, 1.6);
    for (int i = 0; i < 3; i++) case_body(&leg->link[i], between(0.05, 0.15), 0.06);
    for (int i = 0; i < 3; i++) case_joint(&leg->joint[i]);
    leg->foot_radius = one_in(2) ? NAN : between(0.01, 0.015);
}

/* A robot that stands; `leg` has room for all legs. */
static void case_robot(plant_robot *robot, plant_leg *leg, int32_t legs, double latency,
                       double delay) {
    memset(robot, 0, sizeof *robot);
    robot->legs = legs;
    robot->leg = leg;
    robot->gravity = 9.81;
    robot->weight = 25.0;
    case_body(&robot->trunk, between(1.0, 2.0), 0.2);
    vector_between(robot->trunk_center, 3, -0.01, 0.01);
    vector_between(robot->trunk_size, 3, 0.03, 0.1);
    robot->servo = (plant_servo){between(20, 60), between(0.5, 2.0),    4.0, between(4, 8), 0.01,
                                 latency,         one_in(2) ? 2.0 : 0.0};
    robot->contact = (plant_contact){between(0.01, 0.015), between(2000, 6000),
                                     between(10, 40),      0.0002,
                                     between(0.4, 1.0),    0.03};
    robot->sensor = (plant_sensor){delay, between(0.0, 0.03), 0.05, (int32_t)draw(2)};
    robot->suspension = (plant_suspension){5000.0, 200.0, 50.0, 2.0};
    for (int32_t i = 0; i < legs; i++) case_leg(&leg[i], i, legs);
}

/* Numbers of a ground. */
typedef struct {
    plant_ground ground;
    double reals[CASE_REALS];
    int64_t integers[CASE_INTEGERS];
} case_ground;

static void case_field(case_ground *g, uint64_t seed) {
    const plant_field field = {seed, 40, 10, 0.5, between(0.002, 0.01), 0.03, 0.08, 0.015, 0.002};
    if (plant_field_reals(&field) > CASE_REALS || plant_field_integers(&field) > CASE_INTEGERS)
        abort();
    g->ground.contacts = plant_field_fill(&field, g->reals, g->integers);
    g->ground.top = field.height;
}

/* A ground of a kind: plane, obstacles, kerb, waves. */
static void case_ground_of(case_ground *g, int32_t kind) {
    memset(g, 0, sizeof *g);
    g->ground = (plant_ground){kind, 1, 0.0, 0.0, g->reals, g->integers, NULL};
    g->ground.slope = one_in(2) ? between(-0.1, 0.1) : 0.0;
    if (kind == PLANT_OBSTACLES) {
        case_field(g, draw(1000));
    } else if (kind == PLANT_KERB) {
        g->ground.contacts = 2;
        g->reals[0] = between(0.02, 0.12);
        g->reals[1] = one_in(2) ? INFINITY : g->reals[0] + 0.1;
        g->reals[2] = g->ground.top = between(0.002, 0.01);
    } else if (kind == PLANT_WAVES) {
        g->ground.top = between(0.002, 0.01);
        g->reals[0] = 0.5 * g->ground.top;
        g->reals[1] = between(10.0, 20.0);
    }
}

/* A triangle between -1 and 1. */
static double case_wave(double phase) {
    const double part = phase - floor(phase);
    return part < 0.5 ? 4.0 * part - 1.0 : 3.0 - 4.0 * part;
}

/* Hip and knee commands of a trot. */
static void case_trot(int32_t legs, int tick, double size, double *hip, double *knee) {
    for (int32_t i = 0; i < legs; i++) {
        const double phase = 0.02 * tick + 0.5 * ((i + i / 2) % 2);
        hip[i] = size * case_wave(phase) - 0.1;
        knee[i] = size * case_wave(phase + 0.25) - 0.05;
    }
}

#endif

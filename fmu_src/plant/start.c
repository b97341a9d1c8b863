/* Start coordinates and mass of the trunk, which plant_place needs. */
#include <math.h>

#include "numbers.h"

#define START_DEEPEST 1e6 /* [m] depth to which the ground is searched */

/* Add the inertia of a body about a point. */
static void add_about(double *inertia, const plant_body *body, const double *point) {
    const double m = body->mass, *i = body->inertia;
    const double x = body->com[0] - point[0], y = body->com[1] - point[1];
    const double z = body->com[2] - point[2];
    inertia[0] += i[0] + m * (y * y + z * z);
    inertia[1] += i[1] + m * (x * x + z * z);
    inertia[2] += i[2] + m * (x * x + y * y);
    inertia[3] += i[3] - m * x * y;
    inertia[4] += i[4] - m * x * z;
    inertia[5] += i[5] - m * y * z;
}

void plant_join(const plant_body *first, const plant_body *second, plant_body *joined) {
    plant_body sum = {first->mass + second->mass, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0, 0.0, 0.0, 0.0}};
    for (int i = 0; i < 3; i++)
        sum.com[i] = (first->mass * first->com[i] + second->mass * second->com[i]) / sum.mass;
    add_about(sum.inertia, first, sum.com);
    add_about(sum.inertia, second, sum.com);
    *joined = sum;
}

void plant_box(double mass, const double *size, const double *com, plant_body *box) {
    const double x = size[0] * size[0], y = size[1] * size[1], z = size[2] * size[2];
    const double share = mass / 12.0;
    *box = (plant_body){mass,
                        {com[0], com[1], com[2]},
                        {(y + z) * share, (x + z) * share, (x + y) * share, 0.0, 0.0, 0.0}};
}

double plant_side_offset(uint64_t seed, double size) {
    const double side = plant_uniform(seed, PLANT_RANDOM_BODY, 0) < 0.5 ? -1.0 : 1.0;
    return side * size * (0.75 + 0.5 * plant_uniform(seed, PLANT_RANDOM_BODY, 1));
}

/* Greatest height of a ball's centre at which it just touches an obstacle or the plane. */
static double rest_on_obstacles(const plant_ground *ground, double x, double y, double radius) {
    const double tile = ground->reals[0], *balls = ground->reals + 2;
    const int64_t cells = (int64_t)ground->reals[1] * (int64_t)ground->reals[1];
    const int64_t *members = ground->integers + cells + 1;
    double highest = radius;
    for (int64_t k = 0; k < ground->integers[cells]; k++) {
        const double *ball = balls + 4 * members[k];
        double dx = x - ball[0], dy = y - ball[1];
        dx -= tile * floor(dx / tile + 0.5);
        dy -= tile * floor(dy / tile + 0.5);
        const double near = ball[3] + radius, room = near * near - (dx * dx + dy * dy);
        if (!(room > 0.0)) continue;
        const double top = ball[2] + s_sqrt(room);
        if (top > highest) highest = top;
    }
    return highest;
}

double plant_rest_height(const plant_ground *ground, double x, double y, double radius,
                         double *found) {
    if (ground->kind == PLANT_PLANE) return radius;
    if (ground->kind == PLANT_OBSTACLES) return rest_on_obstacles(ground, x, y, radius);
    double high = ground->top + radius, low = -high, middle;
    while (!plant_touches(ground, x, y, low, radius, found)) {
        if (low < -START_DEEPEST) return high;
        low *= 2.0;
    }
    while (low < (middle = (low + high) / 2.0) && middle < high) {
        if (plant_touches(ground, x, y, middle, radius, found))
            low = middle;
        else
            high = middle;
    }
    return high;
}

void plant_start(const plant_robot *robot, const plant_ground *ground, const double *angles,
                 double clearance, double *found, double *coordinates) {
    double height = -INFINITY, sine, cosine;
    for (int32_t leg = 0; leg < robot->legs; leg++) {
        double points[9];
        plant_leg_points(&robot->leg[leg], angles[0], angles[1], angles[2], points);
        const double *foot = points + 6;
        const double radius = foot_radius(robot, leg);
        const double above = plant_rest_height(ground, foot[0], foot[1], radius, found) - foot[2];
        if (above > height) height = above;
        for (int i = 0; i < 3; i++) coordinates[6 + 3 * leg + i] = angles[i];
    }
    height += clearance;
    s_sin_cos(ground->slope, &sine, &cosine);
    coordinates[0] = -sine * height;
    coordinates[1] = 0.0;
    coordinates[2] = cosine * height;
    coordinates[3] = 0.0;
    coordinates[4] = -ground->slope;
    coordinates[5] = 0.0;
}

/* Coordinates and speeds of a lane put into the bytes of a plant and read out of them: the
 * interface of the plant starts robots at rest and shows no rates of the Euler angles.
 *
 * q, v: x, y, z, yaw, pitch, roll, then abduction, hip and knee of every leg as a tree has them
 * (hip and knee turn about +y, so minus the joint angle), 6 + 3 legs numbers each. */
#define PLANT_WIDTH 1
#include "layout.h"

void inside_put(void *plant, int32_t lane, const double *q, const double *v);
void inside_get(void *plant, int32_t lane, double *q, double *v);

static double *of_trunk(void *plant, size_t offset, int32_t lane) {
    const plant_header *h = (const plant_header *)plant;
    return (double *)((char *)plant + h->trunk) + offset / sizeof(double) * (size_t)h->robots +
           (size_t)lane;
}

static double *of_leg(void *plant, size_t offset, int32_t leg, int32_t lane) {
    const plant_header *h = (const plant_header *)plant;
    const int robots_abreast = h->robots == h->width;
    const int32_t group = robots_abreast ? leg : leg / h->width;
    const int32_t at = robots_abreast ? lane : leg % h->width;
    const size_t count = sizeof(leg_state) / sizeof(double);
    return (double *)((char *)plant + h->state) +
           ((size_t)group * count + offset / sizeof(double)) * (size_t)h->width + (size_t)at;
}

static const size_t place[6] = {offsetof(trunk_state, x.x),   offsetof(trunk_state, x.y),
                                offsetof(trunk_state, x.z),   offsetof(trunk_state, yaw),
                                offsetof(trunk_state, pitch), offsetof(trunk_state, roll)};
static const size_t speed[6] = {offsetof(trunk_state, xd.x),   offsetof(trunk_state, xd.y),
                                offsetof(trunk_state, xd.z),   offsetof(trunk_state, yawd),
                                offsetof(trunk_state, pitchd), offsetof(trunk_state, rolld)};
static const size_t rate[6] = {offsetof(trunk_state, xdd.x),   offsetof(trunk_state, xdd.y),
                               offsetof(trunk_state, xdd.z),   offsetof(trunk_state, yawdd),
                               offsetof(trunk_state, pitchdd), offsetof(trunk_state, rolldd)};

/* Accelerations become 0, so that the first half kick of the step that follows changes no speed. */
void inside_put(void *plant, int32_t lane, const double *q, const double *v) {
    for (int i = 0; i < 6; i++) {
        *of_trunk(plant, place[i], lane) = q[i];
        *of_trunk(plant, speed[i], lane) = v[i];
        *of_trunk(plant, rate[i], lane) = 0.0;
    }
    for (int32_t i = 0; i < 3 * ((const plant_header *)plant)->legs; i++) {
        const size_t joint = (size_t)(i % 3) * sizeof(double);
        *of_leg(plant, offsetof(leg_state, q) + joint, i / 3, lane) = q[6 + i];
        *of_leg(plant, offsetof(leg_state, qd) + joint, i / 3, lane) = v[6 + i];
        *of_leg(plant, offsetof(leg_state, qdd) + joint, i / 3, lane) = 0.0;
    }
}

void inside_get(void *plant, int32_t lane, double *q, double *v) {
    for (int i = 0; i < 6; i++) {
        q[i] = *of_trunk(plant, place[i], lane);
        v[i] = *of_trunk(plant, speed[i], lane);
    }
    for (int32_t i = 0; i < 3 * ((const plant_header *)plant)->legs; i++) {
        const size_t joint = (size_t)(i % 3) * sizeof(double);
        q[6 + i] = *of_leg(plant, offsetof(leg_state, q) + joint, i / 3, lane);
        v[6 + i] = *of_leg(plant, offsetof(leg_state, qd) + joint, i / 3, lane);
    }
}

/* The laws one by one, for other engines and for tests. */
#define PLANT_WIDTH 1
#include "contact.h"
#include "ground.h"
#include "numbers.h"
#include "random.h"
#include "servo.h"

double plant_servo_torque(const plant_servo *servo, double error, double speed) {
    const servo_numbers n = servo_of(servo);
    return servo_torque(&n, error, speed);
}

double plant_joint_torque(const plant_joint *joint, double angle, double speed) {
    const passive_numbers n = passive_of(joint);
    return passive_torque(&n, angle, speed);
}

double plant_contact_force(const plant_contact *contact, const double *normal, double depth,
                           const double *velocity, double stopping, double *force) {
    const contact_numbers n = contact_of(contact);
    double press;
    const v3 found = contact_force(&n, (v3){normal[0], normal[1], normal[2]}, depth,
                                   (v3){velocity[0], velocity[1], velocity[2]}, stopping, &press);
    force[0] = found.x;
    force[1] = found.y;
    force[2] = found.z;
    return press;
}

int32_t plant_touches(const plant_ground *ground, double x, double y, double z, double radius,
                      double *found) {
    return ground_touches(ground, x, y, z, radius, found);
}

double plant_uniform(uint64_t seed, int32_t purpose, uint64_t index) {
    return random_uniform(seed, (uint32_t)purpose, index);
}

double plant_normal(uint64_t seed, int32_t purpose, uint64_t index) {
    return random_normal(seed, (uint32_t)purpose, index);
}

void plant_obstacle(uint64_t seed, int64_t index, double tile, double smallest, double largest,
                    double *place) {
    double pair[2], size[2];
    random_pair(seed, PLANT_RANDOM_GROUND, (uint64_t)index * 2, pair);
    random_pair(seed, PLANT_RANDOM_GROUND, (uint64_t)index * 2 + 1, size);
    place[0] = tile * pair[0];
    place[1] = tile * pair[1];
    place[2] = (smallest + (largest - smallest) * size[0]) / 2.0;
}

/* Torque of a geared position servo, for any number of lanes. */
#ifndef PLANT_SERVO_H
#define PLANT_SERVO_H

#include "lanes.h"

typedef struct {
    B stiffness;   /* [N m/rad] P */
    B damping;     /* [N m s/rad] D */
    B stall;       /* [N m] largest torque */
    B per_no_load; /* [s/rad] one over the no-load speed */
} servo_numbers;

/* tau = P error - D speed, within the limits of the motor at that speed:
 * stall (-1 - speed/no_load) <= tau <= stall (1 - speed/no_load) from the supply voltage, and
 * |tau| <= stall from the current limit. error: commanded minus actual angle [rad]; speed: of the
 * joint [rad/s]. */
INL V servo_torque(const servo_numbers *s, V error, V speed) {
    const V one = v_all(1.0), stall = wide(s->stall), ratio = speed * wide(s->per_no_load);
    const V highest = stall * v_min(v_max(one - ratio, -one), one);
    const V lowest = -stall * v_min(v_max(one + ratio, -one), one);
    const V wanted = wide(s->stiffness) * error - wide(s->damping) * speed;
    return v_min(v_max(wanted, lowest), highest);
}

#endif

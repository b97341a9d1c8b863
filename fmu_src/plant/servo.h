/* Torques at a joint, for any number of lanes: of its geared position servo, and of the joint
 * itself. */
#ifndef PLANT_SERVO_H
#define PLANT_SERVO_H

#include "lanes.h"

#define STOP_DEPTH 0.005 /* [rad] beyond a stop over which its damping sets in */

typedef struct {
    V stiffness;   /* [N m/rad] P */
    V damping;     /* [N m s/rad] D */
    V stall;       /* [N m] largest torque */
    V per_no_load; /* [s/rad] one over the no-load speed */
} servo_numbers;

typedef struct {
    V damping;        /* [N m s/rad] */
    V friction;       /* [N m] */
    V per_slow;       /* [s/rad] one over the speed below which friction is proportional to it */
    V low, high;      /* [rad] coordinates of the stops; infinite: none */
    V stop_stiffness; /* [N m/rad] */
    V stop_damping;   /* [N m s/rad] */
} passive_numbers;

/* tau = P error - D speed, within the limits of the motor at that speed:
 * stall (-1 - speed/no_load) <= tau <= stall (1 - speed/no_load) from the supply voltage, and
 * |tau| <= stall from the current limit. error: commanded minus actual angle [rad]; speed: of the
 * joint [rad/s]. */
INL V servo_torque(const servo_numbers *s, V error, V speed) {
    const V one = v_all(1.0), stall = s->stall, ratio = speed * s->per_no_load;
    const V highest = stall * v_min(v_max(one - ratio, -one), one);
    const V lowest = -stall * v_min(v_max(one + ratio, -one), one);
    const V wanted = s->stiffness * error - s->damping * speed;
    return v_min(v_max(wanted, lowest), highest);
}

/* Torque by which a stop pushes back, max(0, k d + c min(1, d / d_c) d'): as in a contact, damping
 * sets in with the depth d, and a stop never pulls. approach: rate of the depth [rad/s]. */
INL V stop_torque(const passive_numbers *n, V depth, V approach) {
    const V zero = v_all(0.0), one = v_all(1.0);
    const V onset = v_min(one, depth * (1.0 / STOP_DEPTH));
    const V spring = n->stop_stiffness * depth + n->stop_damping * onset * approach;
    return v_select(depth > zero, v_max(spring, zero), zero);
}

/* tau = -(damping speed + friction min(1, max(-1, speed / slow))), and the torque of the stops.
 * angle: coordinate of the joint [rad]. */
INL V passive_torque(const passive_numbers *n, V angle, V speed) {
    const V one = v_all(1.0), slip = v_min(v_max(speed * n->per_slow, -one), one);
    const V resisting = n->damping * speed + n->friction * slip;
    return stop_torque(n, n->low - angle, -speed) - stop_torque(n, angle - n->high, speed) -
           resisting;
}

#endif

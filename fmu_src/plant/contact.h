/* Force of the ground on a foot, for any number of lanes. */
#ifndef PLANT_CONTACT_H
#define PLANT_CONTACT_H

#include "vectors.h"

typedef struct {
    B stiffness; /* [N/m] k */
    B damping;   /* [N s/m] c */
    B per_depth; /* [1/m] one over the depth d_c over which the damping sets in */
    B friction;  /* [1] mu */
    B slow;      /* [m/s] sliding speed below which friction is proportional to it */
} contact_numbers;

/* Normal force: max(0, k d + c min(1, d/d_c) d'). Damping sets in with the depth d instead of
 * jumping at first touch (after Hunt and Crossley, 1975), and the ground never pulls. Tangential
 * force: Coulomb friction, proportional to the sliding speed below a threshold. The threshold is
 * `slow`, or mu F h / m where that is larger: the speed from which friction stops the foot within
 * one step.
 *
 * normal: of the surface, pointing out of it; depth [m]: there is no force unless it is above 0;
 * velocity: of the foot at the contact point [m/s], in the frame of the normal; stopping: step h
 * over apparent mass m of a foot [s/kg]; press: normal force [N]. */
INL v3 contact_force(const contact_numbers *c, v3 normal, V depth, v3 velocity, B stopping,
                     V *press) {
    const V zero = v_all(0.0), one = v_all(1.0);
    const V approach = -v_dot(velocity, normal);
    const V onset = v_min(one, depth * wide(c->per_depth));
    const V spring = wide(c->stiffness) * depth + wide(c->damping) * onset * approach;
    const V pressed = v_select(depth > 0.0, v_max(spring, zero), zero);
    const v3 sliding = v_add(velocity, v_scale(approach, normal));
    const V grip = wide(c->friction) * pressed;
    const V speed =
        v_max(v_max(v_sqrt(v_dot(sliding, sliding)), wide(c->slow)), grip * wide(stopping));
    *press = pressed;
    return v_sub(v_scale(pressed, normal), v_scale(grip / speed, sliding));
}

#endif

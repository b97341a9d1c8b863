/* When a robot has fallen, for any number of lanes. */
#ifndef PLANT_FALL_H
#define PLANT_FALL_H

#include "dynamics.h"

#define FALL_TIPPED  0.5   /* cosine of 60 degrees from the normal of the ground */
#define FALL_UPENDED 0.174 /* cosine of 80 degrees; at 90 yaw and roll have one axis */

/* Whether a robot has fallen: its trunk is tipped by more than 60 degrees from the normal of the
 * ground, or a corner of its box is in the ground. On a steep slope a trunk may point straight up
 * or down before it is tipped that far. It then counts as fallen 10 degrees before it does so. */
INL int fallen(const plant_parts *p, const plant_ground *ground, const trunk_motion *t, int robot) {
    const robot_numbers *n = p->robot;
    const double top = B_AT(n->top, robot), height = B_AT(t->height, robot);
    const double up[3] = {B_AT(t->up.x, robot), B_AT(t->up.y, robot), B_AT(t->up.z, robot)};
    if (!(up[2] >= FALL_TIPPED && fabs(B_AT(t->cp, robot)) >= FALL_UPENDED)) return 1;
    const double center[3] = {B_AT(n->box_center.x, robot), B_AT(n->box_center.y, robot),
                              B_AT(n->box_center.z, robot)};
    const double half[3] = {B_AT(n->box_half.x, robot), B_AT(n->box_half.y, robot),
                            B_AT(n->box_half.z, robot)};
    for (int corner = 0; corner < 8; corner++) {
        double at[3];
        for (int i = 0; i < 3; i++) at[i] = center[i] + ((corner >> i) & 1 ? half[i] : -half[i]);
        const double z = height + (up[0] * at[0] + up[1] * at[1] + up[2] * at[2]);
        if (!(z < top)) continue;
        if (!p->contacts) return 1;
        const rotation *g = &t->ground; /* from ground to trunk */
        double in[3];
        for (int i = 0; i < 3; i++) {
            const b3 c = column(g, i);
            in[i] = B_AT(c.x, robot) * at[0] + B_AT(c.y, robot) * at[1] + B_AT(c.z, robot) * at[2];
        }
        if (ground && ground_touches(ground, B_AT(t->at.x, robot) + in[0],
                                     B_AT(t->at.y, robot) + in[1], z, 0.0, p->found) > 0)
            return 1;
    }
    return 0;
}

#endif

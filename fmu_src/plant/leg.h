/* Motion of a leg, and what its equations of motion are made of, for any number of lanes. */
#ifndef PLANT_LEG_H
#define PLANT_LEG_H

#include "robot.h"

/* A rotation for every leg, row by row. */
typedef struct {
    v3 x, y, z;
} v_rotation;

/* Position and motion of a leg. The axes of the leg are the trunk's, turned by the abduction. */
typedef struct {
    V c1, s1, ca, sa, cb,
        sb;          /* cosine and sine of the abduction and of the angles of femur and tibia */
    v3 femur, tibia; /* [m] hip to knee, knee to foot, in the axes of the leg */
    v3 foot;         /* [m] centre of the foot, in the axes of the trunk */
    twist first, second, third; /* of the links at their joints, in the axes of the leg */
    /* only of legs with any axes, whose own axes are the trunk's */
    v3 hip;             /* [m] first joint to second */
    v3 axis[3];         /* of the joints */
    v_rotation link[3]; /* from the links to the trunk */
} leg_motion;

/* Action of the ground on the feet of a group of legs. */
typedef struct {
    v3 force;  /* [N] in the axes of the legs */
    v3 moment; /* [N m] about the knees */
    V load;    /* [N] sum of the normal forces */
} push;

/* Equations of a leg on a trunk that it does not move, in the axes of the leg. */
typedef struct {
    V u[3];                         /* [N m] torques minus those of the bias forces */
    V M11, M12, M13, M22, M23, M33; /* mass matrix of its joints, rotors included */
    wrench column[3]; /* wrench on the trunk per acceleration of a joint, third joint first */
    wrench bias;      /* wrench on the trunk without accelerations of the joints */
    v_inertia all;    /* of the whole leg about its first joint */
} leg_balance;

#endif

/* Numbers and state of a robot as the equations of motion need them, for any number of lanes.
 *
 * Coordinates are those of a tree, from the trunk outward: usually abduction about +x, hip and knee
 * about +y. They are the joint angles in the order of `angle`, times `sign`.
 * Structs of B hold what a robot has once, structs of V hold what every leg has. They contain
 * nothing else, so that a lane can be filled and read number by number. */
#ifndef PLANT_ROBOT_H
#define PLANT_ROBOT_H

#include "contact.h"
#include "servo.h"
#include "vectors.h"

/* Numbers of the robot. */
typedef struct {
    b_inertia trunk;         /* trunk, about its reference point, in its axes */
    B gravity;               /* [m/s^2] downward */
    B half_weight;           /* [N] scales the noise of the sensors */
    B slew_rate;             /* [rad/s] fastest change of a command; 0: no limit */
    contact_numbers contact; /* */
    B passive;               /* 1: a joint has friction, damping or stops */
    B per_foot_mass;         /* [1/kg] one over the apparent mass of a foot along the ground */
    B time_constant;         /* [s] of the low-pass of the sensors; 0: none */
    B share;         /* [1] share of the new value in the low-pass for a tick of `share_of` */
    B share_of;      /* [s] tick length for which `share` was computed */
    B noise;         /* [N] standard deviation of the sensors' own noise */
    B added;         /* [N] standard deviation of the noise that the conditions add */
    B deviation;     /* [N] standard deviation of both together */
    B norm;          /* 1: a sensor measures the whole force, 0: its normal part */
    B hold[4];       /* [N/m], [N s/m], [N m/rad], [N m s/rad] of the suspension */
    rotation ground; /* from ground to world */
    B top;           /* [m] no point of the ground is higher over its plane */
    b3 box_center, box_half; /* [m] the box whose corners tell a fall */
} robot_numbers;

/* Numbers of a joint. */
typedef struct {
    V rotor; /* [kg m^2] reflected inertia */
    servo_numbers servo;
    passive_numbers passive;
} joint_numbers;

/* Numbers of a leg. */
typedef struct {
    v3 mount;               /* [m] first joint in the trunk */
    v3 hip;                 /* [m] from the first joint to the second */
    V femur, tibia;         /* [m] lengths */
    V femur_angle;          /* [rad] reference pose */
    V tibia_angle;          /* [rad] */
    V abduction_angle;      /* [rad] */
    V sign[3];              /* coordinate per joint angle: 1 or -1 */
    V angle[3];             /* which joint angle: 0 abduction, 1 hip, 2 knee */
    V free[3];              /* 1, or 0 for a locked joint */
    v3 axis[3];             /* of the joints, where all links hang straight down */
    V reference[3];         /* [rad] turns of the joints from there to the reference pose */
    v_inertia link[3];      /* links, about their joints, in their axes */
    joint_numbers joint[3]; /* from the trunk outward; from here on plant_tune changes it */
    V radius;               /* [m] of the foot ball */
} leg_numbers;

/* State of the trunk. */
typedef struct {
    b3 x, xd, xdd;            /* [m], [m/s], [m/s^2] of the reference point, world frame */
    B yaw, pitch, roll;       /* [rad] */
    B yawd, pitchd, rolld;    /* [rad/s] */
    B yawdd, pitchdd, rolldd; /* [rad/s^2] */
    B held;                   /* 1: the trunk is held */
    B pose[6];                /* [m], [rad] x, y, z, yaw, pitch, roll at which it is held */
    B start[6];               /* [m], [rad] pose at the start */
} trunk_state;

/* State of a leg, joints from the trunk outward. */
typedef struct {
    V q[3], qd[3], qdd[3]; /* [rad], [rad/s], [rad/s^2] */
    V target[3];           /* [rad] target that the servo follows now */
    V asked[3];            /* [rad] command as it was given */
    V commanded[3];        /* [rad] last command sent: 0 for a damaged leg, slew rate limited */
    V work[3];             /* [J] |torque speed|, integrated over time since the start */
    V torque[3];           /* [N m] at the last tick */
    v3 foot;               /* [m] centre of the foot, world frame */
    v3 force;              /* [N] of the ground on the foot, world frame */
    V load;                /* [N] sum of its normal parts */
    V filtered;            /* [N] output of the low-pass */
    V reading;             /* [N] load that the sensor delivers */
    V sound;               /* 0: the leg is damaged, else 1 */
    V stuck;               /* [N] constant reading of a stuck sensor; NaN: it works */
} leg_state;

/* Values that a leg keeps from the inward to the outward pass of the equations of motion: its part
 * of the mass matrix in the form L D L', foot first. */
typedef struct {
    V g[3][6];       /* columns of the coupling with the trunk, eliminated */
    V per_d[3];      /* one over D */
    V y[3];          /* torques, eliminated */
    V l10, l20, l21; /* L */
} leg_kept;

/* Pointers to the parts of a plant. */
typedef struct {
    robot_numbers *robot;
    leg_numbers *leg; /* per group of legs */
    trunk_state *trunk;
    leg_state *state; /* per group of legs */
    leg_kept *kept;   /* per group of legs */
    V *coming;        /* commands that wait: 3 per group and entry */
    V *loads;         /* readings that wait: per group and entry */
    double *found;    /* contact points that a ground wrote: per lane */
    int32_t legs;     /* number of legs */
    int32_t groups;   /* groups of legs; one per leg if the lanes are robots */
    int32_t contacts; /* most contact points of a foot; 0: planes only */
    int32_t any_axes; /* 1: some joint turns about another axis than x, y, y */
    int32_t lanes;    /* number of robots */
} plant_parts;

/* Number of legs in a group; the last group may have fewer than there are lanes. */
INL int32_t legs_in(const plant_parts *p, int32_t group) {
#ifdef PLANT_LEGS_ABREAST
    const int32_t left = p->legs - group * PLANT_WIDTH;
    return left < PLANT_WIDTH ? left : PLANT_WIDTH;
#else
    (void)p;
    (void)group;
    return 1;
#endif
}

/* Add the contributions of the legs of a group, leg after leg: the same order for all kinds of
 * lanes.
 */
INL void add_up(const plant_parts *p, int32_t group, B *sum, const V *part, int count) {
#ifdef PLANT_LEGS_ABREAST
    const int32_t legs = legs_in(p, group);
    for (int32_t leg = 0; leg < legs; leg++)
        for (int i = 0; i < count; i++) sum[i] += part[i][leg];
#else
    (void)p;
    (void)group;
    for (int i = 0; i < count; i++) sum[i] += part[i];
#endif
}

#endif

/* A robot as the equations of motion need it, for any number of lanes: numbers and state.
 *
 * Coordinates are those of a tree: hip and knee turn about +y, so they are minus the joint angles.
 * Structs of B hold what a robot has once, structs of V what every leg has; nothing else is in
 * them, so that a lane is filled and read number by number. */
#ifndef PLANT_ROBOT_H
#define PLANT_ROBOT_H

#include "contact.h"
#include "servo.h"
#include "vectors.h"

/* Numbers of the robot. */
typedef struct {
    b_inertia trunk;         /* about its reference point, in its axes */
    B gravity;               /* [m/s^2] downward */
    B half_weight;           /* [N] scale of the sensors' noise */
    B reflected_inertia;     /* [kg m^2] of every joint */
    B slew_rate;             /* [rad/s] fastest change of a command; 0: no limit */
    servo_numbers servo;     /* */
    contact_numbers contact; /* */
    B per_foot_mass;         /* [1/kg] one over the apparent mass of a foot along the ground */
    B time_constant;         /* [s] of the sensors */
    B share;                 /* [1] new part in a reading of the low-pass, at `share_of` */
    B share_of;              /* [s] length of the tick that `share` was found for */
    B noise;                 /* [N] standard deviation of the sensors' own noise */
    B added;                 /* [N] standard deviation of what the conditions add */
    B deviation;             /* [N] of both together */
    B norm;                  /* 1: a sensor feels the whole force, 0: its normal part */
    B hold[4];               /* [N/m], [N s/m], [N m/rad], [N m s/rad] of the suspension */
    rotation ground;         /* from ground to world */
    B top;                   /* [m] no point of the ground is higher over its plane */
    b3 box_center, box_half; /* [m] the box that must not touch the ground */
} robot_numbers;

/* Numbers of a leg. */
typedef struct {
    v3 mount;          /* [m] abduction joint in the trunk */
    v3 hip;            /* [m] from the abduction axis to the hip axis */
    V femur, tibia;    /* [m] lengths */
    V femur_angle;     /* [rad] reference pose */
    V tibia_angle;     /* [rad] */
    v_inertia link[3]; /* about their joints, in their axes */
} leg_numbers;

/* State of the trunk. */
typedef struct {
    b3 x, xd, xdd;            /* [m], [m/s], [m/s^2] reference point, world */
    B yaw, pitch, roll;       /* [rad] */
    B yawd, pitchd, rolld;    /* [rad/s] */
    B yawdd, pitchdd, rolldd; /* [rad/s^2] */
    B held;                   /* 1: the trunk is held */
    B pose[6];                /* [m], [rad] x, y, z, yaw, pitch, roll that it is held at */
    B start[6];               /* [m], [rad] where it started */
} trunk_state;

/* State of a leg: abduction, hip, knee. */
typedef struct {
    V q[3], qd[3], qdd[3]; /* [rad], [rad/s], [rad/s^2] */
    V target[3];           /* [rad] what the servo follows now */
    V asked[3];            /* [rad] the command as it was given */
    V commanded[3]; /* [rad] the last one sent: of a damaged leg 0, with a limited slew rate */
    V work[3];      /* [J] |torque speed| over time since the start */
    V torque[3];    /* [N m] at the last tick */
    v3 foot;        /* [m] centre of the foot, world */
    v3 force;       /* [N] of the ground on the foot, world */
    V load;         /* [N] sum of its normal parts */
    V filtered;     /* [N] behind the low-pass */
    V reading;      /* [N] what the sensor delivers */
    V sound;        /* 0: the leg is damaged, else 1 */
    V stuck;        /* [N] what the sensor delivers for good; not a number: it works */
} leg_state;

/* What a leg keeps from the inward to the outward pass of the equations of motion: its part of the
 * mass matrix in the form L D L', foot first. */
typedef struct {
    V g[3][6];       /* columns of the coupling with the trunk, eliminated */
    V per_d[3];      /* one over D */
    V y[3];          /* torques, eliminated */
    V l10, l20, l21; /* L */
} leg_kept;

/* Where the parts of a plant lie. */
typedef struct {
    robot_numbers *robot;
    leg_numbers *leg; /* per group of legs */
    trunk_state *trunk;
    leg_state *state; /* per group of legs */
    leg_kept *kept;   /* per group of legs */
    V *coming;        /* commands under way: 3 per group and entry */
    V *loads;         /* readings under way: per group and entry */
    double *found;    /* places of contact that a ground wrote: per lane */
    int32_t legs;     /* number of legs */
    int32_t groups;   /* of legs: as many as there are if the lanes are robots */
    int32_t contacts; /* most places of contact of a foot; 0: planes only */
    int32_t lanes;    /* number of robots */
} plant_parts;

/* Legs in a group: all lanes, but the last group may have fewer. */
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

/* Add what the legs of a group contribute, leg after leg: the same order whatever the lanes are. */
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

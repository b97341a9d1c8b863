/* Converts the numbers of a caller to those that the equations of motion need, for one robot. */
#ifndef PLANT_NUMBERS_H
#define PLANT_NUMBERS_H

#include "plant.h"
#include "robot.h"

/* Inertia about the frame of the link, by the parallel-axis theorem. */
static inline v_inertia about_frame(const plant_body *body) {
    const double m = body->mass, x = body->com[0], y = body->com[1], z = body->com[2];
    const double *i = body->inertia;
    return (v_inertia){m,
                       {m * x, m * y, m * z},
                       i[0] + m * (y * y + z * z),
                       i[1] + m * (x * x + z * z),
                       i[2] + m * (x * x + y * y),
                       i[3] - m * x * y,
                       i[4] - m * x * z,
                       i[5] - m * y * z};
}

static inline servo_numbers servo_of(const plant_servo *servo) {
    return (servo_numbers){servo->stiffness, servo->damping, servo->stall_torque,
                           1.0 / servo->no_load_speed};
}

static inline double own_or(double own, double common) { return isnan(own) ? common : own; }

/* The servo of a joint. */
static inline plant_servo servo_at(const plant_joint *joint, const plant_servo *common) {
    plant_servo servo = *common;
    servo.stiffness = own_or(joint->stiffness, common->stiffness);
    servo.damping = own_or(joint->damping, common->damping);
    servo.stall_torque = own_or(joint->stall_torque, common->stall_torque);
    servo.no_load_speed = own_or(joint->no_load_speed, common->no_load_speed);
    servo.reflected_inertia = own_or(joint->reflected_inertia, common->reflected_inertia);
    return servo;
}

static inline passive_numbers passive_of(const plant_joint *joint) {
    return (passive_numbers){joint->joint_damping, joint->dry_friction, 1.0 / joint->friction_speed,
                             joint->low,           joint->high,         joint->stop_stiffness,
                             joint->stop_damping};
}

static inline int has_stops(const passive_numbers *n) {
    return n->low > -INFINITY || n->high < INFINITY;
}

static inline int has_passive(const passive_numbers *n) {
    return n->damping > 0.0 || n->friction > 0.0 || has_stops(n);
}

static inline double foot_radius(const plant_robot *robot, int32_t leg) {
    return own_or(robot->leg[leg].foot_radius, robot->contact.foot_radius);
}

/* The parts of a leg that plant_tune changes. */
static inline void set_joints(leg_numbers *n, const plant_robot *robot, int32_t leg) {
    for (int j = 0; j < 3; j++) {
        const plant_joint *own = &robot->leg[leg].joint[(int)n->angle[j]];
        const plant_servo servo = servo_at(own, &robot->servo);
        passive_numbers passive = passive_of(own);
        if (n->sign[j] < 0.0) { /* the coordinate is minus the joint angle */
            passive.low = -own->high;
            passive.high = -own->low;
        }
        n->joint[j] = (joint_numbers){servo.reflected_inertia, servo_of(&servo), passive};
    }
    n->radius = foot_radius(robot, leg);
}

/* A joint of a leg: its axis in the straight pose, its turn from there to the reference pose [rad],
 * the joint angle that turns it, and the coordinate per angle. */
static inline void set_joint(leg_numbers *n, int j, v3 axis, double reference, int angle,
                             double sign) {
    n->axis[j] = axis;
    n->reference[j] = reference;
    n->angle[j] = angle;
    n->sign[j] = sign;
}

static inline void set_axes(leg_numbers *n, const plant_leg *leg) {
    const v3 x = {1.0, 0.0, 0.0}, y = {0.0, 1.0, 0.0}, z = {0.0, 0.0, 1.0};
    const double side = leg->mount[1] < 0.0 ? -1.0 : 1.0;
    const double flexes = leg->knee_in_front ? 1.0 : -1.0;
    if (leg->kind == PLANT_COXA) {
        double s, c;
        s_sin_cos(leg->pointing, &s, &c);
        const v3 across = {s, -c, 0.0};
        set_joint(n, 0, z, 0.0, 1, -side);
        set_joint(n, 1, across, leg->femur_angle, 2, 1.0);
        set_joint(n, 2, across, -leg->tibia_angle, 0, side);
        return;
    }
    const int hip = leg->kind == PLANT_HIP ? 0 : 1;
    set_joint(n, 1 - hip, x, leg->abduction_angle, 0, 1.0);
    set_joint(n, hip, y, leg->femur_angle, 1, -1.0);
    set_joint(n, 2, y, -leg->tibia_angle, 2, flexes);
}

static inline void set_geometry(leg_numbers *n, const plant_leg *leg) {
    n->mount = (v3){leg->mount[0], leg->mount[1], leg->mount[2]};
    n->hip = (v3){leg->hip[0], leg->hip[1], leg->hip[2]};
    n->femur = leg->femur;
    n->tibia = leg->tibia;
    n->femur_angle = leg->femur_angle;
    n->tibia_angle = leg->tibia_angle;
    n->abduction_angle = leg->abduction_angle;
    for (int j = 0; j < 3; j++) n->free[j] = leg->locked[j] ? 0.0 : 1.0;
    set_axes(n, leg);
    for (int i = 0; i < 3; i++) n->link[i] = about_frame(&leg->link[i]);
}

static inline void set_leg(leg_numbers *n, const plant_robot *robot, int32_t leg) {
    set_geometry(n, &robot->leg[leg]);
    set_joints(n, robot, leg);
}

static inline void set_servo(robot_numbers *n, const plant_robot *robot) {
    n->slew_rate = robot->servo.slew_rate;
    n->passive = 0.0;
    for (int32_t leg = 0; leg < robot->legs; leg++)
        for (int j = 0; j < 3; j++) {
            const passive_numbers passive = passive_of(&robot->leg[leg].joint[j]);
            if (has_passive(&passive)) n->passive = 1.0;
        }
}

static inline contact_numbers contact_of(const plant_contact *contact) {
    return (contact_numbers){contact->stiffness, contact->damping, 1.0 / contact->damping_depth,
                             contact->friction, contact->friction_speed};
}

static inline void set_sensor(robot_numbers *n, const plant_sensor *sensor) {
    n->time_constant = sensor->time_constant;
    n->noise = n->deviation = sensor->noise * n->half_weight;
    n->norm = sensor->norm ? 1.0 : 0.0;
}

/* Whether a robot has legs of other kinds than PLANT_ABDUCTION. */
static inline int32_t has_any_axes(const plant_robot *robot) {
    for (int32_t leg = 0; leg < robot->legs; leg++)
        if (robot->leg[leg].kind != PLANT_ABDUCTION) return 1;
    return 0;
}

/* Rotation from a ground to the world. */
static inline rotation rotation_of(const plant_ground *ground) {
    double s, c;
    s_sin_cos(ground->slope, &s, &c);
    return (rotation){{c, 0.0, -s}, {0.0, 1.0, 0.0}, {s, 0.0, c}};
}

static inline void set_robot(robot_numbers *n, const plant_robot *robot,
                             const plant_ground *ground) {
    const double *center = robot->trunk_center, *size = robot->trunk_size;
    const plant_suspension *s = &robot->suspension;
    const v_inertia trunk = about_frame(&robot->trunk);
    n->trunk = (b_inertia){trunk.m,  {trunk.h.x, trunk.h.y, trunk.h.z},
                           trunk.xx, trunk.yy,
                           trunk.zz, trunk.xy,
                           trunk.xz, trunk.yz};
    n->gravity = robot->gravity;
    n->half_weight = robot->weight / 2.0;
    set_servo(n, robot);
    n->contact = contact_of(&robot->contact);
    set_sensor(n, &robot->sensor);
    n->hold[0] = s->stiffness;
    n->hold[1] = s->damping;
    n->hold[2] = s->angular_stiffness;
    n->hold[3] = s->angular_damping;
    n->ground = rotation_of(ground);
    n->top = ground->top;
    n->box_center = (b3){center[0], center[1], center[2]};
    n->box_half = (b3){size[0] / 2.0, size[1] / 2.0, size[2] / 2.0};
}

/* Set the state at rest at coordinates as of plant_place; the commands are the same coordinates. */
static inline void set_start(const plant_parts *p, const double *coordinates, double height) {
    trunk_state *t = p->trunk;
    for (int i = 0; i < 6; i++) t->start[i] = coordinates[i];
    t->x = (b3){coordinates[0], coordinates[1], coordinates[2] + height};
    t->yaw = coordinates[3];
    t->pitch = coordinates[4];
    t->roll = coordinates[5];
    for (int32_t leg = 0; leg < p->legs; leg++) {
        leg_state *s = &p->state[leg];
        for (int j = 0; j < 3; j++) {
            const leg_numbers *n = &p->leg[leg];
            const double angle = coordinates[6 + 3 * leg + (int)n->angle[j]];
            s->q[j] = s->target[j] = s->asked[j] = s->commanded[j] = n->sign[j] * angle;
        }
        s->sound = 1.0;
        s->stuck = NAN;
    }
}

#endif

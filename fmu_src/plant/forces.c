/* What acts on a robot besides gravity, for engines that know trees of bodies but neither these
 * servos nor this contact: the laws of servo.h, contact.h and ground.h on coordinates of theirs. */
#include "contact.h"
#include "ground.h"
#include "plant.h"
#include "servo.h"

#define FORCES_TIPPED  0.5   /* cosine of 60 degrees */
#define FORCES_UPENDED 0.174 /* cosine of 80 degrees */

/* Pivots and foot of a leg, in the trunk frame. */
typedef struct {
    v3 hip, knee, foot; /* [m] */
    v3 axis;            /* [1] of hip and knee */
} leg_pose;

static v3 vector_at(const double *x) { return (v3){x[0], x[1], x[2]}; }

static leg_pose pose_of(const plant_leg *leg, double abduction, double hip, double knee) {
    double s, c, s2, c2, s3, c3;
    const double tilt = hip - leg->femur_angle, low = tilt + knee + leg->tibia_angle;
    s_sin_cos(abduction, &s, &c);
    s_sin_cos(tilt, &s2, &c2);
    s_sin_cos(low, &s3, &c3);
    const v3 femur = {leg->femur * s2, s * leg->femur * c2, -c * leg->femur * c2};
    const v3 tibia = {leg->tibia * s3, s * leg->tibia * c3, -c * leg->tibia * c3};
    leg_pose pose;
    pose.hip = v_add(vector_at(leg->mount), about_x(c, s, vector_at(leg->hip)));
    pose.knee = v_add(pose.hip, femur);
    pose.foot = v_add(pose.knee, tibia);
    pose.axis = (v3){0.0, -c, -s};
    return pose;
}

/* From trunk to world: Rz(yaw) Ry(pitch) Rx(roll). */
static rotation trunk_to_world(double yaw, double pitch, double roll) {
    double sr, cr, sp, cp, sy, cy;
    s_sin_cos(roll, &sr, &cr);
    s_sin_cos(pitch, &sp, &cp);
    s_sin_cos(yaw, &sy, &cy);
    return (rotation){{cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr},
                      {sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr},
                      {-sp, cp * sr, cp * cr}};
}

/* From ground to world: about y, so that the ground rises along x. */
static rotation ground_to_world(double slope) {
    double s, c;
    s_sin_cos(slope, &s, &c);
    return (rotation){{c, 0.0, -s}, {0.0, 1.0, 0.0}, {s, 0.0, c}};
}

/* A trunk in motion. */
typedef struct {
    rotation world;   /* [1] from trunk to world */
    v3 place;         /* [m] world frame */
    v3 velocity;      /* [m/s] trunk frame */
    v3 spin;          /* [rad/s] trunk frame */
    double sine_roll; /* [1] */
    double cosine_roll;
} trunk_motion;

static trunk_motion motion_of(const double *q, const double *v) {
    trunk_motion t;
    t.world = trunk_to_world(q[3], q[4], q[5]);
    t.place = vector_at(q);
    t.velocity = v_turn_back(&t.world, vector_at(v));
    s_sin_cos(q[5], &t.sine_roll, &t.cosine_roll);
    const v3 rates = {v[5], t.cosine_roll * v[4], -t.sine_roll * v[4]};
    t.spin = v_add(v_scale(v[3], wide3(t.world.z)), rates);
    return t;
}

/* Where what a leg feels is added to. */
typedef struct {
    double *base;  /* [N], [N m] generalized forces of the trunk, 6 */
    double *joint; /* [N m] of the three joints */
    double *force; /* [N] of the ground on the foot, world frame, 3 */
    double *load;  /* [N] sum of the normal forces */
} leg_sums;

/* Add the force at one place of contact. */
static void push(const contact_numbers *contact, double stopping, const rotation *ground,
                 const trunk_motion *trunk, const plant_leg *leg, const leg_pose *pose,
                 const double *speed, const double *found, leg_sums to) {
    const v3 normal = vector_at(found), x = {1.0, 0.0, 0.0}, axis = pose->axis;
    const v3 below = v_turn(ground, v_scale(-contact->radius, normal));
    const v3 point = v_add(pose->foot, v_turn_back(&trunk->world, below));
    const v3 from_mount = v_sub(point, vector_at(leg->mount));
    const v3 from_hip = v_sub(point, pose->hip), from_knee = v_sub(point, pose->knee);
    /* Hip and knee of the tree turn about +y, the leg swings forward about -y. */
    v3 velocity = v_add(trunk->velocity, v_cross(trunk->spin, point));
    velocity = v_add(velocity, v_scale(speed[0], v_cross(x, from_mount)));
    velocity = v_add(velocity, v_scale(-speed[1], v_cross(axis, from_hip)));
    velocity = v_add(velocity, v_scale(-speed[2], v_cross(axis, from_knee)));
    const v3 seen = v_turn_back(ground, v_turn(&trunk->world, velocity));
    double press;
    const v3 world =
        v_turn(ground, contact_force(contact, normal, found[3], seen, stopping, &press));
    const v3 local = v_turn_back(&trunk->world, world), moment = v_cross(point, local);
    to.base[0] += world.x;
    to.base[1] += world.y;
    to.base[2] += world.z;
    to.base[3] += v_dot(wide3(trunk->world.z), moment);
    to.base[4] += trunk->cosine_roll * moment.y - trunk->sine_roll * moment.z;
    to.base[5] += moment.x;
    to.joint[0] += v_cross(from_mount, local).x;
    to.joint[1] -= v_dot(axis, v_cross(from_hip, local));
    to.joint[2] -= v_dot(axis, v_cross(from_knee, local));
    to.force[0] += world.x;
    to.force[1] += world.y;
    to.force[2] += world.z;
    *to.load += press;
}

static void suspend(const plant_suspension *by, const double *held, const double *q,
                    const double *v, double *out) {
    for (int i = 0; i < 3; i++) {
        out[i] += by->stiffness * (held[i] - q[i]) - by->damping * v[i];
        out[3 + i] +=
            by->angular_stiffness * (held[3 + i] - q[3 + i]) - by->angular_damping * v[3 + i];
    }
}

void plant_forces(const plant_robot *robot, const plant_ground *ground, const double *q,
                  const double *v, const double *target, const double *held, double stopping,
                  int32_t touches, double dt, double *work, double *out) {
    const int legs = robot->legs, joints = 3 * legs, size = 6 + joints;
    double *torque = out + size, *foot = torque + joints, *force = foot + joints;
    double *load = force + joints, *found = load + legs;
    const servo_numbers servo = {robot->servo.stiffness, robot->servo.damping,
                                 robot->servo.stall_torque, 1.0 / robot->servo.no_load_speed};
    const plant_contact *rubber = &robot->contact;
    const contact_numbers contact = {rubber->foot_radius, rubber->stiffness,
                                     rubber->damping,     1.0 / rubber->damping_depth,
                                     rubber->friction,    rubber->friction_speed};
    const rotation slope = ground_to_world(ground->slope);
    const trunk_motion trunk = motion_of(q, v);
    memset(out, 0, sizeof *out * (size_t)(size + 3 * joints + legs));
    if (held) suspend(&robot->suspension, held, q, v, out);
    for (int i = 0; i < joints; i++) {
        torque[i] = servo_torque(&servo, target[i] - q[6 + i], v[6 + i]);
        out[6 + i] += torque[i];
        work[i] += s_abs(torque[i] * v[6 + i]) * dt;
    }
    for (int k = 0; k < legs; k++) {
        const double *angle = q + 6 + 3 * k, *speed = v + 6 + 3 * k;
        const plant_leg *leg = &robot->leg[k];
        const leg_pose pose = pose_of(leg, angle[0], -angle[1], -angle[2]);
        const v3 center = v_add(trunk.place, v_turn(&trunk.world, pose.foot));
        foot[3 * k] = center.x;
        foot[3 * k + 1] = center.y;
        foot[3 * k + 2] = center.z;
        const v3 at = v_turn_back(&slope, center);
        if (!touches || !(at.z < contact.radius + ground->top)) continue;
        const int32_t count = ground_touches(ground, at.x, at.y, at.z, contact.radius, found);
        const leg_sums to = {out, out + 6 + 3 * k, force + 3 * k, load + k};
        for (int32_t c = 0; c < count; c++)
            push(&contact, stopping, &slope, &trunk, leg, &pose, speed, found + 4 * c, to);
    }
}

int32_t plant_fallen(const plant_robot *robot, const plant_ground *ground, const double *q,
                     double *found) {
    const rotation world = trunk_to_world(q[3], q[4], q[5]), slope = ground_to_world(ground->slope);
    /* The third column of both: the upright axis of the trunk and the normal of the ground. On a
     * steep slope the trunk can point straight up or down before it is tipped by 60 degrees; there
     * yaw and roll are one, so that it counts as fallen 10 degrees earlier. */
    const double upright = world.x.z * slope.x.z + world.y.z * slope.y.z + world.z.z * slope.z.z;
    double sp, cp;
    s_sin_cos(q[4], &sp, &cp);
    if (!(upright >= FORCES_TIPPED && s_abs(cp) >= FORCES_UPENDED)) return 1;
    for (int corner = 0; corner < 8; corner++) {
        double edge[3];
        for (int i = 0; i < 3; i++)
            edge[i] =
                robot->trunk_center[i] + (corner >> i & 1 ? 0.5 : -0.5) * robot->trunk_size[i];
        const v3 there = v_add(vector_at(q), v_turn(&world, vector_at(edge)));
        const v3 at = v_turn_back(&slope, there);
        if (at.z < ground->top && ground_touches(ground, at.x, at.y, at.z, 0.0, found) > 0)
            return 1;
    }
    return 0;
}

void plant_leg_points(const plant_leg *leg, double abduction, double hip, double knee,
                      double *points) {
    const leg_pose pose = pose_of(leg, abduction, hip, knee);
    memcpy(points, &pose, 9 * sizeof *points);
}

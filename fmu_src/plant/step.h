/* The longest integration steps that follow the motion of a robot. docs/physics/step.md has the
 * derivation.
 *
 * The robot stands in its reference pose with all feet on a level plane. All that is stiff acts at
 * once: every servo with its stiffness and damping, every joint with its friction, its damping and
 * the springs of its stops, every foot with its stiffness and its full damping. M is the mass
 * matrix, K and D are the matrices of these stiffnesses and dampings. Velocity Verlet, which
 * computes forces with the speed of half a step before, is stable with a step h if and only if 4 M
 * - 2 h D - h^2 K is positive definite. */
#ifndef PLANT_STEP_H
#define PLANT_STEP_H

#include "foot_mass.h"
#include "numbers.h"
#include "plant_config.h"

#define STEP_MARGIN 1.4           /* longest step over the one that a robot gets, at least */
#define STEP_USUAL  (1.0 / 960.0) /* [s] longest step that a robot gets: 16 in a tick of 1/60 s */
#define STEP_PARTS  480.0 /* [1/s] one over a step that a robot gets is a multiple of this */
#define STEP_ROUNDS 50    /* of the power iteration, which errs by 0.4 % at most */

#ifndef PLANT_MOST_LEGS
#define PLANT_MOST_LEGS 64
#endif

enum { STEP_LAWS = 4 }; /* of a leg: its foot, then its three servos */

/* A spring and a damper. */
typedef struct {
    double stiffness, damping;
} step_law;

/* Accelerations at the ends of all springs, of the robot at rest on which only forces at these ends
 * act: for every leg that of the foot, along the normal of the ground, and those of the joints. */
static inline void step_response(const plant_parts *p, const trunk_motion *t, const double *forces,
                                 double *response) {
    const V none[3] = {0.0, 0.0, 0.0}; /* angles of the reference pose, and speeds */
    const v3 up = wide3(t->up), still = {0.0, 0.0, 0.0};
    B sum[SUMS], z[6];
    trunk_alone(p->robot, t, sum);
    for (int32_t g = 0; g < p->groups; g++) {
        const leg_motion m = leg_moves(p->any_axes, &p->leg[g], none, none, still, still);
        const v3 force = about_x(m.c1, -m.s1, v_scale(forces[STEP_LAWS * g], up));
        const push ground = {force, v_cross(m.tibia, force), 0.0};
        V part[SUMS];
        leg_inward(p->any_axes, &p->leg[g], &m, none, forces + STEP_LAWS * g + 1, &ground,
                   &p->kept[g], part);
        add_up(p, g, sum, part, SUMS);
    }
    add_linear_part(sum);
    for (int i = 0; i < 6; i++) z[i] = -sum[SUM_X + i];
    solve_trunk(sum, z);
    for (int32_t g = 0; g < p->groups; g++) {
        V *joints = response + STEP_LAWS * g + 1;
        leg_outward(&p->kept[g], z, joints);
        /* at rest, accelerations obey the same relations as speeds */
        const leg_motion m = leg_moves(p->any_axes, &p->leg[g], none, joints,
                                       (v3){z[0], z[1], z[2]}, (v3){z[3], z[4], z[5]});
        const v3 foot = v_add(m.third.v, v_cross(m.third.w, m.tibia));
        response[STEP_LAWS * g] = v_dot(about_x(m.c1, m.s1, foot), up);
    }
}

/* The spring and the damper of a joint. */
static inline step_law joint_law(const joint_numbers *joint) {
    const servo_numbers *servo = &joint->servo;
    const passive_numbers *passive = &joint->passive;
    /* a servo at the limit of its voltage is a damper */
    step_law law = {servo->stiffness, s_max(servo->damping, servo->stall * servo->per_no_load)};
    law.damping += passive->damping;
    if (passive->friction > 0.0) law.damping += passive->friction * passive->per_slow;
    if (has_stops(passive)) {
        law.stiffness += passive->stop_stiffness;
        law.damping += passive->stop_damping;
    }
    return law;
}

/* Longest stable step [s] with springs and dampers alone, by power iteration: the motion u that is
 * the first to become unstable has the smallest h with u' (4 M - 2 h D - h^2 K) u = 0. */
static inline double step_of_springs(const plant_parts *p) {
    const contact_numbers *contact = &p->robot->contact;
    step_law law[STEP_LAWS * PLANT_MOST_LEGS];
    for (int32_t leg = 0; leg < p->legs; leg++) {
        law[STEP_LAWS * leg] = (step_law){contact->stiffness, contact->damping};
        for (int j = 0; j < 3; j++) law[STEP_LAWS * leg + 1 + j] = joint_law(&p->leg[leg].joint[j]);
    }
    const trunk_motion t = trunk_moves(p);
    const int32_t ends = STEP_LAWS * p->legs;
    double force[STEP_LAWS * PLANT_MOST_LEGS], moved[STEP_LAWS * PLANT_MOST_LEGS], h = STEP_USUAL;
    for (int32_t i = 0; i < ends; i++) force[i] = 1.0 + 0.1 * (double)(i % 7); /* all modes */
    for (int round = 0; round < STEP_ROUNDS; round++) {
        double mass = 0.0, stiffness = 0.0, damping = 0.0, largest = 0.0;
        step_response(p, &t, force, moved);
        for (int32_t i = 0; i < ends; i++) {
            const step_law *l = &law[i];
            mass += force[i] * moved[i];
            stiffness += l->stiffness * moved[i] * moved[i];
            damping += l->damping * moved[i] * moved[i];
        }
        stiffness /= mass;
        damping /= mass;
        h = 4.0 / (damping + s_sqrt(damping * damping + 4.0 * stiffness));
        for (int32_t i = 0; i < ends; i++) {
            const step_law *l = &law[i];
            force[i] = (2.0 * l->damping + h * l->stiffness) * moved[i];
            largest = s_max(largest, s_abs(force[i]));
        }
        for (int32_t i = 0; i < ends; i++) force[i] /= largest;
    }
    return h;
}

/* Longest step [s] with which friction at the usual load slows a foot below the friction speed
 * only. In a gait with half its feet on the ground a foot carries twice its share of the weight. */
static inline double step_of_friction(const plant_parts *p) {
    const contact_numbers *contact = &p->robot->contact;
    const double load = 4.0 * p->robot->half_weight / (double)p->legs;
    return least_foot_mass(p) * contact->slow / (contact->friction * load);
}

#endif

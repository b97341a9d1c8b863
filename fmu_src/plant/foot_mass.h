/* Apparent mass of the feet of one robot at rest, along the ground. */
#ifndef PLANT_FOOT_MASS_H
#define PLANT_FOOT_MASS_H

#include "dynamics.h"

/* Accelerations of the trunk, in its axes (z), and of the joints of leg `pushed`, when a force in
 * the axes of the trunk pushes its foot and nothing else acts. */
static inline void pushed_foot(const plant_parts *p, const trunk_motion *t, int32_t pushed,
                               b3 force, B z[6], V qdd[3]) {
    const V none[3] = {0.0, 0.0, 0.0};
    B sum[SUMS];
    trunk_alone(p->robot, t, sum);
    for (int32_t g = 0; g < p->groups; g++) {
        const leg_motion m =
            leg_moves(p->any_axes, &p->leg[g], p->state[g].q, none, (v3){0, 0, 0}, (v3){0, 0, 0});
        push ground = {{0, 0, 0}, {0, 0, 0}, 0};
        V part[SUMS];
        if (g == pushed) {
            ground.force = about_x(m.c1, -m.s1, wide3(force));
            ground.moment = v_cross(m.tibia, ground.force);
        }
        leg_inward(p->any_axes, &p->leg[g], &m, none, none, &ground, &p->kept[g], part);
        add_up(p, g, sum, part, SUMS);
    }
    add_linear_part(sum);
    for (int i = 0; i < 6; i++) z[i] = -sum[SUM_X + i];
    solve_trunk(sum, z);
    leg_outward(&p->kept[pushed], z, qdd);
}

/* Least apparent mass of any foot in any direction along the ground [kg].
 *
 * One over the largest eigenvalue of T' J M^-1 J' T, with J the Jacobian of the foot centre and T
 * two unit vectors along the ground: force over acceleration of a foot that is pushed sideways,
 * with the other feet free (Khatib, 1987). */
static inline double least_foot_mass(const plant_parts *p) {
    trunk_motion t = trunk_moves(p);
    const b3 along[2] = {b_turn_back(&t.turn, column(&p->robot->ground, 0)),
                         b_turn_back(&t.turn, column(&p->robot->ground, 1))};
    double largest = 0.0;
    t.w = t.v = (b3){0, 0, 0};
    for (int32_t leg = 0; leg < p->groups; leg++) {
        double mobility[2][2];
        for (int i = 0; i < 2; i++) {
            B z[6];
            V qdd[3];
            pushed_foot(p, &t, leg, along[i], z, qdd);
            /* at rest, accelerations obey the same relations as speeds */
            const leg_motion m = leg_moves(p->any_axes, &p->leg[leg], p->state[leg].q, qdd,
                                           (v3){z[0], z[1], z[2]}, (v3){z[3], z[4], z[5]});
            const v3 knee = v_add(m.third.v, v_cross(m.third.w, m.tibia));
            const v3 foot = about_x(m.c1, m.s1, knee);
            for (int k = 0; k < 2; k++) mobility[i][k] = v_dot(foot, wide3(along[k]));
        }
        const double half = 0.5 * (mobility[0][0] + mobility[1][1]);
        const double apart = 0.5 * (mobility[0][0] - mobility[1][1]);
        const double eigenvalue = half + s_sqrt(apart * apart + mobility[0][1] * mobility[1][0]);
        if (eigenvalue > largest) largest = eigenvalue;
    }
    return 1.0 / largest;
}

#endif

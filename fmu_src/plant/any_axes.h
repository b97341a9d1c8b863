/* Legs whose joints turn about any axes: the same quantities as for abduction about x, hip and knee
 * about y, in axes of the trunk.
 *
 * Here the axes of the leg are those of the trunk, so its cosine and sine of the abduction are 1
 * and 0. What follows from a leg_motion or a leg_balance is computed by the same lines for all
 * legs. */
#ifndef PLANT_ANY_AXES_H
#define PLANT_ANY_AXES_H

#include "leg.h"

/* A rotation by an angle about a unit axis, by the formula of Rodrigues. */
INL v_rotation rotation_about(v3 axis, V angle) {
    V s, c;
    v_sin_cos(angle, &s, &c);
    const V one = v_all(1.0);
    const v3 a = v_scale(one - c, axis), b = v_scale(s, axis);
    return (v_rotation){{a.x * axis.x + c, a.x * axis.y - b.z, a.x * axis.z + b.y},
                        {a.y * axis.x + b.z, a.y * axis.y + c, a.y * axis.z - b.x},
                        {a.z * axis.x - b.y, a.z * axis.y + b.x, a.z * axis.z + c}};
}

INL v3 vr_turn(const v_rotation *r, v3 a) {
    return (v3){v_dot(r->x, a), v_dot(r->y, a), v_dot(r->z, a)};
}

/* The vector of components of a with the rows of a matrix whose columns are turned. */
INL v3 vr_row(v3 row, const v_rotation *r) {
    return v_add(v_scale(row.x, r->x), v_add(v_scale(row.y, r->y), v_scale(row.z, r->z)));
}

/* First a, then b outside of it: the product b a. */
INL v_rotation vr_after(const v_rotation *b, const v_rotation *a) {
    return (v_rotation){vr_row(b->x, a), vr_row(b->y, a), vr_row(b->z, a)};
}

/* An inertia in axes that are turned: R I R'. */
INL v_inertia vr_inertia(const v_rotation *r, const v_inertia *i) {
    const v3 x = v_inertia_times(i, r->x), y = v_inertia_times(i, r->y);
    const v3 z = v_inertia_times(i, r->z);
    return (v_inertia){i->m,           vr_turn(r, i->h), v_dot(r->x, x), v_dot(r->y, y),
                       v_dot(r->z, z), v_dot(r->x, y),   v_dot(r->x, z), v_dot(r->y, z)};
}

INL leg_motion leg_moves_any(const leg_numbers *n, const V *q, const V *qd, v3 w, v3 v) {
    leg_motion m;
    const V zero = v_all(0.0);
    memset(&m, 0, sizeof m);
    m.c1 = v_all(1.0);
    m.s1 = zero;
    for (int j = 0; j < 3; j++) {
        const v_rotation own = rotation_about(n->axis[j], n->reference[j] + q[j]);
        m.axis[j] = j ? vr_turn(&m.link[j - 1], n->axis[j]) : n->axis[j];
        m.link[j] = j ? vr_after(&m.link[j - 1], &own) : own;
    }
    m.hip = vr_turn(&m.link[0], n->hip);
    m.femur = vr_turn(&m.link[1], (v3){zero, zero, -n->femur});
    m.tibia = vr_turn(&m.link[2], (v3){zero, zero, -n->tibia});
    m.foot = v_add(n->mount, v_add(m.hip, v_add(m.femur, m.tibia)));
    m.first = (twist){v_add(w, v_scale(qd[0], m.axis[0])), v_add(v, v_cross(w, n->mount))};
    m.second = (twist){v_add(m.first.w, v_scale(qd[1], m.axis[1])),
                       v_add(m.first.v, v_cross(m.first.w, m.hip))};
    m.third = (twist){v_add(m.second.w, v_scale(qd[2], m.axis[2])),
                      v_add(m.second.v, v_cross(m.second.w, m.femur))};
    return m;
}

/* Add to an acceleration what a joint causes that turns with its link: V x S qd. */
INL twist with_bias(twist a, twist moves, v3 axis, V qd) {
    const v3 turns = v_scale(qd, axis);
    return (twist){v_add(a.w, v_cross(moves.w, turns)), v_add(a.v, v_cross(moves.v, turns))};
}

/* Column of the mass matrix: the wrench that moves a body as a joint does. */
INL wrench column_of(const v_inertia *i, v3 axis) {
    return (wrench){v_inertia_times(i, axis), v_cross(axis, i->h)};
}

INL leg_balance leg_balance_any(const leg_numbers *n, const leg_motion *m, const V *qd,
                                const V *torque, const push *ground) {
    const V zero = v_all(0.0);
    const v3 still = {zero, zero, zero}, r = m->hip, d = m->femur, *A = m->axis;
    const twist a1 = with_bias((twist){still, still}, m->first, A[0], qd[0]);
    const twist a2 =
        with_bias((twist){a1.w, v_add(a1.v, v_cross(a1.w, r))}, m->second, A[1], qd[1]);
    const twist a3 = with_bias((twist){a2.w, v_add(a2.v, v_cross(a2.w, d))}, m->third, A[2], qd[2]);
    const v_inertia i1 = vr_inertia(&m->link[0], &n->link[0]);
    const v_inertia i2 = vr_inertia(&m->link[1], &n->link[1]);
    const v_inertia i3 = vr_inertia(&m->link[2], &n->link[2]);
    wrench f3 = newton_euler(&i3, m->third, a3);
    wrench f2 = newton_euler(&i2, m->second, a2);
    wrench f1 = newton_euler(&i1, m->first, a1);
    f3.f = v_sub(f3.f, ground->force);
    f3.n = v_sub(f3.n, ground->moment);
    const wrench m3 = moved(f3, d);
    f2 = (wrench){v_add(f2.n, m3.n), v_add(f2.f, m3.f)};
    const wrench m2 = moved(f2, r);
    f1 = (wrench){v_add(f1.n, m2.n), v_add(f1.f, m2.f)};
    leg_balance b;
    b.u[0] = torque[0] - v_dot(A[0], f1.n);
    b.u[1] = torque[1] - v_dot(A[1], f2.n);
    b.u[2] = torque[2] - v_dot(A[2], f3.n);
    b.bias = f1;
    const v_inertia i23 = joined(shifted(i3, d), &i2);
    b.all = joined(shifted(i23, r), &i1);
    b.column[0] = column_of(&i3, A[2]);
    b.M33 = v_dot(A[2], b.column[0].n) + n->joint[2].rotor;
    b.column[0] = moved(b.column[0], d);
    b.M23 = v_dot(A[1], b.column[0].n);
    b.column[0] = moved(b.column[0], r);
    b.M13 = v_dot(A[0], b.column[0].n);
    b.column[1] = column_of(&i23, A[1]);
    b.M22 = v_dot(A[1], b.column[1].n) + n->joint[1].rotor;
    b.column[1] = moved(b.column[1], r);
    b.M12 = v_dot(A[0], b.column[1].n);
    b.column[2] = column_of(&b.all, A[0]);
    b.M11 = v_dot(A[0], b.column[2].n) + n->joint[0].rotor;
    return b;
}

#endif

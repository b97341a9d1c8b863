/* Equations of motion of a trunk with legs, for any number of lanes.
 *
 * Every leg is a chain of three links. Its composite inertia is summed from the foot inward
 * (Featherstone 2008, chapter 6), its three joints are eliminated (L D L'), and the remainder is
 * added to the trunk. This leaves a Schur complement of six unknowns, so the cost grows linearly
 * with the number of legs. Accelerations are computed in a freely falling frame; gravity is
 * subtracted at the end. */
#ifndef PLANT_DYNAMICS_H
#define PLANT_DYNAMICS_H

#include "any_axes.h"
#include "ground.h"

/* Orientation and motion of the trunk. */
typedef struct {
    B sr, cr, sp, cp; /* sine and cosine of roll and pitch */
    rotation turn;    /* from trunk to world */
    b3 w, v;          /* [rad/s], [m/s] in the axes of the trunk */
    b3 up;            /* normal of the ground in the axes of the trunk */
    B height;         /* [m] of the reference point over the plane of the ground */
    rotation ground;  /* from ground to trunk, row by row; not set for planes */
    b3 at;            /* [m] reference point in the frame of the ground; not set for planes */
} trunk_motion;

INL b3 column(const rotation *r, int i) {
    return i == 0   ? (b3){r->x.x, r->y.x, r->z.x}
           : i == 1 ? (b3){r->x.y, r->y.y, r->z.y}
                    : (b3){r->x.z, r->y.z, r->z.z};
}

INL trunk_motion trunk_moves(const plant_parts *p) {
    const trunk_state *s = p->trunk;
    trunk_motion m;
    B sy, cy;
    b_sin_cos(s->roll, &m.sr, &m.cr);
    b_sin_cos(s->pitch, &m.sp, &m.cp);
    b_sin_cos(s->yaw, &sy, &cy);
    m.turn.x = (b3){cy * m.cp, cy * m.sp * m.sr - sy * m.cr, cy * m.sp * m.cr + sy * m.sr};
    m.turn.y = (b3){sy * m.cp, sy * m.sp * m.sr + cy * m.cr, sy * m.sp * m.cr - cy * m.sr};
    m.turn.z = (b3){-m.sp, m.cp * m.sr, m.cp * m.cr};
    m.w = (b3){s->rolld - m.sp * s->yawd, m.cr * s->pitchd + m.cp * m.sr * s->yawd,
               m.cp * m.cr * s->yawd - m.sr * s->pitchd};
    m.v = b_turn_back(&m.turn, s->xd);
    const rotation *g = &p->robot->ground;
    const b3 normal = column(g, 2);
    m.up = b_turn_back(&m.turn, normal);
    m.height = b_dot(normal, s->x);
    if (p->contacts) {
        const b3 along = b_turn_back(&m.turn, column(g, 0));
        const b3 across = b_turn_back(&m.turn, column(g, 1));
        m.ground = (rotation){
            {along.x, across.x, m.up.x}, {along.y, across.y, m.up.y}, {along.z, across.z, m.up.z}};
        m.at = b_turn_back(g, s->x);
    }
    return m;
}

/* Motion of a leg with abduction about x, hip and knee about y. */
INL leg_motion leg_moves_xyy(const leg_numbers *n, const V *q, const V *qd, v3 w, v3 v) {
    leg_motion m;
    const V zero = v_all(0.0);
    const V alpha = n->femur_angle + q[1], beta = alpha - n->tibia_angle + q[2];
    v_sin_cos(n->abduction_angle + q[0], &m.s1, &m.c1);
    v_sin_cos(alpha, &m.sa, &m.ca);
    v_sin_cos(beta, &m.sb, &m.cb);
    m.femur = (v3){-n->femur * m.sa, zero, -n->femur * m.ca};
    m.tibia = (v3){-n->tibia * m.sb, zero, -n->tibia * m.cb};
    const v3 reach = v_add(n->hip, v_add(m.femur, m.tibia));
    m.foot = v_add(n->mount, about_x(m.c1, m.s1, reach));
    m.first =
        (twist){about_x(m.c1, -m.s1, w), about_x(m.c1, -m.s1, v_add(v, v_cross(w, n->mount)))};
    m.first.w.x += qd[0];
    m.second = (twist){m.first.w, v_add(m.first.v, v_cross(m.first.w, n->hip))};
    m.second.w.y += qd[1];
    m.third = (twist){m.second.w, v_add(m.second.v, v_cross(m.second.w, m.femur))};
    m.third.w.y += qd[2];
    return m;
}

/* any: 1 for legs with any axes. Where it is a constant only one of the two is compiled. */
INL leg_motion leg_moves(int any, const leg_numbers *n, const V *q, const V *qd, v3 w, v3 v) {
    return any ? leg_moves_any(n, q, qd, w, v) : leg_moves_xyy(n, q, qd, w, v);
}

INL void add_push(const plant_parts *p, const leg_numbers *n, const leg_motion *m, v3 normal,
                  V depth, B stopping, push *sum) {
    const contact_numbers *c = &p->robot->contact;
    V press;
    const v3 lever = v_sub(m->tibia, v_scale(n->radius, normal));
    const v3 velocity = v_add(m->third.v, v_cross(m->third.w, lever));
    const v3 force = contact_force(c, normal, depth, velocity, stopping, &press);
    sum->force = v_add(sum->force, force);
    sum->moment = v_add(sum->moment, v_cross(lever, force));
    sum->load += press;
}

/* Contacts with a ground that is not a plane: its touch function is called lane by lane. */
INL push push_uneven(const plant_parts *p, const plant_ground *const *grounds,
                     const trunk_motion *t, const leg_numbers *n, const leg_motion *m,
                     int32_t group, B stopping) {
    const V zero = v_all(0.0);
    const V radius = n->radius, top = wide(p->robot->top);
    const v3 at = v_add(wide3(t->at), v_turn_back(&t->ground, m->foot));
    push sum = {{zero, zero, zero}, {zero, zero, zero}, zero};
    int32_t count[PLANT_WIDTH], most = 0;
    for (int lane = 0; lane < PLANT_WIDTH; lane++) {
        const int robot = lane % PLANT_ROBOTS_ABREAST;
        double *found = p->found + (size_t)lane * 4 * (size_t)p->contacts;
        count[lane] = 0;
#ifdef PLANT_LEGS_ABREAST
        if (lane >= legs_in(p, group)) continue;
#else
        (void)group;
#endif
        if (grounds[robot] && V_AT(at.z, lane) < V_AT(radius, lane) + V_AT(top, lane))
            count[lane] = ground_touches(grounds[robot], V_AT(at.x, lane), V_AT(at.y, lane),
                                         V_AT(at.z, lane), V_AT(radius, lane), found);
        if (count[lane] > most) most = count[lane];
    }
    for (int32_t k = 0; k < most; k++) {
        v3 normal = {zero, zero, zero};
        V depth = zero;
        for (int lane = 0; lane < PLANT_WIDTH; lane++) {
            if (k >= count[lane]) continue;
            const double *found = p->found + (size_t)lane * 4 * (size_t)p->contacts + 4 * k;
            V_AT(normal.x, lane) = found[0];
            V_AT(normal.y, lane) = found[1];
            V_AT(normal.z, lane) = found[2];
            V_AT(depth, lane) = found[3];
        }
        const v3 trunk = v_turn(&t->ground, normal);
        const push before = sum;
        add_push(p, n, m, about_x(m->c1, -m->s1, trunk), depth, stopping, &sum);
        /* a lane without this contact keeps its bits */
        const V none = v_all(0.0);
#define KEEP(x) sum.x = v_select(depth > none, sum.x, before.x)
        KEEP(force.x);
        KEEP(force.y);
        KEEP(force.z);
        KEEP(moment.x);
        KEEP(moment.y);
        KEEP(moment.z);
        KEEP(load);
#undef KEEP
    }
    return sum;
}

INL push push_of_ground(const plant_parts *p, const plant_ground *const *grounds,
                        const trunk_motion *t, const leg_numbers *n, const leg_motion *m,
                        int32_t group, B stopping) {
    if (p->contacts) return push_uneven(p, grounds, t, n, m, group, stopping);
    const V zero = v_all(0.0);
    push sum = {{zero, zero, zero}, {zero, zero, zero}, zero};
    const V depth = n->radius - (wide(t->height) + v_dot(wide3(t->up), m->foot));
    add_push(p, n, m, about_x(m->c1, -m->s1, wide3(t->up)), depth, stopping, &sum);
    return sum;
}

/* Entries of the sums over the legs: lower triangle of the trunk's six equations, first moment,
 * mass, right side. */
enum { SUM_H = 21, SUM_M = 24, SUM_X = 25, SUMS = 31 };
#define LOWER(i, j) ((i) * ((i) + 1) / 2 + (j))

/* Bias forces and composite inertia of a leg with abduction about x, hip and knee about y. */
INL leg_balance leg_balance_xyy(const leg_numbers *n, const leg_motion *m, const V *qd,
                                const V *torque, const push *ground) {
    leg_balance b;
    const V zero = v_all(0.0);
    const twist T1 = m->first, T2 = m->second, T3 = m->third;
    const v3 r = n->hip, d = m->femur;
    /* accelerations of the links without those of the coordinates */
    const twist a1 = {{zero, T1.w.z * qd[0], -T1.w.y * qd[0]},
                      {zero, T1.v.z * qd[0], -T1.v.y * qd[0]}};
    twist a2 = {a1.w, v_add(a1.v, v_cross(a1.w, r))};
    a2.w.x -= T2.w.z * qd[1];
    a2.w.z += T2.w.x * qd[1];
    a2.v.x -= T2.v.z * qd[1];
    a2.v.z += T2.v.x * qd[1];
    twist a3 = {a2.w, v_add(a2.v, v_cross(a2.w, d))};
    a3.w.x -= T3.w.z * qd[2];
    a3.w.z += T3.w.x * qd[2];
    a3.v.x -= T3.v.z * qd[2];
    a3.v.z += T3.v.x * qd[2];
    /* wrenches that these accelerations need, minus those of the ground, from the foot inward */
    const v_inertia i3 = turned_y(m->cb, m->sb, &n->link[2]);
    const v_inertia i2 = turned_y(m->ca, m->sa, &n->link[1]);
    wrench f3 = newton_euler(&i3, T3, a3);
    wrench f2 = newton_euler(&i2, T2, a2);
    wrench f1 = newton_euler(&n->link[0], T1, a1);
    f3.f = v_sub(f3.f, ground->force);
    f3.n = v_sub(f3.n, ground->moment);
    const wrench m3 = moved(f3, d);
    f2.n = v_add(f2.n, m3.n);
    f2.f = v_add(f2.f, m3.f);
    const wrench m2 = moved(f2, r);
    f1.n = v_add(f1.n, m2.n);
    f1.f = v_add(f1.f, m2.f);
    b.u[0] = torque[0] - f1.n.x;
    b.u[1] = torque[1] - f2.n.y;
    b.u[2] = torque[2] - f3.n.y;
    b.bias = f1;
    /* composite inertias, and columns of the mass matrix */
    const v_inertia i23 = joined(shifted(i3, d), &i2);
    b.all = joined(shifted(i23, r), &n->link[0]);
    wrench F3 = {{i3.xy, i3.yy, i3.yz}, {i3.h.z, zero, -i3.h.x}};
    b.M33 = i3.yy + n->joint[2].rotor;
    F3 = moved(F3, d);
    b.M23 = F3.n.y;
    F3 = moved(F3, r);
    b.M13 = F3.n.x;
    wrench F2 = {{i23.xy, i23.yy, i23.yz}, {i23.h.z, zero, -i23.h.x}};
    b.M22 = i23.yy + n->joint[1].rotor;
    F2 = moved(F2, r);
    b.M12 = F2.n.x;
    b.column[2] = (wrench){{b.all.xx, b.all.xy, b.all.xz}, {zero, -b.all.h.z, b.all.h.y}};
    b.M11 = b.all.xx + n->joint[0].rotor;
    b.column[0] = F3;
    b.column[1] = F2;
    return b;
}

/* Inward pass of a leg: bias forces, composite inertia and elimination of its joints. Its
 * contribution to the trunk's equations is written to `part`. A locked joint has one over D of 0,
 * so nothing accelerates it and no other joint sees it. */
INL void leg_inward(int any, const leg_numbers *n, const leg_motion *m, const V *qd,
                    const V *torque, const push *ground, leg_kept *k, V part[SUMS]) {
    const V zero = v_all(0.0);
    const leg_balance b =
        any ? leg_balance_any(n, m, qd, torque, ground) : leg_balance_xyy(n, m, qd, torque, ground);
    const V *u = b.u;
    /* L D L' of the three joints, knee first */
    const V d3 = n->free[2] / b.M33, l32 = b.M23 * d3, l31 = b.M13 * d3;
    const V e22 = b.M22 - l32 * b.M23, e12 = b.M12 - l32 * b.M13, d2 = n->free[1] / e22,
            l21 = e12 * d2;
    const V e11 = b.M11 - l31 * b.M13 - l21 * e12, d1 = n->free[0] / e11;
    const V u2 = u[1] - l32 * u[2], u1 = u[0] - l31 * u[2] - l21 * u2;
    /* columns in the axes of the trunk, about its reference point */
    V G[3][6];
    for (int j = 0; j < 3; j++) {
        const v3 f = about_x(m->c1, m->s1, b.column[j].f);
        const v3 t = v_add(about_x(m->c1, m->s1, b.column[j].n), v_cross(n->mount, f));
        G[j][0] = t.x;
        G[j][1] = t.y;
        G[j][2] = t.z;
        G[j][3] = f.x;
        G[j][4] = f.y;
        G[j][5] = f.z;
    }
    for (int i = 0; i < 6; i++) G[1][i] -= l32 * G[0][i];
    for (int i = 0; i < 6; i++) G[2][i] -= l31 * G[0][i] + l21 * G[1][i];
    /* contribution to the trunk's equations */
    const v3 force = about_x(m->c1, m->s1, b.bias.f);
    const v3 moment = v_add(about_x(m->c1, m->s1, b.bias.n), v_cross(n->mount, force));
    const V bias[6] = {moment.x, moment.y, moment.z, force.x, force.y, force.z};
    const v_inertia c = shifted(turned_x(m->c1, m->s1, b.all), n->mount);
    const V own[6] = {c.xx, c.xy, c.yy, c.xz, c.yz, c.zz};
    for (int i = 0; i < 6; i++) {
        const V g0 = G[0][i] * d3, g1 = G[1][i] * d2, g2 = G[2][i] * d1;
        part[SUM_X + i] = bias[i] + g0 * u[2] + g1 * u2 + g2 * u1;
        for (int j = 0; j <= i; j++) {
            const V taken = g0 * G[0][j] + g1 * G[1][j] + g2 * G[2][j];
            part[LOWER(i, j)] = (i < 3 ? own[LOWER(i, j)] : zero) - taken;
        }
    }
    part[SUM_H] = c.h.x;
    part[SUM_H + 1] = c.h.y;
    part[SUM_H + 2] = c.h.z;
    part[SUM_M] = c.m;
    memcpy(k->g, G, sizeof G);
    k->per_d[0] = d3;
    k->per_d[1] = d2;
    k->per_d[2] = d1;
    k->y[0] = u[2];
    k->y[1] = u2;
    k->y[2] = u1;
    k->l10 = l32;
    k->l20 = l31;
    k->l21 = l21;
}

/* Add moment and force of the suspension on the trunk, in its axes. */
INL void add_suspension(const robot_numbers *n, const trunk_state *s, const trunk_motion *m,
                        B x6[6]) {
    const B q[6] = {s->x.x, s->x.y, s->x.z, s->yaw, s->pitch, s->roll};
    const B qd[6] = {s->xd.x, s->xd.y, s->xd.z, s->yawd, s->pitchd, s->rolld};
    B Q[6];
    for (int i = 0; i < 6; i++) {
        const B pull =
            n->hold[i < 3 ? 0 : 2] * (s->pose[i] - q[i]) - n->hold[i < 3 ? 1 : 3] * qd[i];
        Q[i] = b_select(s->held > 0.0, pull, b_all(0.0));
    }
    const b3 force = b_turn_back(&m->turn, (b3){Q[0], Q[1], Q[2]});
    /* Q = E' n with w = E (yawd, pitchd, rolld) */
    const B across = (Q[3] + m->sp * Q[5]) / m->cp;
    const B moment[3] = {Q[5], m->cr * Q[4] + m->sr * across, m->cr * across - m->sr * Q[4]};
    for (int i = 0; i < 3; i++) x6[i] += moment[i];
    x6[3] += force.x;
    x6[4] += force.y;
    x6[5] += force.z;
}

/* A symmetric matrix of three rows, as its lower triangle. */
typedef struct {
    B xx, xy, yy, xz, yz, zz;
} symmetric;

/* Inverse by cofactors: one division, and few operations that depend on one another. */
INL symmetric inverse(symmetric a) {
    const B xx = a.yy * a.zz - a.yz * a.yz, xy = a.xz * a.yz - a.xy * a.zz;
    const B xz = a.xy * a.yz - a.xz * a.yy;
    const B per = 1.0 / (a.xx * xx + a.xy * xy + a.xz * xz);
    return (symmetric){per * xx,
                       per * xy,
                       per * (a.xx * a.zz - a.xz * a.xz),
                       per * xz,
                       per * (a.xy * a.xz - a.xx * a.yz),
                       per * (a.xx * a.yy - a.xy * a.xy)};
}

INL b3 times(symmetric a, b3 x) {
    return (b3){a.xx * x.x + a.xy * x.y + a.xz * x.z, a.xy * x.x + a.yy * x.y + a.yz * x.z,
                a.xz * x.x + a.yz * x.y + a.zz * x.z};
}

/* Solve the six equations of the trunk in two blocks of three: the linear accelerations are
 * eliminated, then the angular ones found. A: lower triangle; z: right side, then the solution. */
INL void solve_trunk(const B A[21], B z[6]) {
    const symmetric angular = {A[0], A[1], A[2], A[3], A[4], A[5]};
    const symmetric linear = {A[LOWER(3, 3)], A[LOWER(4, 3)], A[LOWER(4, 4)],
                              A[LOWER(5, 3)], A[LOWER(5, 4)], A[LOWER(5, 5)]};
    const symmetric per = inverse(linear);
    b3 Q[3], K[3]; /* columns of the lower left block, and of the inverse times it */
    for (int j = 0; j < 3; j++) {
        Q[j] = (b3){A[LOWER(3, j)], A[LOWER(4, j)], A[LOWER(5, j)]};
        K[j] = times(per, Q[j]);
    }
    const b3 n = {z[0], z[1], z[2]}, f = {z[3], z[4], z[5]};
    const symmetric left = {angular.xx - b_dot(Q[0], K[0]), angular.xy - b_dot(Q[1], K[0]),
                            angular.yy - b_dot(Q[1], K[1]), angular.xz - b_dot(Q[2], K[0]),
                            angular.yz - b_dot(Q[2], K[1]), angular.zz - b_dot(Q[2], K[2])};
    const b3 rest = {n.x - b_dot(K[0], f), n.y - b_dot(K[1], f), n.z - b_dot(K[2], f)};
    const b3 w = times(inverse(left), rest);
    const b3 v = b_sub(times(per, f),
                       b_add(b_add(b_scale(w.x, K[0]), b_scale(w.y, K[1])), b_scale(w.z, K[2])));
    z[0] = w.x;
    z[1] = w.y;
    z[2] = w.z;
    z[3] = v.x;
    z[4] = v.y;
    z[5] = v.z;
}

/* Equations of the trunk without legs: inertia on the left, minus the bias forces on the right. */
INL void trunk_alone(const robot_numbers *robot, const trunk_motion *m, B sum[SUMS]) {
    const b_inertia *t = &robot->trunk;
    const b3 wh = b_cross(m->w, t->h);
    const b3 L = b_add(b_inertia_times(t, m->w), b_cross(t->h, m->v));
    const b3 n = b_add(b_cross(m->w, L), b_cross(m->v, wh));
    const b3 f = b_cross(m->w, b_add(b_scale(t->m, m->v), wh));
    const B zero = b_all(0.0);
    const B lower[6] = {t->xx, t->xy, t->yy, t->xz, t->yz, t->zz};
    for (int i = 0; i < 21; i++) sum[i] = i < 6 ? lower[i] : zero;
    sum[SUM_H] = t->h.x;
    sum[SUM_H + 1] = t->h.y;
    sum[SUM_H + 2] = t->h.z;
    sum[SUM_M] = t->m;
    const B bias[6] = {n.x, n.y, n.z, f.x, f.y, f.z};
    for (int i = 0; i < 6; i++) sum[SUM_X + i] = bias[i];
}

/* The linear part of the composite inertia of trunk and legs, from first moment and mass. */
INL void add_linear_part(B sum[SUMS]) {
    const B hx = sum[SUM_H], hy = sum[SUM_H + 1], hz = sum[SUM_H + 2], mass = sum[SUM_M];
    sum[LOWER(3, 1)] += hz;
    sum[LOWER(3, 2)] -= hy;
    sum[LOWER(4, 0)] -= hz;
    sum[LOWER(4, 2)] += hx;
    sum[LOWER(5, 0)] += hy;
    sum[LOWER(5, 1)] -= hx;
    for (int i = 3; i < 6; i++) sum[LOWER(i, i)] += mass;
}

/* Outward pass: accelerations of the joints of a leg from that of the trunk. */
INL void leg_outward(const leg_kept *k, const B z[6], V qdd[3]) {
    V a[3];
    for (int j = 0; j < 3; j++) {
        V s = k->y[j];
        for (int i = 0; i < 6; i++) s -= k->g[j][i] * wide(z[i]);
        a[j] = s * k->per_d[j];
    }
    qdd[0] = a[2];
    qdd[1] = a[1] - k->l21 * a[2];
    qdd[2] = a[0] - k->l10 * qdd[1] - k->l20 * a[2];
}

/* Accelerations of the trunk's coordinates from those in its axes. */
INL void trunk_outward(const robot_numbers *n, const trunk_motion *m, const B z[6],
                       trunk_state *s) {
    const b3 al = {z[0], z[1], z[2]}, lin = b_add((b3){z[3], z[4], z[5]}, b_cross(m->w, m->v));
    s->xdd = b_turn(&m->turn, lin);
    s->xdd.z -= n->gravity;
    const B by = al.y - (m->cp * m->cr * s->rolld * s->yawd - m->sr * s->rolld * s->pitchd -
                         m->sp * m->sr * s->pitchd * s->yawd);
    const B bz = al.z + m->cr * s->rolld * s->pitchd + m->sp * m->cr * s->pitchd * s->yawd +
                 m->cp * m->sr * s->rolld * s->yawd;
    s->pitchdd = m->cr * by - m->sr * bz;
    s->yawdd = (m->sr * by + m->cr * bz) / m->cp;
    s->rolldd = al.x + m->cp * s->pitchd * s->yawd + m->sp * s->yawdd;
}

/* Add the torques of the joints themselves to those of their servos. */
INL void add_passive(const plant_parts *p, const leg_numbers *n, const leg_state *s, V torque[3]) {
    const V has = wide(p->robot->passive);
    int some = 0;
    for (int robot = 0; robot < PLANT_ROBOTS_ABREAST; robot++)
        some |= B_AT(p->robot->passive, robot) > 0.0;
    if (!some) return;
    for (int j = 0; j < 3; j++) {
        const V more = torque[j] + passive_torque(&n->joint[j].passive, s->q[j], s->qd[j]);
        torque[j] = v_select(has > 0.0, more, torque[j]); /* a robot without keeps its bits */
    }
}

/* Accelerations from coordinates, speeds and targets. dt: length of the step that begins [s]; the
 * friction threshold and the work of the servos need it. */
INL void accelerate_legs(int any, const plant_parts *p, const plant_ground *const *grounds,
                         double dt) {
    const robot_numbers *robot = p->robot;
    const trunk_motion t = trunk_moves(p);
    const v3 w = wide3(t.w), v = wide3(t.v);
    const B stopping = dt * robot->per_foot_mass;
    B sum[SUMS];
    trunk_alone(robot, &t, sum);
    for (int32_t g = 0; g < p->groups; g++) {
        leg_state *s = &p->state[g];
        const leg_numbers *n = &p->leg[g];
        const leg_motion m = leg_moves(any, n, s->q, s->qd, w, v);
        const push ground = push_of_ground(p, grounds, &t, n, &m, g, stopping);
        V torque[3], part[SUMS];
        for (int j = 0; j < 3; j++) {
            torque[j] = servo_torque(&n->joint[j].servo, s->target[j] - s->q[j], s->qd[j]);
            s->work[j] += v_abs(torque[j] * s->qd[j]) * dt;
        }
        add_passive(p, n, s, torque);
        leg_inward(any, n, &m, s->qd, torque, &ground, &p->kept[g], part);
        add_up(p, g, sum, part, SUMS);
    }
    add_linear_part(sum);
    B z[6];
    for (int i = 0; i < 6; i++) z[i] = -sum[SUM_X + i];
    add_suspension(robot, p->trunk, &t, z);
    solve_trunk(sum, z);
    for (int32_t g = 0; g < p->groups; g++) leg_outward(&p->kept[g], z, p->state[g].qdd);
    trunk_outward(robot, &t, z, p->trunk);
}

/* A function of its own, so that the compiler sees the usual legs alone. */
OUT_OF_LINE void accelerate_any(const plant_parts *p, const plant_ground *const *grounds,
                                double dt) {
    accelerate_legs(1, p, grounds, dt);
}

INL void accelerate(const plant_parts *p, const plant_ground *const *grounds, double dt) {
    if (p->any_axes)
        accelerate_any(p, grounds, dt);
    else
        accelerate_legs(0, p, grounds, dt);
}

#endif

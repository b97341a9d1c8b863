/* Vectors, wrenches and inertias of three dimensions, for any number of lanes. */
#ifndef PLANT_VECTORS_H
#define PLANT_VECTORS_H

#include "lanes.h"

/* v_... works on V, one per leg; b_... on B, one per robot. */
#define VECTORS(T, v3, v)                                                                          \
    typedef struct {                                                                               \
        T x, y, z;                                                                                 \
    } v3;                                                                                          \
    INL v3 v##_add(v3 a, v3 b) { return (v3){a.x + b.x, a.y + b.y, a.z + b.z}; }                   \
    INL v3 v##_sub(v3 a, v3 b) { return (v3){a.x - b.x, a.y - b.y, a.z - b.z}; }                   \
    INL v3 v##_scale(T s, v3 a) { return (v3){s * a.x, s * a.y, s * a.z}; }                        \
    INL T v##_dot(v3 a, v3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }                        \
    INL v3 v##_cross(v3 a, v3 b) {                                                                 \
        return (v3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};          \
    }

VECTORS(V, v3, v)
VECTORS(B, b3, b)

INL v3 wide3(b3 a) { return (v3){wide(a.x), wide(a.y), wide(a.z)}; }

/* A rotation, row by row. */
typedef struct {
    b3 x, y, z;
} rotation;

INL b3 b_turn(const rotation *r, b3 a) {
    return (b3){b_dot(r->x, a), b_dot(r->y, a), b_dot(r->z, a)};
}
INL b3 b_turn_back(const rotation *r, b3 a) {
    return b_add(b_add(b_scale(a.x, r->x), b_scale(a.y, r->y)), b_scale(a.z, r->z));
}
INL v3 v_turn(const rotation *r, v3 a) {
    return (v3){v_dot(wide3(r->x), a), v_dot(wide3(r->y), a), v_dot(wide3(r->z), a)};
}
INL v3 v_turn_back(const rotation *r, v3 a) {
    return v_add(v_add(v_scale(a.x, wide3(r->x)), v_scale(a.y, wide3(r->y))),
                 v_scale(a.z, wide3(r->z)));
}

/* Rotations of a vector about x and y by an angle with cosine c and sine s. */
INL v3 about_x(V c, V s, v3 a) { return (v3){a.x, c * a.y - s * a.z, s * a.y + c * a.z}; }
INL v3 about_y(V c, V s, v3 a) { return (v3){c * a.x + s * a.z, a.y, c * a.z - s * a.x}; }

/* Inertia of a body about a point: mass [kg], h = mass times centre of mass [kg m], second moments
 * [kg m^2]. */
#define INERTIA(T, v3, inertia)                                                                    \
    typedef struct {                                                                               \
        T m;                                                                                       \
        v3 h;                                                                                      \
        T xx, yy, zz, xy, xz, yz;                                                                  \
    } inertia;                                                                                     \
    INL v3 inertia##_times(const inertia *i, v3 w) {                                               \
        return (v3){i->xx * w.x + i->xy * w.y + i->xz * w.z,                                       \
                    i->xy * w.x + i->yy * w.y + i->yz * w.z,                                       \
                    i->xz * w.x + i->yz * w.y + i->zz * w.z};                                      \
    }

INERTIA(V, v3, v_inertia)
INERTIA(B, b3, b_inertia)

INL v_inertia turned_y(V c, V s, const v_inertia *i) {
    const V cc = c * c, ss = s * s, cs = c * s, t = 2.0 * cs * i->xz;
    return (v_inertia){i->m,
                       about_y(c, s, i->h),
                       cc * i->xx + t + ss * i->zz,
                       i->yy,
                       ss * i->xx - t + cc * i->zz,
                       c * i->xy + s * i->yz,
                       cs * (i->zz - i->xx) + (cc - ss) * i->xz,
                       c * i->yz - s * i->xy};
}

INL v_inertia turned_x(V c, V s, v_inertia i) {
    const V cc = c * c, ss = s * s, cs = c * s, t = 2.0 * cs * i.yz;
    return (v_inertia){i.m,
                       about_x(c, s, i.h),
                       i.xx,
                       cc * i.yy - t + ss * i.zz,
                       ss * i.yy + t + cc * i.zz,
                       c * i.xy - s * i.xz,
                       s * i.xy + c * i.xz,
                       cs * (i.yy - i.zz) + (cc - ss) * i.yz};
}

/* About a point from which the point before lies at r. */
INL v_inertia shifted(v_inertia i, v3 r) {
    const v3 g = v_add(v_add(i.h, i.h), v_scale(i.m, r)); /* 2 h + m r */
    const V gx = g.x * r.x, gy = g.y * r.y, gz = g.z * r.z;
    const v3 k = v_add(i.h, v_scale(i.m, r)); /* h + m r */
    return (v_inertia){i.m,
                       k,
                       i.xx + gy + gz,
                       i.yy + gx + gz,
                       i.zz + gx + gy,
                       i.xy - (k.x * r.y + r.x * i.h.y),
                       i.xz - (k.x * r.z + r.x * i.h.z),
                       i.yz - (k.y * r.z + r.y * i.h.z)};
}

INL v_inertia joined(v_inertia a, const v_inertia *b) {
    return (v_inertia){a.m + b->m,   v_add(a.h, b->h), a.xx + b->xx, a.yy + b->yy,
                       a.zz + b->zz, a.xy + b->xy,     a.xz + b->xz, a.yz + b->yz};
}

/* Moment [N m] about a point, and force [N]. */
typedef struct {
    v3 n, f;
} wrench;

/* Angular speed [rad/s] and velocity of a point [m/s]; or their rates. */
typedef struct {
    v3 w, v;
} twist;

/* About a point from which the point before lies at r. */
INL wrench moved(wrench a, v3 r) { return (wrench){v_add(a.n, v_cross(r, a.f)), a.f}; }

/* The wrench that moves a body: I a + V x* (I V), Featherstone (2008), Eq. 2.68. */
INL wrench newton_euler(const v_inertia *i, twist V_, twist a) {
    const v3 L = v_add(v_inertia_times(i, V_.w), v_cross(i->h, V_.v));
    const v3 wh = v_cross(V_.w, i->h), p = v_add(v_scale(i->m, V_.v), wh);
    wrench r;
    r.n = v_add(v_add(v_inertia_times(i, a.w), v_cross(i->h, a.v)),
                v_add(v_cross(V_.w, L), v_cross(V_.v, wh)));
    r.f = v_add(v_add(v_scale(i->m, a.v), v_cross(a.w, i->h)), v_cross(V_.w, p));
    return r;
}

#endif

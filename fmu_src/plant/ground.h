/* Where a ball touches a ground: a plane, obstacles, a kerb, waves, or a ground of one's own.
 *
 * All functions follow `plant_touch` in plant.h, in the frame of the ground. */
#ifndef PLANT_GROUND_H
#define PLANT_GROUND_H

#include <math.h>

#include "lanes.h"
#include "plant.h"

/* Beyond this distance [m] a motion has diverged, and a cell number would overflow. */
#define GROUND_END 1e6

static inline void ground_found(double *at, double nx, double ny, double nz, double depth) {
    at[0] = nx;
    at[1] = ny;
    at[2] = nz;
    at[3] = depth;
}

/* A ball touches the plane at its lowest point. */
static inline int32_t ground_plane(double z, double radius, double *found) {
    if (!(z < radius)) return 0;
    ground_found(found, 0.0, 0.0, 1.0, radius - z);
    return 1;
}

/* Row or column of the cell at a position, in a tile that is repeated without end. The remainder of
 * a tiny negative number rounds up to the divisor, so the remainder is taken twice. */
static inline int64_t ground_cell(double x, double tile, int64_t cells) {
    const double n = (double)cells, place = x / tile * n;
    const int64_t cell = (int64_t)(place - n * floor(place / n));
    return cell >= cells ? cell - cells : cell;
}

/* The plane, and every obstacle listed in the cell that is near enough. */
static inline int32_t ground_obstacles(double x, double y, double z, double radius,
                                       const double *reals, const int64_t *integers,
                                       double *found) {
    const double tile = reals[0];
    const int64_t cells = (int64_t)reals[1];
    const double *balls = reals + 2;
    int32_t count = ground_plane(z, radius, found);
    const int64_t cell = ground_cell(y, tile, cells) * cells + ground_cell(x, tile, cells);
    const int64_t *members = integers + cells * cells + 1;
    for (int64_t k = integers[cell]; k < integers[cell + 1]; k++) {
        const double *ball = balls + 4 * members[k];
        double dx = x - ball[0], dy = y - ball[1];
        dx -= tile * floor(dx / tile + 0.5);
        dy -= tile * floor(dy / tile + 0.5);
        const double dz = z - ball[2];
        const double distance = s_sqrt(dx * dx + dy * dy + dz * dz);
        const double depth = radius + ball[3] - distance;
        if (!(depth > 0.0)) continue;
        const double share = 1.0 / distance;
        ground_found(found + 4 * count, share * dx, share * dy, share * dz, depth);
        count++;
    }
    return count;
}

/* The plane where there is no kerb, and the nearest point of the kerb: top, face or edge. A centre
 * inside the kerb is pushed out through its nearest surface. */
static inline int32_t ground_kerb(double x, double z, double radius, const double *reals,
                                  double *found) {
    const double begin = reals[0], end = reals[1], height = reals[2];
    int32_t count = x < begin || x > end ? ground_plane(z, radius, found) : 0;
    const double dx = x - s_min(s_max(x, begin), end), dz = z - s_min(z, height);
    double distance = s_sqrt(dx * dx + dz * dz), nx, nz;
    if (distance > 0.0) {
        nx = dx / distance;
        nz = dz / distance;
    } else {
        const double up = height - z, back = x - begin, on = end - x;
        nx = 0.0;
        nz = 1.0;
        distance = -up;
        if (back < up && back <= on) {
            nx = -1.0;
            nz = 0.0;
            distance = -back;
        } else if (on < up) {
            nx = 1.0;
            nz = 0.0;
            distance = -on;
        }
    }
    if (radius > distance) ground_found(found + 4 * count++, nx, 0.0, nz, radius - distance);
    return count;
}

/* The nearest point (u, v, h(u, v)) of z = a (sin(k u) + sin(k v)), by Newton's method. */
static inline int32_t ground_waves(double x, double y, double z, double radius, const double *reals,
                                   double *found) {
    const double a = reals[0], k = reals[1];
    double u = x, v = y, su, cu, sv, cv;
    for (int i = 0; i < 20; i++) {
        s_sin_cos(k * u, &su, &cu);
        s_sin_cos(k * v, &sv, &cv);
        const double below = a * (su + sv) - z, hu = a * k * cu, hv = a * k * cv;
        const double gu = u - x + below * hu, gv = v - y + below * hv;
        const double huu = 1.0 + hu * hu - below * a * k * k * su;
        const double hvv = 1.0 + hv * hv - below * a * k * k * sv;
        const double huv = hu * hv, determinant = huu * hvv - huv * huv;
        const double du = (hvv * gu - huv * gv) / determinant;
        const double dv = (huu * gv - huv * gu) / determinant;
        u -= du;
        v -= dv;
        if (s_abs(du) + s_abs(dv) < 1e-9) break;
    }
    s_sin_cos(k * u, &su, &cu);
    s_sin_cos(k * v, &sv, &cv);
    const double hu = a * k * cu, hv = a * k * cv, h = a * (su + sv);
    const double length = s_sqrt(1.0 + hu * hu + hv * hv);
    const double nx = -hu / length, ny = -hv / length, nz = 1.0 / length;
    const double depth = radius - ((x - u) * nx + (y - v) * ny + (z - h) * nz);
    if (!(depth > 0.0)) return 0;
    ground_found(found, nx, ny, nz, depth);
    return 1;
}

static inline int32_t ground_touches(const plant_ground *ground, double x, double y, double z,
                                     double radius, double *found) {
    if (!(s_abs(x) < GROUND_END && s_abs(y) < GROUND_END && s_abs(z) < GROUND_END)) return 0;
    switch (ground->kind) {
    case PLANT_OBSTACLES:
        return ground_obstacles(x, y, z, radius, ground->reals, ground->integers, found);
    case PLANT_KERB:
        return ground_kerb(x, z, radius, ground->reals, found);
    case PLANT_WAVES:
        return ground_waves(x, y, z, radius, ground->reals, found);
    case PLANT_OWN:
        return ground->touch(x, y, z, radius, ground->reals, ground->integers, found);
    default:
        return ground_plane(z, radius, found);
    }
}

#endif

/* The hill of 04_own_ground.py: where a ball of a radius at (x, y, z) touches it [m]. */
#include <math.h>
#include <stdint.h>

static int32_t place(double *at, double nx, double ny, double nz, double depth) {
    at[0] = nx;
    at[1] = ny;
    at[2] = nz;
    at[3] = depth;
    return 1;
}

/* reals: where the hill is, its height, radius of its ball [m]. */
int32_t hill(double x, double y, double z, double radius, const double *reals,
             const int64_t *integers, double *found) {
    const double dx = x - reals[0], dz = z - (reals[1] - reals[2]);
    const double away = sqrt(dx * dx + y * y + dz * dz), near = reals[2] + radius;
    int32_t count = z < radius ? place(found, 0.0, 0.0, 1.0, radius - z) : 0;
    (void)integers;
    if (away < near) count += place(found + 4 * count, dx / away, y / away, dz / away, near - away);
    return count;
}

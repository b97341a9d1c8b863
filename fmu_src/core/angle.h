/* Angles brought into a range. */
#ifndef APNC_ANGLE_H
#define APNC_ANGLE_H

#include "elementary.h"

#define APNC_PI       ((apnc_real)3.14159265358979323846)
#define APNC_TAN_PI_8 ((apnc_real)0.41421356237309503)

/* angle [rad], however far off, brought into [low, low + 2 pi). */
static inline apnc_real apnc_wrap_far(apnc_real angle, apnc_real low) {
    return angle - 2 * APNC_PI * apnc_floor((angle - low) / (2 * APNC_PI));
}

/* angle [rad] from [low - 2 pi, low + 4 pi) brought into [low, low + 2 pi). */
static inline apnc_real apnc_wrap(apnc_real angle, apnc_real low) {
    const apnc_real down = angle < low + 2 * APNC_PI ? angle : angle - 2 * APNC_PI;
    return angle < low ? angle + 2 * APNC_PI : down;
}

/* Angle of the vector (x, y) [rad], 0 for the zero vector; without branches. */
static inline apnc_real apnc_angle(apnc_real y, apnc_real x) {
    const apnc_real ax = apnc_abs(x), ay = apnc_abs(y);
    const apnc_real most = ax > ay ? ax : ay, least = ay < ax ? ay : ax;
    const int beyond = least > APNC_TAN_PI_8 * most; /* then the angle against the diagonal */
    const apnc_real over = beyond ? least - most : least;
    const apnc_real under = beyond ? least + most : most;
    const apnc_real within = apnc_atan(over / (under > 0 ? under : 1));
    const apnc_real eighth = beyond ? APNC_PI / 4 + within : within;
    const apnc_real quarter = ay > ax ? APNC_PI / 2 - eighth : eighth;
    const apnc_real half = x < 0 ? APNC_PI - quarter : quarter;
    return apnc_copysign(half, y);
}

#endif

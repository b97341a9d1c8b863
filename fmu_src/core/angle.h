/* Angles brought into a range. */
#ifndef APNC_ANGLE_H
#define APNC_ANGLE_H

#include "elementary.h"

#define APNC_PI ((apnc_real)3.14159265358979323846)

/* angle [rad], however far off, brought into [low, low + 2 pi). */
static inline apnc_real apnc_wrap_far(apnc_real angle, apnc_real low) {
    return angle - 2 * APNC_PI * apnc_floor((angle - low) / (2 * APNC_PI));
}

/* angle [rad] from [low - 2 pi, low + 4 pi) brought into [low, low + 2 pi). */
static inline apnc_real apnc_wrap(apnc_real angle, apnc_real low) {
    if (angle < low) return angle + 2 * APNC_PI;
    return angle < low + 2 * APNC_PI ? angle : angle - 2 * APNC_PI;
}

/* Angle of the vector (x, y) [rad], 0 for the zero vector. atan2 takes twice as long for signed
 * zeros and infinities, which do not occur here. */
static inline apnc_real apnc_angle(apnc_real y, apnc_real x) {
    if (x > 0) return apnc_atan(y / x);
    if (x < 0) return apnc_atan(y / x) + (y < 0 ? -APNC_PI : APNC_PI);
    return y > 0 ? APNC_PI / 2 : y < 0 ? -APNC_PI / 2 : 0;
}

#endif

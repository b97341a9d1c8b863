/* Angles brought into a range. */
#ifndef APNC_ANGLE_H
#define APNC_ANGLE_H

#include <math.h>

#define APNC_PI 3.14159265358979323846

/* angle [rad], however far off, brought into [low, low + 2 pi). */
static inline double apnc_wrap_far(double angle, double low) {
    return angle - 2.0 * APNC_PI * floor((angle - low) / (2.0 * APNC_PI));
}

/* angle [rad] from [low - 2 pi, low + 4 pi) brought into [low, low + 2 pi). */
static inline double apnc_wrap(double angle, double low) {
    if (angle < low) return angle + 2.0 * APNC_PI;
    return angle < low + 2.0 * APNC_PI ? angle : angle - 2.0 * APNC_PI;
}

/* Angle of the vector (x, y) [rad], 0 for the zero vector. atan2 takes twice as long for signed
 * zeros and infinities, which do not occur here. */
static inline double apnc_angle(double y, double x) {
    if (x > 0.0) return atan(y / x);
    if (x < 0.0) return atan(y / x) + (y < 0.0 ? -APNC_PI : APNC_PI);
    return y > 0.0 ? 0.5 * APNC_PI : y < 0.0 ? -0.5 * APNC_PI : 0.0;
}

#endif

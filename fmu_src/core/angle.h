/* Angles brought into a range. */
#ifndef APNC_ANGLE_H
#define APNC_ANGLE_H

#include <math.h>

#define APNC_PI 3.14159265358979323846

/* angle [rad] brought into [low, low + 2 pi) */
static inline double apnc_wrap(double angle, double low) {
    return angle - 2.0 * APNC_PI * floor((angle - low) / (2.0 * APNC_PI));
}

#endif

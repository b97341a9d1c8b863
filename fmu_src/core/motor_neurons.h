/* Motor neurons: from oscillator outputs to joint commands (Eq. 4). */
#ifndef APNC_MOTOR_NEURONS_H
#define APNC_MOTOR_NEURONS_H

#include "apnc_variables.h"

/* Factor on the slopes of a leg: up on the right, down on the left when turning left. */
static inline apnc_real apnc_amplitude_scale(const apnc_parameters *p, apnc_real turn, int leg) {
    const apnc_real change = p->turn_gain * turn;
    return leg < APNC_LEGS / 2 ? 1 + change : 1 - change;
}

/* Joint command theta_i = a_i o_i + b_i [rad]. */
static inline apnc_real apnc_command(apnc_real scale, apnc_real a, apnc_real o, apnc_real b) {
    return scale * a * o + b;
}

#endif

/* Motor neurons: from oscillator outputs to joint commands (Eq. 4). */
#ifndef APNC_MOTOR_NEURONS_H
#define APNC_MOTOR_NEURONS_H

/* Factor on the slopes of a leg: up on the right, down on the left when turning left. */
static inline double apnc_amplitude_scale(const apnc_parameters *p, double turn, int leg) {
    const double change = p->turn_gain * turn;
    return leg < APNC_LEGS / 2 ? 1.0 + change : 1.0 - change;
}

/* Joint command theta_i = a_i o_i + b_i [rad]. */
static inline double apnc_command(double scale, double a, double o, double b) {
    return scale * a * o + b;
}

#endif

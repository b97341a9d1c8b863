/* Foot load as the circuits see it (text below Eq. 5). */
#ifndef APNC_LOAD_H
#define APNC_LOAD_H

/* A load above so many times the weight is no load: a sensor shows it when its wire breaks. */
#define APNC_MOST_WEIGHTS 1000.0

/* Factor from a load [N] to F, the load over half the weight. */
static inline double apnc_load_scale(double robot_weight) { return 2.0 / robot_weight; }

/* F of a load [N], at most F_max; zero and a fault if it is not finite, negative or beyond
 * most [N]. */
static inline double apnc_load(double grf, double scale, double F_max, double most,
                               int32_t *fault) {
    *fault = !(grf >= 0.0 && grf <= most);
    const double F = *fault ? 0.0 : grf * scale;
    return F < F_max ? F : F_max;
}

#endif

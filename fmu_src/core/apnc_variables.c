/* All variables, for access by value reference.
 *
 * Generated from apnc_core/variables.py by `python -m build_fmu.generate`; do not edit.
 */
#include "apnc_variables.h"

#ifdef APNC_NAMING_FLAT
#define LEG(name) "leg", "_" name
#define RELATION(name) name, ""
#else
#define LEG(name) "leg[", "]." name
#define RELATION(name) name "[", "]"
#endif
#define AT(group, field) offsetof(apnc_data, group.field)

const apnc_variable apnc_variables[APNC_VARIABLES] = {
    {"grf", LEG("grf"), AT(inputs, grf), APNC_LEGS, APNC_REAL, APNC_INPUT, 0.0, 1.0, -1.0},
    {"MI", "MI", "", AT(inputs, MI), 1, APNC_REAL, APNC_INPUT, 0.08, 0.0, 1.0},
    {"turn", "turn", "", AT(inputs, turn), 1, APNC_REAL, APNC_INPUT, 0.0, -1.0, 1.0},
    {"reset", "reset", "", AT(inputs, reset), 1, APNC_BOOLEAN, APNC_INPUT, 0.0, 0.0, 1.0},
    {"Ts", "Ts", "", AT(parameters, Ts), 1, APNC_REAL, APNC_FIXED, 0.016666666666666666, 0.0001, 1.0},
    {"robot_weight", "robot_weight", "", AT(parameters, robot_weight), 1, APNC_REAL, APNC_TUNABLE, 24.525, 0.001, 1000000.0},
    {"F_max", "F_max", "", AT(parameters, F_max), 1, APNC_REAL, APNC_TUNABLE, 1.0, 0.0, 2000.0},
    {"method", "method", "", AT(parameters, method), 1, APNC_ENUMERATION, APNC_TUNABLE, 1.0, 1.0, 4.0},
    {"w11", "w11", "", AT(parameters, w11), 1, APNC_REAL, APNC_TUNABLE, 1.4, 0.0, 5.0},
    {"w12_0", "w12_0", "", AT(parameters, w12_0), 1, APNC_REAL, APNC_TUNABLE, 0.21, 0.0, 2.0},
    {"bias", "bias", "", AT(parameters, bias), 1, APNC_REAL, APNC_TUNABLE, 0.0, -1.0, 1.0},
    {"o1_start", "o1_start", "", AT(parameters, o1_start), 1, APNC_REAL, APNC_FIXED, 0.01, -1.0, 1.0},
    {"o2_start", "o2_start", "", AT(parameters, o2_start), 1, APNC_REAL, APNC_FIXED, 0.01, -1.0, 1.0},
    {"a1", "a1", "", AT(parameters, a1), 1, APNC_REAL, APNC_TUNABLE, 0.14, 0.0, 1.6},
    {"a2", "a2", "", AT(parameters, a2), 1, APNC_REAL, APNC_TUNABLE, 0.15, 0.0, 1.6},
    {"b1", "b1", "", AT(parameters, b1), 1, APNC_REAL, APNC_TUNABLE, -0.2, -1.6, 1.6},
    {"b2", "b2", "", AT(parameters, b2), 1, APNC_REAL, APNC_TUNABLE, -0.2, -1.6, 1.6},
    {"turn_gain", "turn_gain", "", AT(parameters, turn_gain), 1, APNC_REAL, APNC_TUNABLE, 1.0, 0.0, 1.0},
    {"A_f", "A_f", "", AT(parameters, A_f), 1, APNC_REAL, APNC_TUNABLE, 0.57, 0.0, 1.0},
    {"B_f", "B_f", "", AT(parameters, B_f), 1, APNC_REAL, APNC_TUNABLE, 0.17, 0.0, 1.0},
    {"A_s", "A_s", "", AT(parameters, A_s), 1, APNC_REAL, APNC_TUNABLE, 0.99, 0.0, 1.0},
    {"B_s", "B_s", "", AT(parameters, B_s), 1, APNC_REAL, APNC_TUNABLE, 0.0002, 0.0, 1.0},
    {"alpha", "alpha", "", AT(parameters, alpha), 1, APNC_REAL, APNC_TUNABLE, 0.9, 0.0, 1.0},
    {"rho", "rho", "", AT(parameters, rho), 1, APNC_REAL, APNC_TUNABLE, 0.99, 0.0, 1.0},
    {"phase_measure", "phase_measure", "", AT(parameters, phase_measure), 1, APNC_ENUMERATION, APNC_FIXED, 1.0, 1.0, 2.0},
    {"phase_filter", "phase_filter", "", AT(parameters, phase_filter), 1, APNC_REAL, APNC_TUNABLE, 0.05, 0.0001, 1.0},
    {"N", "N", "", AT(parameters, N), 1, APNC_INTEGER, APNC_FIXED, 50.0, 1.0, 256.0},
    {"sigma", "sigma", "", AT(parameters, sigma), 1, APNC_REAL, APNC_TUNABLE, 0.4, 0.0, 10.0},
    {"kappa_rule", "kappa_rule", "", AT(parameters, kappa_rule), 1, APNC_ENUMERATION, APNC_TUNABLE, 1.0, 1.0, 2.0},
    {"kappa_hold", "kappa_hold", "", AT(parameters, kappa_hold), 1, APNC_INTEGER, APNC_TUNABLE, 200.0, 1.0, 1000000.0},
    {"xi", "xi", "", AT(parameters, xi), 1, APNC_REAL, APNC_TUNABLE, 0.01, 0.0, 1.0},
    {"feedback_kept", "feedback_kept", "", AT(parameters, feedback_kept), 1, APNC_REAL, APNC_TUNABLE, 0.1, 0.0, 1.0},
    {"coupling_sign", "coupling_sign", "", AT(parameters, coupling_sign), 1, APNC_ENUMERATION, APNC_TUNABLE, 1.0, 1.0, 2.0},
    {"phi_frozen", "phi_frozen", "", AT(parameters, phi_frozen), 1, APNC_BOOLEAN, APNC_TUNABLE, 1.0, 0.0, 1.0},
    {"MI_zero_resets", "MI_zero_resets", "", AT(parameters, MI_zero_resets), 1, APNC_BOOLEAN, APNC_TUNABLE, 1.0, 0.0, 1.0},
    {"stored", "stored", "", AT(parameters, stored), 1, APNC_BOOLEAN, APNC_FIXED, 0.0, 0.0, 1.0},
    {"phi_stored", RELATION("phi_stored"), AT(parameters, phi_stored), APNC_RELATIONS, APNC_REAL, APNC_FIXED, 0.0, -7.0, 7.0},
    {"gamma_tegotae", "gamma_tegotae", "", AT(parameters, gamma_tegotae), 1, APNC_REAL, APNC_TUNABLE, 0.015, 0.0, 10.0},
    {"grf_reset", "grf_reset", "", AT(parameters, grf_reset), 1, APNC_REAL, APNC_TUNABLE, 0.4, 0.0, 10.0},
    {"theta_hip", LEG("theta_hip"), AT(outputs, theta_hip), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"theta_knee", LEG("theta_knee"), AT(outputs, theta_knee), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"o1", LEG("o1"), AT(outputs, o1), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, -1.0, 1.0},
    {"o2", LEG("o2"), AT(outputs, o2), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, -1.0, 1.0},
    {"gamma", LEG("gamma"), AT(outputs, gamma), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"grf_expected", LEG("grf_expected"), AT(outputs, grf_expected), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"f1", LEG("f1"), AT(outputs, f1), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"f2", LEG("f2"), AT(outputs, f2), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"g1", LEG("g1"), AT(outputs, g1), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"g2", LEG("g2"), AT(outputs, g2), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"fault", LEG("fault"), AT(outputs, fault), APNC_LEGS, APNC_BOOLEAN, APNC_OUTPUT, 0.0, 0.0, 1.0},
    {"phi", RELATION("phi"), AT(outputs, phi), APNC_RELATIONS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"phi_memory", RELATION("phi_memory"), AT(outputs, phi_memory), APNC_RELATIONS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"d", "d", "", AT(outputs, d), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"kappa", "kappa", "", AT(outputs, kappa), 1, APNC_REAL, APNC_OUTPUT, 0.0, 0.0, 1.0},
    {"tick", "tick", "", AT(outputs, tick), 1, APNC_INTEGER, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"K_f", LEG("K_f"), AT(outputs, K_f), APNC_LEGS, APNC_REAL, APNC_LOCAL, 0.0, 1.0, -1.0},
    {"K_s", LEG("K_s"), AT(outputs, K_s), APNC_LEGS, APNC_REAL, APNC_LOCAL, 0.0, 1.0, -1.0},
    {"forward_model", "forward_model", "", AT(parameters, forward_model), 1, APNC_ENUMERATION, APNC_FIXED, 1.0, 1.0, 3.0},
    {"rbf_rate", "rbf_rate", "", AT(parameters, rbf_rate), 1, APNC_REAL, APNC_TUNABLE, 0.02, 0.0, 1.0},
};

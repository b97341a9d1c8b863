/* All variables, for access by value reference; start values of the robot's own
 * numbers are those of the build.
 *
 * Generated from apnc_plant/variables.py by `python -m apnc_plant.generate`; do not edit.
 */
#include "plant_variables.h"

#include "apnc_config.h"
#include "model.h"
#include "robot_config.h"

#ifdef APNC_NAMING_FLAT
#define LEG(structured, flat) "leg", "_" flat
#define ONE(structured, flat) flat, ""
#else
#define LEG(structured, flat) "leg[", "]." structured
#define ONE(structured, flat) structured, ""
#endif
#define AT(group, field) offsetof(plant_values, group.field)

const apnc_variable apnc_variables[PLANT_VARIABLES] = {
    {"theta_hip", LEG("theta_hip", "theta_hip"), AT(inputs, theta_hip), APNC_LEGS, APNC_REAL, APNC_INPUT, 0.0, 1.0, -1.0},
    {"theta_knee", LEG("theta_knee", "theta_knee"), AT(inputs, theta_knee), APNC_LEGS, APNC_REAL, APNC_INPUT, 0.0, 1.0, -1.0},
    {"seed", ONE("seed", "seed"), AT(parameters, seed), 1, APNC_INTEGER, APNC_FIXED, 0.0, 0.0, 2147483647.0},
    {"roughness", ONE("roughness", "roughness"), AT(parameters, roughness), 1, APNC_REAL, APNC_FIXED, 0.0, 0.0, 1.0},
    {"slope", ONE("slope", "slope"), AT(parameters, slope), 1, APNC_REAL, APNC_FIXED, 0.0, -1.5, 1.5},
    {"payload", ONE("payload", "payload"), AT(parameters, payload), 1, APNC_REAL, APNC_FIXED, 0.0, 0.0, 100.0},
    {"condition", ONE("condition", "condition"), AT(parameters, condition), 1, APNC_ENUMERATION, APNC_TUNABLE, 1.0, 1.0, 7.0},
    {"step", ONE("step", "step"), AT(parameters, step), 1, APNC_REAL, APNC_FIXED, ROBOT_STEP, 1e-06, 0.016666666666666666},
    {"servo.stiffness", ONE("servo.stiffness", "servo_stiffness"), AT(parameters, servo_stiffness), 1, APNC_REAL, APNC_TUNABLE, ROBOT_SERVO_STIFFNESS, 1e-06, 1000000.0},
    {"servo.damping", ONE("servo.damping", "servo_damping"), AT(parameters, servo_damping), 1, APNC_REAL, APNC_TUNABLE, ROBOT_SERVO_DAMPING, 0.0, 1000000.0},
    {"servo.stall_torque", ONE("servo.stall_torque", "servo_stall_torque"), AT(parameters, servo_stall_torque), 1, APNC_REAL, APNC_TUNABLE, ROBOT_SERVO_STALL_TORQUE, 1e-06, 1000000.0},
    {"servo.no_load_speed", ONE("servo.no_load_speed", "servo_no_load_speed"), AT(parameters, servo_no_load_speed), 1, APNC_REAL, APNC_TUNABLE, ROBOT_SERVO_NO_LOAD_SPEED, 1e-06, 1000000.0},
    {"servo.reflected_inertia", ONE("servo.reflected_inertia", "servo_reflected_inertia"), AT(parameters, servo_reflected_inertia), 1, APNC_REAL, APNC_FIXED, ROBOT_SERVO_REFLECTED_INERTIA, 0.0, 1000.0},
    {"servo.latency", ONE("servo.latency", "servo_latency"), AT(parameters, servo_latency), 1, APNC_REAL, APNC_TUNABLE, ROBOT_SERVO_LATENCY, 0.0, 1.0},
    {"servo.slew_rate", ONE("servo.slew_rate", "servo_slew_rate"), AT(parameters, servo_slew_rate), 1, APNC_REAL, APNC_TUNABLE, ROBOT_SERVO_SLEW_RATE, 0.0, 1000000.0},
    {"contact.foot_radius", ONE("contact.foot_radius", "contact_foot_radius"), AT(parameters, contact_foot_radius), 1, APNC_REAL, APNC_FIXED, ROBOT_CONTACT_FOOT_RADIUS, 0.0001, 1.0},
    {"contact.stiffness", ONE("contact.stiffness", "contact_stiffness"), AT(parameters, contact_stiffness), 1, APNC_REAL, APNC_TUNABLE, ROBOT_CONTACT_STIFFNESS, 1e-12, 1000000000.0},
    {"contact.damping", ONE("contact.damping", "contact_damping"), AT(parameters, contact_damping), 1, APNC_REAL, APNC_TUNABLE, ROBOT_CONTACT_DAMPING, 0.0, 1000000000.0},
    {"contact.damping_depth", ONE("contact.damping_depth", "contact_damping_depth"), AT(parameters, contact_damping_depth), 1, APNC_REAL, APNC_TUNABLE, ROBOT_CONTACT_DAMPING_DEPTH, 1e-09, 1.0},
    {"contact.friction", ONE("contact.friction", "contact_friction"), AT(parameters, contact_friction), 1, APNC_REAL, APNC_TUNABLE, ROBOT_CONTACT_FRICTION, 0.0, 1000.0},
    {"contact.friction_speed", ONE("contact.friction_speed", "contact_friction_speed"), AT(parameters, contact_friction_speed), 1, APNC_REAL, APNC_TUNABLE, ROBOT_CONTACT_FRICTION_SPEED, 1e-06, 1000.0},
    {"sensor.delay", ONE("sensor.delay", "sensor_delay"), AT(parameters, sensor_delay), 1, APNC_REAL, APNC_TUNABLE, ROBOT_SENSOR_DELAY, 0.0, 1.0},
    {"sensor.time_constant", ONE("sensor.time_constant", "sensor_time_constant"), AT(parameters, sensor_time_constant), 1, APNC_REAL, APNC_TUNABLE, ROBOT_SENSOR_TIME_CONSTANT, 0.0, 1000.0},
    {"sensor.noise", ONE("sensor.noise", "sensor_noise"), AT(parameters, sensor_noise), 1, APNC_REAL, APNC_TUNABLE, ROBOT_SENSOR_NOISE, 0.0, 1000.0},
    {"sensor.component", ONE("sensor.component", "sensor_component"), AT(parameters, sensor_component), 1, APNC_ENUMERATION, APNC_TUNABLE, ROBOT_SENSOR_COMPONENT, 1.0, 2.0},
    {"position.x", ONE("position.x", "position_x"), AT(outputs, position_x), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"position.y", ONE("position.y", "position_y"), AT(outputs, position_y), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"position.z", ONE("position.z", "position_z"), AT(outputs, position_z), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"rpy.roll", ONE("rpy.roll", "rpy_roll"), AT(outputs, rpy_roll), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"rpy.pitch", ONE("rpy.pitch", "rpy_pitch"), AT(outputs, rpy_pitch), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"rpy.yaw", ONE("rpy.yaw", "rpy_yaw"), AT(outputs, rpy_yaw), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"velocity.x", ONE("velocity.x", "velocity_x"), AT(outputs, velocity_x), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"velocity.y", ONE("velocity.y", "velocity_y"), AT(outputs, velocity_y), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"velocity.z", ONE("velocity.z", "velocity_z"), AT(outputs, velocity_z), 1, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_angle.abduction", LEG("joint_angle.abduction", "joint_angle_abduction"), AT(outputs, joint_angle_abduction), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_angle.hip", LEG("joint_angle.hip", "joint_angle_hip"), AT(outputs, joint_angle_hip), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_angle.knee", LEG("joint_angle.knee", "joint_angle_knee"), AT(outputs, joint_angle_knee), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_speed.abduction", LEG("joint_speed.abduction", "joint_speed_abduction"), AT(outputs, joint_speed_abduction), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_speed.hip", LEG("joint_speed.hip", "joint_speed_hip"), AT(outputs, joint_speed_hip), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_speed.knee", LEG("joint_speed.knee", "joint_speed_knee"), AT(outputs, joint_speed_knee), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_torque.abduction", LEG("joint_torque.abduction", "joint_torque_abduction"), AT(outputs, joint_torque_abduction), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_torque.hip", LEG("joint_torque.hip", "joint_torque_hip"), AT(outputs, joint_torque_hip), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_torque.knee", LEG("joint_torque.knee", "joint_torque_knee"), AT(outputs, joint_torque_knee), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_work.abduction", LEG("joint_work.abduction", "joint_work_abduction"), AT(outputs, joint_work_abduction), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_work.hip", LEG("joint_work.hip", "joint_work_hip"), AT(outputs, joint_work_hip), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"joint_work.knee", LEG("joint_work.knee", "joint_work_knee"), AT(outputs, joint_work_knee), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"foot_position.x", LEG("foot_position.x", "foot_position_x"), AT(outputs, foot_position_x), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"foot_position.y", LEG("foot_position.y", "foot_position_y"), AT(outputs, foot_position_y), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"foot_position.z", LEG("foot_position.z", "foot_position_z"), AT(outputs, foot_position_z), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"foot_force.x", LEG("foot_force.x", "foot_force_x"), AT(outputs, foot_force_x), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"foot_force.y", LEG("foot_force.y", "foot_force_y"), AT(outputs, foot_force_y), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"foot_force.z", LEG("foot_force.z", "foot_force_z"), AT(outputs, foot_force_z), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"grf", LEG("grf", "grf"), AT(outputs, grf), APNC_LEGS, APNC_REAL, APNC_OUTPUT, 0.0, 1.0, -1.0},
    {"fell", ONE("fell", "fell"), AT(outputs, fell), 1, APNC_BOOLEAN, APNC_OUTPUT, 0.0, 0.0, 1.0},
};

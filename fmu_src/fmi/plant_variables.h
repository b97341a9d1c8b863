/* Variables of a robot's FMU: structs, one field per variable of the table.
 *
 * Generated from apnc_plant/variables.py by `python -m apnc_plant.generate`; do not edit.
 */
#ifndef PLANT_VARIABLES_H
#define PLANT_VARIABLES_H

#include "apnc_variable.h"

#define PLANT_VARIABLES 54

typedef enum {
    PLANT_CONDITION_C1 = 1, /* nothing is wrong */
    PLANT_CONDITION_C2 = 2, /* noisy loads */
    PLANT_CONDITION_C3 = 3, /* the right front leg is damaged: its hip and knee are held at 0 */
    PLANT_CONDITION_C4 = 4, /* a payload of 0.5 of the robot's mass, which cannot be added or removed between steps */
    PLANT_CONDITION_S1 = 5, /* held in the air */
    PLANT_CONDITION_S2 = 6, /* the sensors of both front legs are stuck */
    PLANT_CONDITION_S3 = 7, /* no sensor delivers a load */
} plant_condition;

typedef enum {
    PLANT_LOAD_COMPONENT_NORMAL = 1, /* along the normal of the ground */
    PLANT_LOAD_COMPONENT_NORM = 2, /* length of the whole force */
} plant_load_component;

/* Parameters. */
typedef struct {
    int32_t seed; /* decides the asymmetry of the robot, the noise of its sensors and the obstacles */
    double roughness; /* [1] height of the obstacles on the ground over the robot's step height; 0 for none */
    double slope; /* [rad] angle by which the ground rises along x */
    double payload; /* [kg] mass of a box on the trunk, added to that of the condition */
    int32_t condition; /* what is wrong with the robot */
    double step; /* [s] longest integration step; a step of the FMU is divided into equal parts */
    double servo_stiffness; /* [N.m/rad] torque of a servo per position error */
    double servo_damping; /* [N.m.s/rad] torque of a servo per joint speed */
    double servo_stall_torque; /* [N.m] largest torque of a servo */
    double servo_no_load_speed; /* [rad/s] speed at which a servo has no driving torque left */
    double servo_reflected_inertia; /* [kg.m2] rotor inertia times the gear ratio squared */
    double servo_latency; /* [s] age of a command when the servo starts to follow it */
    double servo_slew_rate; /* [rad/s] fastest change of a command that a servo follows; 0 for no limit */
    double contact_foot_radius; /* [m] radius of the foot balls */
    double contact_stiffness; /* [N/m] normal force on a foot per depth */
    double contact_damping; /* [N.s/m] normal force per approach speed, from the damping depth on */
    double contact_damping_depth; /* [m] depth over which the damping sets in */
    double contact_friction; /* [1] Coulomb coefficient of the feet */
    double contact_friction_speed; /* [m/s] sliding speed below which friction is proportional to it */
    double sensor_delay; /* [s] age of a load when it arrives */
    double sensor_time_constant; /* [s] time constant of the low-pass of the loads; 0 for none */
    double sensor_noise; /* [1] standard deviation of the loads' noise over half the weight */
    int32_t sensor_component; /* part of the force on a foot that its sensor measures */
} plant_parameters;

/* Inputs of one step. */
typedef struct {
    double theta_hip[APNC_LEGS]; /* [rad] command of the hip joint, relative to the reference pose */
    double theta_knee[APNC_LEGS]; /* [rad] command of the knee joint, relative to the reference pose */
} plant_inputs;

/* Outputs after a step. */
typedef struct {
    double position_x; /* [m] trunk reference point; world: x forward at the start, y to the left, z up */
    double position_y; /* [m] trunk reference point; world: x forward at the start, y to the left, z up */
    double position_z; /* [m] trunk reference point; world: x forward at the start, y to the left, z up */
    double rpy_roll; /* [rad] roll, pitch and yaw of the trunk; world to trunk: yaw about z, then pitch about y, then roll about x; positive roll: right side down; pitch: nose down; yaw: to the left */
    double rpy_pitch; /* [rad] roll, pitch and yaw of the trunk; world to trunk: yaw about z, then pitch about y, then roll about x; positive roll: right side down; pitch: nose down; yaw: to the left */
    double rpy_yaw; /* [rad] roll, pitch and yaw of the trunk; world to trunk: yaw about z, then pitch about y, then roll about x; positive roll: right side down; pitch: nose down; yaw: to the left */
    double velocity_x; /* [m/s] velocity of the trunk reference point; world: x forward at the start, y to the left, z up */
    double velocity_y; /* [m/s] velocity of the trunk reference point; world: x forward at the start, y to the left, z up */
    double velocity_z; /* [m/s] velocity of the trunk reference point; world: x forward at the start, y to the left, z up */
    double joint_angle_abduction[APNC_LEGS]; /* [rad] angle of the joint; joint; 0 in the reference pose; positive abduction: moves the foot to the left; hip: swings the foot forward; knee: lifts the foot */
    double joint_angle_hip[APNC_LEGS]; /* [rad] angle of the joint; joint; 0 in the reference pose; positive abduction: moves the foot to the left; hip: swings the foot forward; knee: lifts the foot */
    double joint_angle_knee[APNC_LEGS]; /* [rad] angle of the joint; joint; 0 in the reference pose; positive abduction: moves the foot to the left; hip: swings the foot forward; knee: lifts the foot */
    double joint_speed_abduction[APNC_LEGS]; /* [rad/s] speed of the joint; joint; 0 in the reference pose; positive abduction: moves the foot to the left; hip: swings the foot forward; knee: lifts the foot */
    double joint_speed_hip[APNC_LEGS]; /* [rad/s] speed of the joint; joint; 0 in the reference pose; positive abduction: moves the foot to the left; hip: swings the foot forward; knee: lifts the foot */
    double joint_speed_knee[APNC_LEGS]; /* [rad/s] speed of the joint; joint; 0 in the reference pose; positive abduction: moves the foot to the left; hip: swings the foot forward; knee: lifts the foot */
    double joint_torque_abduction[APNC_LEGS]; /* [N.m] torque of the servo; joint; 0 in the reference pose; positive abduction: moves the foot to the left; hip: swings the foot forward; knee: lifts the foot */
    double joint_torque_hip[APNC_LEGS]; /* [N.m] torque of the servo; joint; 0 in the reference pose; positive abduction: moves the foot to the left; hip: swings the foot forward; knee: lifts the foot */
    double joint_torque_knee[APNC_LEGS]; /* [N.m] torque of the servo; joint; 0 in the reference pose; positive abduction: moves the foot to the left; hip: swings the foot forward; knee: lifts the foot */
    double joint_work_abduction[APNC_LEGS]; /* [J] |torque times speed| of the servo over time since the start; joint; never decreases */
    double joint_work_hip[APNC_LEGS]; /* [J] |torque times speed| of the servo over time since the start; joint; never decreases */
    double joint_work_knee[APNC_LEGS]; /* [J] |torque times speed| of the servo over time since the start; joint; never decreases */
    double foot_position_x[APNC_LEGS]; /* [m] centre of the foot ball; world: x forward at the start, y to the left, z up */
    double foot_position_y[APNC_LEGS]; /* [m] centre of the foot ball; world: x forward at the start, y to the left, z up */
    double foot_position_z[APNC_LEGS]; /* [m] centre of the foot ball; world: x forward at the start, y to the left, z up */
    double foot_force_x[APNC_LEGS]; /* [N] force of the ground on the foot; world: x forward at the start, y to the left, z up */
    double foot_force_y[APNC_LEGS]; /* [N] force of the ground on the foot; world: x forward at the start, y to the left, z up */
    double foot_force_z[APNC_LEGS]; /* [N] force of the ground on the foot; world: x forward at the start, y to the left, z up */
    double grf[APNC_LEGS]; /* [N] load the foot sensor delivers to the controller; positive: the foot presses; never negative */
    int32_t fell; /* true once the trunk has tipped by more than 60 degrees or touched the ground; nothing moves from then on */
} plant_outputs;

/* Everything an importer can see, in one block. */
typedef struct {
    plant_parameters parameters;
    plant_inputs inputs;
    plant_outputs outputs;
} plant_values;

#endif

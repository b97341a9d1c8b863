/* Names that a linker sees carry a prefix where a build has one, so that two builds in one program
 * share none. */
#ifndef PLANT_NAMES_H
#define PLANT_NAMES_H

#include "plant_config.h"

#ifdef PLANT_PREFIX

#define PLANT_PASTE(a, b) a##b
#define PLANT_JOIN(a, b)  PLANT_PASTE(a, b)
#define PLANT_NAME(name)  PLANT_JOIN(PLANT_PREFIX, name)

#define plant_accelerations        PLANT_NAME(plant_accelerations)
#define plant_advance              PLANT_NAME(plant_advance)
#define plant_best_level           PLANT_NAME(plant_best_level)
#define plant_box                  PLANT_NAME(plant_box)
#define plant_command              PLANT_NAME(plant_command)
#define plant_contact_force        PLANT_NAME(plant_contact_force)
#define plant_create               PLANT_NAME(plant_create)
#define plant_fallen               PLANT_NAME(plant_fallen)
#define plant_field_fill           PLANT_NAME(plant_field_fill)
#define plant_field_integers       PLANT_NAME(plant_field_integers)
#define plant_field_reals          PLANT_NAME(plant_field_reals)
#define plant_foot_mass            PLANT_NAME(plant_foot_mass)
#define plant_forces               PLANT_NAME(plant_forces)
#define plant_history              PLANT_NAME(plant_history)
#define plant_intact               PLANT_NAME(plant_intact)
#define plant_join                 PLANT_NAME(plant_join)
#define plant_joint_torque         PLANT_NAME(plant_joint_torque)
#define plant_kernel_legs          PLANT_NAME(plant_kernel_legs)
#define plant_kernel_legs_avx2     PLANT_NAME(plant_kernel_legs_avx2)
#define plant_kernel_robots        PLANT_NAME(plant_kernel_robots)
#define plant_kernel_robots_avx2   PLANT_NAME(plant_kernel_robots_avx2)
#define plant_kernel_robots_avx512 PLANT_NAME(plant_kernel_robots_avx512)
#define plant_kernel_scalar        PLANT_NAME(plant_kernel_scalar)
#define plant_lanes                PLANT_NAME(plant_lanes)
#define plant_leg_points           PLANT_NAME(plant_leg_points)
#define plant_level_name           PLANT_NAME(plant_level_name)
#define plant_loads                PLANT_NAME(plant_loads)
#define plant_longest_step         PLANT_NAME(plant_longest_step)
#define plant_normal               PLANT_NAME(plant_normal)
#define plant_obstacle             PLANT_NAME(plant_obstacle)
#define plant_own_step             PLANT_NAME(plant_own_step)
#define plant_place                PLANT_NAME(plant_place)
#define plant_rest_height          PLANT_NAME(plant_rest_height)
#define plant_sample               PLANT_NAME(plant_sample)
#define plant_sample_size          PLANT_NAME(plant_sample_size)
#define plant_sensor_disturb       PLANT_NAME(plant_sensor_disturb)
#define plant_sensor_read          PLANT_NAME(plant_sensor_read)
#define plant_sensor_size          PLANT_NAME(plant_sensor_size)
#define plant_sensor_start         PLANT_NAME(plant_sensor_start)
#define plant_servo_torque         PLANT_NAME(plant_servo_torque)
#define plant_set_conditions       PLANT_NAME(plant_set_conditions)
#define plant_shift_velocity       PLANT_NAME(plant_shift_velocity)
#define plant_side_offset          PLANT_NAME(plant_side_offset)
#define plant_size                 PLANT_NAME(plant_size)
#define plant_stable_step          PLANT_NAME(plant_stable_step)
#define plant_start                PLANT_NAME(plant_start)
#define plant_state_of             PLANT_NAME(plant_state_of)
#define plant_touches              PLANT_NAME(plant_touches)
#define plant_tune                 PLANT_NAME(plant_tune)
#define plant_uniform              PLANT_NAME(plant_uniform)
#define plant_use_level            PLANT_NAME(plant_use_level)

#endif

#endif

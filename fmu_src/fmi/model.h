/* What the shell needs of a model: controller_model.c has it of the controller, plant_model.c of
 * the robot. A build has one of them. */
#ifndef APNC_MODEL_H
#define APNC_MODEL_H

#include "instance.h"

#define apnc_variables      APNC_NAME(variables)
#define apnc_variable_count APNC_NAME(variable_count)
#define apnc_values_size    APNC_NAME(values_size)
#define apnc_state_size     APNC_NAME(state_size)
#define apnc_model_defaults APNC_NAME(model_defaults)
#define apnc_model_tick     APNC_NAME(model_tick)
#define apnc_model_refresh  APNC_NAME(model_refresh)
#define apnc_model_accepts  APNC_NAME(model_accepts)
#define apnc_model_start    APNC_NAME(model_start)
#define apnc_model_step     APNC_NAME(model_step)
#define apnc_model_pack     APNC_NAME(model_pack)
#define apnc_model_unpack   APNC_NAME(model_unpack)
#define apnc_model_sound    APNC_NAME(model_sound)
#define apnc_model_leave    APNC_NAME(model_leave)

/* Table of variables. */
extern const apnc_variable apnc_variables[];
extern const int apnc_variable_count;

/* Bytes of the values of all variables, and of everything else that a saved state needs: plain
 * data of a size that the build fixes. The state begins as zeros. */
size_t apnc_values_size(void);
size_t apnc_state_size(void);

/* Every variable at its start value; outputs 0. */
void apnc_model_defaults(void *values);

/* Length of a tick [s], by which times are compared. */
double apnc_model_tick(const apnc_instance *instance);

/* Bring the outputs up to date: before the first step those of a model that starts with the
 * parameters as they are, later those of the last step. Called if run->outdated. */
apnc_status apnc_model_refresh(apnc_instance *instance);

/* Whether a parameter may have a value that lies in its range; logs if not. */
apnc_status apnc_model_accepts(apnc_instance *instance, const apnc_variable *variable,
                               double value);

/* Start at run->start_time; the parameters are in their ranges, the outputs up to date. */
apnc_status apnc_model_start(apnc_instance *instance);

/* Step from t by h [s]; both are checked. Inputs are held. An error leaves run->time as it was. */
apnc_status apnc_model_step(apnc_instance *instance, double t, double h);

/* Take out of a copy of a state, or put back into the instance's own, what is not plain data. */
void apnc_model_pack(void *state);
apnc_status apnc_model_unpack(apnc_instance *instance);

/* Whether a state that came from outside can be stepped: its bytes may have been made by hand. */
int apnc_model_sound(const void *values, const apnc_run *run, const void *state);

/* Give back what the model has allocated at instance->own. */
void apnc_model_leave(apnc_instance *instance);

#endif

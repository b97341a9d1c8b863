/* The robot behind the shell: steps of any length, cut into ticks at whose ends the sensors read.
 */
#include <math.h>
#include <string.h>

#include "model.h"
#include "plant.h"
#include "plant_variables.h"
#include "robot_config.h"

#define TICK      (1.0 / 60.0) /* [s] longest time between two readings; longer steps are cut */
#define TOO_SHORT 1e-9 /* [s] a step below changes nothing: what rounding has left of a run */
#define HISTORY   256  /* commands, and readings, under way at most */
#define CONTACTS  32   /* places at which a foot touches obstacles at most */

/* A condition of the paper for this robot. */
typedef struct {
    double payload;             /* [kg] */
    double grf_noise;           /* [1] see plant_conditions */
    double held_at;             /* [m] */
    int32_t held;               /* */
    uint8_t damaged[APNC_LEGS]; /* */
    double stuck[APNC_LEGS];    /* [N] */
} condition_numbers;

static const condition_numbers conditions[] = {ROBOT_CONDITIONS};
static const plant_leg legs[APNC_LEGS] = {ROBOT_LEGS};
static const plant_body bare_trunk = ROBOT_TRUNK; /* without payload and error */

/* What is saved beside the values; the bytes of a plant follow it, at a multiple of 64. */
typedef struct {
    double payload;    /* [kg] of the condition that the robot started with */
    int32_t contacts;  /* that the plant was made for; 0: planes */
    int32_t placed;    /* the plant has a robot */
    int32_t condition; /* that is in force */
    int32_t hurried;   /* steps were found too short for the history, and it was said */
} plant_run;

/* The ground that an instance stands on; the numbers of obstacles follow it. */
typedef struct {
    plant_ground ground;
    double roughness, slope, foot_radius; /* what it was made for */
    int32_t seed;
} plant_site;

const int apnc_variable_count = PLANT_VARIABLES;

_Static_assert(sizeof(plant_run) <= 64, "the plant begins 64 bytes into the state");
_Static_assert(offsetof(plant_outputs, grf) == (9 + 18 * APNC_LEGS) * sizeof(double),
               "the outputs are in the order of plant_sample");

static void *plant_in(void *state) { return (char *)state + 64; }

size_t apnc_values_size(void) { return sizeof(plant_values); }

size_t apnc_state_size(void) {
    return 64 + plant_size(PLANT_LEGS, PLANT_BASELINE, APNC_LEGS, CONTACTS, HISTORY);
}

void apnc_model_defaults(void *values) {
    for (int i = 0; i < apnc_variable_count; i++) {
        const apnc_variable *variable = &apnc_variables[i];
        char *at = (char *)values + variable->offset;
        for (int k = 0; k < variable->count; k++) {
            if (variable->type == APNC_REAL)
                ((double *)(void *)at)[k] = variable->start;
            else
                ((int32_t *)(void *)at)[k] = (int32_t)variable->start;
        }
    }
}

double apnc_model_tick(const apnc_instance *instance) {
    (void)instance;
    return TICK;
}

static const condition_numbers *condition_of(const plant_parameters *p) {
    return &conditions[p->condition - 1];
}

static plant_servo servo_of(const plant_parameters *p) {
    return (plant_servo){p->servo_stiffness,     p->servo_damping,           p->servo_stall_torque,
                         p->servo_no_load_speed, p->servo_reflected_inertia, p->servo_latency,
                         p->servo_slew_rate};
}

static plant_contact contact_of(const plant_parameters *p) {
    return (plant_contact){p->contact_foot_radius, p->contact_stiffness,
                           p->contact_damping,     p->contact_damping_depth,
                           p->contact_friction,    p->contact_friction_speed};
}

static plant_sensor sensor_of(const plant_parameters *p) {
    return (plant_sensor){p->sensor_delay, p->sensor_time_constant, p->sensor_noise,
                          p->sensor_component == PLANT_LOAD_COMPONENT_NORM};
}

/* Radius of the largest foot. */
static double largest_foot(const plant_parameters *p) {
    double largest = 0.0;
    for (int leg = 0; leg < APNC_LEGS; leg++) {
        const double own = legs[leg].foot_radius;
        largest = fmax(largest, isnan(own) ? p->contact_foot_radius : own);
    }
    return largest;
}

/* The trunk with its payload and the error of its centre of mass. */
static plant_body trunk_of(const plant_parameters *p) {
    static const double edges[3] = ROBOT_TRUNK_EDGES, center[3] = ROBOT_TRUNK_CENTER;
    static const double box[3] = ROBOT_PAYLOAD_SIZE;
    const double off = plant_side_offset((uint64_t)p->seed, ROBOT_COM_SIDE_OFFSET);
    const double top[3] = {center[0], center[1], center[2] + (edges[2] + box[2]) / 2.0};
    plant_body payload, trunk = bare_trunk;
    trunk.com[1] += off;
    plant_box(p->payload + condition_of(p)->payload, box, top, &payload);
    plant_join(&trunk, &payload, &trunk);
    return trunk;
}

static plant_robot robot_of(const plant_parameters *p) {
    const plant_robot robot = {
        .legs = APNC_LEGS,
        .gravity = ROBOT_GRAVITY,
        .weight = ROBOT_WEIGHT,
        .trunk = trunk_of(p),
        .trunk_center = ROBOT_TRUNK_CENTER,
        .trunk_size = ROBOT_TRUNK_EDGES,
        .servo = servo_of(p),
        .contact = contact_of(p),
        .sensor = sensor_of(p),
        .suspension = ROBOT_SUSPENSION,
        .leg = legs,
    };
    return robot;
}

static apnc_status out_of_memory(apnc_instance *instance) {
    return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR, "out of memory");
}

/* Make the ground that the parameters ask for, unless it is there. */
static apnc_status prepare_site(apnc_instance *instance) {
    static const double diameters[2] = ROBOT_FIELD_DIAMETERS;
    const plant_parameters *p = &((const plant_values *)instance->values)->parameters;
    const plant_field field = {(uint64_t)p->seed,
                               ROBOT_FIELD_BALLS,
                               ROBOT_FIELD_CELLS,
                               ROBOT_FIELD_TILE,
                               p->roughness * ROBOT_FIELD_STEP,
                               diameters[0],
                               diameters[1],
                               largest_foot(p),
                               ROBOT_FIELD_SINK_IN};
    const int rough = p->roughness > 0.0;
    plant_site *site = instance->own;
    if (site && site->roughness == p->roughness && site->slope == p->slope &&
        (!rough || (site->seed == p->seed && site->foot_radius == field.foot_radius)))
        return APNC_OK;
    apnc_model_leave(instance);
    const size_t reals = rough ? (size_t)plant_field_reals(&field) : 0;
    const size_t integers = rough ? (size_t)plant_field_integers(&field) : 0;
    site = instance->allocate(instance, sizeof *site + 8 * (reals + integers));
    if (!site) return out_of_memory(instance);
    double *numbers = (double *)(void *)(site + 1);
    int64_t *places = (int64_t *)(void *)(numbers + reals);
    *site = (plant_site){
        {rough ? PLANT_OBSTACLES : PLANT_PLANE, 1, p->slope, field.height, numbers, places, NULL},
        p->roughness,
        p->slope,
        field.foot_radius,
        p->seed};
    if (rough) site->ground.contacts = plant_field_fill(&field, numbers, places);
    instance->own = site;
    if (site->ground.contacts <= CONTACTS) return APNC_OK;
    return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                       "seed = %ld puts %ld obstacles in one place: %d are allowed", (long)p->seed,
                       (long)site->ground.contacts - 1, CONTACTS - 1);
}

static void apply_condition(const plant_parameters *p, plant_run *run, void *plant) {
    const condition_numbers *c = condition_of(p);
    const plant_conditions wanted = {c->grf_noise, c->held, c->held_at, c->damaged, c->stuck};
    plant_set_conditions(plant, 0, &wanted);
    run->condition = p->condition;
}

/* Refuse an integration step that is too long for the robot with the present parameters. */
static apnc_status refuse_step(apnc_instance *instance) {
    const plant_parameters *p = &((const plant_values *)instance->values)->parameters;
    plant_robot robot = robot_of(p);
    robot.trunk = bare_trunk;
    const double longest = plant_longest_step(&robot);
    if (p->step <= longest) return APNC_OK;
    return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                       "step = %g s is too long for the servos and feet of this robot: %g s is "
                       "the longest",
                       p->step, floor(1e6 * longest) / 1e6);
}

/* Put the robot on the ground that its parameters ask for. */
static apnc_status place(apnc_instance *instance) {
    static const double angles[3] = {0.0, 0.0, 0.0};
    const plant_parameters *p = &((const plant_values *)instance->values)->parameters;
    plant_run *run = instance->state;
    void *plant = plant_in(instance->state);
    double coordinates[6 + 3 * APNC_LEGS], found[4 * CONTACTS];
    if (apnc_report_parameters(instance) != APNC_OK) return APNC_ERROR;
    if (refuse_step(instance) != APNC_OK) return APNC_ERROR;
    if (prepare_site(instance) != APNC_OK) return APNC_ERROR;
    const plant_site *site = instance->own;
    const plant_robot robot = robot_of(p);
    run->contacts = site->ground.kind == PLANT_PLANE ? 0 : site->ground.contacts;
    run->payload = condition_of(p)->payload;
    plant_create(plant, PLANT_LEGS, plant_best_level(), APNC_LEGS, run->contacts, HISTORY);
    plant_start(&robot, &site->ground, angles, 0.0, found, coordinates);
    plant_place(plant, 0, &robot, &site->ground, (uint64_t)p->seed, coordinates,
                condition_of(p)->held_at, TICK);
    apply_condition(p, run, plant);
    run->placed = 1;
    return APNC_OK;
}

/* The sample of the plant in the order of the variables: by component, then by leg. */
static void show(apnc_instance *instance) {
    plant_values *values = instance->values;
    double sample[9 + 19 * APNC_LEGS], *shown = (double *)(void *)&values->outputs;
    const void *plant = plant_in(instance->state);
    plant_sample(plant, 0, sample);
    memcpy(shown, sample, 9 * sizeof *sample);
    for (int signal = 0; signal < 6; signal++)
        for (int leg = 0; leg < APNC_LEGS; leg++)
            for (int i = 0; i < 3; i++)
                shown[9 + (3 * signal + i) * APNC_LEGS + leg] =
                    sample[9 + (signal * APNC_LEGS + leg) * 3 + i];
    memcpy(values->outputs.grf, sample + 9 + 18 * APNC_LEGS, sizeof values->outputs.grf);
    values->outputs.fell = plant_state_of(plant, 0) == PLANT_FELL;
}

apnc_status apnc_model_refresh(apnc_instance *instance) {
    if (instance->run->phase == APNC_INITIALIZATION && place(instance) != APNC_OK)
        return APNC_ERROR;
    show(instance);
    return APNC_OK;
}

apnc_status apnc_model_accepts(apnc_instance *instance, const apnc_variable *variable,
                               double value) {
    const plant_run *run = instance->state;
    if (variable->offset != offsetof(plant_values, parameters.condition)) return APNC_OK;
    const condition_numbers *c = &conditions[(int)value - 1];
    if (instance->run->phase == APNC_STEPPING && c->payload != run->payload)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "%s = %g has a payload of %g kg, but the robot started with %g kg",
                           variable->name, value, c->payload, run->payload);
    return APNC_OK;
}

apnc_status apnc_model_start(apnc_instance *instance) {
    const plant_parameters *p = &((const plant_values *)instance->values)->parameters;
    return apnc_report(instance, APNC_OK, APNC_LOG_EVENTS, "started at %g s: %d legs, seed %ld",
                       instance->run->start_time, APNC_LEGS, (long)p->seed);
}

static apnc_status refuse_commands(apnc_instance *instance, int number, const double *commands) {
    for (int leg = 0; leg < APNC_LEGS; leg++)
        if (!isfinite(commands[leg]))
            return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                               "%s = %g is not a finite angle",
                               apnc_scalar_name(&apnc_variables[number], leg).text, commands[leg]);
    return APNC_OK;
}

/* Whether a step is too short for the history: commands and loads then arrive early. */
static apnc_status note_hurry(apnc_instance *instance, double duration) {
    const plant_parameters *p = &((const plant_values *)instance->values)->parameters;
    plant_run *run = instance->state;
    const double age = fmax(p->servo_latency, p->sensor_delay);
    if (run->hurried || duration * (HISTORY - 3) >= age) return APNC_OK;
    run->hurried = 1;
    return apnc_report(instance, APNC_WARNING, APNC_LOG_WARNING,
                       "steps of %g s are short for a delay of %g s: after %d of them what is "
                       "under way arrives early",
                       duration, age, HISTORY - 3);
}

/* Parameters that were set since the last step come into force. */
static void tune(apnc_instance *instance) {
    const plant_parameters *p = &((const plant_values *)instance->values)->parameters;
    plant_run *run = instance->state;
    const plant_robot robot = robot_of(p);
    plant_tune(plant_in(run), 0, &robot);
    /* a trunk is held where it is when that begins */
    if (run->condition != p->condition) apply_condition(p, run, plant_in(run));
    instance->run->tuned = 0;
}

apnc_status apnc_model_step(apnc_instance *instance, double t, double h) {
    const plant_values *values = instance->values;
    const plant_parameters *p = &values->parameters;
    const double *hip = values->inputs.theta_hip, *knee = values->inputs.theta_knee;
    const plant_site *site = instance->own;
    const plant_ground *const ground = &site->ground;
    void *plant = plant_in(instance->state);
    const double parts = fmax(1.0, ceil(h / TICK - 1e-6)), duration = h / parts;

    if (refuse_commands(instance, 0, hip) || refuse_commands(instance, 1, knee)) return APNC_ERROR;
    if (plant_state_of(plant, 0) == PLANT_DIVERGED)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "the motion has diverged: a reset or a saved state starts again");
    if (h < TOO_SHORT || plant_state_of(plant, 0) == PLANT_FELL) return APNC_OK;
    if (parts > APNC_MAX_TICKS_PER_STEP)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "step by %g s has more than %g ticks of %g s", h,
                           APNC_MAX_TICKS_PER_STEP, TICK);
    if (instance->run->tuned) {
        if (refuse_step(instance) != APNC_OK) return APNC_ERROR;
        tune(instance);
    }
    const apnc_status status = note_hurry(instance, duration);
    double part = 0.0;
    do {
        plant_command(plant, 0, hip, knee);
        plant_advance(plant, &ground, duration, p->step);
        part += 1.0;
    } while (part < parts && plant_state_of(plant, 0) == PLANT_WALKS);
    instance->run->outdated = 1;
    if (plant_state_of(plant, 0) == PLANT_DIVERGED)
        return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                           "the motion diverged before t = %.9g s with integration steps of "
                           "%.4g s",
                           t + part * duration, p->step);
    if (plant_state_of(plant, 0) == PLANT_FELL)
        apnc_report(instance, APNC_OK, APNC_LOG_EVENTS, "fell at %.9g s", t + part * duration);
    return status;
}

void apnc_model_pack(void *state) { plant_use_level(plant_in(state), PLANT_BASELINE); }

/* Stand on the ground of the restored parameters, and use the instructions of this machine. */
apnc_status apnc_model_unpack(apnc_instance *instance) {
    const plant_run *run = instance->state;
    if (!run->placed) return APNC_OK;
    plant_use_level(plant_in(instance->state), plant_best_level());
    if (!apnc_parameters_in_range(instance->values)) {
        instance->run->outdated = 1;
        return APNC_OK;
    }
    if (prepare_site(instance) != APNC_OK) return APNC_ERROR;
    const plant_ground *ground = &((const plant_site *)instance->own)->ground;
    if (run->contacts == (ground->kind == PLANT_PLANE ? 0 : ground->contacts)) return APNC_OK;
    return apnc_report(instance, APNC_ERROR, APNC_LOG_ERROR,
                       "saved state does not fit the ground of its parameters");
}

int apnc_model_sound(const void *values, const apnc_run *run, const void *state) {
    const plant_run *own = state;
    const int walks = run->phase == APNC_STEPPING || run->phase == APNC_TERMINATED;
    (void)values;
    if (!own->placed) return !walks && run->outdated;
    if (own->contacts < 0 || own->contacts > CONTACTS) return 0;
    return plant_intact((const char *)state + 64, PLANT_LEGS, PLANT_BASELINE, APNC_LEGS,
                        own->contacts, HISTORY);
}

void apnc_model_leave(apnc_instance *instance) {
    if (instance->own) instance->release(instance, instance->own);
    instance->own = NULL;
}

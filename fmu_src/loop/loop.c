#include "loop.h"

#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { LOOP_MOST_LANES = 8, LOOP_MOST_LEGS = 64, LOOP_ALIGNMENT = 64 };

/* The controller's wall time is measured at one in this many ticks. */
#define LOOP_TIMED 16

/* Types of FMI 2.0, chapters 2.1 and 4.2, which are the same on all platforms. */
typedef void *fmu_component;
typedef int fmu_status; /* 0: success, 1: warning, above: failure */
enum { FMU_WARNING = 1, FMU_ERROR = 3, FMU_CO_SIMULATION = 1 };

typedef struct {
    void (*logger)(void *environment, const char *name, fmu_status status, const char *category,
                   const char *message, ...);
    void *(*allocate)(size_t, size_t);
    void (*release)(void *);
    void (*step_finished)(void *, fmu_status);
    void *environment;
} fmu_callbacks;

typedef fmu_component fmu_instantiate(const char *, int, const char *, const char *,
                                      const fmu_callbacks *, int, int);
typedef void fmu_free_instance(fmu_component);
typedef fmu_status fmu_setup(fmu_component, int, double, double, int, double);
typedef fmu_status fmu_call(fmu_component);
typedef fmu_status fmu_set_real(fmu_component, const uint32_t *, size_t, const double *);
typedef fmu_status fmu_set_integer(fmu_component, const uint32_t *, size_t, const int32_t *);
typedef fmu_status fmu_do_step(fmu_component, double, double, int);
typedef fmu_status fmu_get_real(fmu_component, const uint32_t *, size_t, double *);
typedef fmu_status fmu_get_integer(fmu_component, const uint32_t *, size_t, int32_t *);

/* A function from its address. POSIX allows to convert a data pointer to a function pointer. */
#define FUNCTION(type, address) (*(type **)(void *)&(address))

typedef struct {
    loop_run *run;
    fmu_component controller;
    fmu_callbacks callbacks;
    int32_t mi, turn, reset, condition; /* index of the value of each schedule that holds */
    int32_t push;                       /* index of the push that comes next */
} loop_lane;

typedef struct {
    const loop_functions *functions;
    const loop_variables *variables;
    double Ts, step;
    int32_t lanes;
    size_t plant;   /* [bytes] from the start */
    size_t outputs; /* count of numbers read from the controller, and room for the reals */
    loop_lane lane[LOOP_MOST_LANES];
    const plant_ground *ground[LOOP_MOST_LANES];
} loop;

static size_t aligned(size_t size) {
    return (size + LOOP_ALIGNMENT - 1) / LOOP_ALIGNMENT * LOOP_ALIGNMENT;
}

static void *plant_in(const loop *l) { return (char *)(uintptr_t)l + l->plant; }

size_t loop_size(int32_t kind, int32_t level, int32_t legs, int32_t contacts, int32_t history) {
    const size_t plant = plant_size(kind, level, legs, contacts, history);
    return plant ? aligned(sizeof(loop)) + plant : 0;
}

void loop_create(void *memory, int32_t kind, int32_t level, int32_t legs, int32_t contacts,
                 int32_t history, const loop_functions *functions, const loop_variables *variables,
                 double Ts, double step) {
    loop *l = (loop *)memory;
    memset(l, 0, sizeof *l);
    l->functions = functions;
    l->variables = variables;
    l->Ts = Ts;
    l->step = step;
    l->lanes = plant_lanes(kind, level);
    l->plant = aligned(sizeof *l);
    plant_create(plant_in(l), kind, level, legs, contacts, history);
}

int32_t loop_lanes(const void *memory) { return ((const loop *)memory)->lanes; }

loop_run *loop_run_in(const void *memory, int32_t lane) {
    return ((const loop *)memory)->lane[lane].run;
}

/* The controller's message about an error becomes the message of the run. */
static void log_message(void *environment, const char *name, fmu_status status,
                        const char *category, const char *message, ...) {
    loop_run *run = (loop_run *)environment;
    va_list arguments;
    (void)name;
    (void)category;
    if (status <= FMU_WARNING || !message) return;
    va_start(arguments, message);
    vsnprintf(run->message, sizeof run->message, message, arguments);
    va_end(arguments);
}

static void end_run(loop *l, int32_t lane, int32_t end) {
    loop_lane *at = &l->lane[lane];
    if (at->controller) FUNCTION(fmu_free_instance, l->functions->free_instance)(at->controller);
    at->run->end = end;
    at->controller = NULL;
    at->run = NULL;
    l->ground[lane] = NULL;
}

/* End a run that the controller refused. Its message stays; if there is none, the failed call is
 * named. */
static void refuse(loop *l, int32_t lane, const char *call) {
    loop_run *run = l->lane[lane].run;
    if (!run->message[0]) snprintf(run->message, sizeof run->message, "%s failed", call);
    end_run(l, lane, LOOP_REFUSED);
}

/* Read back the start values of the controller. Returns the call that failed, or NULL. */
static const char *read_parameters(const loop *l, const loop_lane *at) {
    const loop_functions *f = l->functions;
    const loop_variables *v = l->variables;
    double *to = at->run->parameters;
    int32_t whole[LOOP_MOST_LEGS];
    if (!to) return NULL;
    if (FUNCTION(fmu_get_real, f->get_real)(at->controller, v->real_parameters,
                                            (size_t)v->n_real_parameters, to) > FMU_WARNING)
        return "fmi2GetReal";
    to += v->n_real_parameters;
    if (FUNCTION(fmu_get_integer, f->get_integer)(at->controller, v->integer_parameters,
                                                  (size_t)v->n_integer_parameters,
                                                  whole) > FMU_WARNING)
        return "fmi2GetInteger";
    for (int32_t i = 0; i < v->n_integer_parameters; i++) *to++ = whole[i];
    if (FUNCTION(fmu_get_integer, f->get_boolean)(at->controller, v->boolean_parameters,
                                                  (size_t)v->n_boolean_parameters,
                                                  whole) > FMU_WARNING)
        return "fmi2GetBoolean";
    for (int32_t i = 0; i < v->n_boolean_parameters; i++) *to++ = whole[i] != 0;
    return NULL;
}

/* Start the controller. Returns the call that failed, or NULL. */
static const char *start_controller(loop *l, int32_t lane) {
    loop_lane *at = &l->lane[lane];
    const loop_run *run = at->run;
    const loop_functions *f = l->functions;
    const loop_starts *s = run->starts;
    at->callbacks = (fmu_callbacks){log_message, calloc, free, NULL, at->run};
    at->controller = FUNCTION(fmu_instantiate, f->instantiate)("controller", FMU_CO_SIMULATION,
                                                               run->guid, "", &at->callbacks, 0, 1);
    if (!at->controller) return "fmi2Instantiate";
    if (FUNCTION(fmu_setup, f->setup_experiment)(at->controller, 0, 0.0, 0.0, 0, 0.0) > FMU_WARNING)
        return "fmi2SetupExperiment";
    if (FUNCTION(fmu_call, f->enter_initialization)(at->controller) > FMU_WARNING)
        return "fmi2EnterInitializationMode";
    if (FUNCTION(fmu_set_real, f->set_real)(at->controller, s->real, (size_t)s->n_reals, s->reals) >
        FMU_WARNING)
        return "fmi2SetReal";
    if (FUNCTION(fmu_set_integer, f->set_integer)(at->controller, s->integer, (size_t)s->n_integers,
                                                  s->integers) > FMU_WARNING)
        return "fmi2SetInteger";
    if (FUNCTION(fmu_set_integer, f->set_boolean)(at->controller, s->boolean, (size_t)s->n_booleans,
                                                  s->booleans) > FMU_WARNING)
        return "fmi2SetBoolean";
    if (FUNCTION(fmu_call, f->exit_initialization)(at->controller) > FMU_WARNING)
        return "fmi2ExitInitializationMode";
    return read_parameters(l, at);
}

void loop_begin(void *memory, int32_t lane, loop_run *run) {
    loop *l = (loop *)memory;
    loop_lane *at = &l->lane[lane];
    run->count = 0;
    run->end = LOOP_RUNS;
    run->controller_s = 0.0;
    run->message[0] = '\0';
    *at = (loop_lane){run, NULL, {0}, 0, 0, 0, 0, 0};
    l->ground[lane] = run->ground;
    plant_place(plant_in(l), lane, run->robot, run->ground, run->seed, run->coordinates,
                run->height, l->Ts);
    plant_set_conditions(plant_in(l), lane, &run->condition[0]);
    const char *failed = start_controller(l, lane);
    if (failed) refuse(l, lane, failed);
}

static double now(void) {
    struct timespec t;
    timespec_get(&t, TIME_UTC);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* Value of a schedule at a tick; `at`: index of the value that held before. */
static double value_at(const loop_schedule *schedule, int32_t tick, int32_t *at) {
    while (*at + 1 < schedule->n && schedule->tick[*at + 1] <= tick) ++*at;
    return schedule->value[*at];
}

/* Let the controller compute tick `n` and read its outputs. Returns the call that failed, or NULL.
 */
static const char *step_controller(loop *l, loop_lane *at, int32_t n, const double *inputs,
                                   int32_t reset, double *outputs) {
    const loop_functions *f = l->functions;
    const loop_variables *v = l->variables;
    int32_t whole[LOOP_MOST_LEGS];
    if (FUNCTION(fmu_set_real, f->set_real)(at->controller, v->inputs, (size_t)v->legs + 2,
                                            inputs) > FMU_WARNING)
        return "fmi2SetReal";
    if (FUNCTION(fmu_set_integer, f->set_boolean)(at->controller, v->reset, 1, &reset) >
        FMU_WARNING)
        return "fmi2SetBoolean";
    if (FUNCTION(fmu_do_step, f->do_step)(at->controller, n * l->Ts, l->Ts, 1) > FMU_WARNING)
        return "fmi2DoStep";
    if (FUNCTION(fmu_get_real, f->get_real)(at->controller, v->reals, (size_t)v->n_reals, outputs) >
        FMU_WARNING)
        return "fmi2GetReal";
    outputs += v->n_reals;
    if (v->n_integers &&
        FUNCTION(fmu_get_integer, f->get_integer)(at->controller, v->integers,
                                                  (size_t)v->n_integers, whole) > FMU_WARNING)
        return "fmi2GetInteger";
    for (int32_t i = 0; i < v->n_integers; i++) *outputs++ = whole[i];
    if (v->n_booleans &&
        FUNCTION(fmu_get_integer, f->get_boolean)(at->controller, v->booleans,
                                                  (size_t)v->n_booleans, whole) > FMU_WARNING)
        return "fmi2GetBoolean";
    for (int32_t i = 0; i < v->n_booleans; i++) *outputs++ = whole[i] != 0;
    return NULL;
}

/* Write the values of one variable at this tick; a record keeps all ticks of a variable together.
 */
static void record_row(double *record, const loop_run *run, const double *row, int32_t size) {
    double *to = record + (size_t)run->count * (size_t)size;
    for (int32_t i = 0; i < size; i++) to[i] = row[i]; /* few: a call of memcpy takes longer */
}

static void record_controller(const loop_variables *v, const loop_run *run, const double *row) {
    double *record = run->controller_record;
    for (int32_t i = 0; i < v->n_sizes; i++) {
        record_row(record, run, row, v->sizes[i]);
        record += (size_t)run->ticks * (size_t)v->sizes[i];
        row += v->sizes[i];
    }
}

static void record_plant(const loop *l, int32_t lane, const loop_run *run) {
    const int32_t legs = l->variables->legs;
    const int32_t sizes[10] = {3,        3,        3,        3 * legs, 3 * legs,
                               3 * legs, 3 * legs, 3 * legs, 3 * legs, legs};
    double sample[9 + 19 * LOOP_MOST_LEGS], *record = run->plant_record;
    const double *row = sample;
    plant_sample(plant_in(l), lane, sample);
    for (int i = 0; i < 10; i++) {
        if (run->plant_signals >> i & 1) {
            record_row(record, run, row, sizes[i]);
            record += (size_t)run->ticks * (size_t)sizes[i];
        }
        row += sizes[i];
    }
}

/* First half of a tick of a lane: conditions, controller, record, command, push. */
static const char *control(loop *l, int32_t lane) {
    loop_lane *at = &l->lane[lane];
    loop_run *run = at->run;
    const int32_t n = run->count, legs = l->variables->legs;
    double row[32 * LOOP_MOST_LEGS], *outputs = row + legs + 3;
    while (at->condition + 1 < run->n_conditions && run->condition_tick[at->condition + 1] <= n)
        plant_set_conditions(plant_in(l), lane, &run->condition[++at->condition]);
    plant_loads(plant_in(l), lane, row);
    row[legs] = value_at(&run->mi, n, &at->mi);
    row[legs + 1] = value_at(&run->turn, n, &at->turn);
    const int32_t reset = value_at(&run->reset, n, &at->reset) != 0.0;
    row[legs + 2] = reset;
    const int timed = n % LOOP_TIMED == 0;
    const double begin = timed ? now() : 0.0;
    const char *failed = step_controller(l, at, n, row, reset, outputs);
    if (timed) run->controller_s += LOOP_TIMED * (now() - begin);
    if (failed) return failed;
    if (run->controller_record) record_controller(l->variables, run, row);
    if (run->plant_record) record_plant(l, lane, run);
    plant_command(plant_in(l), lane, outputs, outputs + legs);
    if (at->push < run->n_pushes && run->push_tick[at->push] == n) {
        const double *change = run->push + 2 * at->push++;
        plant_shift_velocity(plant_in(l), lane, change[0], change[1]);
    }
    return NULL;
}

/* Second half, after the robots have moved: whether and how a run has ended. */
static int32_t end_of(const loop *l, int32_t lane) {
    const loop_run *run = l->lane[lane].run;
    const int32_t state = plant_state_of(plant_in(l), lane);
    if (state == PLANT_DIVERGED) return LOOP_DIVERGED;
    if (state == PLANT_FELL) return LOOP_FELL;
    return run->count == run->ticks ? LOOP_COMPLETE : LOOP_RUNS;
}

int32_t loop_walk(void *memory, int32_t ticks, const volatile int32_t *stop) {
    loop *l = (loop *)memory;
    int32_t ended = 0, walking = 0;
    for (int32_t lane = 0; lane < l->lanes; lane++) walking += l->lane[lane].run != NULL;
    for (int32_t k = 0; k < ticks && walking && !ended && !(stop && *stop); k++) {
        for (int32_t lane = 0; lane < l->lanes; lane++) {
            if (!l->lane[lane].run) continue;
            const char *failed = control(l, lane);
            if (!failed) continue;
            refuse(l, lane, failed);
            ended++;
        }
        plant_advance(plant_in(l), l->ground, l->Ts, l->step);
        for (int32_t lane = 0; lane < l->lanes; lane++) {
            loop_run *run = l->lane[lane].run;
            if (!run) continue;
            run->count++;
            const int32_t end = end_of(l, lane);
            if (end == LOOP_RUNS) continue;
            end_run(l, lane, end);
            ended++;
        }
    }
    return ended;
}

void loop_free(void *memory) {
    loop *l = (loop *)memory;
    for (int32_t lane = 0; lane < l->lanes; lane++)
        if (l->lane[lane].run) end_run(l, lane, LOOP_RUNS);
}

/* Closed loops of controller FMU and plant, several side by side: the co-simulation master in C.
 *
 * A loop has the lanes of a plant. Every lane holds a run of its own, and a lane whose run has
 * ended takes the next. The controller is any FMU of FMI 2.0; it is called through its functions.
 *
 * At tick n the controller gets the loads that the sensors show at n Ts. Its commands act on the
 * servos from n Ts to (n + 1) Ts, as those of a control computer on the robot do.
 *
 * Python parses this header with cffi, after plant.h.
 */
#ifndef LOOP_H
#define LOOP_H

#include "plant.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Addresses of the functions of the controller's library. */
typedef struct {
    void *instantiate, *free_instance, *setup_experiment, *enter_initialization;
    void *exit_initialization, *set_real, *set_integer, *set_boolean, *do_step;
    void *get_real, *get_integer, *get_boolean;
} loop_functions;

/* Value references that are read and written, the same for all runs of a loop. */
typedef struct {
    int32_t legs;
    const uint32_t *inputs; /* loads of the legs, MI, turn: legs + 2 of type Real */
    const uint32_t *reset;  /* 1 of type Boolean */
    const uint32_t *reals;  /* outputs: hip and knee commands first, 2 legs of them, then others */
    int32_t n_reals;        /* */
    const uint32_t *integers; /* outputs to be recorded */
    int32_t n_integers;       /* */
    const uint32_t *booleans; /* outputs to be recorded */
    int32_t n_booleans;       /* */
    const int32_t *sizes; /* entries of each variable of the record: of the inputs, the reset, */
    int32_t n_sizes;      /* reals, integers and booleans, one after the other */
    const uint32_t *real_parameters;    /* to be read back at the start */
    int32_t n_real_parameters;          /* */
    const uint32_t *integer_parameters; /* to be read back at the start */
    int32_t n_integer_parameters;       /* */
    const uint32_t *boolean_parameters; /* to be read back at the start */
    int32_t n_boolean_parameters;       /* */
} loop_variables;

/* Start values of the controller. */
typedef struct {
    int32_t n_reals, n_integers, n_booleans;
    const uint32_t *real, *integer, *boolean; /* value references */
    const double *reals;
    const int32_t *integers;
    const int32_t *booleans;
} loop_starts;

/* A quantity that changes at ticks: value i holds from tick[i] on; tick[0] is 0, ticks grow. */
typedef struct {
    int32_t n;
    const int32_t *tick;
    const double *value;
} loop_schedule;

/* How a run ended. */
enum {
    LOOP_RUNS = 0,
    LOOP_COMPLETE = 1,
    LOOP_FELL = 2,
    LOOP_DIVERGED = 3,
    LOOP_REFUSED = 4 /* by the controller; the message says why */
};

/* One run. Everything must live until it has ended. */
typedef struct {
    const char *guid;                  /* of the controller */
    const loop_starts *starts;         /* */
    const plant_robot *robot;          /* */
    const plant_ground *ground;        /* */
    uint64_t seed;                     /* of the noise of the sensors */
    const double *coordinates;         /* start, as plant_place takes them */
    double height;                     /* [m] of the trunk above these coordinates */
    int32_t ticks;                     /* planned */
    loop_schedule mi, turn, reset;     /* */
    int32_t n_conditions;              /* */
    const int32_t *condition_tick;     /* tick from which each condition holds; the first is 0 */
    const plant_conditions *condition; /* */
    int32_t n_pushes;                  /* ticks at whose begin the robot is pushed */
    const int32_t *push_tick;          /* they grow */
    const double *push;                /* [m/s] change of velocity, x and y for each tick */
    uint32_t plant_signals;    /* which signals of plant_sample are recorded: bit i stands for the
                                  i-th of them */
    double *plant_record;      /* these signals one after the other, each of `ticks` times its size;
                                  NULL: none */
    double *controller_record; /* the variables one after the other, each of `ticks` times its
                                  size; NULL: none */
    double *parameters;        /* as the controller has them at the start: reals, then integers,
                                  then booleans, one after the other; NULL: none */
    /* results */
    int32_t count;       /* ticks taken */
    int32_t end;         /* LOOP_... */
    double controller_s; /* [s] wall time in the controller, estimated from a sample of ticks */
    char message[256];   /* why the run ended early */
} loop_run;

/* Size of a loop in bytes; arguments as of plant_size. */
size_t loop_size(int32_t kind, int32_t level, int32_t legs, int32_t contacts, int32_t history);

/* Make the bytes at `memory` (aligned to 64) a loop without runs.
 *
 * Ts: time of a tick; step: longest integration step [s]. functions and variables must live as
 * long as the loop. */
void loop_create(void *memory, int32_t kind, int32_t level, int32_t legs, int32_t contacts,
                 int32_t history, const loop_functions *functions, const loop_variables *variables,
                 double Ts, double step);

/* Number of lanes. */
int32_t loop_lanes(const void *loop);

/* Begin a run in a lane that has none. A controller that refuses ends it at once. */
void loop_begin(void *loop, int32_t lane, loop_run *run);

/* Walk until a run has ended, `ticks` ticks have passed or *stop is not 0 (stop may be NULL).
 *
 * Returns the number of runs that have ended; their lanes are empty from then on. */
int32_t loop_walk(void *loop, int32_t ticks, const volatile int32_t *stop);

/* The run in a lane, or NULL. */
loop_run *loop_run_in(const void *loop, int32_t lane);

/* Free the controllers of the runs that have not ended. */
void loop_free(void *loop);

#ifdef __cplusplus
}
#endif

#endif

/* One instance of the FMU, apart from the FMI version: values, time, messages, saved states. */
#ifndef APNC_INSTANCE_H
#define APNC_INSTANCE_H

#include <stddef.h>
#include <stdint.h>

#include "apnc.h"

#ifdef APNC_SINGLE
#error "FMI variables are of type double"
#endif

#define apnc_log_names           APNC_NAME(log_names)
#define apnc_report              APNC_NAME(report)
#define apnc_refuse              APNC_NAME(refuse)
#define apnc_allowed             APNC_NAME(allowed)
#define apnc_choose_logging      APNC_NAME(choose_logging)
#define apnc_run_clear           APNC_NAME(run_clear)
#define apnc_set_times           APNC_NAME(set_times)
#define apnc_get                 APNC_NAME(get)
#define apnc_set                 APNC_NAME(set)
#define apnc_parameters_in_range APNC_NAME(parameters_in_range)
#define apnc_start               APNC_NAME(start)
#define apnc_step                APNC_NAME(step)
#define apnc_blob_size           APNC_NAME(blob_size)
#define apnc_blob_write          APNC_NAME(blob_write)
#define apnc_blob_read           APNC_NAME(blob_read)

/* The codes of FMI 2.0 and 3.0. */
typedef enum { APNC_OK = 0, APNC_WARNING = 1, APNC_DISCARD = 2, APNC_ERROR = 3 } apnc_status;

/* Log categories, in the order of the model description. */
typedef enum { APNC_LOG_WARNING, APNC_LOG_ERROR, APNC_LOG_EVENTS, APNC_LOG_CATEGORIES } apnc_log;

extern const char *const apnc_log_names[APNC_LOG_CATEGORIES];

/* Life of an instance. */
typedef enum {
    APNC_INSTANTIATED = 1,
    APNC_INITIALIZATION = 2,
    APNC_STEPPING = 4,
    APNC_TERMINATED = 8
} apnc_phase;

/* Phases in which a function may be called. */
#define APNC_ANY      (APNC_INSTANTIATED | APNC_INITIALIZATION | APNC_STEPPING | APNC_TERMINATED)
#define APNC_READABLE (APNC_INITIALIZATION | APNC_STEPPING | APNC_TERMINATED)
#define APNC_WRITABLE (APNC_INSTANTIATED | APNC_INITIALIZATION | APNC_STEPPING)

/* All that a saved state holds: plain data, no pointers. */
typedef struct {
    apnc_data data;
    apnc_state state;
    double start_time;  /* [s] */
    double stop_time;   /* [s] infinite if there is none */
    double time;        /* [s] end of the last step */
    int64_t next_tick;  /* number of the next tick, due at start_time + next_tick Ts */
    int32_t phase;      /* apnc_phase */
    int32_t outdated;   /* outputs do not show the parameters set since */
    int32_t limited_MI; /* the value of MI was last found unusable or out of its range */
    int32_t limited_turn;
} apnc_run;

typedef struct apnc_instance {
    apnc_run run;
    int logging[APNC_LOG_CATEGORIES];
    void (*emit)(struct apnc_instance *, apnc_status, apnc_log, const char *message);
} apnc_instance;

/* Log a message of printf form and return its status. */
apnc_status apnc_report(apnc_instance *instance, apnc_status status, apnc_log category,
                        const char *format, ...)
#if defined(__GNUC__)
    __attribute__((format(printf, 4, 5)))
#endif
    ;

/* Log why a function refuses. */
apnc_status apnc_refuse(apnc_instance *instance, const char *function, const char *why);

/* Whether the instance is in one of the phases; logs if not. NULL is in none. */
int apnc_allowed(apnc_instance *instance, int phases, const char *function);

/* Switch the named categories, or all of them if none is named. */
apnc_status apnc_choose_logging(apnc_instance *instance, const char *function, int on, size_t n,
                                const char *const categories[]);

/* Values as after instantiation. */
void apnc_run_clear(apnc_run *run);

/* Times of the experiment [s]; stop_time counts if stop_defined. */
apnc_status apnc_set_times(apnc_instance *instance, const char *function, double start_time,
                           int stop_defined, double stop_time);

/* Read or write one value; wanted and its C type must be those of the variable. Before
 * initialization only rows with a start value can be read. */
apnc_status apnc_get(apnc_instance *instance, uint32_t value_reference, apnc_type wanted,
                     void *value);
apnc_status apnc_set(apnc_instance *instance, uint32_t value_reference, apnc_type wanted,
                     const void *value);

/* Whether every parameter lies in its range. */
int apnc_parameters_in_range(const apnc_data *data);

/* Check all parameters against their ranges, then start the controller. */
apnc_status apnc_start(apnc_instance *instance);

/* Run every tick with t <= start_time + k Ts < t + h. Times in s. A step beyond the stop time is
 * an error. */
apnc_status apnc_step(apnc_instance *instance, double t, double h);

/* Saved states as bytes. */
size_t apnc_blob_size(void);
void apnc_blob_write(const apnc_run *run, unsigned char *blob);
apnc_status apnc_blob_read(apnc_instance *instance, const unsigned char *blob, size_t size,
                           apnc_run *run);

#endif

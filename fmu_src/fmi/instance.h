/* One instance of an FMU, apart from the FMI version and the model: life, access to values by
 * reference, messages, saved states. */
#ifndef APNC_INSTANCE_H
#define APNC_INSTANCE_H

#include <stddef.h>
#include <stdint.h>

#include "apnc_variable.h"

#ifdef APNC_SINGLE
#error "FMI variables are of type double"
#endif

#define apnc_log_names           APNC_NAME(log_names)
#define apnc_report              APNC_NAME(report)
#define apnc_refuse              APNC_NAME(refuse)
#define apnc_allowed             APNC_NAME(allowed)
#define apnc_choose_logging      APNC_NAME(choose_logging)
#define apnc_instance_room       APNC_NAME(instance_room)
#define apnc_instance_settle     APNC_NAME(instance_settle)
#define apnc_instance_leave      APNC_NAME(instance_leave)
#define apnc_clear               APNC_NAME(clear)
#define apnc_set_times           APNC_NAME(set_times)
#define apnc_scalar_name         APNC_NAME(scalar_name)
#define apnc_shown_as            APNC_NAME(shown_as)
#define apnc_get                 APNC_NAME(get)
#define apnc_set                 APNC_NAME(set)
#define apnc_parameters_in_range APNC_NAME(parameters_in_range)
#define apnc_report_parameters   APNC_NAME(report_parameters)
#define apnc_start               APNC_NAME(start)
#define apnc_step                APNC_NAME(step)
#define apnc_save                APNC_NAME(save)
#define apnc_restore             APNC_NAME(restore)
#define apnc_saved_size          APNC_NAME(saved_size)
#define apnc_run_at              APNC_NAME(run_at)
#define apnc_state_at            APNC_NAME(state_at)
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

/* Part of a tick by which the last step may end after the stop time, as a rounded one does. */
#define APNC_STOP_TOLERANCE 0.5
/* Part of a tick by which a step may start away from the end of the one before. */
#define APNC_GAP_TOLERANCE 0.5
/* Longer steps are taken for a mistake [ticks]. */
#define APNC_MAX_TICKS_PER_STEP 10000000.0

/* What every model has in a saved state. */
typedef struct {
    double start_time; /* [s] */
    double stop_time;  /* [s] infinite if there is none */
    double time;       /* [s] end of the last step */
    int32_t phase;     /* apnc_phase */
    int32_t outdated;  /* outputs do not show the last step, or the parameters set since */
    int32_t tuned;     /* parameters were set since the last step */
    int32_t unused;
} apnc_run;

/* A saved state is one block of plain data without pointers: the values of all variables, the run,
 * the model's state, each at a multiple of 64 bytes. */
typedef struct apnc_instance {
    void *values;  /* of all variables; begin of the block */
    apnc_run *run; /* in the block */
    void *state;   /* of the model, in the block */
    void *own;     /* what the model has allocated beside the block; NULL at first */
    int logging[APNC_LOG_CATEGORIES];
    void (*emit)(struct apnc_instance *, apnc_status, apnc_log, const char *message);
    void *(*allocate)(struct apnc_instance *, size_t size);
    void (*release)(struct apnc_instance *, void *memory);
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

/* Bytes that an instance needs behind its own struct for its block. */
size_t apnc_instance_room(void);

/* Put the block of an instance at `room`, with values as after instantiation. */
void apnc_instance_settle(apnc_instance *instance, void *room);

/* Give back what the model has allocated. */
void apnc_instance_leave(apnc_instance *instance);

/* Values as after instantiation. */
void apnc_clear(apnc_instance *instance);

/* Times of the experiment [s]; stop_time counts if stop_defined. */
apnc_status apnc_set_times(apnc_instance *instance, const char *function, double start_time,
                           int stop_defined, double stop_time);

/* "leg[2].grf" */
typedef struct {
    char text[64];
} apnc_name;

apnc_name apnc_scalar_name(const apnc_variable *variable, int element);

/* Whether the model description shows a variable as this type. In a build with APNC_REALS every
 * variable is a Real, for tools that read all of them so. */
int apnc_shown_as(const apnc_variable *variable, apnc_type type);

/* Read or write one value; wanted and its C type must be those of the variable. Before
 * initialization only variables with a start value can be read. */
apnc_status apnc_get(apnc_instance *instance, uint32_t value_reference, apnc_type wanted,
                     void *value);
apnc_status apnc_set(apnc_instance *instance, uint32_t value_reference, apnc_type wanted,
                     const void *value);

/* Whether every parameter lies in its range; the second logs each that does not. */
int apnc_parameters_in_range(const void *values);
apnc_status apnc_report_parameters(apnc_instance *instance);

/* Check all parameters against their ranges, then start the model. */
apnc_status apnc_start(apnc_instance *instance);

/* Step from t by h. Times in s. A step that does not begin where the last one ended, or ends
 * beyond the stop time, is an error. */
apnc_status apnc_step(apnc_instance *instance, double t, double h);

/* Bytes of a block, and where run and state lie in it; the values come first. */
size_t apnc_saved_size(void);
size_t apnc_run_at(void);
size_t apnc_state_at(void);

/* Saved states: a copy of the block, and the same as bytes behind a header. A blob is read into
 * `saved`, of apnc_saved_size() bytes. What cannot be restored leaves a fresh instance. */
void apnc_save(const apnc_instance *instance, void *saved);
apnc_status apnc_restore(apnc_instance *instance, const void *saved);
size_t apnc_blob_size(void);
void apnc_blob_write(const void *saved, unsigned char *blob);
apnc_status apnc_blob_read(apnc_instance *instance, const unsigned char *blob, size_t size,
                           void *saved);

#endif

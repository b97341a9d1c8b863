/* Layout of the bytes of a plant, the same for all kinds of lanes: a header, then arrays of
 * numbers.
 *
 * The structs of robot.h hold numbers only. A struct of wide numbers is therefore `width` times as
 * large as one of single numbers, and number i of lane k is at index i * width + k. */
#ifndef PLANT_LAYOUT_H
#define PLANT_LAYOUT_H

#include "plant.h"
#include "robot.h"

enum { PLANT_MOST_LANES = 8, PLANT_ALIGNMENT = 64, PLANT_MOST_ENTRIES = 1 << 16 };

typedef struct {
    int32_t kind, level;
    int32_t legs, contacts, history; /* see plant_size */
    int32_t width;                   /* numbers side by side in V */
    int32_t robots;                  /* numbers side by side in B */
    int32_t groups;                  /* of legs, see robot.h */
    int32_t any_axes;                /* see plant_parts */
    int32_t coming_first;            /* entry of the oldest command that waits */
    int32_t coming_count;            /* number of commands that wait */
    int32_t loads_last;              /* entry of the newest reading */
    int32_t loads_count;             /* readings kept */
    double latency;                  /* [s] of commands */
    double delay;                    /* [s] of readings */
    size_t robot, leg, trunk, state, kept, coming, loads, found, waits, spans, scratch;
    size_t end;                          /* [bytes] from the start */
    int32_t fares[PLANT_MOST_LANES];     /* PLANT_WALKS ... */
    uint64_t seed[PLANT_MOST_LANES];     /* seed of the sensors' noise */
    uint64_t readings[PLANT_MOST_LANES]; /* readings since the start */
} plant_header;

/* Count of numbers in a struct of single numbers. */
#define NUMBERS_OF(type) (sizeof(type) / sizeof(double) / (size_t)(PLANT_WIDTH))

/* The parts of the plant at `memory`. */
INL plant_parts parts_of(void *memory) {
    const plant_header *h = (const plant_header *)memory;
    char *m = (char *)memory;
    plant_parts p;
    p.robot = (robot_numbers *)(m + h->robot);
    p.leg = (leg_numbers *)(m + h->leg);
    p.trunk = (trunk_state *)(m + h->trunk);
    p.state = (leg_state *)(m + h->state);
    p.kept = (leg_kept *)(m + h->kept);
    p.coming = (V *)(m + h->coming);
    p.loads = (V *)(m + h->loads);
    p.found = (double *)(m + h->found);
    p.legs = h->legs;
    p.groups = h->groups;
    p.contacts = h->contacts;
    p.any_axes = h->any_axes;
    p.lanes = h->robots;
    return p;
}

/* The functions that every way to compute a plant has; NULL if this build lacks it. */
typedef struct {
    int32_t width, robots;
    void (*advance)(void *plant, const plant_ground *const *grounds, double duration, double step);
} plant_kernel;

extern const plant_kernel plant_kernel_scalar;
extern const plant_kernel plant_kernel_legs;
extern const plant_kernel plant_kernel_robots;
extern const plant_kernel plant_kernel_legs_avx2;
extern const plant_kernel plant_kernel_robots_avx2;
extern const plant_kernel plant_kernel_robots_avx512;

#endif

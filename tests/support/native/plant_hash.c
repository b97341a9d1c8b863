/* Walks robots on every ground in every kind of plant that this machine has.
 *
 * plant_hash TICKS: prints a number that depends on every bit of every sample, as the plain program
 * computes it; ends with 1 and names the lane if another kind differs from it. */
#include <stdio.h>

#include "plant_case.h"

enum { LANES = 8, ROOM = 1 << 22 };

static int ticks;
static const double latency = 0.02, delay = 0.03, Ts = 1.0 / 60.0;
static _Alignas(64) unsigned char memory[ROOM];
static plant_robot robot[LANES];
static plant_leg leg[LANES][CASE_LEGS];
static case_ground ground[LANES];
static uint64_t hash_of_scalar[LANES];

/* Put a robot on a ground as a caller does. found: room for 4 numbers per contact. */
static void case_place(void *plant, int32_t lane, const plant_robot *robot,
                       const plant_ground *ground, uint64_t seed, double Ts) {
    static double found[4 * 1024];
    double start[6 + 3 * CASE_LEGS];
    const double angles[3] = {0.0, 0.0, 0.0};
    plant_start(robot, ground, angles, 0.001, found, start);
    plant_place(plant, lane, robot, ground, seed, start, 0.0, Ts);
}

static void mix(uint64_t *hash, const double *numbers, int count) {
    for (int i = 0; i < count; i++) {
        uint64_t bits;
        const double number = numbers[i] == numbers[i] ? numbers[i] : NAN;
        memcpy(&bits, &number, sizeof bits);
        if (number != number) bits = 1; /* one of many */
        *hash = (*hash ^ bits) * UINT64_C(0x100000001b3);
        *hash ^= *hash >> 29;
    }
}

/* Robots first ... first + lanes - 1 side by side; the hash of each. */
static void walk(int32_t kind, int32_t level, int32_t legs, int first, uint64_t *hash) {
    const int32_t lanes = plant_lanes(kind, level);
    const int32_t history = plant_history(latency, delay, Ts);
    int32_t contacts = 0;
    for (int i = 0; i < LANES; i++)
        if (ground[i].ground.kind != PLANT_PLANE && ground[i].ground.contacts > contacts)
            contacts = ground[i].ground.contacts;
    if (plant_size(kind, level, legs, contacts, history) > ROOM) abort();
    plant_create(memory, kind, level, legs, contacts, history);
    const plant_ground *below[LANES];
    for (int32_t lane = 0; lane < lanes; lane++) {
        const int i = first + lane;
        below[lane] = &ground[i].ground;
        case_place(memory, lane, &robot[i], below[lane], (uint64_t)i, Ts);
        hash[lane] = UINT64_C(0xcbf29ce484222325);
    }
    for (int tick = 0; tick < ticks; tick++) {
        double hip[CASE_LEGS], knee[CASE_LEGS], sample[9 + 19 * CASE_LEGS];
        for (int32_t lane = 0; lane < lanes; lane++) {
            case_trot(legs, tick + 7 * (first + lane), 0.15, hip, knee);
            plant_command(memory, lane, hip, knee);
        }
        plant_advance(memory, below, Ts, Ts / 16.0);
        for (int32_t lane = 0; lane < lanes; lane++) {
            plant_sample(memory, lane, sample);
            mix(&hash[lane], sample, plant_sample_size(legs));
        }
    }
}

/* Whether all kinds agree on the robots of this round. */
static int agree(int32_t legs) {
    int same = 1;
    for (int i = 0; i < LANES; i++) walk(PLANT_SCALAR, PLANT_BASELINE, legs, i, &hash_of_scalar[i]);
    for (int32_t kind = PLANT_LEGS; kind <= PLANT_ROBOTS; kind++)
        for (int32_t level = 0; level <= plant_best_level(); level++) {
            const int32_t lanes = plant_lanes(kind, level);
            for (int first = 0; first + lanes <= LANES; first += lanes) {
                uint64_t hash[LANES];
                walk(kind, level, legs, first, hash);
                for (int32_t lane = 0; lane < lanes; lane++)
                    if (hash[lane] != hash_of_scalar[first + lane]) {
                        printf("legs %d kind %d level %s lane %d differs\n", (int)legs, (int)kind,
                               plant_level_name(level), (int)lane);
                        same = 0;
                    }
            }
        }
    return same;
}

int main(int argc, char **argv) {
    static const int32_t numbers[] = {2, 3, 4, 7, 17};
    uint64_t all = 0;
    ticks = argc > 1 ? atoi(argv[1]) : 0;
    int same = 1;
    for (size_t k = 0; k < sizeof numbers / sizeof *numbers; k++) {
        for (int uneven = 0; uneven < 2; uneven++) {
            for (int i = 0; i < LANES; i++) {
                case_robot(&robot[i], leg[i], numbers[k], latency, delay);
                case_ground_of(&ground[i], uneven ? i % 4 : PLANT_PLANE);
            }
            same &= agree(numbers[k]);
            for (int i = 0; i < LANES; i++) {
                const double bits[2] = {(double)(hash_of_scalar[i] >> 32),
                                        (double)(hash_of_scalar[i] & 0xffffffffu)};
                mix(&all, bits, 2);
            }
        }
    }
    printf("%016llx\n", (unsigned long long)all);
    return !same;
}

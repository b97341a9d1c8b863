/* Load cells without a robot, for other engines: a plant of one robot whose loads are given. */
#define PLANT_WIDTH 1
#include "numbers.h"
#include "plant.h"
#include "sensor.h"

size_t plant_sensor_size(int32_t legs, int32_t history) {
    return plant_size(PLANT_SCALAR, PLANT_BASELINE, legs, 0, history);
}

void plant_sensor_start(void *memory, int32_t legs, int32_t history, const plant_sensor *sensor,
                        double weight, uint64_t seed) {
    plant_create(memory, PLANT_SCALAR, PLANT_BASELINE, legs, 0, history);
    plant_header *h = (plant_header *)memory;
    const plant_parts p = parts_of(memory);
    p.robot->half_weight = weight / 2.0;
    set_sensor(p.robot, sensor);
    h->delay = sensor->delay;
    h->loads_count = 1;
    h->seed[0] = seed;
    for (int32_t leg = 0; leg < legs; leg++) p.state[leg].stuck = NAN;
}

void plant_sensor_disturb(void *memory, const plant_conditions *conditions) {
    plant_set_conditions(memory, 0, conditions);
}

void plant_sensor_read(void *memory, double duration, const double *load, double *grf) {
    plant_header *h = (plant_header *)memory;
    const plant_parts p = parts_of(memory);
    V felt[64];
    for (int32_t leg = 0; leg < p.legs; leg++) felt[leg] = load[leg];
    read_sensors(h, &p, (double *)((char *)memory + h->spans), felt, duration);
    plant_loads(memory, 0, grf);
}

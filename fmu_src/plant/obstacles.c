/* A field of obstacles: caps of balls on a plane, and a grid to find the balls near a foot.
 *
 * A square tile is repeated without end and divided into cells. A cell lists the balls that a foot
 * over it can touch, so that a contact examines only a few balls. */
#include <math.h>
#include <string.h>

#include "plant.h"

/* One ball: position of its centre and radius [m]. */
static void ball_of(const plant_field *field, int64_t index, double *ball) {
    double place[3];
    plant_obstacle(field->seed, index, field->tile, field->smallest, field->largest, place);
    ball[0] = place[0];
    ball[1] = place[1];
    ball[2] = field->height - place[2];
    ball[3] = place[2];
}

/* Range of cells, along one axis, over which a foot can touch a ball. */
typedef struct {
    int64_t first, last;
} cell_range;

static cell_range cells_about(const plant_field *field, double place, double reach) {
    const double size = field->tile / (double)field->cells;
    return (cell_range){(int64_t)floor((place - reach) / size),
                        (int64_t)floor((place + reach) / size)};
}

/* Largest distance from the axis of a ball at which a foot touches it [m]. The foot is sunk into
 * the plane by `sink_in`. */
static double reach_of(const plant_field *field, const double *ball) {
    const double near = ball[3] + field->foot_radius;
    const double low = field->foot_radius - field->sink_in - ball[2];
    return sqrt(near * near - low * low);
}

static int64_t wrapped(int64_t cell, int64_t cells) { return (cell % cells + cells) % cells; }

int64_t plant_field_reals(const plant_field *field) { return 2 + 4 * field->balls; }

int64_t plant_field_integers(const plant_field *field) {
    int64_t members = 0;
    for (int64_t i = 0; i < field->balls; i++) {
        double ball[4];
        ball_of(field, i, ball);
        const double reach = reach_of(field, ball);
        const cell_range x = cells_about(field, ball[0], reach);
        const cell_range y = cells_about(field, ball[1], reach);
        members += (x.last - x.first + 1) * (y.last - y.first + 1);
    }
    return field->cells * field->cells + 1 + members;
}

/* Visit every cell of every ball. Without `members` the balls per cell are counted in `next`; else
 * each ball is written to `members` at index `next` of its cell. */
static void visit(const plant_field *field, const double *balls, int64_t *next, int64_t *members) {
    for (int64_t i = 0; i < field->balls; i++) {
        const double reach = reach_of(field, balls + 4 * i);
        const cell_range x = cells_about(field, balls[4 * i], reach);
        const cell_range y = cells_about(field, balls[4 * i + 1], reach);
        for (int64_t row = y.first; row <= y.last; row++)
            for (int64_t column = x.first; column <= x.last; column++) {
                const int64_t cell =
                    wrapped(row, field->cells) * field->cells + wrapped(column, field->cells);
                if (members) members[next[cell]] = i;
                next[cell]++;
            }
    }
}

int32_t plant_field_fill(const plant_field *field, double *reals, int64_t *integers) {
    const int64_t cells = field->cells * field->cells;
    int64_t *members = integers + cells + 1, most = 0, begin = 0;
    reals[0] = field->tile;
    reals[1] = (double)field->cells;
    for (int64_t i = 0; i < field->balls; i++) ball_of(field, i, reals + 2 + 4 * i);
    memset(integers, 0, (size_t)(cells + 1) * sizeof *integers);
    visit(field, reals + 2, integers, NULL);
    for (int64_t cell = 0; cell < cells; cell++) {
        const int64_t count = integers[cell];
        if (count > most) most = count;
        integers[cell] = begin;
        begin += count;
    }
    visit(field, reals + 2, integers, members);
    /* every cell now points to the end of its list, where that of the next cell begins */
    for (int64_t cell = cells; cell > 0; cell--) integers[cell] = integers[cell - 1];
    integers[0] = 0;
    return 1 + (int32_t)most;
}

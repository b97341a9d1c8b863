/* The integration step of a robot: the longest stable and allowed one, and the one that it gets. */
#define PLANT_WIDTH 1
#include "step.h"

/* Room for a robot in its reference pose. */
typedef struct {
    robot_numbers robot;
    trunk_state trunk;
    leg_numbers leg[PLANT_MOST_LEGS];
    leg_state state[PLANT_MOST_LEGS];
    leg_kept kept[PLANT_MOST_LEGS];
} step_room;

static plant_parts posed(step_room *room, const plant_robot *robot) {
    static const plant_ground level = {PLANT_PLANE, 1, 0.0, 0.0, NULL, NULL, NULL};
    plant_parts p;
    memset(&p, 0, sizeof p);
    memset(&room->trunk, 0, sizeof room->trunk);
    memset(room->state, 0, sizeof room->state);
    set_robot(&room->robot, robot, &level);
    for (int32_t leg = 0; leg < robot->legs; leg++) set_leg(&room->leg[leg], robot, leg);
    p.robot = &room->robot;
    p.leg = room->leg;
    p.trunk = &room->trunk;
    p.state = room->state;
    p.kept = room->kept;
    p.legs = p.groups = robot->legs;
    p.lanes = 1;
    p.any_axes = has_any_axes(robot);
    return p;
}

double plant_stable_step(const plant_robot *robot) {
    step_room room;
    const plant_parts p = posed(&room, robot);
    return step_of_springs(&p);
}

double plant_longest_step(const plant_robot *robot) {
    step_room room;
    const plant_parts p = posed(&room, robot);
    return s_min(step_of_springs(&p), STEP_MARGIN * step_of_friction(&p));
}

double plant_own_step(const plant_robot *robot) {
    const double parts = ceil(STEP_MARGIN / (STEP_PARTS * plant_longest_step(robot)));
    return s_min(1.0 / (STEP_PARTS * parts), STEP_USUAL);
}

/* All forces on a robot but gravity, for engines that integrate a tree of bodies themselves but do
 * not have these servos and this contact. The laws are those of the plant, on the engine's
 * coordinates. */
#define PLANT_WIDTH 1
#include "fall.h"
#include "numbers.h"
#include "plant.h"

/* State of a trunk from six coordinates and six speeds of a tree. */
static trunk_state trunk_at(const double *q, const double *v) {
    trunk_state s;
    memset(&s, 0, sizeof s);
    s.x = (b3){q[0], q[1], q[2]};
    s.yaw = q[3];
    s.pitch = q[4];
    s.roll = q[5];
    if (!v) return s;
    s.xd = (b3){v[0], v[1], v[2]};
    s.yawd = v[3];
    s.pitchd = v[4];
    s.rolld = v[5];
    return s;
}

/* Parts of a plant of one robot, with room for the contact points of a foot. */
static plant_parts parts_with(robot_numbers *robot, trunk_state *trunk, const plant_ground *ground,
                              double *found) {
    plant_parts p;
    memset(&p, 0, sizeof p);
    p.robot = robot;
    p.trunk = trunk;
    p.contacts = ground->kind == PLANT_PLANE ? 0 : ground->contacts;
    p.found = found;
    p.lanes = 1;
    return p;
}

static void suspend(const plant_suspension *by, const double *held, const double *q,
                    const double *v, double *out) {
    for (int i = 0; i < 3; i++) {
        out[i] += by->stiffness * (held[i] - q[i]) - by->damping * v[i];
        out[3 + i] +=
            by->angular_stiffness * (held[3 + i] - q[3 + i]) - by->angular_damping * v[3 + i];
    }
}

/* Add the action of the ground on a foot to the generalized forces of trunk and joints. The wrench
 * on the tibia is moved to the axis of every joint in turn. */
static void add_generalized(int any, const leg_numbers *n, const leg_motion *m,
                            const trunk_motion *t, const push *ground, double *base,
                            double *joint) {
    const wrench at_knee = {ground->moment, ground->force};
    const wrench at_hip = moved(at_knee, m->femur);
    const wrench at_abduction = moved(at_hip, any ? m->hip : n->hip);
    const v3 force = about_x(m->c1, m->s1, at_abduction.f);
    const v3 moment = v_add(about_x(m->c1, m->s1, at_abduction.n), v_cross(n->mount, force));
    const v3 world = v_turn(&t->turn, force);
    joint[0] += any ? v_dot(m->axis[0], at_abduction.n) : at_abduction.n.x;
    joint[1] += any ? v_dot(m->axis[1], at_hip.n) : at_hip.n.y;
    joint[2] += any ? v_dot(m->axis[2], at_knee.n) : at_knee.n.y;
    base[0] += world.x;
    base[1] += world.y;
    base[2] += world.z;
    base[3] += v_dot(wide3(t->turn.z), moment);
    base[4] += t->cr * moment.y - t->sr * moment.z;
    base[5] += moment.x;
}

static void write_vector(double *at, v3 a) {
    at[0] = a.x;
    at[1] = a.y;
    at[2] = a.z;
}

void plant_forces(const plant_robot *robot, const plant_ground *ground, const double *q,
                  const double *v, const double *target, const double *held, double stopping,
                  double dt, double *work, double *out) {
    const int32_t legs = robot->legs, joints = 3 * legs, size = 6 + joints;
    double *torque = out + size, *foot = torque + joints, *force = foot + joints;
    double *load = force + joints, *found = load + legs;
    robot_numbers numbers;
    set_robot(&numbers, robot, ground);
    trunk_state trunk = trunk_at(q, v);
    const plant_parts p = parts_with(&numbers, &trunk, ground, found);
    const trunk_motion t = trunk_moves(&p);
    memset(out, 0, sizeof *out * (size_t)(found - out));
    if (held) suspend(&robot->suspension, held, q, v, out);
    for (int32_t k = 0; k < legs; k++) {
        leg_numbers leg;
        set_leg(&leg, robot, k);
        for (int32_t j = 0; j < 3; j++) {
            const int32_t i = 3 * k + j;
            const joint_numbers *joint = &leg.joint[j];
            torque[i] = servo_torque(&joint->servo, target[i] - q[6 + i], v[6 + i]);
            work[i] += s_abs(torque[i] * v[6 + i]) * dt;
            out[6 + i] += torque[i];
            if (numbers.passive > 0.0)
                out[6 + i] += passive_torque(&joint->passive, q[6 + i], v[6 + i]);
        }
        const int any = robot->leg[k].kind != PLANT_ABDUCTION;
        const leg_motion m =
            leg_moves(any, &leg, q + 6 + 3 * k, v + 6 + 3 * k, wide3(t.w), wide3(t.v));
        const push pushed = push_of_ground(&p, &ground, &t, &leg, &m, 0, stopping);
        add_generalized(any, &leg, &m, &t, &pushed, out, out + 6 + 3 * k);
        write_vector(foot + 3 * k, v_add(wide3(trunk.x), v_turn(&t.turn, m.foot)));
        write_vector(force + 3 * k, v_turn(&t.turn, about_x(m.c1, m.s1, pushed.force)));
        load[k] = pushed.load;
    }
}

int32_t plant_fallen(const plant_robot *robot, const plant_ground *ground, const double *q,
                     double *found) {
    robot_numbers numbers;
    set_robot(&numbers, robot, ground);
    trunk_state trunk = trunk_at(q, NULL);
    const plant_parts p = parts_with(&numbers, &trunk, ground, found);
    const trunk_motion t = trunk_moves(&p);
    return fallen(&p, ground, &t, 0);
}

void plant_leg_points(const plant_leg *leg, double abduction, double hip, double knee,
                      double *points) {
    const V still[3] = {0.0, 0.0, 0.0};
    const v3 zero = {0.0, 0.0, 0.0};
    leg_numbers n;
    set_geometry(&n, leg);
    const double angles[3] = {abduction, hip, knee};
    V q[3];
    for (int j = 0; j < 3; j++) q[j] = n.sign[j] * angles[(int)n.angle[j]];
    const int any = leg->kind != PLANT_ABDUCTION;
    const leg_motion m = leg_moves(any, &n, q, still, zero, zero);
    const v3 pivot = v_add(n.mount, any ? m.hip : about_x(m.c1, m.s1, n.hip));
    write_vector(points, pivot);
    write_vector(points + 3, v_add(pivot, about_x(m.c1, m.s1, m.femur)));
    write_vector(points + 6, m.foot);
}

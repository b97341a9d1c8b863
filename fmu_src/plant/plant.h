/* A legged robot on the ground in plain C: what a program needs to build, command and read it.
 *
 * A plant holds one robot, or several side by side (lanes). All lanes have the same number of legs
 * and are advanced together; a lane has the very bits that its robot has alone. The caller gives
 * the memory; nothing is allocated. A plant has no pointers to itself: its bytes can be copied,
 * stored and put back, on the same build.
 *
 * Frames: world (x forward at the start, y left, z up), trunk (in its reference point), ground (the
 * world's, turned about y by the slope). Legs are ordered as the controller has them, right side
 * first. Joint angles are zero in the reference pose; positive hip and knee angles swing the leg
 * forward and lift the foot, a positive abduction moves the foot to the left.
 *
 * Python reads this header as it is (cffi): plain declarations, no macros in them.
 */
#ifndef PLANT_H
#define PLANT_H

#include <stddef.h>
#include <stdint.h>

#include "plant_names.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A rigid body in the frame of its link. */
typedef struct {
    double mass;       /* [kg] */
    double com[3];     /* [m] centre of mass */
    double inertia[6]; /* [kg m^2] about it: xx, yy, zz, xy, xz, yz */
} plant_body;

/* A leg: abduction about x, hip and knee about y. All vectors in axes parallel to the trunk's. */
typedef struct {
    double mount[3];    /* [m] abduction joint in the trunk */
    double hip[3];      /* [m] from the abduction axis to the hip axis */
    double femur;       /* [m] hip axis to knee axis */
    double tibia;       /* [m] knee axis to centre of the foot */
    double femur_angle; /* [rad] reference pose, back of vertical */
    double tibia_angle; /* [rad] reference pose, forward of the femur */
    plant_body link[3]; /* hip, femur, tibia; frames at their joints */
} plant_leg;

/* A geared position servo, the same in every joint. */
typedef struct {
    double stiffness;         /* [N m/rad] torque per position error */
    double damping;           /* [N m s/rad] torque per joint speed */
    double stall_torque;      /* [N m] largest torque */
    double no_load_speed;     /* [rad/s] at which no driving torque is left */
    double reflected_inertia; /* [kg m^2] rotor inertia times the gear ratio squared */
    double latency;           /* [s] age of a command when the servo starts to follow it */
    double slew_rate;         /* [rad/s] fastest change of the command; 0: no limit */
} plant_servo;

/* Rubber ball against hard ground, the same at every foot. */
typedef struct {
    double foot_radius;    /* [m] */
    double stiffness;      /* [N/m] normal force per depth */
    double damping;        /* [N s/m] normal force per speed of approach, from damping_depth on */
    double damping_depth;  /* [m] depth over which the damping sets in */
    double friction;       /* [1] Coulomb coefficient */
    double friction_speed; /* [m/s] sliding speed below which friction is proportional to it */
} plant_contact;

/* A load cell in every foot. */
typedef struct {
    double delay;         /* [s] age of a load when it arrives */
    double time_constant; /* [s] of the first-order low-pass; 0: none */
    double noise;         /* [1] standard deviation over half the weight */
    int32_t norm;         /* 1: length of the whole force; 0: its part along the normal */
} plant_sensor;

/* Suspension of a held trunk: springs and dampers on its six coordinates. */
typedef struct {
    double stiffness;         /* [N/m] */
    double damping;           /* [N s/m] */
    double angular_stiffness; /* [N m/rad] */
    double angular_damping;   /* [N m s/rad] */
} plant_suspension;

/* A robot as numbers. */
typedef struct {
    int32_t legs;                /* 2 to 64 */
    double gravity;              /* [m/s^2] downward */
    double weight;               /* [N] without payload: scale of the sensors' noise */
    plant_body trunk;            /* with the payload and the seeded error of its centre of mass */
    double trunk_center[3];      /* [m] middle of the box that must not touch the ground */
    double trunk_size[3];        /* [m] edges of that box */
    plant_servo servo;           /* */
    plant_contact contact;       /* */
    plant_sensor sensor;         /* */
    plant_suspension suspension; /* */
    const plant_leg *leg;        /* one per leg */
} plant_robot;

/* Where a ball touches a ground, in the frame of the ground.
 *
 * x, y, z: centre of the ball [m]; radius: of the ball [m], 0 for a point; reals, integers: numbers
 * of the ground; found: normal (x, y, z, pointing out of the ground) and depth [m], above 0, of
 * every place, one after the other. Returns the number of places: 0 where z >= radius + top. */
typedef int32_t (*plant_touch)(double x, double y, double z, double radius, const double *reals,
                               const int64_t *integers, double *found);

/* Kinds of grounds. */
enum {
    PLANT_PLANE = 0,     /* no numbers */
    PLANT_OBSTACLES = 1, /* reals: tile, cells along its edge, then x, y, z, radius of each ball;
                            integers: where each cell begins in a list of balls, and that list */
    PLANT_KERB = 2,      /* reals: begin, end, height [m] */
    PLANT_WAVES = 3,     /* reals: half the amplitude [m], wavenumber [rad/m] */
    PLANT_OWN = 4        /* the caller's touch function */
};

/* A ground. It must outlive the plants that stand on it. */
typedef struct {
    int32_t kind;            /* PLANT_PLANE ... PLANT_OWN */
    int32_t contacts;        /* most places at which a ball touches at a time */
    double slope;            /* [rad] by which it rises along x */
    double top;              /* [m] height over its plane that no point of it exceeds */
    const double *reals;     /* of its kind */
    const int64_t *integers; /* of its kind */
    plant_touch touch;       /* of PLANT_OWN; else not looked at */
} plant_ground;

/* What is wrong with a robot. */
typedef struct {
    double grf_noise; /* [1] standard deviation over half the weight, on top of the sensors' */
    int32_t held;     /* 1: the trunk is held level */
    double held_at;   /* [m] height above its start at which it is held */
    const uint8_t *damaged; /* per leg, 1: hip and knee are held at 0; NULL: none */
    const double *stuck; /* [N] per leg, what its sensor delivers; not a number: it works; NULL */
} plant_conditions;

/* How the lanes of a plant are computed; the bits are those of PLANT_SCALAR. */
enum {
    PLANT_SCALAR = 0, /* one robot, plain C */
    PLANT_LEGS = 1,   /* one robot, its legs side by side */
    PLANT_ROBOTS = 2  /* several robots side by side */
};

/* Instruction sets, from the least on. */
enum { PLANT_BASELINE = 0, PLANT_AVX2 = 1, PLANT_AVX512 = 2 };

/* How a lane fares. */
enum { PLANT_WALKS = 0, PLANT_FELL = 1, PLANT_DIVERGED = 2 };

/* What is drawn by chance; every purpose has numbers of its own. */
enum { PLANT_RANDOM_BODY = 1, PLANT_RANDOM_SENSOR = 2, PLANT_RANDOM_GROUND = 3 };

/* Best instruction set of this machine that this library was built for. */
int32_t plant_best_level(void);

/* Name of an instruction set: "baseline", "avx2", "avx512". */
const char *plant_level_name(int32_t level);

/* Robots side by side for a kind at a level: 1 for PLANT_SCALAR and PLANT_LEGS. */
int32_t plant_lanes(int32_t kind, int32_t level);

/* Bytes of a plant, or 0 if there is none such.
 *
 * kind, level: as above; legs: 2 to 64; contacts: the most of any ground that it will stand on, or
 * 0 if all of them are planes, which is faster; history: the most commands and readings that are
 * under way, see plant_history. */
size_t plant_size(int32_t kind, int32_t level, int32_t legs, int32_t contacts, int32_t history);

/* Entries that latency and delay need if no tick is shorter than Ts [s]; 65536 at most. */
int32_t plant_history(double latency, double delay, double Ts);

/* Make the bytes at `memory` (aligned to 64) a plant without robots. The arguments are those that
 * plant_size was asked with. */
void plant_create(void *memory, int32_t kind, int32_t level, int32_t legs, int32_t contacts,
                  int32_t history);

/* Go on with the instructions of another level, where they lay out a plant alike: PLANT_SCALAR and
 * PLANT_LEGS always do. */
void plant_use_level(void *plant, int32_t level);

/* Whether bytes that were stored, and may have been changed since, are a plant that plant_create
 * made with these arguments: such a plant can be advanced, whatever its numbers are. */
int32_t plant_intact(const void *memory, int32_t kind, int32_t level, int32_t legs,
                     int32_t contacts, int32_t history);

/* Put a robot into a lane, at rest at its start.
 *
 * coordinates: x, y, z [m], yaw, pitch, roll [rad] of the trunk, then abduction, hip and knee of
 * every leg as joint angles [rad], 6 + 3 legs numbers. height: [m] by which the trunk starts above
 * that, as one that is held there does. Ts: length of the ticks to come [s]: before the start the
 * servos were told the start pose once a tick. The robots of a plant have one latency and one delay
 * of the sensors: those of the robot that was placed last hold for all. */
void plant_place(void *plant, int32_t lane, const plant_robot *robot, const plant_ground *ground,
                 uint64_t seed, const double *coordinates, double height, double Ts);

/* Change gains, contact and sensor of a lane; geometry and masses stay. */
void plant_tune(void *plant, int32_t lane, const plant_servo *servo, const plant_contact *contact,
                const plant_sensor *sensor);

/* From now on these conditions hold. */
void plant_set_conditions(void *plant, int32_t lane, const plant_conditions *conditions);

/* Command the servos from now on: hip and knee angle of every leg [rad], legs numbers each. */
void plant_command(void *plant, int32_t lane, const double *hip, const double *knee);

/* Integrate one tick, in equal steps of at most `step`, then let the sensors read. Times in s.
 * grounds: that of every lane. */
void plant_advance(void *plant, const plant_ground *const *grounds, double duration, double step);

/* How a lane fares after the last tick: PLANT_WALKS, PLANT_FELL, PLANT_DIVERGED. */
int32_t plant_state_of(const void *plant, int32_t lane);

/* Numbers of a sample: 9 + 19 legs. */
int32_t plant_sample_size(int32_t legs);

/* One sample of a lane: position (3) [m], roll, pitch, yaw [rad], velocity (3) [m/s]; then for
 * every leg in turn joint angles (3) [rad]; so their speeds [rad/s], torques [N m], works [J]; so
 * place of the foot (3) [m] and force of the ground on it (3) [N], world frame; so its load as the
 * sensor delivers it [N]. */
void plant_sample(const void *plant, int32_t lane, double *sample);

/* Loads of a lane as the sensors deliver them [N], legs numbers. */
void plant_loads(const void *plant, int32_t lane, double *grf);

/* Accelerations (6 + 3 legs) of the coordinates at the end of the last step, for tests. */
void plant_accelerations(const void *plant, int32_t lane, double *accelerations);

/* Least apparent mass of any foot along the ground at the start [kg]. */
double plant_foot_mass(const void *plant, int32_t lane);

/* What acts on a robot besides gravity, for other engines: the same laws on coordinates of theirs.
 *
 * q, v: coordinates and speeds of a tree: x, y, z, yaw, pitch, roll, then abduction, hip and knee
 * of every leg, of which hip and knee turn about +y (so minus the joint angle); target: commanded
 * tree coordinates of the joints, 3 legs numbers; held: six coordinates the trunk is held at, or
 * NULL; stopping: length of the step over foot mass [s/kg]; work: [J] per joint, grows by
 * |torque speed| dt; out: generalized forces (6 + 3 legs), then torques in tree coordinates, feet
 * and forces on them in the world frame (3 legs each), sums of the normal forces (legs), and room
 * for the places of contact of a foot (4 for each of the ground's `contacts`). */
void plant_forces(const plant_robot *robot, const plant_ground *ground, const double *q,
                  const double *v, const double *target, const double *held, double stopping,
                  double dt, double *work, double *out);

/* Whether a trunk at these six coordinates has tipped by more than 60 degrees from the normal of
 * the ground, or touches it with a corner. found: room for the places of contact, as plant_touch.
 */
int32_t plant_fallen(const plant_robot *robot, const plant_ground *ground, const double *q,
                     double *found);

/* Hip pivot, knee pivot and foot of a leg in the trunk frame [m], 9 numbers. */
void plant_leg_points(const plant_leg *leg, double abduction, double hip, double knee,
                      double *points);

/* Torque of a servo [N m]; error [rad], speed [rad/s]. */
double plant_servo_torque(const plant_servo *servo, double error, double speed);

/* Force of the ground on a foot (3) and its normal part [N].
 *
 * normal: of the ground; depth: [m], above 0; velocity: of the foot at the place of contact [m/s];
 * stopping: as above. */
double plant_contact_force(const plant_contact *contact, const double *normal, double depth,
                           const double *velocity, double stopping, double *force);

/* Where a ball touches a ground; as plant_touch. */
int32_t plant_touches(const plant_ground *ground, double x, double y, double z, double radius,
                      double *found);

/* Load cells alone, for other engines: legs readings of a robot; as plant_advance lets them read.
 * memory: of plant_sensor_size bytes. */
size_t plant_sensor_size(int32_t legs, int32_t history);
void plant_sensor_start(void *memory, int32_t legs, int32_t history, const plant_sensor *sensor,
                        double weight, uint64_t seed);
void plant_sensor_disturb(void *memory, const plant_conditions *conditions);
void plant_sensor_read(void *memory, double duration, const double *load, double *grf);

/* Bodies: a homogeneous box of edges `size` [m], and two rigidly connected. The trunk of a robot
 * that carries a payload is its own body, whose centre of mass is off to the side by
 * plant_side_offset, joined with the box. */
void plant_box(double mass, const double *size, const double *com, plant_body *box);
void plant_join(const plant_body *first, const plant_body *second, plant_body *joined);

/* Sideways error of a trunk's centre of mass [m]: side by chance, amount within a quarter of
 * `size` [m]. */
double plant_side_offset(uint64_t seed, double size);

/* Height of a ball's centre over the plane when it just touches what is below it [m]. found: room
 * for the places of contact, as plant_touch. */
double plant_rest_height(const plant_ground *ground, double x, double y, double radius,
                         double *found);

/* Coordinates, as plant_place takes them, of a robot at rest over the origin, parallel to the
 * ground, its lowest foot `clearance` [m] above what is below it. angles: abduction, hip and knee
 * of every leg [rad]; found: as above. */
void plant_start(const plant_robot *robot, const plant_ground *ground, const double *angles,
                 double clearance, double *found, double *coordinates);

/* A field of obstacles by chance: caps of balls. */
typedef struct {
    uint64_t seed;
    int64_t balls;            /* in a tile */
    int64_t cells;            /* along an edge of a tile */
    double tile;              /* [m] edge of the square that is repeated without end */
    double height;            /* [m] by which the balls stand out */
    double smallest, largest; /* [m] diameters of the balls */
    double foot_radius;       /* [m] largest ball that touches them */
    double sink_in;           /* [m] by which it may sink into the plane beside them */
} plant_field;

/* The numbers of a ground of the kind PLANT_OBSTACLES: how many there are, and they themselves.
 * Returns the most places at which a ball touches at a time. */
int64_t plant_field_reals(const plant_field *field);
int64_t plant_field_integers(const plant_field *field);
int32_t plant_field_fill(const plant_field *field, double *reals, int64_t *integers);

/* Obstacles of a tile: place (x, y) in [0, tile) and radius of number `index`. */
void plant_obstacle(uint64_t seed, int64_t index, double tile, double smallest, double largest,
                    double *place);

/* Numbers by chance: in [0, 1), and of the standard normal distribution. Counter-based: Philox
 * 4x32-10 of Salmon et al. (2011), key: the seed, counter: index and purpose. */
double plant_uniform(uint64_t seed, int32_t purpose, uint64_t index);
double plant_normal(uint64_t seed, int32_t purpose, uint64_t index);

#ifdef __cplusplus
}
#endif

#endif

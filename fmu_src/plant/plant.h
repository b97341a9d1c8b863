/* A legged robot on the ground in plain C: the interface to build, command and read it.
 *
 * A plant holds one robot, or several side by side (lanes). All lanes have the same number of legs
 * and are advanced together. The motion in a lane has the same bits as that of its robot alone. The
 * caller provides the memory; nothing is allocated. A plant holds no pointers to its own memory, so
 * its bytes can be copied, stored and restored by the same build.
 *
 * Frames: world (x forward at the start, y left, z up); trunk (origin at its reference point);
 * ground (the world frame, turned about y by the slope). The legs are in the order of the
 * controller, right side first. Joint angles are zero in the reference pose. A positive hip angle
 * swings the leg forward, a positive knee angle flexes the knee and lifts the foot, a positive
 * abduction moves the foot to the left.
 *
 * Python parses this header with cffi, so the declarations are plain and contain no macros.
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
    double inertia[6]; /* [kg m^2] about the centre of mass: xx, yy, zz, xy, xz, yz */
} plant_body;

/* What a joint has of its own. NaN: as the servo of the robot has it. */
typedef struct {
    double stiffness, damping, stall_torque, no_load_speed, reflected_inertia; /* see plant_servo */
    double joint_damping;  /* [N m s/rad] of the joint itself, apart from its motor */
    double dry_friction;   /* [N m] of the joint itself */
    double friction_speed; /* [rad/s] below it dry friction is proportional to the speed */
    double low, high;      /* [rad] joint angles of its stops; infinite: none */
    double stop_stiffness; /* [N m/rad] torque per angle beyond a stop */
    double stop_damping;   /* [N m s/rad] torque per speed there */
} plant_joint;

/* Joints of a leg from the trunk outward. In the straight pose all links hang down. */
enum {
    PLANT_ABDUCTION = 0, /* abduction about x, hip about y, knee about y */
    PLANT_HIP = 1,       /* hip about y, abduction about x, knee about y */
    PLANT_COXA = 2       /* coxa about z, then femur and tibia about the axis across the leg, about
                            which a positive turn lifts a femur. The hip angle turns the coxa, the
                            knee angle the femur, and the tibia is held as the abduction is. */
};

/* A leg. All vectors are in axes parallel to the trunk's in the straight pose. The joints of the
 * links hip, femur and tibia are those of its kind. */
typedef struct {
    double mount[3];        /* [m] abduction joint, in the trunk frame */
    double hip[3];          /* [m] from the abduction axis to the hip axis */
    double femur;           /* [m] hip axis to knee axis */
    double tibia;           /* [m] knee axis to centre of the foot */
    double femur_angle;     /* [rad] reference pose, back of vertical */
    double tibia_angle;     /* [rad] reference pose, forward of the femur */
    plant_body link[3];     /* hip, femur, tibia; each frame lies at its joint */
    plant_joint joint[3];   /* in the order of the joint angles: abduction, hip, knee */
    double foot_radius;     /* [m] of the foot ball; NaN: as the contact of the robot has it */
    double abduction_angle; /* [rad] reference pose, the foot to the left */
    int32_t knee_in_front;  /* 1: the knee lies in front of the line from hip to foot, and a
                               positive angle turns the tibia back; 0: the other way */
    int32_t kind;           /* PLANT_ABDUCTION ... PLANT_COXA */
    int32_t locked[3];      /* joints from the trunk outward; 1: it does not exist */
    double pointing;        /* [rad] PLANT_COXA: where the leg points, about z from x */
} plant_leg;

/* A geared position servo, that of every joint that has no numbers of its own. */
typedef struct {
    double stiffness;         /* [N m/rad] torque per position error */
    double damping;           /* [N m s/rad] torque per joint speed */
    double stall_torque;      /* [N m] largest torque */
    double no_load_speed;     /* [rad/s] speed at which no driving torque is left */
    double reflected_inertia; /* [kg m^2] rotor inertia times the gear ratio squared */
    double latency;           /* [s] age of a command when the servo starts to follow it */
    double slew_rate;         /* [rad/s] fastest change of the command; 0: no limit */
} plant_servo;

/* A rubber ball on hard ground; feet are alike but for their radius. */
typedef struct {
    double foot_radius;    /* [m] */
    double stiffness;      /* [N/m] normal force per depth */
    double damping;        /* [N s/m] normal force per approach speed, from damping_depth on */
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

/* Suspension that holds a trunk: a spring and a damper on each of its six coordinates. */
typedef struct {
    double stiffness;         /* [N/m] */
    double damping;           /* [N s/m] */
    double angular_stiffness; /* [N m/rad] */
    double angular_damping;   /* [N m s/rad] */
} plant_suspension;

/* A robot as numbers. */
typedef struct {
    int32_t legs;           /* 2 to 64 */
    double gravity;         /* [m/s^2] downward */
    double weight;          /* [N] without payload; it scales the noise of the sensors */
    plant_body trunk;       /* includes the payload and the seeded error of its centre of mass */
    double trunk_center[3]; /* [m] middle of its outline; a corner of it on the ground is a fall */
    double trunk_size[3];   /* [m] edges of the outline */
    plant_servo servo;      /* */
    plant_contact contact;  /* */
    plant_sensor sensor;    /* */
    plant_suspension suspension; /* */
    const plant_leg *leg;        /* one per leg */
} plant_robot;

/* A touch function: where a ball touches a ground, in the frame of the ground.
 *
 * x, y, z: centre of the ball [m]; radius: of the ball [m], 0 for a point; reals, integers: numbers
 * of the ground; found: for each contact point its normal (x, y, z, pointing out of the ground) and
 * its depth [m], which is above 0. Returns the number of contact points; 0 where z >= radius + top.
 */
typedef int32_t (*plant_touch)(double x, double y, double z, double radius, const double *reals,
                               const int64_t *integers, double *found);

/* Kinds of ground. */
enum {
    PLANT_PLANE = 0,     /* no numbers */
    PLANT_OBSTACLES = 1, /* reals: tile, cells along its edge, then x, y, z, radius of each ball;
                            integers: start of each cell in a list of balls, then that list */
    PLANT_KERB = 2,      /* reals: begin, end, height [m] */
    PLANT_WAVES = 3,     /* reals: half the amplitude [m], wavenumber [rad/m] */
    PLANT_OWN = 4        /* the caller's touch function */
};

/* A ground. It must outlive the plants that stand on it. */
typedef struct {
    int32_t kind;            /* PLANT_PLANE ... PLANT_OWN */
    int32_t contacts;        /* most contact points of a ball at a time */
    double slope;            /* [rad] angle by which it rises along x */
    double top;              /* [m] no point of the ground is higher above its plane */
    const double *reals;     /* as its kind says */
    const int64_t *integers; /* as its kind says */
    plant_touch touch;       /* only used if the kind is PLANT_OWN */
} plant_ground;

/* What is wrong with a robot. */
typedef struct {
    double grf_noise; /* [1] standard deviation over half the weight, added to the sensors' own */
    int32_t held;     /* 1: the trunk is held level */
    double held_at;   /* [m] height above its start at which the trunk is held */
    const uint8_t *damaged; /* per leg, 1: hip and knee are held at 0; NULL: no leg is damaged */
    const double *stuck;    /* [N] per leg, constant reading of a stuck sensor; NaN: it works;
                               NULL: all work */
} plant_conditions;

/* How the lanes of a plant are computed. All kinds give the bits of PLANT_SCALAR. */
enum {
    PLANT_SCALAR = 0, /* one robot, plain C */
    PLANT_LEGS = 1,   /* one robot, its legs side by side in a vector */
    PLANT_ROBOTS = 2  /* several robots side by side in a vector */
};

/* Instruction sets, the smallest first. */
enum { PLANT_BASELINE = 0, PLANT_AVX2 = 1, PLANT_AVX512 = 2 };

/* State of the robot in a lane. A robot diverged if its speeds are not numbers or far too high, or
 * if it came to lie with steps that are not stable, see plant_stable_step. */
enum { PLANT_WALKS = 0, PLANT_FELL = 1, PLANT_DIVERGED = 2 };

/* Purposes of random numbers; each purpose has its own sequence. */
enum { PLANT_RANDOM_BODY = 1, PLANT_RANDOM_SENSOR = 2, PLANT_RANDOM_GROUND = 3 };

/* Best instruction set that both this machine and this library have. */
int32_t plant_best_level(void);

/* Name of an instruction set: "baseline", "avx2", "avx512". */
const char *plant_level_name(int32_t level);

/* Number of robots side by side for a kind at a level: 1 for PLANT_SCALAR and PLANT_LEGS. */
int32_t plant_lanes(int32_t kind, int32_t level);

/* Size of a plant in bytes, or 0 if the arguments are not allowed.
 *
 * kind, level: as above; legs: 2 to 64; contacts: the largest number of contact points of any
 * ground that it will stand on, or 0 if all of them are planes, which is faster; history: the
 * largest number of delayed commands and readings, see plant_history. */
size_t plant_size(int32_t kind, int32_t level, int32_t legs, int32_t contacts, int32_t history);

/* Number of commands and readings that latency and delay keep waiting if no tick is shorter than
 * Ts [s]; 65536 at most. */
int32_t plant_history(double latency, double delay, double Ts);

/* Make the bytes at `memory` (aligned to 64) a plant without robots. The other arguments are those
 * of plant_size. */
void plant_create(void *memory, int32_t kind, int32_t level, int32_t legs, int32_t contacts,
                  int32_t history);

/* Continue with the instructions of another level, if both levels lay out a plant alike.
 * PLANT_SCALAR and PLANT_LEGS do so at all levels. */
void plant_use_level(void *plant, int32_t level);

/* Whether stored bytes, which may have been changed, are a plant that plant_create made with these
 * arguments. Such a plant can be advanced safely, whatever its numbers are. */
int32_t plant_intact(const void *memory, int32_t kind, int32_t level, int32_t legs,
                     int32_t contacts, int32_t history);

/* Put a robot into a lane, at rest at its start.
 *
 * coordinates: x, y, z [m], yaw, pitch, roll [rad] of the trunk, then abduction, hip and knee of
 * every leg as joint angles [rad], 6 + 3 legs numbers. height: [m] by which the trunk starts
 * higher, if it is held. Ts: length of the coming ticks [s]; before the start, the start pose
 * counts as commanded once per tick. All robots of a plant share one latency and one sensor delay:
 * those of the robot that was placed last. They also share one set of equations: next to a robot
 * with a leg of another kind than PLANT_ABDUCTION, the last bits of the others change. */
void plant_place(void *plant, int32_t lane, const plant_robot *robot, const plant_ground *ground,
                 uint64_t seed, const double *coordinates, double height, double Ts);

/* Change servo, contact, sensor, joints and radii of the feet of a lane to those of a robot;
 * geometry and masses stay. */
void plant_tune(void *plant, int32_t lane, const plant_robot *robot);

/* Set the conditions that hold from now on. */
void plant_set_conditions(void *plant, int32_t lane, const plant_conditions *conditions);

/* Set the commands that hold from now on: hip and knee angle of every leg [rad], one number per leg
 * each. */
void plant_command(void *plant, int32_t lane, const double *hip, const double *knee);

/* Change the velocity of the whole robot along x and y of the world at once [m/s], as a push on all
 * its bodies does. */
void plant_shift_velocity(void *plant, int32_t lane, double x, double y);

/* Integrate one tick in equal steps of at most `step`, then read the sensors. Times are in s.
 * grounds: one per lane. */
void plant_advance(void *plant, const plant_ground *const *grounds, double duration, double step);

/* State of a lane after the last tick: PLANT_WALKS, PLANT_FELL or PLANT_DIVERGED. */
int32_t plant_state_of(const void *plant, int32_t lane);

/* Count of numbers in a sample: 9 + 19 legs. */
int32_t plant_sample_size(int32_t legs);

/* Write one sample of a lane. First come position (3) [m], roll, pitch, yaw [rad] and velocity (3)
 * [m/s] of the trunk. Then come seven blocks, each with all legs in turn: joint angles (3) [rad],
 * joint speeds (3) [rad/s], torques (3) [N m], works (3) [J], position of the foot (3) [m] and
 * force of the ground on it (3) [N] in the world frame, load that the sensor delivers (1) [N]. */
void plant_sample(const void *plant, int32_t lane, double *sample);

/* Write the loads that the sensors of a lane deliver [N], one number per leg. */
void plant_loads(const void *plant, int32_t lane, double *grf);

/* Write the accelerations of the coordinates at the end of the last step, 6 + 3 legs numbers; for
 * tests. */
void plant_accelerations(const void *plant, int32_t lane, double *accelerations);

/* Least apparent mass of any foot along the ground at the start [kg]. */
double plant_foot_mass(const void *plant, int32_t lane);

/* Longest integration step [s] that follows the motion of a robot, see step.h. The robot is the one
 * without payload and without the seeded error of its centre of mass. With a longer step,
 * vibrations grow that no robot has, or its feet slip where they would not. */
double plant_longest_step(const plant_robot *robot);

/* Longest stable integration step [s]: with a longer one, vibrations grow that no robot has. */
double plant_stable_step(const plant_robot *robot);

/* Integration step [s] that a robot gets: 1/960 s, or the longest of 1/1440 s, 1/1920 s and so on
 * that stays below the longest step by a margin. Arguments as of plant_longest_step. */
double plant_own_step(const plant_robot *robot);

/* All forces on a robot but gravity, for other engines: the same laws on their coordinates.
 *
 * q, v: coordinates and speeds of a tree: x, y, z, yaw, pitch, roll, then abduction, hip and knee
 * of every leg, of which hip and knee turn about +y; target: commanded
 * tree coordinates of the joints, 3 legs numbers; held: six coordinates the trunk is held at, or
 * NULL; stopping: length of the step over foot mass [s/kg]; work: [J] per joint, grows by
 * |torque speed| dt; out: generalized forces (6 + 3 legs), then torques of the servos in tree
 * coordinates, feet and forces on them in the world frame (3 legs each), sums of the normal forces
 * (legs), and room for the contact points of a foot (4 numbers for each of the ground's
 * `contacts`). */
void plant_forces(const plant_robot *robot, const plant_ground *ground, const double *q,
                  const double *v, const double *target, const double *held, double stopping,
                  double dt, double *work, double *out);

/* Whether a trunk at these six coordinates has tipped by more than 60 degrees from the normal of
 * the ground, or touches it with a corner. found: room for the contact points, as of plant_touch.
 */
int32_t plant_fallen(const plant_robot *robot, const plant_ground *ground, const double *q,
                     double *found);

/* Write second joint, third joint and foot of a leg in the trunk frame [m], 9 numbers. */
void plant_leg_points(const plant_leg *leg, double abduction, double hip, double knee,
                      double *points);

/* Torque of a servo [N m] at a position error [rad] and a joint speed [rad/s]. */
double plant_servo_torque(const plant_servo *servo, double error, double speed);

/* Torque of a joint apart from its servo [N m], of friction, damping and stops, at a joint angle
 * [rad] and speed [rad/s]. */
double plant_joint_torque(const plant_joint *joint, double angle, double speed);

/* Force of the ground on a foot (3) and its normal part [N].
 *
 * normal: of the ground; depth: [m], above 0; velocity: of the foot at the contact point [m/s];
 * stopping: as of plant_forces. */
double plant_contact_force(const plant_contact *contact, const double *normal, double depth,
                           const double *velocity, double stopping, double *force);

/* Where a ball touches a ground of any kind; arguments and result as of plant_touch. */
int32_t plant_touches(const plant_ground *ground, double x, double y, double z, double radius,
                      double *found);

/* The load cells of a robot alone, for other engines; they read as in plant_advance.
 * memory: plant_sensor_size bytes. */
size_t plant_sensor_size(int32_t legs, int32_t history);
void plant_sensor_start(void *memory, int32_t legs, int32_t history, const plant_sensor *sensor,
                        double weight, uint64_t seed);
void plant_sensor_disturb(void *memory, const plant_conditions *conditions);
void plant_sensor_read(void *memory, double duration, const double *load, double *grf);

/* Bodies: a homogeneous box of edges `size` [m], and two bodies rigidly connected. The trunk of a
 * robot with payload joins the box of the payload with the trunk's own body, whose centre of mass
 * is shifted sideways by plant_side_offset. */
void plant_box(double mass, const double *size, const double *com, plant_body *box);
void plant_join(const plant_body *first, const plant_body *second, plant_body *joined);

/* Sideways error of a trunk's centre of mass [m]. Its side is random, its amount is random within a
 * quarter of `size` [m]. */
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
    double height;            /* [m] height of the balls above the plane */
    double smallest, largest; /* [m] diameters of the balls */
    double foot_radius;       /* [m] radius of the largest foot that touches them */
    double sink_in;           /* [m] depth to which a foot may sink into the plane */
} plant_field;

/* The numbers of a ground of the kind PLANT_OBSTACLES: their counts, and a function that writes
 * them. plant_field_fill returns the largest number of contact points of a ball. */
int64_t plant_field_reals(const plant_field *field);
int64_t plant_field_integers(const plant_field *field);
int32_t plant_field_fill(const plant_field *field, double *reals, int64_t *integers);

/* Obstacle number `index` of a tile: position (x, y) in [0, tile) and radius [m]. */
void plant_obstacle(uint64_t seed, int64_t index, double tile, double smallest, double largest,
                    double *place);

/* Random numbers: uniform in [0, 1), and of the standard normal distribution. The generator is
 * counter-based: Philox 4x32-10 of Salmon et al. (2011). Key: the seed; counter: index and purpose.
 */
double plant_uniform(uint64_t seed, int32_t purpose, uint64_t index);
double plant_normal(uint64_t seed, int32_t purpose, uint64_t index);

#ifdef __cplusplus
}
#endif

#endif

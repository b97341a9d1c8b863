/* What the page is given of a robot: numbers that Python writes down and wasm32 reads as they are.
 *
 * Little-endian; plant_robot ends with a pointer, which takes 8 bytes on either side and is set
 * here. APNC_LEGS is that of the build.
 */
#ifndef PLAY_H
#define PLAY_H

#include "plant.h"

typedef struct {
    plant_robot robot; /* its trunk carries nothing and is symmetric; `leg` is set here */
    plant_leg leg[APNC_LEGS];
    double trunk_mass;       /* [kg] */
    double trunk_inertia[6]; /* [kg m^2] of the trunk, as in plant_body */
    double trunk_com[3];     /* [m] its centre of mass */
    double com_side_offset;  /* [m] see plant_side_offset */
    double payload_size[3];  /* [m] edges of the payload */
    plant_field field;       /* obstacles at their highest; their seed is that of the walk */
    double clearance;        /* [m] of the lowest foot at the start */
    double start[3];         /* [rad] abduction, hip and knee of every leg at the start */
    double Ts;               /* [s] */
    double step;             /* [s] longest integration step */
} play_numbers;

#endif

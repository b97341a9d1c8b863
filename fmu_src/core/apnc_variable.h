/* How a variable of the controller or of the robot is reached, named and checked.
 *
 * Generated from apnc_core/schema.py by `python -m build_fmu.generate`; do not edit.
 */
#ifndef APNC_VARIABLE_H
#define APNC_VARIABLE_H

#include <stddef.h>
#include <stdint.h>

#include "apnc_names.h"
#include "apnc_real.h"

#if APNC_LEGS < 2 || APNC_LEGS > 64
#error "APNC_LEGS must be 2 to 64"
#endif

#define APNC_VR_STRIDE 100u  /* value reference = stride * number + element */
#define APNC_VR_TIME   9900u /* of the independent variable in FMI 3.0 */

typedef enum { APNC_REAL, APNC_INTEGER, APNC_BOOLEAN, APNC_ENUMERATION } apnc_type;

typedef enum { APNC_INPUT, APNC_OUTPUT, APNC_LOCAL, APNC_FIXED, APNC_TUNABLE } apnc_role;

typedef struct {
    const char *name;
    const char *before; /* scalar name = before + index + after; before alone if count is 1 */
    const char *after;
    size_t offset; /* of the first entry in the values of all variables [bytes] */
    int count;
    apnc_type type;
    apnc_role role;
    apnc_real start;
    apnc_real min; /* inclusive; min > max: no range */
    apnc_real max;
} apnc_variable;

#endif

/* As driver.c, with inputs that are commands to a robot [rad]. */
#define SCALE 0.02
#include "driver.c"

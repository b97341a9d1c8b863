/* Build-time choices. The build of an FMU writes its own version of this file beside the sources.
 */
#ifndef PLANT_CONFIG_H
#define PLANT_CONFIG_H

/* Define PLANT_PREFIX for names of this build's own, PLANT_ONE_ROBOT to leave out what computes
 * several robots side by side, and PLANT_MOST_LEGS where all robots have fewer than 64 legs. */

#endif

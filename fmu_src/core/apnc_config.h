/* Build-time choices. The build writes its own version of this file beside the sources. */
#ifndef APNC_CONFIG_H
#define APNC_CONFIG_H

#ifndef APNC_LEGS
#define APNC_LEGS 4 /* number of legs, the right ones first */
#endif

/* Define APNC_SINGLE for numbers of type float: processors without double arithmetic. */
/* Own start values: #define APNC_DEFAULTS(p) (p)->robot_weight = 60.0; (p)->xi = 0.03; */

#endif

"""Gait metrics: pure functions on arrays, the same for every study and report.

Arguments of the same name mean the same in every function, for T samples and n legs in the FMU's
order:

- ``time``: sample times [s], shape (T,); ``sample_time``: time between two samples [s].
- ``o1``, ``o2``: outputs of the neurons N1 and N2 of every CPG, shape (T, n).
- ``target``: relative phases phi_12 .. phi_1n of a gait [rad], shape (n - 1,).
- ``touch``: index of the touch moment, None if there is none.
- ``standing``: which feet stand, shape (T, n).
- ``starts``: when the cycles of each oscillator begin [samples], an array per leg.
- ``position``: of the trunk in the world frame [m], shape (T, 3).
- ``roll``, ``pitch``, ``yaw``: of the trunk [rad], shape (T,).
- ``speed``: of the trunk along its path [m/s].

An undefined value is ``None``, e.g. the stride length of a robot that does not move.
"""

from apnc.metrics.convergence import STRICT_TOLERANCE as STRICT_TOLERANCE
from apnc.metrics.convergence import convergence_time as convergence_time
from apnc.metrics.convergence import convergence_time_authors as convergence_time_authors
from apnc.metrics.convergence import phase_error as phase_error
from apnc.metrics.convergence import settling_time as settling_time
from apnc.metrics.convergence import touch_moment as touch_moment
from apnc.metrics.gaits import GAITS as GAITS
from apnc.metrics.gaits import default_target as default_target
from apnc.metrics.gaits import gait_name as gait_name
from apnc.metrics.gaits import nearest_gait as nearest_gait
from apnc.metrics.motion import MIN_SPEED as MIN_SPEED
from apnc.metrics.motion import balance as balance
from apnc.metrics.motion import cost_of_transport as cost_of_transport
from apnc.metrics.motion import forward_distance as forward_distance
from apnc.metrics.motion import forward_speed as forward_speed
from apnc.metrics.motion import heading_range as heading_range
from apnc.metrics.motion import mean_speed as mean_speed
from apnc.metrics.motion import path_length as path_length
from apnc.metrics.motion import smoothed_speed as smoothed_speed
from apnc.metrics.motion import turned as turned
from apnc.metrics.phases import coherence as coherence
from apnc.metrics.phases import cpg_phase as cpg_phase
from apnc.metrics.phases import final_phases as final_phases
from apnc.metrics.phases import phase_difference_authors as phase_difference_authors
from apnc.metrics.phases import relative_phases as relative_phases
from apnc.metrics.phases import wrap as wrap
from apnc.metrics.phases import wrap_for_display as wrap_for_display
from apnc.metrics.smoothing import smooth as smooth
from apnc.metrics.strides import coordination as coordination
from apnc.metrics.strides import cycle_starts as cycle_starts
from apnc.metrics.strides import duty_factors as duty_factors
from apnc.metrics.strides import foot_lifts as foot_lifts
from apnc.metrics.strides import slips as slips
from apnc.metrics.strides import stance as stance
from apnc.metrics.strides import stride_frequency as stride_frequency
from apnc.metrics.strides import stride_length as stride_length
from apnc.metrics.strides import touch_downs_per_stride as touch_downs_per_stride
from apnc_plant.robot.model import GRAVITY as GRAVITY

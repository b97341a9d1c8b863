"""Gait metrics: pure functions on arrays, so that every study and report means the same by a word.

Conventions of the whole package: sample arrays have shape (T,) or (T, n_legs); time in seconds;
an undefined value (no stride taken, robot not moving) is ``None``, never a made-up number.
"""

from apnc.metrics.convergence import (
    STRICT_TOLERANCE,
    convergence_time,
    convergence_time_authors,
    default_target,
    phase_error,
    touch_moment,
)
from apnc.metrics.gait import (
    coordination,
    duty_factors,
    stance,
    stride_duty,
    stride_frequency,
    stride_starts,
)
from apnc.metrics.motion import (
    GRAVITY,
    balance,
    cost_of_transport,
    fell,
    forward_distance,
    forward_speed,
    path_length,
    path_speed,
    smoothed_speed,
)
from apnc.metrics.phases import (
    cpg_phase,
    final_phases,
    phase_difference_authors,
    phase_from_peaks,
    relative_phases,
    relative_phasors,
    wrap,
    wrap_for_display,
)
from apnc.metrics.smoothing import smooth

__all__ = [
    "GRAVITY",
    "STRICT_TOLERANCE",
    "balance",
    "convergence_time",
    "convergence_time_authors",
    "coordination",
    "cost_of_transport",
    "cpg_phase",
    "default_target",
    "duty_factors",
    "fell",
    "final_phases",
    "forward_distance",
    "forward_speed",
    "path_length",
    "path_speed",
    "phase_difference_authors",
    "phase_error",
    "phase_from_peaks",
    "relative_phases",
    "relative_phasors",
    "smooth",
    "smoothed_speed",
    "stance",
    "stride_duty",
    "stride_frequency",
    "stride_starts",
    "touch_moment",
    "wrap",
    "wrap_for_display",
]

"""Find the gait of a robot: from a robot file to a tuned one, see docs/robots/tune.md."""

from apnc.tune.design import MI_AIMED
from apnc.tune.evaluate import Stopped
from apnc.tune.tuning import MINUTES, Allowed, Tuned, tune
from apnc.tune.validation import SEEDS, Cell, Validation, in_words

__all__ = [
    "MINUTES", "MI_AIMED", "SEEDS", "Allowed", "Cell", "Stopped", "Tuned", "Validation",
    "in_words", "tune",
]  # fmt: skip

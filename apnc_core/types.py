"""Types of values that all packages share."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]
"""Array of numbers; whoever uses it states its shape and unit."""

"""Coordinates of the tree, the same for every engine."""

from __future__ import annotations

from typing import Final

import numpy as np

BASE: Final = 6
"""Coordinates of the floating base: x, y, z [m], yaw, pitch, roll [rad]; the joints follow."""

JOINT_SIGN: Final = np.array([1.0, -1.0, -1.0])
"""Tree coordinate per joint angle: the tree turns about +y, a leg that swings forward about -y."""

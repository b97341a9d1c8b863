"""Coordinates of the tree of joints, the same in all engines."""

from __future__ import annotations

from typing import Final

import numpy as np

BASE: Final = 6
"""Coordinates of the floating base: x, y, z [m], yaw, pitch, roll [rad]; the joints follow."""

JOINT_SIGN: Final = np.array([1.0, -1.0, -1.0])
"""Tree coordinate per joint angle: a positive one turns about +y, a leg swings forward about -y."""

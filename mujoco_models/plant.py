"""The plant in MuJoCo."""

from __future__ import annotations

from apnc_plant.legged import LeggedPlant
from mujoco_models.tree import MujocoTree


class MujocoPlant(LeggedPlant):
    """One robot in its own MuJoCo model; see :class:`LeggedPlant`."""

    engine = MujocoTree

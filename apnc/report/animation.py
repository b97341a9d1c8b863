"""What the animation draws, packed for the browser: legs, trunk, forces, contacts."""

from __future__ import annotations

from typing import Any

from apnc import metrics
from apnc.loop.recording import Record
from apnc.report.encoding import packed
from apnc.report.skeleton import leg_chains, trunk_box
from apnc.report.theme import leg_colours
from exudyn_models.robot.model import RobotDescription


def animation_data(record: Record, robot: RobotDescription | None) -> dict[str, Any]:
    """Everything the animation needs, arrays in base64.

    Args:
        record: the run.
        robot: geometry of legs and trunk, None for straight legs.

    Keys: ``time`` (T,), ``position`` and ``rpy`` (T, 3), ``chains`` (T, n, 4, 3), ``force``
    (T, n, 3) as 32-bit floats; ``stance`` (T, n) as bytes.
    """
    plant = record.plant
    colours = leg_colours(record.legs)
    size, center = trunk_box(record, robot)
    return {
        "legs": list(record.legs),
        "colours": [colours[leg] for leg in record.legs],
        "count": len(record),
        "weight": record.mass * metrics.GRAVITY,
        "trunk": size,
        "trunkCenter": center,
        "time": packed(record.time, "<f4"),
        "position": packed(plant["position"], "<f4"),
        "rpy": packed(plant["rpy"], "<f4"),
        "chains": packed(leg_chains(record, robot), "<f4"),
        "force": packed(plant["foot_force"], "<f4"),
        "stance": packed(metrics.stance(plant["foot_force"][..., 2]), "u1"),
    }

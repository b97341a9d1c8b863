"""What the animation draws, packed for the browser: legs, trunk, forces, contacts."""

from __future__ import annotations

from typing import Any

from apnc_studies import metrics
from apnc_studies.report.encoding import packed
from apnc_studies.report.skeleton import LILIBOT, Skeleton, leg_chains
from apnc_studies.report.theme import leg_colours
from exudyn_models.recording import Record


def animation_data(record: Record, skeleton: Skeleton | None) -> dict[str, Any]:
    """Everything the animation needs, arrays in base64.

    Args:
        record: the run.
        skeleton: geometry of the legs, None for straight legs.

    Keys: ``time`` (T,), ``position`` and ``rpy`` (T, 3), ``chains`` (T, n, 4, 3), ``force``
    (T, n, 3) as 32-bit floats; ``stance`` (T, n) as bytes.
    """
    plant = record.plant
    colours = leg_colours(record.legs)
    return {
        "legs": list(record.legs),
        "colours": [colours[leg] for leg in record.legs],
        "count": len(record),
        "weight": record.mass * metrics.GRAVITY,
        "trunk": list((skeleton or LILIBOT).trunk),
        "trunkCenter": list((skeleton or LILIBOT).trunk_center),
        "time": packed(record.time, "<f4"),
        "position": packed(plant["position"], "<f4"),
        "rpy": packed(plant["rpy"], "<f4"),
        "chains": packed(leg_chains(record, skeleton), "<f4"),
        "force": packed(plant["foot_force"], "<f4"),
        "stance": packed(metrics.stance(plant["foot_force"][..., 2]), "u1"),
    }

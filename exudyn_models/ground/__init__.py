"""Grounds: one object each, which nothing else needs to know the kind of."""

from exudyn_models.ground.terrain import Ground

Surface = Plane = Kerb = Waves = Ground
GROUNDS = {"obstacles": Ground}

__all__ = ["GROUNDS", "Ground", "Kerb", "Plane", "Surface", "Waves"]

"""Multibody models of legged robots in Exudyn and the co-simulation master that drives them."""

"""Search for physical unknowns and gains with which the trot forms at every MI (CMA-ES)."""

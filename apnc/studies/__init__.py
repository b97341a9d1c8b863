"""Studies: many experiments, what is measured of each, what the paper claims, and figures."""

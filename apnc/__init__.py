"""Adaptive neural control for legged robots: simulate a walk, sum it up, run a study."""

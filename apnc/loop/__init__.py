"""The closed loop: what is run, what walks, what controls it, and what is recorded."""

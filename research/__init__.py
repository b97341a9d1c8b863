"""Studies of the model itself, and what writes the documentation; see README.md."""

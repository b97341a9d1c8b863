"""Studies of the model itself, and the scripts that write the documentation. See README.md."""

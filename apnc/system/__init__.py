"""Parts for models of a whole system: the robot as an FMU, and both FMUs connected."""

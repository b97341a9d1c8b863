"""The reference plant: the robot as a kinematic tree in Exudyn."""

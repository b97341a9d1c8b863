"""Robots, grounds, sensors and faults as data, and the robot in plain C that walks them."""

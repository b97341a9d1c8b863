"""Robots, grounds, sensors and conditions as data, and the plant in plain C that uses them."""

"""Robots as data, and the files they are read from."""

"""``python -m research.engines``."""

from research.command import main

main("engines")

"""``python -m research.contact``."""

from research.command import main

main("contact")

"""``python -m research.engines``."""

from research.command import main

if __name__ == "__main__":
    main("engines")

"""``python -m research.limits``."""

from research.command import main

if __name__ == "__main__":
    main("limits")

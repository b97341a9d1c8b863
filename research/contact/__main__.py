"""``python -m research.contact``."""

from research.command import main

if __name__ == "__main__":
    main("contact")

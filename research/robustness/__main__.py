"""``python -m research.robustness``."""

from research.command import main

if __name__ == "__main__":
    main("robustness")

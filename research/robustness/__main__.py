"""The command line of the study."""

from research.command import main

if __name__ == "__main__":
    main("robustness")

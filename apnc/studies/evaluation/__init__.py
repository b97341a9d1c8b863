"""The paper's evaluation: trials, where they run, what they leave behind, and what it means."""

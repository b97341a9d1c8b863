"""The studies, and the one machine that runs them all."""

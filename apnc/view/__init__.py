"""A walk live in the browser, on this machine only."""

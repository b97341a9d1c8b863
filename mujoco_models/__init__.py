"""The robots in MuJoCo: an engine for the plant, and export as MJCF for other programs."""

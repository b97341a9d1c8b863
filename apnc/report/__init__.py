"""Reports: one HTML file with plots that opens without a network, and the folder of a run."""

from typing import Final

RUN_FILES: Final = ("summary.json", "record.csv", "report.html")
"""Files in the folder of a run."""

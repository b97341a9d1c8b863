"""The report of one run: a single HTML file with plots and an animation, readable offline."""

from apnc.report.page import write_report

__all__ = ["write_report"]

"""The report of one run: a single HTML file with plots and an animation, readable offline."""

from apnc_studies.report.page import write_report
from apnc_studies.report.skeleton import LILIBOT, Skeleton

__all__ = ["LILIBOT", "Skeleton", "write_report"]

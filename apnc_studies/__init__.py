"""Metrics, studies, reports and the command line."""

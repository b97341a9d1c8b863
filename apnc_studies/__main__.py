"""``python -m apnc_studies`` is ``apnc``."""

from apnc_studies.cli import main

main()

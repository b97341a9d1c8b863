"""``python -m apnc`` is ``apnc``."""

from apnc.cli.main import main

main()

"""The page as a picture, for browsers that cannot run it: ``python -m play.still``, by Chromium."""

from __future__ import annotations

import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Final

from PIL import Image

from play.build import STILL, build

SIZE: Final = (900, 692)
"""The stage and the strip [px]: the controls lie below."""


def main() -> None:
    """Write the picture."""
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    if browser is None:
        sys.exit("no chromium binary found: no picture was taken")
    with tempfile.TemporaryDirectory() as folder:
        page, picture = Path(folder) / "page.html", Path(folder) / "picture.png"
        build(page)
        command = [
            *(browser, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"),
            # it has walked for some seconds then, and stands still
            "--force-prefers-reduced-motion",
            *(f"--user-data-dir={folder}/profile", f"--window-size={SIZE[0]},{SIZE[1]}"),
            *("--virtual-time-budget=3000", f"--screenshot={picture}", page.as_uri()),
        ]
        subprocess.run(command, capture_output=True, check=True)
        Image.open(picture).convert("RGB").save(STILL, quality=82, method=6)


if __name__ == "__main__":
    main()

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

SIZE: Final = (900, 600)
"""Of the picture [px]."""
SHOWN: Final = """<style>
header, .invitation, .time, aside { display: none !important }
main { padding: 0 !important; height: 100vh }
.stage { flex: 1; height: auto !important; min-height: 0 !important }
</style>"""
"""What can be pressed is left out."""


def main() -> None:
    """Write the picture."""
    browser = shutil.which("chromium") or shutil.which("chromium-browser")
    if browser is None:
        sys.exit("no chromium binary found: no picture was taken")
    with tempfile.TemporaryDirectory() as folder:
        page, picture = Path(folder) / "page.html", Path(folder) / "picture.png"
        build(page)
        text = page.read_text(encoding="utf-8")
        page.write_text(text.replace("</head>", f"{SHOWN}</head>"), encoding="utf-8")
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

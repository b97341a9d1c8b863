"""Opens a page in headless Chromium and tells what a person would see."""

from __future__ import annotations

import json
import re
import shutil
import subprocess
from pathlib import Path
from typing import Any

import pytest

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)
needs_browser = pytest.mark.skipif(
    CHROMIUM is None, reason="no chromium binary found: the report was not drawn in a browser"
)
FLAGS = [
    "--headless",
    "--no-sandbox",
    "--disable-gpu",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--enable-logging=stderr",
    "--v=0",
    "--virtual-time-budget=8000",
    "--window-size=1400,1000",
    "--dump-dom",
]
# Runs in the page after its own scripts and leaves what it saw where --dump-dom shows it.
PROBE = """<script>
let apncTries = 10; // a busy machine draws no frame for a while
window.addEventListener("load", () => setTimeout(function look() {
  if (window.apncReady && !window.apncReady() && apncTries-- > 0) return setTimeout(look, 500);
  const painted = (id) => {
    const canvas = document.getElementById(id);
    if (!canvas || !canvas.width) return 0;
    const { data } = canvas.getContext("2d").getImageData(0, 0, canvas.width, canvas.height);
    return new Set(new Uint32Array(data.buffer)).size;
  };
  const seen = { errors: window.apncErrors, plots: {}, robot: painted("robot") };
  for (const plot of document.querySelectorAll(".js-plotly-plot")) {
    seen.plots[plot.id] = plot.querySelectorAll("svg.main-svg").length;
  }
  if (window.apncProbe) Object.assign(seen, window.apncProbe(painted));
  const box = document.createElement("pre");
  box.id = "probe";
  box.textContent = JSON.stringify(seen);
  document.body.append(box);
}, 1500));
</script>"""


def look(page: Path, folder: Path, extra: str = "") -> tuple[dict[str, Any], str]:
    """Open a copy of the page with the probe in chromium; what the probe saw, and the log."""
    assert CHROMIUM is not None
    copy = folder / "probed.html"
    text = page.read_text(encoding="utf-8")
    copy.write_text(text.replace("</body>", extra + PROBE + "</body>"), encoding="utf-8")
    profile = f"--user-data-dir={folder / 'profile'}"
    command = [CHROMIUM, *FLAGS, profile, copy.as_uri()]
    result = subprocess.run(command, capture_output=True, text=True, timeout=120, check=False)
    found = re.search(r'<pre id="probe">(.*?)</pre>', result.stdout, re.DOTALL)
    assert found, f"the page did not finish loading:\n{result.stderr[-2000:]}"
    seen: dict[str, Any] = json.loads(found[1])
    return seen, result.stderr


def console_lines(log: str) -> list[str]:
    return [line for line in log.splitlines() if "CONSOLE" in line]

"""Opens a page in headless Chromium and tells what a person would see."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from driven import CHROMIUM, driven

needs_browser = pytest.mark.skipif(
    CHROMIUM is None, reason="no chromium binary found: the report was not drawn in a browser"
)
# Runs in the page after its own scripts and leaves what it saw in an element.
PROBE = """<script>
window.addEventListener("load", () => setTimeout(function look() {
  if (window.apncReady && !window.apncReady()) return setTimeout(look, 100);
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
}, 400));
</script>"""


def look(page: Path, folder: Path, extra: str = "") -> tuple[dict[str, Any], str]:
    """Open a copy of the page with the probe in chromium; what the probe saw, and the log."""
    copy = folder / "probed.html"
    text = page.read_text(encoding="utf-8")
    copy.write_text(text.replace("</body>", extra + PROBE + "</body>"), encoding="utf-8")
    with driven(folder) as browser:
        browser.size(1400, 1000)
        browser.open(copy.as_uri())
        seen = browser.until("document.getElementById('probe')?.textContent")
    return json.loads(seen), (folder / "browser.log").read_text(encoding="utf-8")


def console_lines(log: str) -> list[str]:
    return [line for line in log.splitlines() if "CONSOLE" in line]

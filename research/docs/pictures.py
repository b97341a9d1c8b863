"""Save every figure of a study's report as SVG, drawn by headless Chromium.

python -m research.docs.pictures apnc-study-all/report.html docs/pictures
"""

from __future__ import annotations

import html
import json
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

FLAGS = ("--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
         "--disable-background-networking", "--disable-component-update", "--disable-sync",
         "--virtual-time-budget=60000", "--window-size=1200,900", "--dump-dom")  # fmt: skip
COLLECT = """<script>
window.addEventListener("load", async () => {
  const pictures = {};
  if (typeof apnc !== "undefined") { await apnc.plotly; apnc.drawAll(); } // else plotly's own
  for (const plot of document.querySelectorAll(".js-plotly-plot")) {
    const size = { format: "svg", width: 1000, height: plot.offsetHeight };
    const url = await Plotly.toImage(plot, size);
    pictures[plot.id] = decodeURIComponent(url.slice(url.indexOf(",") + 1));
  }
  const box = document.createElement("pre");
  box.id = "pictures";
  box.textContent = JSON.stringify(pictures);
  document.body.append(box);
});
</script>"""


def pictures(page: str) -> dict[str, str]:
    """Every plotly figure of an HTML page as SVG text, by the id of its element."""
    chromium = shutil.which("chromium") or shutil.which("chromium-browser")
    if chromium is None:
        sys.exit("no chromium binary found")
    with tempfile.TemporaryDirectory() as temporary:
        file = Path(temporary) / "page.html"
        file.write_text(page.replace("</body>", COLLECT + "</body>"), encoding="utf-8")
        command = [chromium, *FLAGS, f"--user-data-dir={temporary}/profile", file.as_uri()]
        done = subprocess.run(command, capture_output=True, text=True, check=True)
    found = re.search(r'<pre id="pictures">(.*?)</pre>', done.stdout, re.DOTALL)
    if found is None:
        sys.exit("the page did not finish drawing")
    drawn: dict[str, str] = json.loads(html.unescape(found[1]))
    return drawn


def main(report: Path, folder: Path) -> None:
    """Write ``<figure>.svg`` files into ``folder``, named by the keys of the figures."""
    drawn = pictures(report.read_text(encoding="utf-8"))
    folder.mkdir(parents=True, exist_ok=True)
    for name, picture in drawn.items():
        (folder / f"{name.removeprefix('plot-')}.svg").write_text(picture, encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))

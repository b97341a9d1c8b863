"""Draw the front of a search: formation against lift, every set that was walked again.

python docs/make_front.py docs/formation/front.csv docs/pictures/front.svg
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

from make_pictures import pictures
from plotly.offline import get_plotlyjs

from apnc.report import theme

SHIPPED = "shipped"


def figure(rows: list[dict[str, str]]) -> dict[str, object]:
    """Mean over MI of the lowest lift of a foot, over the walks that form the gait."""
    groups = {
        "beaten by another": ([r for r in rows if r["front"] == "0"], theme.GREY, "circle-open", 7),
        "front": ([r for r in rows if r["front"] == "1"], theme.BLUE, "circle", 10),
        "shipped": ([r for r in rows if r["candidate"] == SHIPPED], theme.VERMILLION, "star", 16),
    }
    data = []
    for name, (own, colour, symbol, size) in groups.items():
        own = sorted(own, key=lambda r: float(r["strict"]))
        data.append({
            "type": "scatter",
            "mode": "lines+markers" if name == "front" else "markers",
            "name": name,
            "x": [100.0 * float(r["strict"]) for r in own],
            "y": [float(r["lift_mm"]) for r in own],
            "marker": {"color": colour, "symbol": symbol, "size": size},
            "line": {"shape": "vh", "width": 1, "color": colour},
        })  # fmt: skip
    layout = theme.layout(
        420,
        xaxis=theme.axis("walks that form the strict trot [%]"),
        yaxis=theme.axis("lowest lift of a foot, mean over MI [mm]"),
    )
    return {"data": data, "layout": layout}


def main(table: Path, picture: Path) -> None:
    """Write the picture of a table of ``apnc.studies.search.front``."""
    with table.open(newline="", encoding="utf-8") as file:
        drawn = json.dumps(figure(list(csv.DictReader(file))))
    page = (
        f"<html><head><script>{get_plotlyjs()}</script></head><body>"
        f'<div id="front" class="js-plotly-plot" style="height:420px;width:1000px"></div>'
        f"<script>const f = {drawn}; Plotly.newPlot('front', f.data, f.layout);</script>"
        "</body></html>"
    )
    picture.write_text(pictures(page)["front"], encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]), Path(sys.argv[2]))

"""Draw the Pareto front of the search for Lilibot: lift against speed of every set walked again.

python -m research.docs.front docs/formation/front.csv docs/pictures/front.svg
"""

from __future__ import annotations

import csv
import json
import sys
from pathlib import Path

from plotly.offline import get_plotlyjs

from apnc.report import theme
from research.docs.pictures import pictures

SHIPPED = "shipped"


def figure(rows: list[dict[str, str]]) -> dict[str, object]:
    """Lowest lift of a foot, mean over MI, over the speed at MI 0.4 in that at 0.15."""
    on_it = [row for row in rows if row["front"] == "1" and row["candidate"] != SHIPPED]
    every = [row for row in on_it if float(row["strict"]) == float(row["payload"]) == 1.0]
    groups = {
        "dominated by another": (
            [row for row in rows if row["front"] == "0"], theme.GREY, "x-thin-open", 7,
        ),
        "Pareto front, not every walk a trot": (
            [row for row in on_it if row not in every], theme.ORANGE, "diamond-open", 10,
        ),
        "Pareto front, every walk a trot, with the payload, too": (every, theme.BLUE, "circle", 10),
        "shipped": ([r for r in rows if r["candidate"] == SHIPPED], theme.VERMILLION, "star", 16),
    }  # fmt: skip
    data = [
        {
            "type": "scatter",
            "mode": "markers",
            "name": name,
            "x": [float(row["ratio"]) for row in own],
            "y": [float(row["lift_mm"]) for row in own],
            "marker": {"color": colour, "symbol": symbol, "size": size, "line": {"width": 2}},
        }
        for name, (own, colour, symbol, size) in groups.items()
    ]
    layout = theme.layout(
        420,
        xaxis=theme.axis("speed at MI 0.4 over that at 0.15 [1]"),
        yaxis=theme.axis("lowest lift of a foot, mean over MI [mm]"),
    )
    return {"data": data, "layout": layout}


def main(table: Path, picture: Path) -> None:
    """Write the picture of a table of sets, see docs/formation/search.md."""
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

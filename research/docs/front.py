"""Draw what a quicker servo gains and loses: speed at high MI, and trots without couplings.

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

SHIPPED = "66"
"""Lag of Lilibot's servo [ms], as in the table."""
LOW_MI = ("0.04", "0.06", "0.08")
"""MI at which the controller without couplings was walked."""


def figure(rows: list[dict[str, str]]) -> dict[str, object]:
    """Trots without couplings at low MI over the speed at MI 0.4 in that at 0.15, for each lag."""
    others = [row for row in rows if row["lag_ms"] != SHIPPED]
    own = [row for row in rows if row["lag_ms"] == SHIPPED]
    data = [
        {
            "type": "scatter",
            "mode": "markers+text",
            "name": name,
            "x": [float(row["ratio"]) for row in part],
            "y": [sum(int(row[f"trots_apc_{mi}"]) for mi in LOW_MI) for row in part],
            "text": [f"{row['lag_ms']} ms" for row in part],
            "textposition": "top right",
            "marker": {"color": colour, "symbol": symbol, "size": size},
        }
        for name, part, colour, symbol, size in (
            ("lag of the servo", others, theme.BLUE, "circle", 10),
            ("as shipped", own, theme.VERMILLION, "star", 16),
        )
    ]
    layout = theme.layout(
        420,
        xaxis=theme.axis("speed at MI 0.4 over that at 0.15 [1]"),
        yaxis=theme.axis("trots without couplings, of 30 at MI 0.04 to 0.08", rangemode="tozero"),
    )
    return {"data": data, "layout": layout}


def main(table: Path, picture: Path) -> None:
    """Write the picture of a table of lags, see docs/formation/search.md."""
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

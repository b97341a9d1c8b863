"""Draw ``pictures/ros-walk.svg``: what the controller node reports while robot and node walk.

Start ``roslaunch apnc_ros walk.launch mi:=0.12`` as examples/ros/README.md says, then, in the same
environment, ``python -m research.docs.ros_picture``; it listens for 20 s.
"""

from __future__ import annotations

import json
import subprocess
import sys
from typing import Final

import plotly
from plotly.subplots import make_subplots

from apnc.report.theme import GREY, axis, layout, leg_colours
from research.docs import DOCS, ROOT
from research.docs.manifest import USUAL, note
from research.docs.pictures import pictures

OBSERVER: Final = ROOT / "tests" / "support" / "ros_observer.py"
SECONDS: Final = 20.0
LEGS: Final = ("RF", "RH", "LF", "LH")


def main() -> None:
    """Listen and draw."""
    command = [sys.executable, str(OBSERVER), str(SECONDS)]
    done = subprocess.run(command, capture_output=True, text=True, check=True)
    reports = json.loads(done.stdout.splitlines()[-1])["reports"]
    time = [int(report["tick"]) / 60.0 for report in reports]
    colours = leg_colours(LEGS)
    plot = make_subplots(rows=3, cols=1, shared_xaxes=True, vertical_spacing=0.06)
    for k, leg in enumerate(LEGS[1:]):
        phi = [float(report["phi"].split()[k]) for report in reports]
        line = {"color": colours[leg], "dash": "dot" if leg == "LF" else "solid"}
        plot.add_scatter(x=time, y=phi, name=f"{LEGS[0]}-{leg}", line=line, row=1, col=1)
    others = ((2, "kappa", "kappa"), (3, "jitter_max_ms", "jitter"))
    for row, key, label in others:
        values = [float(report[key]) for report in reports]
        style = {"color": GREY, "shape": "hv" if row == 2 else "linear"}
        plot.add_scatter(x=time, y=values, name=label, line=style, row=row, col=1,
                         showlegend=False)  # fmt: skip
    plot.update_layout(layout(460, hovermode=False))
    titles = ((1, "relative phase [rad]"), (2, "κ [1]"), (3, "largest jitter [ms]"))
    for row, title in titles:
        plot.update_yaxes(row=row, col=1, **axis(title))
    plot.update_xaxes(row=3, col=1, **axis("time of the controller [s]"))
    page = plotly.io.to_html(plot, include_plotlyjs=True, div_id="ros-walk")
    picture = DOCS / "pictures" / "ros-walk.svg"
    picture.write_text(pictures(page)["ros-walk"], encoding="utf-8")
    note({USUAL}, picture)


if __name__ == "__main__":
    main()

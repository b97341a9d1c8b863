"""Run examples of the Modelica package with rumoca and draw what they show, as SVG.

python -m research.docs.modelica_pictures docs/pictures
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

import numpy as np
import plotly.graph_objects as go
import plotly.io
import rumoca
from plotly.subplots import make_subplots

from apnc.report.theme import GREY, axis, layout, leg_colours
from apnc_core.legs import leg_names
from research.docs import ROOT
from research.docs.pictures import pictures

LIBRARY = ROOT / "modelica"
LEGS = leg_names(4)
HALF_TURNS = {"tickvals": [0, np.pi], "ticktext": ["0", "π"], "range": [-1.7, 4.8]}


def simulated(example: str, duration: float) -> Any:
    """Result of ``Apnc.Examples.<example>``; the solver matters to RockingTrunk alone."""
    source = f"model Run\n  extends Apnc.Examples.{example};\nend Run;"
    model = rumoca.Session(roots=[str(LIBRARY)]).loads(source, model="Run")
    config = rumoca.SimConfig(solver="rk-like", rtol=1e-6, atol=1e-8, dt=1 / 60)
    return model.simulate(t=(0.0, duration), config=config)


def figure(result: Any, upper: str, title: str, until: float) -> go.Figure:
    """``controller.<upper>`` of every leg over the relative phases and kappa."""
    plot = make_subplots(rows=3, cols=1, shared_xaxes=True, row_heights=[0.45, 0.42, 0.13])
    time, colours = np.asarray(result.time), leg_colours(LEGS)
    shown = time <= until

    def draw(name: str, row: int, label: str, colour: str, **line: Any) -> None:
        line = {"color": colour, "width": 1.6} | line
        values = np.asarray(result[f"controller.{name}"], dtype=float)[shown]
        plot.add_scatter(x=time[shown], y=values, row=row, col=1, name=label, line=line,
                         showlegend=row == 1)  # fmt: skip

    for i, leg in enumerate(LEGS):
        # the legs of a diagonal lie on each other
        draw(f"{upper}[{i + 1}]", 1, leg, colours[leg], dash="solid" if i < 2 else "dot")
    for k, leg in enumerate(LEGS[1:]):
        draw(f"phi[{k + 1}]", 2, leg, colours[leg])
        draw(f"phi_memory[{k + 1}]", 2, leg, colours[leg], dash="dot", width=1)
    draw("kappa", 3, "kappa", GREY, shape="hv")
    plot.update_layout(layout(480, hovermode=False))
    for row, more in ((1, axis(title)), (2, axis("φ₁ₖ [rad]", **HALF_TURNS))):
        plot.update_yaxes(row=row, col=1, **more)
    plot.update_yaxes(row=3, col=1, **axis("κ", tickvals=[0, 1], range=[-0.2, 1.2]))
    plot.update_xaxes(**axis(""))
    plot.update_xaxes(row=3, col=1, **axis("time [s]"))
    return plot


def main(folder: Path) -> None:
    """Write ``modelica-recalled-gait.svg`` and ``modelica-formation.svg`` into ``folder``."""
    drawings = {
        "modelica-recalled-gait": figure(simulated("RecalledGait", 20.0), "o1", "o₁", 10.0),
        "modelica-formation": figure(
            simulated("FormationWithLoads", 30.0), "grf", "load [N]", 30.0
        ),
    }
    for name, drawing in drawings.items():
        page = plotly.io.to_html(drawing, include_plotlyjs=True, div_id=name)
        (folder / f"{name}.svg").write_text(pictures(page)[name], encoding="utf-8")


if __name__ == "__main__":
    main(Path(sys.argv[1]))

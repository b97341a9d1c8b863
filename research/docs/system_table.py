"""Measure ``docs/data/system_model.csv`` and write the tables of ``docs/system_model.md``.

``nice python -m research.docs.system_table [measure]``: without the word the tables are written
from the file. Every tool that is installed walks five seeds at three MI. Times are compared with
the direct loop of the same seed and MI, run just before: the machine may be busy.
"""

from __future__ import annotations

import csv
import statistics
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any, Final

import numpy as np
import plotly
from plotly.subplots import make_subplots

from apnc import Experiment, metrics
from apnc.loop.fmu_controller import FmuController
from apnc.loop.simulate import plant_of, simulate
from apnc.report import theme
from apnc.system.build import build_system
from build_fmu.build import host_fmu
from research.docs import DOCS, ROOT
from research.docs.pictures import pictures

HOSTS: Final = ROOT / "tests" / "support" / "system_hosts.py"
DATA: Final = DOCS / "data" / "system_model.csv"
PAGE: Final = DOCS / "system_model.md"

MIS: Final = (0.08, 0.15, 0.24)
SEEDS: Final = range(5)
SECONDS: Final = 20.0
TOOLS: Final = {
    "direct loop": "`apnc.simulate`, one process",
    "fmpy.ssp": "fmpy.ssp",
    "libcosim-osp": "libcosim, OSP file",
    "libcosim-ssp": "libcosim, SSP",
    "ecos": "Ecos",
    "container": "container FMU in FMPy",
    "omsimulator": "OMSimulator",
}
COUPLINGS: Final = {
    "load": "loads one tick late",
    "command": "commands one tick late",
    "both": "both one tick late",
    "1 ms": "both FMUs stepped by 1 ms, controller at 60 Hz",
}


def direct(mi: float, seed: int, coupling: str = "") -> dict[str, Any]:
    """A walk in one loop, with loads or commands late, or in steps of 1 ms."""
    experiment = Experiment(mi=mi, seed=seed, duration=SECONDS)
    if not coupling:
        record = simulate(experiment)
        o1, o2 = record.controller["o1"], record.controller["o2"]
        grf, position = record.plant["grf"], record.plant["position"]
        wall = record.wall_s
        return measured({"o1": o1, "o2": o2, "grf": grf, "position": position, "wall": wall})
    plant, Ts = plant_of(experiment), experiment.Ts
    parameters = {k: v for k, v in experiment.parameters().items() if v != ()}
    rows: list[list[Any]] = []
    trace = plant.trace()
    with FmuController(host_fmu(), parameters) as controller:
        h = 0.001 if coupling == "1 ms" else Ts
        load = plant.grf()
        hip, knee = controller.theta_hip.copy(), controller.theta_knee.copy()
        begin = time.perf_counter()
        for n in range(round(SECONDS / h)):
            felt = plant.grf()
            controller.step(
                n * h, h, load if coupling in ("load", "both") else felt, mi, 0.0, False
            )
            load = felt
            now = controller.theta_hip.copy(), controller.theta_knee.copy()
            plant.advance(*((hip, knee) if coupling in ("command", "both") else now), h)
            hip, knee = now
            if h == Ts or n * h >= len(rows) * Ts:
                here = controller.sample()
                rows.append([here["o1"], here["o2"], plant.grf()])
                trace.take()
        wall = time.perf_counter() - begin
    o1, o2, grf = (np.array(each) for each in zip(*rows, strict=True))
    position = trace.channels()["position"]
    return measured({"o1": o1, "o2": o2, "grf": grf, "position": position, "wall": wall})


def hosted(tool: str, folder: Path) -> dict[str, Any] | None:
    """A walk in another tool; ``None`` if it is not there."""
    out = folder.parent / "out.npz"
    out.unlink(missing_ok=True)
    command = [sys.executable, str(HOSTS), tool, str(folder), str(SECONDS), str(out)]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if not out.is_file():
        print(f"{tool}: {done.stderr.strip().splitlines()[-1:]}", file=sys.stderr)
        return None
    with np.load(out) as data:
        return measured(dict(data))


def measured(data: dict[str, Any]) -> dict[str, Any]:
    """Figures of a walk."""
    time_s = np.arange(len(data["o1"]), dtype=np.float64) * Experiment().Ts
    touch = metrics.touch_moment(data["grf"], Experiment().description.weight)
    target = metrics.default_target(4)
    assert target is not None
    convergence = metrics.convergence_time(time_s, data["o1"], data["o2"], touch, target)
    return {
        "convergence_time_s": "" if convergence is None else round(convergence, 3),
        "speed_m_per_s": round(float(metrics.path_length(data["position"]) / time_s[-1]), 5),
        "wall_s": round(float(data["wall"]), 3),
    }


def measure() -> Iterator[dict[str, Any]]:
    """All walks, one row each."""
    with tempfile.TemporaryDirectory() as name:
        for mi in MIS:
            for seed in SEEDS:
                cell = {"mi": mi, "seed": seed}
                yield {"tool": "direct loop", **cell, **direct(mi, seed)}
                for coupling in COUPLINGS:
                    yield {"tool": coupling, **cell, **direct(mi, seed, coupling)}
                archive = Path(name) / f"{mi}-{seed}" / "Lilibot.ssp"
                archive.parent.mkdir()
                folder = build_system(archive, Experiment(mi=mi, seed=seed, duration=SECONDS))
                for tool in list(TOOLS)[1:]:
                    row = hosted(tool, folder)
                    if row:
                        yield {"tool": tool, **cell, **row}


def table(rows: list[dict[str, str]], lines: dict[str, str], ratio: bool) -> str:
    """A table of the page."""
    heads = [f"MI {mi}: trot, time [s], speed [m/s]" for mi in MIS]
    head = ["tool" if ratio else "coupling", *heads, *(["time to the loop's"] if ratio else [])]
    text = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    walls = {(r["mi"], r["seed"]): float(r["wall_s"]) for r in rows if r["tool"] == "direct loop"}
    for tool, label in lines.items():
        own = [r for r in rows if r["tool"] == tool]
        if not own:
            continue
        cells = [label]
        for mi in MIS:
            here = [r for r in own if float(r["mi"]) == mi]
            times = [float(r["convergence_time_s"]) for r in here if r["convergence_time_s"]]
            speed = statistics.median(float(r["speed_m_per_s"]) for r in here)
            when = f"{min(times):.1f} ... {max(times):.1f}" if times else "none"
            cells.append(f"{len(times)} of {len(here)}, {when}, {speed:.3f}")
        if ratio:
            ratios = [float(r["wall_s"]) / walls[r["mi"], r["seed"]] for r in own]
            cells.append(f"{statistics.median(ratios):.1f}")
        text.append(f"| {' | '.join(cells)} |")
    return "\n".join(text)


def write_page(rows: list[dict[str, str]]) -> None:
    """Put both tables between their marks."""
    text = PAGE.read_text(encoding="utf-8")
    couplings = {"direct loop": "as on the robot: loads at n, commands from n on"} | COUPLINGS
    for mark, content in (
        ("tools", table(rows, TOOLS, ratio=True)),
        ("couplings", table(rows, couplings, ratio=False)),
    ):
        before, rest = text.split(f"<!-- {mark} -->\n")
        text = f"{before}<!-- {mark} -->\n{content}\n<!-- end -->{rest.split('<!-- end -->', 1)[1]}"
    PAGE.write_text(text, encoding="utf-8")


def draw(rows: list[dict[str, str]]) -> None:
    """Write ``system-tools.svg``: convergence time and speed of every walk, by tool."""
    plot = make_subplots(rows=2, cols=1, shared_xaxes=True, vertical_spacing=0.06)
    colours = (theme.BLUE, theme.ORANGE, theme.GREEN)
    for mi, colour in zip(MIS, colours, strict=True):
        here = [r for r in rows if float(r["mi"]) == mi and r["tool"] in TOOLS]
        tools = [TOOLS[r["tool"]].replace("`", "") for r in here]
        for row, column in ((1, "convergence_time_s"), (2, "speed_m_per_s")):
            values = [float(r[column]) if r[column] else None for r in here]
            look = {"color": colour, "size": 8, "symbol": ("circle", "diamond", "square")[row - 1]}
            plot.add_scatter(x=tools, y=values, mode="markers", marker=look, name=f"MI {mi:g}",
                             offsetgroup=str(mi), showlegend=row == 1, row=row, col=1)  # fmt: skip
    plot.update_layout(theme.layout(460, scattermode="group", hovermode="closest"))
    for row, title in ((1, "trot after [s]"), (2, "speed [m/s]")):
        plot.update_yaxes(row=row, col=1, **theme.axis(title, rangemode="tozero"))
    page = plotly.io.to_html(plot, include_plotlyjs=True, div_id="system-tools")
    picture = pictures(page)["system-tools"]
    (DOCS / "pictures" / "system-tools.svg").write_text(picture, encoding="utf-8")


def main() -> None:
    """Measure if asked to, and write the page and its picture."""
    if "measure" in sys.argv[1:]:
        with DATA.open("w", encoding="utf-8", newline="") as file:
            writer: csv.DictWriter[str] | None = None
            for row in measure():
                if writer is None:
                    writer = csv.DictWriter(file, list(row), lineterminator="\n")
                    writer.writeheader()
                writer.writerow(row)
                file.flush()
                print(row)
    with DATA.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    write_page(rows)
    draw(rows)


if __name__ == "__main__":
    main()

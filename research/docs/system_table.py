"""Measure ``docs/data/system_model.csv`` and write the tables of ``docs/system_model/delays.md``.

``nice python -m research.docs.system_table [measure]``: without the word the tables are written
from the file. Every tool that is installed walks five seeds at three MI, and a loop with the delays
of tools walks twenty. Times are compared with the direct loop of the same seed and MI, run just
before: the machine may be busy.
"""

from __future__ import annotations

import csv
import importlib.metadata
import statistics
import subprocess
import sys
import tempfile
import time
import zipfile
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any, Final, NamedTuple

import numpy as np
import plotly
from plotly.subplots import make_subplots

from apnc import Experiment, metrics, simulate
from apnc.report import theme
from apnc.system.build import build_system
from apnc.system.structure import Structure, structure_of
from research.docs import DOCS, ROOT
from research.docs.manifest import USUAL, note
from research.docs.pictures import pictures

SUPPORT: Final = ROOT / "tests" / "support"
sys.path.insert(0, str(SUPPORT))

from coupled_loop import walk  # noqa: E402  # it lies with the tests

HOSTS: Final = SUPPORT / "system_hosts.py"
HOST_IN_C: Final = ROOT / "examples" / "host" / "host.c"
DATA: Final = DOCS / "data" / "system_model.csv"
PAGE: Final = DOCS / "system_model" / "delays.md"

MIS: Final = (0.08, 0.15, 0.24)
TOOLS_SEEDS: Final = range(5)
COUPLINGS_SEEDS: Final = range(20)
SECONDS: Final = 20.0
DIRECT: Final = "direct loop"
IN_C: Final = "host.c"


class Tool(NamedTuple):
    """A tool as the table shows it."""

    label: str
    package: str
    takes: str
    delay: str


LATE: Final = "commands, 1 tick"
TOOLS: Final = {
    DIRECT: Tool("`apnc.simulate`", "apnc", "", "none"),
    IN_C: Tool("`examples/host/host.c`", "", "folder, FMUs unpacked", "none"),
    "container": Tool(
        "FMU container, in FMPy", "fmu_manipulation_toolbox", "folder, container.json", "none"
    ),
    "container-ssp": Tool("FMU container, in FMPy", "fmu_manipulation_toolbox", "SSP", LATE),
    "ecos": Tool("Ecos, Python or its program", "ecospy", "SSP", LATE),
    "libcosim-osp": Tool("libcosim", "libcosimpy", "folder, OSP file", LATE),
    "libcosim-ssp": Tool("libcosim", "libcosimpy", "folder, SSP file", LATE),
    "fmpy.ssp": Tool("fmpy.ssp", "fmpy", "SSP", LATE),
    "omsimulator": Tool("OMSimulator", "OMSimulator", "SSP", ""),
}


class Coupling(NamedTuple):
    """A way to connect both FMUs, and what ``coupled_loop.walk`` calls it."""

    label: str
    how: Mapping[str, Any]


COUPLINGS: Final = {
    "in order": Coupling("none: the controller steps first, as on the robot", {}),
    "commands": Coupling("commands 1 tick: both step side by side", {"commands": 1}),
    "loads": Coupling("loads 1 tick", {"loads": 1}),
    "both": Coupling("loads and commands 1 tick each", {"loads": 1, "commands": 1}),
    "two": Coupling("commands 2 ticks", {"commands": 2}),
    "1 ms": Coupling("commands 1 ms: steps of 1 ms, controller at 60 Hz",
                     {"commands": 1, "step": 0.001}),
}  # fmt: skip


def direct(experiment: Experiment) -> dict[str, Any]:
    """A walk in one process."""
    record = simulate(experiment)
    found = {name: record.signals[name] for name in ("o1", "o2", "grf", "position")}
    return measured(found, record.wall_s)


def coupled(folder: Path, structure: Structure, how: Mapping[str, Any]) -> dict[str, Any]:
    """A walk in a loop with delays."""
    begin = time.perf_counter()
    found = walk(folder, structure, SECONDS, **how)
    every = round(1 / 60 / how.get("step", 1 / 60))
    ticks = np.rint(np.arange(SECONDS * 60) * len(found["o1"]) / (SECONDS * 60)).astype(int)
    found = {name: values[ticks] if every > 1 else values for name, values in found.items()}
    return measured(found, time.perf_counter() - begin)


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
        found = dict(data)
    return measured(found, float(found.pop("wall")))


def in_c(folder: Path, experiment: Experiment) -> dict[str, Any]:
    """The direct loop's walk as ``examples/host`` gives it, with the time of the whole program."""
    for file in (folder / "resources").glob("*.fmu"):
        with zipfile.ZipFile(file) as archive:
            archive.extractall(file.with_suffix(""))
    headers = [f"-I{folder}", f"-I{folder / 'resources' / 'Apnc' / 'sources'}"]
    program = folder / "host"
    command = ["gcc", "-O2", *headers, str(HOST_IN_C), "-o", str(program), "-ldl"]
    subprocess.run(command, check=True)
    begin = time.perf_counter()
    done = subprocess.run(
        [str(program), str(folder), str(SECONDS)], capture_output=True, text=True, check=True
    )
    wall = time.perf_counter() - begin
    places = [float(line.split()[1]) for line in done.stdout.splitlines()[1:]]
    if places != simulate(experiment).signals["position"][:, 0].tolist():
        raise AssertionError("examples/host walks elsewhere than the direct loop")
    return direct(experiment) | {"wall_s": round(wall, 4)}


def measured(data: dict[str, Any], wall: float) -> dict[str, Any]:
    """Figures of a walk."""
    time_s = np.arange(len(data["o1"]), dtype=np.float64) * Experiment().Ts
    touch = metrics.touch_moment(data["grf"], Experiment().description.weight)
    target = metrics.default_target(4)
    assert target is not None
    convergence = metrics.convergence_time(time_s, data["o1"], data["o2"], touch, target)
    return {
        "convergence_time_s": "" if convergence is None else round(convergence, 3),
        "speed_m_per_s": round(float(metrics.path_length(data["position"]) / time_s[-1]), 5),
        "wall_s": round(wall, 4),
    }


def measure() -> Iterator[dict[str, Any]]:
    """All walks, one row each."""
    with tempfile.TemporaryDirectory() as name:
        for mi in MIS:
            for seed in COUPLINGS_SEEDS:
                experiment = Experiment(mi=mi, seed=seed, duration=SECONDS, engine="compiled")
                folder = Path(name) / f"{mi}-{seed}" / "Lilibot"
                folder.parent.mkdir()
                build_system(folder.with_suffix(".ssp"), experiment)
                structure, cell = structure_of(experiment), {"mi": mi, "seed": seed}
                for coupling, (_, how) in COUPLINGS.items():
                    row = coupled(folder, structure, how)
                    yield {"tool": f"coupling {coupling}", **cell, **row}
                if seed not in TOOLS_SEEDS:
                    continue
                direct(experiment)  # the first loads the library
                yield {"tool": DIRECT, **cell, **direct(experiment)}
                yield {"tool": IN_C, **cell, **in_c(folder, experiment)}
                for tool in list(TOOLS)[2:]:
                    if found := hosted(tool, folder):
                        yield {"tool": tool, **cell, **found}


def version(package: str) -> str:
    """Version of a package, or nothing."""
    try:
        return importlib.metadata.version(package) if package else ""
    except importlib.metadata.PackageNotFoundError:
        return ""


def tools_table(rows: list[dict[str, str]]) -> str:
    """What each tool takes, what delay it adds, and what it costs."""
    head = ["tool", "version", "takes", "delay it adds", "trot", "speed [m/s]", "us a tick",
            "time over the direct loop's"]  # fmt: skip
    text = [f"| {' | '.join(head)} |", "|---" * len(head) + "|"]
    walls = {(r["mi"], r["seed"]): float(r["wall_s"]) for r in rows if r["tool"] == DIRECT}
    for name, tool in TOOLS.items():
        own = [r for r in rows if r["tool"] == name]
        if not own:
            continue
        trots = sum(bool(r["convergence_time_s"]) for r in own)
        speeds = [f"{median(own, mi, 'speed_m_per_s'):.3f}" for mi in MIS]
        ratios = [float(r["wall_s"]) / walls[r["mi"], r["seed"]] for r in own]
        us = statistics.median(float(r["wall_s"]) for r in own) / (SECONDS * 60) * 1e6
        cells = [tool.label, version(tool.package), tool.takes, tool.delay,
                 f"{trots} of {len(own)}", ", ".join(speeds), f"{us:.3g}",
                 f"{statistics.median(ratios):.2g}"]  # fmt: skip
        text.append(f"| {' | '.join(cells)} |")
    return "\n".join(text)


def couplings_table(rows: list[dict[str, str]]) -> str:
    """What a delay costs."""
    heads = [f"MI {mi}: trot, time [s], speed [m/s]" for mi in MIS]
    text = [f"| delay | {' | '.join(heads)} |", "|---" * (1 + len(MIS)) + "|"]
    for name, coupling in COUPLINGS.items():
        own = [r for r in rows if r["tool"] == f"coupling {name}"]
        cells = [coupling.label]
        for mi in MIS:
            here = [r for r in own if float(r["mi"]) == mi]
            times = [float(r["convergence_time_s"]) for r in here if r["convergence_time_s"]]
            low, mid, high = np.percentile(times, (10, 50, 90)) if times else (0, 0, 0)
            cells.append(f"{len(times)} of {len(here)}, {mid:.1f} ({low:.1f} ... {high:.1f}), "
                         f"{median(own, mi, 'speed_m_per_s'):.3f}")  # fmt: skip
        text.append(f"| {' | '.join(cells)} |")
    return "\n".join(text)


def median(rows: list[dict[str, str]], mi: float, column: str) -> float:
    """Median of a column at one MI."""
    return statistics.median(float(r[column]) for r in rows if float(r["mi"]) == mi)


def write_page(rows: list[dict[str, str]]) -> None:
    """Put both tables between their marks."""
    text = PAGE.read_text(encoding="utf-8")
    for mark, content in (("tools", tools_table(rows)), ("couplings", couplings_table(rows))):
        before, rest = text.split(f"<!-- {mark} -->\n")
        text = f"{before}<!-- {mark} -->\n{content}\n<!-- end -->{rest.split('<!-- end -->', 1)[1]}"
    PAGE.write_text(text, encoding="utf-8")


def draw(rows: list[dict[str, str]]) -> None:
    """Write ``system-tools.svg``: convergence time and speed of every walk, by delay."""
    plot = make_subplots(rows=2, cols=1, shared_xaxes=True, vertical_spacing=0.06)
    colours = (theme.BLUE, theme.ORANGE, theme.GREEN)
    for mi, colour in zip(MIS, colours, strict=True):
        for row, column in ((1, "convergence_time_s"), (2, "speed_m_per_s")):
            here = [r for r in rows if r["tool"].startswith("coupling") and float(r["mi"]) == mi]
            names = [COUPLINGS[r["tool"].removeprefix("coupling ")].label.split(":")[0]
                     for r in here]  # fmt: skip
            values = [float(r[column]) if r[column] else None for r in here]
            look = {"color": colour, "size": 6, "symbol": ("circle", "diamond")[row - 1]}
            plot.add_scatter(x=names, y=values, mode="markers", marker=look, name=f"MI {mi:g}",
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
        note({USUAL}, DATA)
    with DATA.open(encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    write_page(rows)
    draw(rows)


if __name__ == "__main__":
    main()

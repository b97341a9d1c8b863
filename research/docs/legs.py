"""Measure ``docs/data/legs_*.csv``, write their tables and draw the picture of ``docs/legs.md``.

``nice python -m research.docs.legs [measure [PROCESSES]]``: without the word tables and picture are
made from the files. Every number of the robots is taken from their files: run it again after one
has changed. Measuring takes about three minutes of one core.
"""

from __future__ import annotations

import csv
import sys
from collections import Counter
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any, Final

import numpy as np
import plotly.io
from plotly.subplots import make_subplots

from apnc import Experiment, metrics
from apnc.loop.simulate import plant_of, simulate
from apnc.report import theme
from apnc.studies.robots import symmetric
from apnc.studies.table import markdown
from apnc_plant.plant import Plant
from apnc_plant.robot import load_robot
from research.docs import DOCS
from research.docs.manifest import note
from research.docs.pictures import pictures
from research.docs.put_table import put
from research.modes.gaits import CANDIDATES, gait_of
from research.modes.returns import parameters_of, release, return_map
from research.modes.stance import patterns, stance_of
from research.modes.trunk import SpringTrunk

MAPS: Final = DOCS / "data" / "legs_multipliers.csv"
RUNS: Final = DOCS / "data" / "legs_runs.csv"

ROBOTS: Final = ("lilibot", "hexapod")
PLANTS: Final = ("reduced", "full")
MIS: Final = (0.08, 0.15, 0.20)
SEEDS: Final = 10
SECONDS: Final = 25.0

Row = dict[str, Any]


def plant(which: str, experiment: Experiment) -> Plant:
    """The reduced or the full plant of an experiment, at its start."""
    if which == "full":
        return plant_of(experiment)
    return SpringTrunk(experiment.description, experiment.seed)


def mapped(robot: str, which: str, mi: float, gait: str) -> Row:
    """Multipliers of a gait, on the robot with its mass in the middle and sensors without noise."""
    even = symmetric(load_robot(robot))
    experiment = Experiment(robot=even, mi=mi)
    loop = release(lambda: plant(which, experiment), parameters_of(experiment), mi)
    phases = CANDIDATES[len(even.legs)][gait]
    found = return_map(loop, phases)
    if np.isnan(found.orbit):  # gone within a cycle: look closer
        found = return_map(loop, phases, push=0.04)
    return {
        "robot": robot, "plant": which, "mi": mi, "gait": gait, "holds": int(found.holds),
        "multipliers": " ".join(f"{value:.2f}" for value in found.multipliers),
        "orbit_rad": f"{found.orbit:.2f}",
    }  # fmt: skip


def walked(robot: str, which: str, mi: float, seed: int) -> Row:
    """The gait in which a run without couplings ends."""
    experiment = Experiment(robot=robot, mi=mi, seed=seed, duration=SECONDS, controller="apc")
    record = simulate(experiment, plant=plant(which, experiment))
    o1, o2 = record.signals["o1"], record.signals["o2"]
    phases = metrics.final_phases(o1, o2, experiment.Ts)
    return {
        "robot": robot, "plant": which, "mi": mi, "seed": seed, "end": str(record.end),
        "gait": gait_of(phases), "phases_rad": " ".join(f"{value:.2f}" for value in phases),
    }  # fmt: skip


def measure(processes: int) -> None:
    """Write both files, a row as soon as it is there."""
    places = [(robot, which, mi) for robot in ROBOTS for which in PLANTS for mi in MIS]
    gaits = {robot: CANDIDATES[len(load_robot(robot).legs)] for robot in ROBOTS}
    maps = [(*place, gait) for place in places for gait in gaits[place[0]]]
    runs = [(*place, seed) for place in places for seed in range(SEEDS)]
    with ProcessPoolExecutor(processes) as pool:
        write(RUNS, pool.map(walked, *zip(*runs, strict=True)))
        write(MAPS, pool.map(mapped, *zip(*maps, strict=True)))
    note(ROBOTS, RUNS, MAPS)


def write(path: Path, rows: Iterable[Row]) -> None:
    """Write rows as CSV, and show them."""
    with path.open("w", encoding="utf-8", newline="") as file:
        writer: csv.DictWriter[str] | None = None
        for row in rows:
            if writer is None:
                writer = csv.DictWriter(file, list(row), lineterminator="\n")
                writer.writeheader()
            writer.writerow(row)
            file.flush()
            print(*row.values(), flush=True)


def read(path: Path) -> list[Row]:
    """Rows of a file."""
    with path.open(encoding="utf-8") as file:
        return list(csv.DictReader(file))


def at(rows: list[Row], **place: Any) -> list[Row]:
    """Rows with these values."""
    return [row for row in rows if all(row[name] == str(value) for name, value in place.items())]


def largest(row: Row) -> float:
    """The largest multiplier, nan if there is none."""
    return float(row["multipliers"].split()[0])


def multipliers(maps: list[Row], robot: str) -> str:
    """Table of multipliers: a gait per row, the largest two and how far off the orbit is."""

    def cell(row: Row) -> str:
        if np.isnan(largest(row)):
            return "gone"
        off = float(row["orbit_rad"])
        where = f"{off:.1f}" if off < np.pi else "none"
        text = f"{', '.join(row['multipliers'].split()[:2])}; {where}"
        return f"**{text}**" if row["holds"] == "1" else text

    gaits = dict.fromkeys(row["gait"] for row in at(maps, robot=robot))
    return markdown(
        {"gait": gait}
        | {
            f"{which}, MI {mi:g}": cell(at(maps, robot=robot, plant=which, mi=mi, gait=gait)[0])
            for which in PLANTS
            for mi in MIS
        }
        for gait in gaits
    )


def predictions(maps: list[Row], runs: list[Row]) -> str:
    """Table of the gaits that are predicted to hold beside those in which runs end."""
    lines = []
    for robot in ROBOTS:
        for which in PLANTS:
            for mi in MIS:
                place = {"robot": robot, "plant": which, "mi": mi}
                held = [row["gait"] for row in at(maps, **place) if row["holds"] == "1"]
                ended = Counter(row["gait"] for row in at(runs, **place)).most_common()
                lines.append(
                    {"robot": robot, "plant": which, "MI": f"{mi:g}"}
                    | {"multipliers let hold": ", ".join(held) or "none"}
                    | {"runs end in": ", ".join(f"{gait} {count}" for gait, count in ended)}
                )
    return markdown(lines)


def write_page(maps: list[Row], runs: list[Row]) -> None:
    """Put the tables below their marks."""
    page = DOCS / "legs" / "multipliers.md"
    text = page.read_text(encoding="utf-8")
    text = put(text, "legs-predictions", predictions(maps, runs))
    for robot in ROBOTS:
        text = put(text, f"legs-{robot}", multipliers(maps, robot))
    page.write_text(text, encoding="utf-8")


PITCH_CM: Final = 52.0
"""From one robot to the next in a panel."""

GONE: Final = 20.0
"""Where a gait is drawn that is gone within a cycle."""

LOOKS: Final = [
    (which, mi, symbol, colour)
    for which, symbol in zip(PLANTS, ("square", "circle"), strict=True)
    for mi, colour in zip(MIS, (theme.BLUE, theme.ORANGE, theme.GREEN), strict=True)
]


class Panel:
    """A column of the picture: one robot."""

    def __init__(self, plot: Any, column: int, robot: str) -> None:
        """Draw into a column of a plot."""
        self._plot, self._column, self._robot = plot, column, robot
        self._stance = stance_of(symmetric(load_robot(robot)))
        self._n = len(self._stance.x)

    def _add(self, row: int, **trace: Any) -> None:
        self._plot.add_scatter(**{"showlegend": False} | trace, row=row, col=self._column)

    def _feet(
        self, row: int, middle: float, title: str, text: Sequence[str], **marker: Any
    ) -> None:
        """Feet and centre of mass seen from above, nose up [cm]."""
        half, ink = self._n // 2, {"size": 11, "color": theme.INK}
        right, ahead = middle - 100.0 * self._stance.y, 100.0 * self._stance.x
        round_trip = [*range(half), *reversed(range(half, self._n)), 0]
        edge = {"color": theme.GREY, "width": 1}
        self._add(row, x=right[round_trip], y=ahead[round_trip], mode="lines", line=edge)
        cross = {"symbol": "cross-thin", "size": 9, "line": {"width": 1.5, "color": theme.INK}}
        self._add(row, x=[middle], y=[0.0], mode="markers", marker=cross)
        marker |= {"opacity": 1.0, "line": {"color": theme.INK, "width": 1.2}}
        sides = ["middle right"] * half + ["middle left"] * half
        self._add(row, x=right, y=ahead, mode="markers+text", marker=marker, text=text,
                  textfont=ink, textposition=sides)  # fmt: skip
        self._add(row, x=[middle], y=[27.0], mode="text", text=[title],
                  textfont={"size": 12, "color": theme.INK})  # fmt: skip

    def carries(self, row: int) -> None:
        """Which feet carry what in each half cycle of the gait expected of so many legs."""
        gait = np.concatenate([[0.0], metrics.default_target(self._n) or ()])
        for place, half in enumerate(("first", "second")):
            down = [int(leg) for leg in np.flatnonzero((-1.0) ** place * np.cos(gait) > 0.0)]
            share = np.zeros(self._n)
            share[down] = 1.0 / len(down)  # two legs on a diagonal
            if len(down) > 2:
                share = self._stance.carried(down) / self._stance.weight
            colour = [theme.INK if leg in down else "#ffffff" for leg in range(self._n)]
            text = [f"{100.0 * part:.0f} %" if part else "" for part in share]
            title = f"{metrics.gait_name(self._n)}, {half} half cycle"
            self._feet(row, (place - 0.5) * 1.5 * PITCH_CM, title, text, size=14, color=colour)

    def felt(self, row: int) -> None:
        """Patterns of leg lengths that the trunk cannot follow, and how much of each is load."""
        stiff, loads = self._stance.stiffness, self._stance.loads()
        named = list(patterns(self._n).items())[3:]
        for place, (name, pattern) in enumerate(named):
            middle = (place - 0.5 * (len(named) - 1)) * PITCH_CM
            share = pattern @ loads @ pattern / (pattern @ (stiff * pattern))
            sizes = 4.0 + 18.0 * np.sqrt(np.abs(pattern) / np.abs(pattern).max())
            signs = np.sign(pattern.round(6)).astype(int)
            sign = [("#ffffff", theme.BLUE, theme.ORANGE)[each] for each in signs]
            text = [("0", "+", "\u2212")[each] for each in signs]
            title = f"{name}, {100.0 * share:.0f} % load"
            self._feet(row, middle, title, text, size=sizes, color=sign)

    def marks(
        self,
        row: int,
        rows: list[Row],
        value: Callable[[Row], float | None],
        filled: Callable[[Row], bool],
    ) -> None:
        """A marker per gait, MI and plant."""
        for which, mi, symbol, colour in LOOKS:
            here = at(rows, robot=self._robot, plant=which, mi=mi)
            inside = [colour if filled(each) else "#ffffff" for each in here]
            marker = {"symbol": symbol, "size": 9, "color": inside, "opacity": 1.0}
            self._add(row, x=[each["gait"] for each in here], y=[value(each) for each in here],
                      mode="markers", offsetgroup=f"{which} {mi}",
                      marker=marker | {"line": {"color": colour, "width": 1.8}})  # fmt: skip


def shares(runs: list[Row], gaits: list[str], robot: str) -> list[Row]:
    """Share [%] of runs that end in each gait, by plant and MI."""
    found: list[Row] = []
    for which, mi, *_ in LOOKS:
        here = [row["gait"] for row in at(runs, robot=robot, plant=which, mi=mi)]
        place = {"robot": robot, "plant": which, "mi": str(mi)}
        found += [{**place, "gait": gait, "share": 100.0 * here.count(gait) / len(here)}
                  for gait in gaits]  # fmt: skip
    return found


def draw(maps: list[Row], runs: list[Row]) -> None:
    """Write ``legs.svg``: who carries, what feet feel, multipliers, and where runs end."""
    plot = make_subplots(rows=4, cols=2, row_heights=[0.19, 0.19, 0.38, 0.24],
                         vertical_spacing=0.05, horizontal_spacing=0.08,
                         column_titles=list(ROBOTS))  # fmt: skip
    for column, robot in enumerate(ROBOTS, start=1):
        panel = Panel(plot, column, robot)
        panel.carries(1)
        panel.felt(2)
        gaits = [*dict.fromkeys(row["gait"] for row in at(maps, robot=robot)), "other"]
        panel.marks(3, maps, lambda row: np.fmin(largest(row), GONE),
                    lambda row: row["holds"] == "1")  # fmt: skip
        panel.marks(
            4, shares(runs, gaits, robot), lambda row: row["share"] or None, lambda row: True
        )
        for row in (1, 2):
            plot.update_xaxes(row=row, col=column, visible=False, range=[-80, 80])
            alike = ("x", "x2", "x3", "x4")[2 * row + column - 3]
            plot.update_yaxes(row=row, col=column, visible=False, range=[-20, 31],
                              scaleanchor=alike)  # fmt: skip
        common = theme.axis("", categoryarray=gaits, categoryorder="array")
        for row in (3, 4):
            plot.update_xaxes(
                row=row,
                col=column,
                **common,
                range=[-0.5, len(gaits) - 0.5],
                tickvals=gaits,
                tickangle=0,
                tickfont={"size": 10},
                ticktext=[name.replace(" wave of ", "<br>") for name in gaits],
            )
        one = {"color": theme.INK, "width": 1.2, "dash": "dash"}
        plot.add_hline(y=1.0, row=3, col=column, line=one)
    for which, mi, symbol, colour in LOOKS:
        key = {"symbol": symbol, "size": 9, "color": colour}
        plot.add_scatter(x=[None], y=[None], mode="markers", name=f"{which} plant, MI {mi:g}",
                         marker=key, row=3, col=1)  # fmt: skip
    ticks = [0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, GONE]
    names = [*(f"{tick:g}" for tick in ticks[:-1]), "gone"]
    reach = [np.log10(0.15), np.log10(1.3 * GONE)]
    plot.update_yaxes(
        row=3, **theme.axis("", type="log", range=reach, tickvals=ticks, ticktext=names)
    )
    plot.update_yaxes(row=4, **theme.axis("", range=[-8, 108]))
    plot.update_yaxes(row=3, col=1, title="largest multiplier per cycle [1]")
    plot.update_yaxes(row=4, col=1, title="runs that end in it [%]")
    plot.update_layout(theme.layout(1000, scattermode="group", hovermode=False))
    plot.update_layout(
        legend={"y": -0.04, "yanchor": "top", "entrywidth": 190}, margin={"t": 30, "b": 90}
    )
    page = plotly.io.to_html(plot, include_plotlyjs=True, div_id="legs")
    (DOCS / "pictures" / "legs.svg").write_text(pictures(page)["legs"], encoding="utf-8")


def main(words: list[str]) -> None:
    """Measure if asked to, and write the page and its picture."""
    if words[:1] == ["measure"]:
        measure(int(words[1]) if len(words) > 1 else 1)
    maps, runs = read(MAPS), read(RUNS)
    write_page(maps, runs)
    draw(maps, runs)


if __name__ == "__main__":
    main(sys.argv[1:])

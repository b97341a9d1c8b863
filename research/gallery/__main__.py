"""``python -m research.gallery``: import, tune, measure, fmu, film, page."""

from __future__ import annotations

import shutil
import subprocess
import sys
import time
from collections.abc import Sequence
from functools import partial
from pathlib import Path
from typing import Annotated, Any

import typer
from rich.progress import Progress, TaskID
from typer import Option

from apnc.cli.console import say, writable
from apnc.cli.main import main as run_app
from apnc.importing import ModelFileError, import_robot
from apnc.studies.machine import commit, processor
from apnc_plant.robot import load_robot
from apnc_plant.robot.size import mean_leg_length
from research.docs import DOCS
from research.docs.manifest import USUAL, note
from research.gallery import films, fmus, page, store
from research.gallery.by_hand import text_by_hand
from research.gallery.measure import FIRST_SEED, Walk, walks
from research.gallery.robots import GalleryRobot, model_of, robots

app = typer.Typer(
    add_completion=False, pretty_exceptions_enable=False, rich_markup_mode=None, help=__doc__
)

Only = Annotated[list[str] | None, Option("--only", help="Name of a robot; may be given again.")]
Robots = Annotated[Path, Option("--robots", help="Folder of robot files.")]
Workers = Annotated[int, Option("--workers", min=1, help="Number of threads or processes.")]
PICTURES = DOCS / "pictures" / "robots"
PAGE = DOCS / "robots" / "gallery.md"


@app.command("import")
def read(
    output: Annotated[Path, Option(help="Folder for the robot files.")], only: Only = None
) -> None:
    """Read every robot of the gallery from its model file.

    Without --only, robots of repositories that are not there are left out.
    """
    writable(output)
    for robot in robots(only or ()):
        try:
            path, version = model_of(robot)
        except ValueError as error:
            if only or not robot.repository:
                raise
            say(f"{robot.title} is left out: {error}", error=True)
            continue
        begin = time.perf_counter()
        try:
            found = import_robot(path, robot.pose or None)
        except ModelFileError as error:
            store.add_note(output, robot.name, {"version": version, "refused": str(error)})
            say(f"{robot.title}: {error}")
            continue
        target = output / f"{robot.name}.toml"
        target.write_text(found.toml, encoding="utf-8")
        if robot.by_hand is not None:
            target.write_text(text_by_hand(target, robot.by_hand), encoding="utf-8")
        store.add_note(output, robot.name, {"version": version})
        say(f"{robot.title}: {found.robot.mass:.2f} kg, {time.perf_counter() - begin:.1f} s")


@app.command()
def tune(
    robots_in: Robots,
    output: Annotated[Path, Option(help="Folder for the tuned robot files.")],
    minutes: Annotated[float, Option(help="Longest search for each robot [min].")] = 10.0,
    seed: Annotated[int, Option(help="Of every search.")] = 1,
    workers: Workers = 2,
    only: Only = None,
) -> None:
    """Tune robots by ``apnc tune``, one after the other. Those that are tuned already are kept.

    Robots with numbers that were set by hand are copied.
    """
    writable(output)
    known = store.notes_in(robots_in)
    for robot in _there(robots_in, only):
        target = output / f"{robot.name}.toml"
        if target.exists():
            say(f"{robot.title}: kept {target}")
            continue
        source = robots_in / target.name
        if robot.by_hand is not None:
            shutil.copyfile(source, target)
            store.add_note(output, robot.name, known.get(robot.name, {}))
            say(f"{robot.title}: as it was set by hand")
            continue
        command = ["tune", str(source), "--minutes", f"{minutes:g}", "--output", str(target)]
        command += ["--seed", str(seed), "--workers", str(workers)]
        say(f"{robot.title}: apnc {' '.join(command)}")
        begin = time.perf_counter()
        done = subprocess.run([sys.executable, "-m", "apnc", *command], check=False)
        if done.returncode != 0 or not target.exists():
            raise ValueError(f"apnc tune of {robot.name} ended with {done.returncode}")
        took = (time.perf_counter() - begin) / 60.0
        store.add_note(output, robot.name, known.get(robot.name, {}) | {"minutes": took})
    for name, about in known.items():
        if "refused" in about:
            store.add_note(output, name, about)


@app.command()
def measure(
    robots_in: Robots,
    seeds: Annotated[int, Option(min=1, help="Walks at each MI with each controller.")] = 20,
    workers: Workers = 2,
    only: Only = None,
) -> None:
    """Measure robots on fresh seeds; write docs/data/gallery.csv.gz and docs/data/gallery.json.

    With --only, what is stored of the other robots is kept, and so is the commit of the whole.
    """
    chosen = _there(robots_in, only)
    about: dict[str, Any] = {"robots": {}, "refused": {}}
    found: dict[str, list[Walk]] = {}
    if only and store.WALKS.exists():
        about = store.read_json(store.ABOUT)
        for walk in store.read_walks(store.WALKS):
            found.setdefault(walk.robot, []).append(walk)
    known = store.notes_in(robots_in)
    with Progress() as progress:
        for robot in chosen:
            file = robots_in / f"{robot.name}.toml"
            description = load_robot(file)
            shown = partial(_show, progress, progress.add_task(robot.title))
            found[robot.name] = walks(
                robot.name, description, seeds, workers,
                shown,
            )  # fmt: skip
            about["robots"][robot.name] = {
                "mass": description.mass,
                "leg_length": mean_leg_length(description),
                "rate": description.rate,
                "commit": commit(),
                **known.get(robot.name, {}),
                **store.searches_of(file),
            }
    about["refused"] |= {n: each["refused"] for n, each in known.items() if "refused" in each}
    about["refused"] = {n: why for n, why in about["refused"].items() if n not in found}
    about |= {"processor": processor(), "seeds": seeds, "first_seed": FIRST_SEED}
    if not (only and "commit" in about):
        about["commit"] = commit()
    names = [robot.name for robot in robots()]
    store.write_walks(store.WALKS, [walk for name in names for walk in found.get(name, [])])
    store.write_json(store.ABOUT, about)
    note({USUAL}, store.WALKS, "gallery", at=commit())
    for robot in chosen:
        say(f"{robot.title}: misses {'; '.join(page.missed(found[robot.name])) or 'nothing'}")


@app.command("fmu")
def write_fmus(
    robots_in: Robots,
    output: Annotated[Path, Option(help="Folder for the FMUs.")],
    only: Only = None,
) -> None:
    """Build the FMU of every measured robot and walk it; add that to docs/data/gallery.json."""
    writable(output)
    about = store.read_json(store.ABOUT)
    for robot in _there(robots_in, only):
        file = robots_in / f"{robot.name}.toml"
        found = fmus.fmu_of(file, output / f"{robot.name}.fmu")
        about["robots"][robot.name]["fmu"] = found
        store.write_json(store.ABOUT, about)
        say(f"{robot.title}: {found}")


@app.command()
def film(robots_in: Robots, only: Only = None) -> None:
    """Draw a film of every robot into docs/pictures/robots."""
    for robot in _there(robots_in, only):
        try:
            films.film(
                robot.title, load_robot(robots_in / f"{robot.name}.toml"),
                PICTURES / f"{robot.name}.webp",
            )  # fmt: skip
        except ValueError as error:
            say(str(error), error=True)


@app.command("page")
def write_page() -> None:
    """Write docs/robots/gallery.md from what was measured and filmed."""
    about, found = store.read_json(store.ABOUT), store.read_walks(store.WALKS)
    PAGE.write_text(page.text(robots(), about, found, PICTURES), encoding="utf-8")


def _show(progress: Progress, bar: TaskID, done: int, total: int) -> None:
    progress.update(bar, completed=done, total=total)


def _there(folder: Path, only: Sequence[str] | None) -> list[GalleryRobot]:
    """Robots of the gallery that have a file in a folder.

    Raises:
        ValueError: none has, or one that was named has not.
    """
    found = [robot for robot in robots(only or ()) if (folder / f"{robot.name}.toml").is_file()]
    if not found or (only and len(found) < len(set(only))):
        raise ValueError(f"{folder} lacks {' '.join(only or ()) or 'robots of the gallery'}")
    return found


if __name__ == "__main__":
    run_app(program="python -m research.gallery", load=lambda: app)

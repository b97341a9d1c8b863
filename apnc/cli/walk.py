"""``apnc walk``: an experiment from the options of the command line, its run and its folder."""
# ruff: noqa: PLC0415  # what takes seconds to import waits until it is needed

from __future__ import annotations

import importlib.util
import math
from collections.abc import Mapping
from dataclasses import fields, replace
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final

import typer
from typer import Option

import apnc
from apnc.cli import completion as complete
from apnc.cli.browser import open_page
from apnc.cli.console import (
    apart,
    bar,
    file_option,
    given,
    say,
    say_file,
    show_table,
    status,
    writable,
)
from apnc.cli.film import film_of, film_walk
from apnc.cli.interrupt import NOTHING, STOP, Interrupted
from apnc.cli.live import check_view, viewed
from apnc.controllers import CONTROLLERS
from apnc.extras import install_command
from apnc.loop.push import parse_pushes
from apnc.loop.schedule import parse_schedule
from apnc.report import RUN_FILES
from apnc_core.enumerations import Method
from apnc_plant.conditions import CONDITIONS

if TYPE_CHECKING:
    from apnc.loop.experiment import Experiment
    from apnc.loop.simulate import Shown
    from apnc_plant.ground import Ground

ENDED_EARLY: Final = 1
"""Exit code of a run that fell or diverged."""

_SCHEDULES: Final = (
    ("mi", "mi", float),
    ("turn", "turn", float),
    ("reset", "reset", {"true": True, "false": False}.__getitem__),
    ("conditions", "condition", str),
)
_CONTROLLERS: Final = ", ".join(CONTROLLERS)
_NAMED: Final = ", ".join(CONDITIONS)


def walk(
    context: typer.Context,
    robot: Annotated[
        str | None,
        Option(help="Robot name or TOML file. Default: lilibot.", autocompletion=complete.robots),
    ] = None,
    mi: Annotated[
        str | None,
        Option(
            help="Modulatory input MI, which sets the stepping rate *. Default: 0.08, or the "
            "robot's own."
        ),
    ] = None,
    duration: Annotated[float | None, Option(help="Simulated time [s]. Default: 45.0.")] = None,
    seed: Annotated[
        int | None,
        Option(help="Seed of noise, asymmetry and, with --roughness, obstacles. Default: 0."),
    ] = None,
    controller: Annotated[
        str | None,
        Option(
            help=f"One of {_CONTROLLERS}. Default: apnc, or what --fmu starts with.",
            autocompletion=complete.controllers,
        ),
    ] = None,
    preset: Annotated[
        str | None,
        Option(
            help="robot (the defaults and the robot's file), lilibot (the defaults) or paper "
            "(as printed). Default: robot.",
            autocompletion=complete.presets,
        ),
    ] = None,
    setting: Annotated[
        list[str] | None,
        Option(
            "--set",
            help="NAME=VALUE of a parameter of the controller. May be repeated.",
            autocompletion=complete.settings,
        ),
    ] = None,
    params: Annotated[
        Path | None, Option(help="File of parameters: summary.json, SSV, JSON or TOML.")
    ] = None,
    gait: Annotated[Path | None, Option(help="File of a stored gait to start with.")] = None,
    ground: Annotated[
        str | None,
        Option(
            help="plane, obstacles, kerb or waves, as kerb:height=0.006. Default: plane.",
            autocompletion=complete.grounds,
        ),
    ] = None,
    roughness: Annotated[
        float | None,
        Option(help="Obstacles of the robot's size, roughness 0 ... 1. Default: none."),
    ] = None,
    slope: Annotated[
        float | None, Option(help="Rise of the ground along x [deg]. Default: 0.")
    ] = None,
    condition: Annotated[
        str | None,
        Option(
            help=f"Condition, one of {_NAMED} *. Default: C1.", autocompletion=complete.conditions
        ),
    ] = None,
    turn: Annotated[
        str | None, Option(help="Steering, -1 right ... 1 left *. Default: 0.0.")
    ] = None,
    reset: Annotated[
        str | None,
        Option(
            help="true or false *: holds the controller in its start state. Default: false.",
            autocompletion=complete.one_of("true", "false"),
        ),
    ] = None,
    rate: Annotated[
        float | None,
        Option(help="Update rate of the controller [Hz]. Default: 60.0, or the robot's own."),
    ] = None,
    push: Annotated[
        str | None,
        Option(
            help="SECONDS:X:Y of a push: when it begins, and its impulse along x (forward at the "
            "start) and y (left) [N s]; several with commas between. Default: none."
        ),
    ] = None,
    step: Annotated[
        float | None,
        Option(help="Longest integration step of the plant [s]. If omitted, the robot's own."),
    ] = None,
    engine: Annotated[
        str | None,
        Option(
            help="exudyn, mujoco or compiled. Default: exudyn.", autocompletion=complete.engines
        ),
    ] = None,
    fmu: Annotated[
        str | None,
        Option(help="FMU file in place of the built one. Its start values hold unless set here."),
    ] = None,
    output: Annotated[
        Path | None,
        Option(
            help="Folder for the results; a walk in it is replaced. Default: apnc-walk, or "
            "apnc-walk-2 and so on where a walk is already."
        ),
    ] = None,
    json_file: Annotated[
        Path | None, file_option("File to write the summary to as well.", "--json")
    ] = None,
    mcap: Annotated[
        Path | None, file_option("MCAP log to write, for Foxglove, PlotJuggler or Rerun.")
    ] = None,
    video: Annotated[
        Path | None,
        file_option("Film of the walk to write: .gif, .mp4 or .webm, without a browser."),
    ] = None,
    video_size: Annotated[
        str | None,
        Option(help="390 (px wide) or 720p. Default: 390 of a GIF, else 720p."),
    ] = None,
    video_part: Annotated[
        str | None, Option(help="BEGIN:END of what is filmed [s]. Default: all of the walk.")
    ] = None,
    opened: Annotated[bool, Option("--open", help="Open the report in the browser.")] = False,
    view: Annotated[
        bool, Option("--view", help="Show the walk live in the browser, where it can be pushed.")
    ] = False,
    view_speed: Annotated[
        float | None, Option(help="Simulated time per real time with --view. Default: 1.")
    ] = None,
) -> None:
    """Walk a robot under the FMU and write summary.json, record.csv and report.html.

    An option marked * takes one value, or steps over time: --mi 0:0.15,25:0.4 changes at 25 s.

    The exit code is 0 if the walk came to its planned end, and 1 if the robot fell or its motion
    diverged.
    """
    with status("starting"):
        output = output or _free_folder()
        read = given(robot=robot, params=params, gait=gait, fmu=fmu)
        written = {"--output": [output / name for name in RUN_FILES]}
        apart({"--json": json_file, "--mcap": mcap, "--video": video}, read | written)
        experiment = experiment_of(context.params)
        writable(output)
        json_path = writable(json_file, file=True) if json_file else None
        mcap_path = _log_path(mcap) if mcap else None
        check_view(view, view_speed)
        film = film_of(video, video_size, video_part, experiment.duration)
    with viewed(experiment, view, view_speed) as live, bar("walking") as show:

        def progress(t: float, controller: Shown) -> None:
            phases = " ".join(f"{angle:5.2f}" for angle in controller.phi)
            state = f"x real time  phi {phases} rad"
            show(t, experiment.duration, lambda x: f"{t:5.1f} s  {x:4.1f}{state}")

        record = apnc.simulate(
            experiment, plant=live.plant, progress=progress, stop=STOP, watch=live.watch
        )
        live.end(f"{record.end} at {record.ended_at:.2f} s. The report: {output / 'report.html'}")
    if len(record) == 0:
        raise Interrupted(NOTHING)
    from apnc.loop.of_robot import source_of_mi, source_of_rate
    from apnc.loop.schedule import schedule_text
    from apnc.report.folder import summary_text
    from apnc.report.wording import rows, verdicts
    from build_fmu.writing import write_atomically

    summary = apnc.write_report(record, output)
    if json_path:
        write_atomically(json_path, summary_text(record, summary).encode())
    if mcap_path:
        from apnc.report.mcap_file import write_mcap

        with status("writing the log"):
            write_atomically(mcap_path, lambda path: write_mcap(record, path))
    answers = verdicts(summary, experiment.duration)
    asked = [
        ("MI", f"{schedule_text(experiment.mi)}", source_of_mi(experiment)),
        ("Update rate", f"{experiment.rate:g} Hz", source_of_rate(experiment)),
    ]
    show_table([(v.question, v.answer, v.detail) for v in answers] + rows(summary) + asked)
    say_file("report", output / "report.html")
    if film:
        film_walk(record, film)
    if opened:
        open_page((output / "report.html").absolute().as_uri())
    why = f": {record.message}" if record.message else ""
    words = f"{record.end} at {record.ended_at:.2f} s{why}; what was recorded is in {output}"
    if record.end is apnc.End.interrupted:
        raise Interrupted(words)
    if not record.complete:
        say(words, error=True)
        raise typer.Exit(ENDED_EARLY)


OWN_FOLDER: Final = "apnc-walk"


def _free_folder() -> Path:
    """The first of apnc-walk, apnc-walk-2 ... that holds no walk."""
    names = (OWN_FOLDER if n == 1 else f"{OWN_FOLDER}-{n}" for n in count(1))
    return next(
        folder
        for folder in map(Path, names)
        if not any((folder / name).exists() for name in RUN_FILES)
    )


def _log_path(mcap: Path) -> Path:
    """The path of an MCAP log, after a check that the extra is installed and the folder there."""
    if importlib.util.find_spec("mcap_ros2") is None:
        raise ValueError(f"--mcap needs the extra 'mcap': {install_command('mcap')}")
    return writable(mcap, file=True)


def experiment_of(options: Mapping[str, Any]) -> Experiment:
    """The experiment that options of ``apnc walk`` describe. None stands for an option left out.

    Raises:
        ValueError: a value that is not understood or not allowed.
    """
    said = {name: value for name, value in options.items() if value is not None}
    given = {f.name: said[f.name] for f in fields(apnc.Experiment) if f.name in said}
    for name, option, convert in _SCHEDULES:
        if option in said:
            given[name] = parse_schedule(option, said[option], convert)
    if "push" in said:
        given["pushes"] = parse_pushes(said["push"])
    given |= _ground(*map(said.get, ("ground", "roughness", "slope", "seed", "robot")))
    settings: dict[str, Any] = {}
    if "params" in said:
        from apnc.loop.parameters import read_parameters

        settings = read_parameters(said["params"], said.get("controller"))
        if "Ts" in settings:
            given.setdefault("rate", 1.0 / settings.pop("Ts"))
        if "method" in settings:
            given.setdefault("controller", Method(settings.pop("method")).name)
        present = apnc.Experiment(**given).parameters()
        settings = {name: value for name, value in settings.items() if value != present[name]}
    if "gait" in said:
        legs = tuple(leg.name for leg in apnc.Experiment(**given).description.legs)
        settings |= apnc.read_gait(said["gait"]).settings(legs)
    if "setting" in said:
        from apnc.loop.experiment import SET_ELSEWHERE
        from apnc_core.settings import parse

        settings |= (own := dict(map(parse, said["setting"])))
        for name in own.keys() & SET_ELSEWHERE.keys():
            raise ValueError(f"--set {name} is not taken; --{SET_ELSEWHERE[name]} says it")
    return apnc.Experiment(**given, settings=settings)


def _ground(
    text: str | None,
    roughness: float | None,
    slope: float | None,
    seed: int | None,
    robot: str | None,
) -> dict[str, Ground]:
    if (text, roughness, slope) == (None, None, None):
        return {}
    if text is not None and roughness is not None:
        raise ValueError(f"--ground {text} and --roughness {roughness} both say the ground")
    from apnc_plant.ground import parse_ground
    from apnc_plant.robot.size import times_longer

    own: Ground = apnc.Plane()
    if roughness is not None:
        walking = apnc.Experiment() if robot is None else apnc.Experiment(robot=robot)
        scale = times_longer(walking.description)
        own = apnc.Obstacles(roughness=roughness, seed=seed or 0, scale=scale)
    ground = own if text is None else parse_ground(text)
    if slope is not None:
        if ground.slope:
            raise ValueError(f"--ground {text} and --slope {slope} both say the slope")
        ground = replace(ground, slope=math.radians(slope))
    return {"ground": ground}

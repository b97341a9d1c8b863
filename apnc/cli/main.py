"""The command line: ``apnc walk``, ``apnc build``, ``apnc info``."""

from __future__ import annotations

import json
import shutil
import sys
from pathlib import Path
from typing import Annotated

import typer

import apnc_core
from apnc.bench.run import run_bench
from apnc.bench.table import show_bench
from apnc.cli.console import (
    BAD_USE,
    INTERRUPTED,
    StopRequest,
    err,
    out,
    show_summary,
    walking_bar,
    writable,
    writable_file,
)
from apnc.cli.evaluation_cli import add_evaluation
from apnc.cli.info import show_info
from apnc.cli.study_cli import study
from apnc.loop.memory import Gait, gait_of_run, read_gait, write_gait
from apnc.loop.walk import WalkOptions, parse_setting, save, walk
from apnc_core.enumerations import Method
from apnc_core.presets import PRESETS
from build_fmu.build import cached_fmu, host_fmu
from build_fmu.options import NAMINGS, PLATFORMS, BuildError, BuildOptions, host_platform
from exudyn_models.conditions import CONDITIONS
from exudyn_models.physics.plant import CONTACTS
from exudyn_models.robot.file import load_robot

app = typer.Typer(
    add_completion=False,
    no_args_is_help=True,
    pretty_exceptions_enable=False,
    help="Adaptive neural control for legged robots: build the FMU, walk Lilibot under it.",
)

memory_app = typer.Typer(no_args_is_help=True, help="Learned gaits as files.")
app.add_typer(memory_app, name="memory")
add_evaluation(study)
app.add_typer(study, name="study")


@app.command("walk")
def walk_command(
    mi: Annotated[float, typer.Option(help="Modulatory input: sets the stepping rate.")] = 0.08,
    duration: Annotated[float, typer.Option(help="Simulated time [s].")] = 45.0,
    method: Annotated[str, typer.Option(help=f"One of {', '.join(Method.__members__)}.")] = "apnc",
    seed: Annotated[int, typer.Option(help="Seed of sensor noise and asymmetry.")] = 0,
    preset: Annotated[str, typer.Option(help=f"One of {', '.join(PRESETS)}.")] = "lilibot",
    setting: Annotated[
        list[str] | None, typer.Option("--set", help="NAME=VALUE of a parameter; repeatable.")
    ] = None,
    fmu: Annotated[Path | None, typer.Option(help="This FMU instead of the built one.")] = None,
    robot: Annotated[str, typer.Option(help="Name or TOML file of the robot.")] = "lilibot",
    condition: Annotated[str, typer.Option(help=f"One of {', '.join(CONDITIONS)}.")] = "C1",
    contact: Annotated[str, typer.Option(help=f"One of {', '.join(CONTACTS)}.")] = "compiled",
    memory: Annotated[Path | None, typer.Option(help="Start with this learned gait.")] = None,
    output: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("apnc-walk"),
    json_file: Annotated[
        Path | None, typer.Option("--json", help="Write the summary here as well.")
    ] = None,
) -> None:
    """Walk the robot under the FMU and write summary.json, record.csv and report.html."""
    settings = dict(parse_setting(text) for text in setting or [])
    if memory:
        settings = read_gait(memory).settings() | settings
    options = WalkOptions(mi, duration, method, seed, preset, settings, robot, condition, contact)
    legs = len(load_robot(robot).legs)
    folder = writable(output)
    json_path = writable_file(json_file) if json_file else None
    path = fmu or _built(legs)
    stop = StopRequest()
    with stop.listening():
        with walking_bar(duration) as progress:
            record = walk(options, path, progress, stop)
        summary = save(record, options, folder)
        if json_path:
            json_path.write_text(summary.to_json(), encoding="utf-8")
    show_summary(summary, str(folder))
    if record.error:
        raise RuntimeError(f"the run ended at {summary.duration_s:.2f} s: {record.error}")
    if stop.asked:
        err.print(f"interrupted; what was recorded is in {folder}", highlight=False)
        raise typer.Exit(INTERRUPTED)


def _built(legs: int = 4) -> Path:
    with err.status("building the FMU"):
        return host_fmu(legs)


@app.command("build")
def build_command(
    output: Annotated[Path, typer.Option(help="File to write.")] = Path("Apnc.fmu"),
    legs: Annotated[int, typer.Option(help="Number of legs.")] = 4,
    naming: Annotated[str, typer.Option(help=f"One of {', '.join(NAMINGS)}.")] = "structured",
    fmi: Annotated[int, typer.Option(help="Version of the standard, 2 or 3.")] = 2,
    platform: Annotated[
        list[str] | None,
        typer.Option(
            help=f"One of {', '.join(PLATFORMS)}, host, or all; repeatable; all if omitted."
        ),
    ] = None,
) -> None:
    """Build the FMU."""
    chosen = _platforms(platform or ["all"])
    options = BuildOptions(legs=legs, naming=naming, platforms=chosen, fmi=fmi)
    writable_file(output)
    with err.status("building") as status:
        path = cached_fmu(options, lambda name: status.update(f"compiling for {name}"))
    shutil.copyfile(path, output)
    size = output.stat().st_size / 1000
    out.print(f"{output}: {size:.0f} kB, {', '.join(chosen)}", highlight=False, soft_wrap=True)


def _platforms(names: list[str]) -> tuple[str, ...]:
    chosen: list[str] = []
    for name in names:
        chosen += list(PLATFORMS) if name == "all" else [_host(name)]
    return tuple(dict.fromkeys(chosen))


def _host(name: str) -> str:
    return host_platform() if name == "host" else name


@app.command("info")
def info_command(
    fmu: Annotated[Path | None, typer.Argument(help="An FMU; the built one if omitted.")] = None,
) -> None:
    """Show version, folders and the interface of the FMU."""
    show_info(fmu or _built())


@memory_app.command("save")
def memory_save(
    run: Annotated[Path, typer.Argument(help="Output folder of a walk.")],
    file: Annotated[Path, typer.Argument(help="Gait file to write.")],
) -> None:
    """Write the gait that a run has stored."""
    gait = gait_of_run(run)
    write_gait(gait, writable_file(file))
    out.print(f"{file}: {_in_words(gait)}", highlight=False, soft_wrap=True)


@memory_app.command("show")
def memory_show(file: Annotated[Path, typer.Argument(help="Gait file.")]) -> None:
    """Show a gait file."""
    out.print(_in_words(read_gait(file)), highlight=False, soft_wrap=True)


def _in_words(gait: Gait) -> str:
    first, *others = gait.legs
    pairs = zip(others, gait.phi, strict=True)
    return f"phase against {first}: " + ", ".join(f"{leg} {phi:.2f} rad" for leg, phi in pairs)


@app.command("bench")
def bench_command(
    output: Annotated[Path, typer.Option(help="JSON file to write.")] = Path("apnc-bench.json"),
) -> None:
    """Measure what a tick costs, against its arithmetic and against PythonFMU."""
    writable_file(output)
    with err.status("measuring") as status:
        result = run_bench(lambda what: status.update(f"measuring: {what}"))
    output.write_text(json.dumps(result, indent=2) + "\n", encoding="utf-8")
    show_bench(result)
    out.print(f"all figures: {output}", highlight=False, soft_wrap=True)


@app.callback(invoke_without_command=True)
def _version(
    version: Annotated[bool, typer.Option("--version", help="Show the version.")] = False,
) -> None:
    if version:
        out.print(apnc_core.__version__, highlight=False)
        raise typer.Exit()


def main(arguments: list[str] | None = None) -> None:
    """Run the command line; a mistake of the caller is one line on stderr and exit code 2."""
    sys.exit(_run(arguments))


def _run(arguments: list[str] | None) -> int:
    command = typer.main.get_command(app)
    try:
        code = command.main(args=arguments, prog_name="apnc", standalone_mode=False)
    except typer.Exit as exit_:
        return exit_.exit_code
    except (KeyboardInterrupt, typer.Abort):
        err.print("interrupted", highlight=False)
        return INTERRUPTED
    except Exception as error:
        return _explained(error)
    return code if isinstance(code, int) else 0


def _explained(error: Exception) -> int:
    text: str | None = None
    if hasattr(error, "format_message"):  # a usage error of the command-line library
        text = error.format_message()
        if not text:  # no arguments: the help has been shown
            return BAD_USE
    elif isinstance(error, (ValueError, OSError, RuntimeError)):
        text = str(error)
    if text is None:
        raise error
    one_line = text if isinstance(error, BuildError) else " ".join(text.split())
    err.print(f"apnc: {one_line}", highlight=False, markup=False, soft_wrap=True)
    return BAD_USE

"""``apnc export-robot``: a robot as a file for other engines and tools."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

import importlib.util
import os
from pathlib import Path
from typing import Annotated, Final

from typer import Option

from apnc.cli import completion as complete
from apnc.cli.console import apart, given, say, writable

FORMATS: Final = ("mjcf", "urdf")


def export_robot(
    form: Annotated[
        str,
        Option(
            "--format",
            help="Format of the file: mjcf or urdf.",
            autocompletion=complete.one_of("mjcf", "urdf"),
        ),
    ] = "mjcf",
    robot: Annotated[
        str, Option(help="Robot name or TOML file.", autocompletion=complete.robots)
    ] = "lilibot",
    output: Annotated[
        str | None,
        Option(
            metavar="<path>",
            help="File to write, or folder/ to write ROBOT.xml or ROBOT.urdf into.",
        ),
    ] = None,
    servo: Annotated[
        str | None,
        Option(
            help="Actuators of MJCF: position or dcmotor. Default: position.",
            autocompletion=complete.one_of("position", "dcmotor"),
        ),
    ] = None,
    root: Annotated[
        str | None,
        Option(
            help="Root link of URDF: trunk, or base, which has no mass, for KDL. Default: trunk.",
            autocompletion=complete.one_of("trunk", "base"),
        ),
    ] = None,
) -> None:
    """Write a robot as MJCF for MuJoCo, or as URDF for ROS."""
    from apnc_plant.robot import load_robot
    from apnc_plant.robot.names import plain_name
    from build_fmu.writing import write_atomically

    if form not in FORMATS:
        raise ValueError(f"format '{form}' is not one of {', '.join(FORMATS)}")
    if form == "urdf" and servo is not None:
        raise ValueError(f"servo = {servo}; allowed with format mjcf only")
    if form == "mjcf" and root is not None:
        raise ValueError(f"root = {root}; allowed with format urdf only")
    apart({"--output": None if output is None else Path(output)}, given(robot=robot))
    own = load_robot(robot)
    if form == "urdf":
        from apnc_plant.robot.urdf import robot_urdf

        text, suffix = robot_urdf(own, root="trunk" if root is None else root), "urdf"
    else:
        from apnc.extras import missing
        from mujoco_models.tree import export_mjcf

        if importlib.util.find_spec("mujoco") is None:
            raise ValueError(missing("mujoco", "mujoco"))
        text, suffix = export_mjcf(own, servo="position" if servo is None else servo), "xml"
    path = _file("./" if output is None else output, f"{plain_name(own.name)}.{suffix}")
    write_atomically(writable(path, file=True), text.encode())
    say(f"{path}: {own.name}, {len(own.legs)} legs, {own.mass:.3g} kg, {form.upper()}")


def _file(output: str, name: str) -> Path:
    """The file that ``output`` names, or the file ``name`` in it if it is a folder."""
    folder = output.endswith(("/", os.sep)) or Path(output).is_dir()
    return Path(output, name) if folder else Path(output)

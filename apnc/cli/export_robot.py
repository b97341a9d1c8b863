"""``apnc export-robot``: a robot as a file for other engines and tools."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

import importlib.util
from pathlib import Path
from typing import Annotated, Final

from typer import Option

from apnc.cli.console import File, Text, say, writable

FORMATS: Final = ("mjcf", "urdf")


def export_robot(
    form: Annotated[str, Option("--format", help="mjcf, urdf.")] = "mjcf",
    robot: Annotated[str, Option(help="Name or TOML file.")] = "lilibot",
    output: Annotated[File, Option(help="File to write; ROBOT.xml, ROBOT.urdf.")] = None,
    servo: Annotated[Text, Option(help="Of MJCF: position, dcmotor; position if omitted.")] = None,
) -> None:
    """Write a robot as MJCF (MuJoCo) or URDF (ROS): masses, joints, servos, feet, sensors."""
    from apnc_plant.robot import load_robot

    if form not in FORMATS:
        raise ValueError(f"format '{form}' is not one of {', '.join(FORMATS)}")
    if form == "urdf" and servo is not None:
        raise ValueError(f"servo '{servo}' is of MJCF; URDF has limits of a joint only")
    own = load_robot(robot)
    if form == "urdf":
        from apnc_plant.robot.urdf import robot_urdf

        text, suffix = robot_urdf(own), "urdf"
    else:
        from apnc.loop.engines import needs
        from mujoco_models.tree import export_mjcf

        if importlib.util.find_spec("mujoco") is None:
            raise ValueError(needs("mujoco"))
        text, suffix = export_mjcf(own, servo=servo or "position"), "xml"
    path = writable(output or Path(f"{own.name}.{suffix}"), file=True)
    path.write_text(text, encoding="utf-8")
    say(f"{path}: {own.name}, {len(own.legs)} legs, {own.mass:.3g} kg, {form.upper()}")

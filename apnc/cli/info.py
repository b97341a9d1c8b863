"""``apnc info``: version, platforms and interface of an FMU, or what a robot file says."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

import math
import zipfile
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from apnc.cli.console import say, show_table, status

if TYPE_CHECKING:
    from apnc_plant.robot import RobotDescription


def info(
    fmu: Annotated[Path | None, typer.Argument(help="FMU file. Default: the built one.")] = None,
    robot: Annotated[
        str | None, typer.Option(help="Robot name or TOML file, in place of an FMU.")
    ] = None,
) -> None:
    """Show version, platforms and interface of an FMU for co-simulation, FMI 2.0 or 3.0.

    With --robot: size, rate, MI and legs of a robot, and the joints of its own model file.
    """
    if robot is not None:
        from apnc_plant.robot import load_robot

        if fmu is not None:
            raise ValueError(f"{fmu} and --robot {robot}: allowed is one of them")
        _say_robot(load_robot(robot))
        return
    with status("reading"):
        import fmpy

        from apnc.loop.fmu_controller import describe_fmu
        from apnc_core import __version__
        from build_fmu.build import host_fmu

        path = fmu or host_fmu()
        model = describe_fmu(path)
    with zipfile.ZipFile(path) as archive:
        folders = {n.split("/")[1] for n in archive.namelist() if n.startswith("binaries/")}
    show_table(
        [
            ("apnc", __version__),
            ("FMU", str(path)),
            ("model", f"{model.modelName}, FMI {model.fmiVersion} co-simulation"),
            ("guid", model.guid),
            ("platforms", ", ".join(sorted(folders)) or "sources only"),
            ("fmpy", fmpy.__version__),
        ]
    )
    headings = ("name", "causality", "start", "unit", "description")
    rows = [
        (v.name + "".join(f"[{n}]" for n in v.shape), v.causality, v.start, v.unit, v.description)
        for v in model.modelVariables
        if v.causality in ("input", "output", "parameter")
    ]
    show_table(([cell or "" for cell in row] for row in rows), *headings)


def _say_robot(robot: RobotDescription) -> None:
    from apnc.loop.of_robot import own_mi, own_rate
    from apnc_plant.robot.leg_names import by_place
    from apnc_plant.robot.size import leg_length
    from apnc_plant.step import own_step

    mi_range = "{:g} ... {:g}".format(*robot.mi_range) if robot.mi_range else "not in its file"
    of_file, default = "from its file", "the default"
    show_table(
        [
            ("robot", robot.name, ""),
            ("mass", f"{robot.mass:.4g} kg", ""),
            ("longest leg", f"{leg_length(robot):.4g} m", "femur and tibia"),
            ("update rate", f"{own_rate(robot):.4g} Hz", of_file if robot.rate else default),
            ("MI", f"{own_mi(robot):g}", default if robot.mi is None else of_file),
            ("MI range", mi_range, "in which its gait was found"),
            ("integration step", f"{1e6 * own_step(robot):.4g} us", "chosen by the plant"),
            ("own parameters", str(len(robot.controller)), ", ".join(robot.controller)),
        ]
    )
    places = {leg: place for place, leg in reversed(by_place(robot.leg_names).items())}
    say("")
    show_table(
        (
            [leg.name, places.get(leg.name, ""), *(f"{x:g}" for x in leg.mount)]
            for leg in robot.legs
        ),
        "leg", "place", "x [m]", "y [m]", "z [m]",
    )  # fmt: skip
    if robot.joint_map:
        say("\nangle in its own model file = offset + sign angle here")
        show_table(
            (
                [m.leg, m.joint, m.name, f"{m.sign:+d}", f"{math.degrees(m.offset):.4g} deg"]
                for m in robot.joint_map
            ),
            "leg", "joint", "in the file", "sign", "offset",
        )  # fmt: skip

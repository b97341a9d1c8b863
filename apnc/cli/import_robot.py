"""``apnc import-robot``: a robot file from a URDF or MJCF of other people."""
# ruff: noqa: PLC0415  # what takes long to import waits until it is needed

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from apnc.cli.console import apart, file_option, say, show_table, writable
from apnc_plant.signals import JOINTS

if TYPE_CHECKING:
    from apnc.importing import ImportedRobot


def import_robot(
    file: Annotated[Path, Argument(help="URDF or MJCF file. MJCF needs the extra mujoco.")],
    pose: Annotated[
        str | None,
        Option(help="Pose to walk about: a keyframe, or zero. Default: a stance that trots."),
    ] = None,
    forward: Annotated[
        str | None,
        Option(help="Direction of the file that points forward: x, -x, y or -y. Default: found."),
    ] = None,
    output: Annotated[Path, file_option("Robot file to write. Default: robot.toml.")] = Path(
        "robot.toml"
    ),
) -> None:
    """Read a robot from URDF or MJCF; write its robot file and say what was found.

    What the file does not say is estimated from Lilibot, scaled to the size of the robot.
    """
    from apnc.importing import import_robot as read

    apart({"--output": output}, {"the model": [file]})
    if output.suffix != ".toml":
        raise ValueError(f"--output is {output}; allowed: a name that ends in .toml")
    robot = read(file, pose, forward)
    writable(output, file=True).write_text(robot.toml, encoding="utf-8")
    _say(robot, file)
    say(f"{output}: walk it with\napnc walk --robot {output} --engine compiled")


def _say(found: ImportedRobot, file: Path) -> None:
    robot = found.robot
    length = robot.legs[0].femur_length + robot.legs[0].tibia_length
    say(f"{file.name}: {robot.name}, {robot.mass:.4g} kg, {len(robot.legs)} legs of {length:.3g} m")
    say("\nlegs; q is the angle here [rad]")
    joints = {(each.leg, each.joint): each.words() for each in robot.joint_map}
    show_table(
        (
            [
                leg.name,
                *(joints.get((leg.name, joint), "") for joint in JOINTS),
                own.foot.name,
            ]
            for leg, own in zip(robot.legs, found.legs, strict=True)
        ),
        "here", "abduction", "hip", "knee", "foot",
    )  # fmt: skip
    say(f"\nforward: {found.forward} of the file; {found.facing} (--forward)")
    stance = found.stance
    say(
        f"stance: hips {stance.ratio:.3g} and middle of the feet {stance.behind:.3g} behind the "
        "centre of mass, in halves of the distance of neighbouring hips"
    )
    say(f"update rate: {robot.rate:.3g} Hz, at which it moves as Lilibot does at 60 Hz")
    say("\nestimated, since the file does not say it")
    show_table(
        (
            [each.name, f"{each.value:.4g} {each.unit}".strip(), each.why]
            for each in found.estimates
        ),
        "key", "value", "from",
    )  # fmt: skip
    if found.dropped:
        say("\nnot in the robot file")
        for line in found.dropped:
            say(f"- {line}")
    say("")

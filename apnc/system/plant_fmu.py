"""Build the plant FMU: a robot in plain C, with its numbers inside, as an FMU 2.0 or 3.0."""

from __future__ import annotations

import hashlib
import re
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from apnc.loop.of_robot import own_rate
from apnc_core import __version__
from apnc_plant.fmu_config import HEADER, robot_config
from apnc_plant.robot import RobotDescription, load_robot
from apnc_plant.variable_numbers import VARIABLE_NUMBERS
from apnc_plant.variables import ENUMERATIONS, TABLE, starts_of
from build_fmu import sources
from build_fmu.build import built, cached_path
from build_fmu.compile import BuildProgress
from build_fmu.documentation import documentation, page_of
from build_fmu.model import Model, RealType
from build_fmu.platforms import PLATFORMS, check_platforms
from build_fmu.writing import write_atomically

MODEL_SUFFIX: Final = "Plant"

REAL_TYPES: Final = {
    "1": RealType("Number", "dimensionless number", ""),
    "s": RealType("Duration", "duration", "Time"),
    "N": RealType("Force", "force", "Force"),
    "rad": RealType("Angle", "angle", "Angle"),
    "kg": RealType("Mass", "mass", "Mass"),
    "m": RealType("Length", "length, or a coordinate", "Length"),
    "m/s": RealType("Velocity", "velocity", "Velocity"),
    "rad/s": RealType("AngularVelocity", "angular velocity", "AngularVelocity"),
    "N.m": RealType("Torque", "torque", "Torque"),
    "J": RealType("Energy", "energy", "Energy"),
    "N.m/rad": RealType("AngularStiffness", "torque per angle", ""),
    "N.m.s/rad": RealType("AngularDamping", "torque per angular velocity", ""),
    "kg.m2": RealType("MomentOfInertia", "moment of inertia", "MomentOfInertia"),
    "N/m": RealType("Stiffness", "force per length", ""),
    "N.s/m": RealType("Damping", "force per velocity", ""),
}
LOG_CATEGORIES: Final = {
    "logStatusWarning": "steps that are too short",
    "logStatusError": "wrong calls and values, and a motion that diverged",
    "logEvents": "life of the instance, and a fall",
}


@dataclass(frozen=True)
class PlantBuild:
    """Choices of one build.

    Args:
        robot: name of a shipped robot, or its file; its numbers travel in the FMU.
        naming: ``structured`` (``leg[1].grf``) or ``flat`` (``leg1_grf``). In FMI 3.0 the first
            makes arrays and the second a scalar per entry.
        fmi: version of the standard, 2 or 3.
        platforms: names of the binaries to include; empty for sources only.
        enumerations: ``enumeration``, or ``integer`` for importers that drop enumerations.
        reals: whether every variable is a Real, for importers that read all of them so.

    Raises:
        ValueError: a choice outside what is allowed, or a robot that cannot be read or that an FMU
            does not take.
    """

    robot: str = "lilibot"
    naming: str = "structured"
    fmi: int = 2
    platforms: tuple[str, ...] = tuple(PLATFORMS)
    enumerations: str = "enumeration"
    reals: bool = False

    def __post_init__(self) -> None:
        """Check the choices."""
        check_platforms(self.platforms)
        self.model()

    def description(self) -> RobotDescription:
        """The robot."""
        return load_robot(self.robot)

    def model(self) -> Model:
        """What the FMU shows."""
        robot = self.description()
        return Model(
            identifier=plant_model(self.robot),
            about=f"Robot '{robot.name}' on the ground",
            table=TABLE,
            numbers=VARIABLE_NUMBERS,
            legs=tuple(leg.name for leg in robot.legs),
            starts=starts_of(robot),
            enumerations=ENUMERATIONS,
            types=REAL_TYPES,
            log_categories=LOG_CATEGORIES,
            step=1.0 / own_rate(robot),
            naming=self.naming,
            fmi=self.fmi,
            enumerations_as=self.enumerations,
            reals=self.reals,
        )


def plant_model(robot: str) -> str:
    """Name of the model: ``LilibotPlant`` for robot ``lilibot``.

    Args:
        robot: name of a shipped robot, or its file.

    Raises:
        RobotDescriptionError: no such robot, or a file with mistakes.
    """
    words = re.findall(r"[A-Za-z0-9]+", load_robot(robot).name)
    name = "".join(word[0].upper() + word[1:] for word in words)
    return (name if name[:1].isalpha() else f"Robot{name}") + MODEL_SUFFIX


def plant_fmu(build: PlantBuild, progress: BuildProgress = lambda platform: None) -> Path:
    """Path of the plant FMU: from the cache, or built now. The same choices give the same bytes.

    Args:
        build: what to build.
        progress: called with the platform that is compiled next, if anything is compiled.

    Raises:
        BuildError: the compiler failed, or it is needed and not installed.
        OSError: the cache folder cannot be written.
    """
    model, files = build.model(), _files(build)
    pages = _pages(build, model)
    key = hashlib.sha256(repr((model, build.platforms, __version__)).encode())
    for name, content in sorted((files | _configured(build, "") | pages).items()):
        key.update(name.encode() + content)
    path = cached_path(key.hexdigest()[:16], model.identifier)
    if not path.is_file():
        content = built(
            model, files, lambda guid: _configured(build, guid), pages, build.platforms, progress
        )
        write_atomically(path, content)
    return path


def _files(build: PlantBuild) -> dict[str, bytes]:
    own = {HEADER: robot_config(build.description())}
    return sources.collect(build.fmi, sources.PLANT) | own


def _configured(build: PlantBuild, guid: str) -> dict[str, bytes]:
    legs = len(build.description().legs)
    lines = ["/* Build-time choices, written by the build. */", "#define PLANT_ONE_ROBOT"]
    lines += [f"#define PLANT_MOST_LEGS {legs}"]
    lines += [f"#define PLANT_PREFIX {sources.prefix_of(guid)}"] if guid else []
    return {
        "apnc_config.h": sources.shell_config(legs, build.naming, guid, reals=build.reals),
        "plant_config.h": ("\n".join(lines) + "\n").encode(),
    }


def _pages(build: PlantBuild, model: Model) -> dict[str, bytes]:
    robot = build.description()
    more = {"robot": robot.name, "mass": f"{robot.mass:.4g}"}
    return documentation(model, page_of("apnc_plant", "documentation_plant.html.j2"), more)

"""The robots of the gallery as data, and where their model files lie."""

from __future__ import annotations

import os
import tomllib
from collections.abc import Sequence
from dataclasses import dataclass
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path
from typing import Final

from research.gallery.by_hand import ByHand

FILE: Final = Path(__file__).with_name("robots.toml")


@dataclass(frozen=True)
class GalleryRobot:
    """A robot of the gallery.

    Args:
        name: of its files.
        title: its name on the page.
        package: that holds its model file; empty if a repository does.
        file: the model file, below the folder of the package or of the checkout.
        licence: of the model file.
        pose: about which it walks, see ``import_robot``; the rule's stance if empty.
        why: it misses aims, in sentences of which the last has no full stop; empty if it misses
            none.
        repository: that holds its model file, without https; empty if a package does.
        commit: of the repository.
        by_hand: what is set by hand after it was read.
    """

    name: str
    title: str
    package: str
    file: str
    licence: str
    pose: str = ""
    why: str = ""
    repository: str = ""
    commit: str = ""
    by_hand: ByHand | None = None

    @property
    def source(self) -> str:
        """The package or the repository."""
        return self.package or self.repository

    @property
    def root_variable(self) -> str:
        """Environment variable that names the folder of a checkout of its repository."""
        return f"{self.name.upper()}_ROOT"

    @property
    def kind(self) -> str:
        """Format of the model file."""
        return "URDF" if self.file.endswith(".urdf") else "MJCF"


def robots(names: Sequence[str] = ()) -> list[GalleryRobot]:
    """Robots of the gallery, the lightest first; all of them if none is named.

    Raises:
        ValueError: no such robot.
    """
    table = tomllib.loads(FILE.read_text("utf-8"))
    found = {}
    for entry in table["robots"]:
        folder = table["folders"].get(entry.setdefault("package", ""), "")
        entry["file"] = str(Path(folder, entry["file"]))
        if "by_hand" in entry:
            entry["by_hand"] = ByHand(**entry["by_hand"])
        found[entry["name"]] = GalleryRobot(**entry)
    for name in names:
        if name not in found:
            raise ValueError(f"robot is {name!r}; allowed: {', '.join(found)}")
    return [robot for name, robot in found.items() if not names or name in names]


def model_of(robot: GalleryRobot) -> tuple[Path, str]:
    """Model file of a robot, and the version of its package or the commit of its repository.

    Raises:
        ValueError: the package is not installed, or no variable names a checkout of the repository;
            or there is no such file.
    """
    if robot.repository:
        root = os.environ.get(robot.root_variable, "")
        path = Path(root, robot.file)
        if not root or not path.is_file():
            raise ValueError(
                f"{robot.root_variable} is {root!r}; allowed: the folder of a checkout of "
                f"{robot.repository} at commit {robot.commit}, with {robot.file}"
            )
        return path, robot.commit[:12]
    try:
        package = distribution(robot.package)
    except PackageNotFoundError:
        raise ValueError(
            f"{robot.package} is not installed: pip install --group robots in a checkout"
        ) from None
    path = Path(str(package.locate_file(robot.file)))
    if not path.is_file():
        raise ValueError(f"{robot.package} {package.version} has no file {robot.file}")
    return path, package.version

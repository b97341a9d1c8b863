"""Put what every package and extra weighs into docs/install.md, as installed in this environment.

python -m research.docs.sizes        (needs ``pip install -e ".[test]"``)

Names, and what each is for, stand in the page; only the numbers are written anew.
"""

from __future__ import annotations

import importlib.metadata
import re
import tomllib
from collections.abc import Iterable
from pathlib import Path
from typing import Any, Final

from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from research.docs import DOCS, ROOT

PAGE: Final = DOCS / "install.md"
OWN: Final = "apnc"
REST: Final = "and what they need"
"""Ends the line of all packages that have none."""

_SIZE: Final = re.compile(r"^(\| (?P<name>[^|]+) \| \**)\d+(\** \|)", re.MULTILINE)


class Project:
    """This package and those that it needs, by the files of this environment."""

    def __init__(self) -> None:
        found = tomllib.loads((ROOT / "pyproject.toml").read_text("utf-8"))
        self.extras: dict[str, list[str]] = found["project"]["optional-dependencies"]
        self._needs: list[str] = found["project"]["dependencies"]
        self._folders: list[str] = found["tool"]["hatch"]["build"]["targets"]["wheel"]["packages"]
        self._installed: dict[str, Any] = {
            canonicalize_name(each.name): each for each in importlib.metadata.distributions()
        }

    def bytes_of(self, name: str) -> int:
        """Size of a package's files, without compiled Python."""
        if name == OWN:
            folders = (ROOT / folder for folder in self._folders)
            files: Iterable[Path] = (path for each in folders for path in each.rglob("*.*"))
        else:
            files = (path.locate() for path in self._installed[name].files or ())
        return sum(
            path.stat().st_size for path in files if path.is_file() and path.suffix != ".pyc"
        )

    def needed(self, extra: str = "") -> set[str]:
        """Names of this package and all that it needs, with an extra."""
        found: dict[str, set[str]] = {OWN: {extra, ""}}
        left = self._needs + (self.extras[extra] if extra else [])
        while left:
            asked = Requirement(left.pop())
            name, wanted = canonicalize_name(asked.name), {"", *asked.extras}
            if asked.marker and not asked.marker.evaluate({"extra": ""}):
                continue
            new = wanted - found.setdefault(name, set())
            found[name] |= wanted
            for each in new:
                left += self._asked_by(name, each)
        return set(found)

    def _asked_by(self, name: str, extra: str) -> list[str]:
        """What a package asks for with an extra, or without any, on this machine."""
        if name == OWN:
            return self.extras[extra] if extra else []
        asked = []
        for text in self._installed[name].requires or ():
            each = Requirement(text)
            of_extra = each.marker is not None and "extra" in str(each.marker)
            if of_extra == bool(extra) and (
                each.marker is None or each.marker.evaluate({"extra": extra})
            ):
                each.marker = None
                asked.append(str(each))
        return asked


def sizes(page: str, project: Project) -> dict[str, int]:
    """Bytes by the first cell of each line of the page's tables."""
    default = project.needed()
    own = {name: project.bytes_of(name) for name in default}
    lines = [found["name"] for found in _SIZE.finditer(page)]
    shown = {name: sum(own.get(word, 0) for word in re.findall(r"[\w-]+", name)) for name in lines}
    found = {name: own[name] for name in default & shown.keys()}
    for name in lines:
        if name.strip("*") == "together":
            found[name] = sum(own.values())
        elif name.endswith(REST):
            found[name] = sum(own.values()) - sum(own[each] for each in default & shown.keys())
        elif (extra := name.strip("`")) in project.extras:
            more = project.needed(extra) - default
            found[name] = sum(project.bytes_of(each) for each in more)
    return found


def main() -> None:
    """Change the page."""
    page = PAGE.read_text("utf-8")
    found = sizes(page, Project())

    def new(line: re.Match[str]) -> str:
        return f"{line[1]}{round(found[line['name']] / 1e6)}{line[3]}"

    PAGE.write_text(_SIZE.sub(new, page), encoding="utf-8")


if __name__ == "__main__":
    main()

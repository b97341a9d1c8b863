"""The XML of a MJCF file, prepared so that MuJoCo can read it without opening another file.

What is included is put in, and what a robot file does not need is taken out.
"""

from __future__ import annotations

from contextlib import suppress
from pathlib import Path
from typing import Final

from apnc.importing.model import ModelFileError
from apnc.importing.xml_file import LARGEST, Element, described, elements, read_xml

DEEPEST: Final = 8
"""Includes inside includes that are followed."""

_NOT_NEEDED: Final = (
    "asset", "extension", "sensor", "tendon", "contact", "deformable", "custom", "visual",
    "statistic", "keyframe", "equality", "size",
)  # fmt: skip
_NOT_NEEDED_IN_BODIES: Final = ("camera", "light", "plugin", "composite", "flexcomp")


def put_in_includes(root: Element, path: Path) -> None:
    """Put what is included in the place of every ``<include>``.

    Args:
        root: the element ``<mujoco>``.
        path: its file; no included file may lie outside of the folder of this one.

    Raises:
        ModelFileError: a file that may not be included or cannot be read, or too much of it.
    """
    _include(root, path.parent, path.parent.resolve(), DEEPEST, [path.stat().st_size])


def _include(at: Element, folder: Path, top: Path, left: int, size: list[int]) -> None:
    """Put what is included in the place of ``<include>``.

    Args:
        at: element whose includes are followed.
        folder: where its file lies.
        top: the folder that no included file may leave.
        left: how many levels are still followed.
        size: bytes of all files so far, one entry.
    """
    for element in list(at.iter("include")):
        name = element.get("file") or ""
        found = (folder / name).resolve()
        if not found.is_file():
            found = (top / name).resolve()
        if not name or not found.is_relative_to(top):
            raise ModelFileError(
                f"include is {name!r}; allowed: files in the folder of the model file"
            )
        if left == 0:
            raise ModelFileError(f"include {name!r} is nested; allowed: {DEEPEST} levels")
        try:
            inner = read_xml(found)
        except ModelFileError as error:
            raise ModelFileError(f"include {name!r}: {error}") from None
        size[0] += found.stat().st_size
        if size[0] > LARGEST:
            raise ModelFileError(f"it has {size[0]} bytes with includes; allowed: up to {LARGEST}")
        _include(inner, found.parent, top, left - 1, size)
        parent = element.getparent()
        place = parent.index(element)
        parent.remove(element)
        for offset, child in enumerate(list(inner)):
            parent.insert(place + offset, child)


def tied(root: Element) -> dict[str, str]:
    """Bodies and joints that an equality ties to others, and to what."""
    found: dict[str, str] = {}
    for group in root.iter("equality"):
        for element in group.iterchildren("*"):
            if element.get("active") == "false":
                continue
            names = [element.get(key) for key in ("joint1", "joint2", "body1", "body2")]
            present = [name for name in names if name]
            for name in present:
                others = [other for other in present if other != name]
                found[name] = ", ".join(others) or f"the world ({element.tag})"
    return found


def no_load_speeds(root: Element) -> dict[str, float]:
    """What our own export notes in ``<custom>``, by joint; the empty name stands for all others."""
    found = {}
    for element in root.iter("numeric"):
        name, _, joint = element.get("name", "").partition(":")
        if name == "no_load_speed":
            with suppress(ValueError):
                found[joint] = float(element.get("data", ""))
    return found


def strip(root: Element) -> list[str]:
    """Take out what a robot file does not need; says what a reader might miss."""
    said = []
    for element in root.iter("attach", "model"):
        if element.getparent().tag == "asset" or element.tag == "attach":
            raise ModelFileError(f"it has <{element.tag}>, another model; allowed: <include>")
    for tag in ("tendon", "equality"):
        count = sum(len(group) for group in elements(root, tag))
        if count:
            said.append(f"{count} elements of <{tag}>")
    for element in list(root):
        if element.tag in _NOT_NEEDED:
            root.remove(element)
    for world in elements(root, "worldbody"):
        for element in list(world.iter(*_NOT_NEEDED_IN_BODIES)):
            element.getparent().remove(element)
    for actuators in elements(root, "actuator"):
        for element in list(actuators.iterchildren("*")):
            if element.get("joint") is None:
                said.append(f"actuator {element.get('name', element.tag)}: it drives no joint")
                actuators.remove(element)
    for element in root.iter("geom", "site", "skin"):
        for name in ("material", "hfield", "fluidshape"):
            element.attrib.pop(name, None)
    for element in root.iter("compiler"):
        for name in ("meshdir", "texturedir", "assetdir", "strippath"):
            element.attrib.pop(name, None)
    return said


def check_numbers(root: Element) -> None:
    """Refuse numbers that are none: MuJoCo only warns of them, in a log file of its own."""
    for element in root.iter("*"):
        for name, text in element.attrib.items():
            if name != "name" and "nan" in text.lower().split():
                raise ModelFileError(
                    f"{described(element)}: {name} is {text!r}; allowed: finite numbers"
                )

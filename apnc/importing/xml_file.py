"""XML of strangers: no entities, no document type, no network, and no more than a fixed size."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any, Final

import numpy as np
from lxml import etree

from apnc.importing.model import ModelFileError
from apnc_core.types import Array

LARGEST: Final = 16 * 1024**2
"""Largest file that is read [bytes]."""

Element = Any  # of lxml


def read_xml(path: Path) -> Element:
    """The root element of a file.

    Raises:
        ModelFileError: the file is missing or too large, is no XML, or has a document type.
    """
    try:
        size = path.stat().st_size
        if size > LARGEST:
            raise ModelFileError(f"it has {size} bytes; allowed: up to {LARGEST}")
        content = path.read_bytes()
    except OSError as error:
        raise ModelFileError(f"it cannot be read: {error.strerror}") from None
    parser = etree.XMLParser(
        resolve_entities=False, no_network=True, load_dtd=False, huge_tree=False
    )
    try:
        root = etree.fromstring(content, parser)
    except etree.XMLSyntaxError as error:
        raise ModelFileError(f"it is no XML: {error.msg}") from None
    if root.getroottree().docinfo.internalDTD is not None:
        raise ModelFileError("it has a document type; allowed: XML without <!DOCTYPE>")
    return root


def elements(parent: Element, tag: str) -> list[Element]:
    """The children of an element with this tag."""
    return list(parent.iterchildren(tag))


def numbers(element: Element | None, name: str, count: int, default: Array) -> Array:
    """An attribute that holds numbers, shape (count,).

    Args:
        element: the element; None if there is none.
        name: of the attribute.
        count: how many numbers it has.
        default: what holds if it is not there.

    Raises:
        ModelFileError: it holds something else.
    """
    text = None if element is None else element.get(name)
    if text is None:
        return default
    try:
        found = np.array([float(word) for word in text.split()])
    except ValueError:
        found = np.zeros(0)
    if found.shape != (count,) or not np.isfinite(found).all():
        allowed = "a finite number" if count == 1 else f"{count} finite numbers"
        raise ModelFileError(f"{described(element)}: {name} is {text[:80]!r}; allowed: {allowed}")
    return found


def number(element: Element | None, name: str, default: float = math.nan) -> float:
    """As :func:`numbers`, for one number."""
    return float(numbers(element, name, 1, np.array([default]))[0])


def described(element: Element) -> str:
    """An element as a message names it: by its own name or that of the nearest named one."""
    at = element
    while at is not None and at.get("name") is None:
        at = at.getparent()
    tag = element.tag if isinstance(element.tag, str) else "element"
    if at is None:
        return tag
    return f"{at.tag} {at.get('name')}" + ("" if at is element else f", {tag}")

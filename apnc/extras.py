"""What to install where a package of an extra is missing."""

from __future__ import annotations

import importlib.metadata
import json
from pathlib import Path
from typing import Any


def missing(package: str, extra: str) -> str:
    """What to say where a package is missing that an extra brings."""
    return f"'{package}' is not installed: {install_command(extra)}"


def install_command(extra: str) -> str:
    """The command that installs an extra, as it works where the person stands.

    Returns:
        ``pip install ".[build]"`` in the checkout that the package was installed from, with ``-e``
        if it was installed so. Elsewhere the same with the path of the checkout or wheel, and
        ``pip install "apnc[build]"`` if the package came from an index.
    """
    from urllib.parse import urlsplit  # noqa: PLC0415  # takes 10 ms, and is seldom needed
    from urllib.request import url2pathname  # noqa: PLC0415  # as well

    found = _installed_from()
    path = Path(url2pathname(urlsplit(found.get("url", "")).path))
    if not (found and path.exists()):
        return f'pip install "apnc[{extra}]"'
    editable = "-e " if found.get("dir_info", {}).get("editable") else ""
    place = "." if path.samefile(Path.cwd()) else path
    return f'pip install {editable}"{place}[{extra}]"'


def _installed_from() -> dict[str, Any]:
    """What pip wrote down of a folder or file that it installed the package from; else empty."""
    try:
        text = importlib.metadata.distribution("apnc").read_text("direct_url.json")
    except importlib.metadata.PackageNotFoundError:
        return {}
    found: dict[str, Any] = json.loads(text or "{}")
    return found if found.get("url", "").startswith("file:") else {}

"""JavaScript modules and all else of the page put into one HTML file."""

from __future__ import annotations

import base64
import json
import re
from pathlib import Path
from typing import Any, Final

PAGE: Final = Path(__file__).parent / "page"
_IMPORT: Final = re.compile(r'^import (\{[^}]*\}) from "\./(\w+)\.js";\n', re.MULTILINE)
_EXPORT: Final = re.compile(r"^export ((?:async )?(?:const|class|function) )(\w+)", re.MULTILINE)


def script(entry: str = "main") -> str:
    """The modules as one script, each in a scope of its own, after those that it imports.

    A module imports by name from files beside it, and exports what it declares.
    """
    done: dict[str, str] = {}
    _visit(entry, done)
    return "\n".join(done.values())


def _visit(name: str, done: dict[str, str]) -> None:
    text = (PAGE / f"{name}.js").read_text(encoding="utf-8")
    for _, other in _IMPORT.findall(text):
        if other not in done:
            _visit(other, done)
    exported = [found[1] for found in _EXPORT.findall(text)]
    text = _EXPORT.sub(r"\1\2", _IMPORT.sub(r"const \1 = module_\2;\n", text))
    done[name] = (
        f"const module_{name} = (() => {{\n{text}\nreturn {{ {', '.join(exported)} }};\n}})();"
    )


def page(data: dict[str, Any], still: bytes) -> str:
    """The HTML file.

    Args:
        data: what the script reads.
        still: a picture for browsers that cannot run it, as WebP.
    """
    parts = {
        "style": (PAGE / "style.css").read_text(encoding="utf-8"),
        "script": script(),
        "data": json.dumps(data, separators=(",", ":")).replace("</", "<\\/"),
        "still": f"data:image/webp;base64,{base64.b64encode(still).decode()}",
    }
    text = (PAGE / "index.html").read_text(encoding="utf-8")
    return re.sub(r"/\* (style|script|data|still) \*/", lambda found: parts[found[1]], text)

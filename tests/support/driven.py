"""A page in headless Chromium that a test drives while it runs, over a pair of pipes."""

from __future__ import annotations

import base64
import json
import os
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser"))), None)
PATIENCE = 60.0  # [s] that a busy machine may need


class Driven:
    """A page of the browser."""

    def __init__(self, asked: int, told: int) -> None:
        self._asked = os.fdopen(asked, "wb", buffering=0)
        self._told = os.fdopen(told, "rb")
        self._count, self._session = 0, {}
        pages = [t for t in self.do("Target.getTargets")["targetInfos"] if t["type"] == "page"]
        found = self.do("Target.attachToTarget", targetId=pages[0]["targetId"], flatten=True)
        self._session = {"sessionId": found["sessionId"]}

    def do(self, method: str, **given: Any) -> Any:
        """Call a method of the browser's protocol, and its answer."""
        self._count += 1
        message = {"id": self._count, "method": method, "params": given, **self._session}
        self._asked.write(json.dumps(message).encode() + b"\0")
        while True:
            found = bytearray()
            while (byte := self._told.read(1)) != b"\0":
                assert byte, "the browser has ended"
                found += byte
            answer = json.loads(found)
            if answer.get("id") == self._count:
                assert "error" not in answer, answer
                return answer["result"]

    def size(self, width: int, height: int, *, dark: bool = False) -> None:
        """Set the size of the window [px], and whether the user prefers a dark page."""
        metrics = {"width": width, "height": height, "deviceScaleFactor": 1, "mobile": False}
        self.do("Emulation.setDeviceMetricsOverride", **metrics)
        scheme = {"name": "prefers-color-scheme", "value": "dark" if dark else "light"}
        self.do("Emulation.setEmulatedMedia", features=[scheme])

    def open(self, address: str) -> None:
        """Open an address in the page."""
        self.do("Page.navigate", url=address)

    def value(self, expression: str) -> Any:
        """Value of a JavaScript expression in the page; None if it throws."""
        answer = self.do("Runtime.evaluate", expression=expression, returnByValue=True)
        return answer["result"].get("value") if "exceptionDetails" not in answer else None

    def until(self, expression: str) -> Any:
        """Wait until a JavaScript expression is true, and its value."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            if value := self.value(expression):
                return value
            time.sleep(0.05)
        raise AssertionError(
            f"{expression} did not come true: {self.value('document.body.innerText')}"
        )

    def mouse(self, kind: str, x: float, y: float, *, shift: bool = False) -> None:
        """Send ``mousePressed``, ``mouseMoved`` or ``mouseReleased`` at a place [px]."""
        held = {"button": "left", "buttons": 0 if kind == "mouseReleased" else 1, "clickCount": 1}
        at = {"x": x, "y": y, "modifiers": 8 if shift else 0}
        self.do("Input.dispatchMouseEvent", type=kind, **at, **held)

    def picture(self, path: Path) -> None:
        """Write what is seen as a PNG file."""
        shot = self.do("Page.captureScreenshot", format="png")["data"]
        path.write_bytes(base64.b64decode(shot))


@contextmanager
def driven(folder: Path) -> Iterator[Driven]:
    """A browser with an empty page; its profile and its log are kept in a folder."""
    assert CHROMIUM is not None
    (asked, ask), (tell, told) = os.pipe(), os.pipe()
    command = [
        *("bash", "-c", f'exec 3<&{asked} 4>&{told}; exec "$@"', "bash"),
        *(CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"),
        *("--no-first-run", "--disable-background-networking", "--disable-component-update"),
        *("--disable-quic", "--disable-sync", "--enable-logging=stderr", "--v=0"),
        "--remote-debugging-pipe",
        *(f"--user-data-dir={folder / 'profile'}", "about:blank"),
    ]
    with (
        (folder / "browser.log").open("wb") as log,
        subprocess.Popen(
            command, pass_fds=(asked, told), stdout=subprocess.DEVNULL, stderr=log
        ) as process,
    ):
        os.close(asked)
        os.close(told)
        try:
            yield Driven(ask, tell)
        finally:
            process.terminate()

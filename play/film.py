"""The page as a film: ``python -m play.film FILE.webp``, by Chromium.

The robot finds its gait, the controller stores it, the foot sensors are switched off, and the robot
walks on.
"""

from __future__ import annotations

import base64
import io
import json
import os
import shutil
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Final

from PIL import Image

from play.build import build

SIZE: Final = (680, 480)
"""Of the page [px]."""
SCALE: Final = 0.8
"""Of the film to the page."""
RATE: Final = 12
"""Pictures per second; the film shows the time as it passes."""
PARTS: Final = ((0.0, 2.5), (5.5, 9.5))
"""What is shown of the walk [s]."""
EVENTS: Final = {6.5: "page.breakOne()", 7.25: "page.sensors(page.legs)"}
"""What happens in the walk, and when [s]."""
LAST: Final = 2.0
"""How long the last picture stays [s]."""
QUALITY: Final = 20
"""Of the pictures, up to 100. The film shall be small enough for the front page, 500 kB."""
SHOWN: Final = """<style>
header, .invitation button, .time, aside { display: none !important }
main { padding: 0 !important; height: 100vh }
.stage { flex: 1; height: auto !important; min-height: 0 !important }
.stage { background: #edf2f6 !important }
.invitation { bottom: 4px !important }
.invitation p { font-size: 17px !important; min-height: 2.9em !important }
.invitation p { background: none !important }
</style>"""
"""What can be pressed is left out, and the background is plain."""
FLOOR: Final = "#e4ebf1"
"""Of the tiles. The less they stand out, the smaller is the film."""
STEP: Final = """{{
  const page = window.play;
  page.paused = true;
  page.owed = 0;
  {event};
  page.look.tile = "{floor}";
  page.passed = {passed};
  for (let n = 0; n < {ticks}; n++) page.step();
  page.picture();
}}"""


class Browser:
    """A page in headless Chromium, driven through a pair of pipes."""

    def __init__(self, asked: int, told: int) -> None:
        self._asked = os.fdopen(asked, "wb", buffering=0)
        self._told = os.fdopen(told, "rb")
        self._count = 0
        self._session: dict[str, str] = {}
        (target,) = (
            info["targetId"]
            for info in self.do("Target.getTargets")["targetInfos"]
            if info["type"] == "page"
        )
        session = self.do("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        self._session = {"sessionId": session}

    def do(self, method: str, **given: Any) -> Any:
        """Call a method of the browser's protocol, and its answer."""
        self._count += 1
        message = {"id": self._count, "method": method, "params": given, **self._session}
        self._asked.write(json.dumps(message).encode() + b"\0")
        while True:
            answer = json.loads(self._read())
            if answer.get("id") == self._count:
                if "error" in answer:
                    raise OSError(f"{method}: {answer['error']['message']}")
                return answer["result"]

    def _read(self) -> bytes:
        found = bytearray()
        while (byte := self._told.read(1)) != b"\0":
            if not byte:
                raise OSError("the browser ended before the film was taken")
            found += byte
        return bytes(found)

    def value(self, expression: str) -> Any:
        """Value of a JavaScript expression in the page."""
        answer = self.do("Runtime.evaluate", expression=expression, returnByValue=True)
        if "exceptionDetails" in answer:
            raise OSError(answer["exceptionDetails"]["exception"]["description"])
        return answer["result"].get("value")

    def picture(self) -> Image.Image:
        """What is seen now."""
        shot = self.do("Page.captureScreenshot", format="png")["data"]
        return Image.open(io.BytesIO(base64.b64decode(shot))).convert("RGB")


@contextmanager
def opened(page: Path, profile: Path) -> Iterator[Browser]:
    """A page in a browser that ends with the block."""
    binary = shutil.which("chromium") or shutil.which("chromium-browser")
    if binary is None:
        sys.exit("no chromium binary found: no film was taken")
    (asked, ask), (tell, told) = os.pipe(), os.pipe()
    command = [
        # the browser reads from 3 and writes to 4
        *("bash", "-c", f'exec 3<&{asked} 4>&{told}; exec "$@"', "bash"),
        *(binary, "--headless", "--no-sandbox", "--disable-gpu", "--hide-scrollbars"),
        *("--remote-debugging-pipe", f"--user-data-dir={profile}"),
        *(f"--window-size={SIZE[0]},{SIZE[1]}", page.as_uri()),
    ]
    with subprocess.Popen(
        command, pass_fds=(asked, told), stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL
    ) as process:
        os.close(asked)
        os.close(told)
        try:
            yield Browser(ask, tell)
        finally:
            process.terminate()


def pictures() -> Iterator[Image.Image]:
    """The pictures of the film."""
    with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as folder:
        page = Path(folder) / "page.html"
        build(page)
        text = page.read_text(encoding="utf-8")
        page.write_text(text.replace("</head>", f"{SHOWN}</head>"), encoding="utf-8")
        with opened(page, Path(folder) / "profile") as browser:
            browser.do(
                "Emulation.setDeviceMetricsOverride",
                **{
                    "width": SIZE[0],
                    "height": SIZE[1],
                    "deviceScaleFactor": SCALE,
                    "mobile": False,
                },
            )
            while not browser.value("window.play !== undefined"):
                time.sleep(0.1)
            browser.value("window.play.begin({})")
            for count in range(round(PARTS[-1][1] * RATE)):
                event, now = EVENTS.get(count / RATE, ""), count / RATE
                step = STEP.format(event=event, ticks=60 // RATE, passed=1 / RATE, floor=FLOOR)
                browser.value(step)
                if any(begin <= now < end for begin, end in PARTS):
                    yield browser.picture()


def main(file: Path) -> None:
    """Write the film."""
    first, *rest = pictures()
    file.parent.mkdir(parents=True, exist_ok=True)
    first.save(
        file,
        save_all=True,
        append_images=rest,
        duration=[1000 // RATE] * len(rest) + [round(1000 * LAST)],
        loop=0,
        quality=QUALITY,
        method=4,
    )


if __name__ == "__main__":
    main(Path(sys.argv[1]))

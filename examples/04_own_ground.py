"""A ground of one's own: a low hill across which Lilibot walks, in Python and, faster, in C."""

import ctypes
import shutil
import subprocess
import tempfile
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

import apnc
from apnc_plant.ground import Numbers

AT, HEIGHT, RADIUS = 0.6, 0.015, 1.5  # of a large ball that stands out of the plane [m]


class Hill(apnc.Ground):
    """The top of the ball, touched in Python."""

    kind = "hill"
    top = HEIGHT  # no point is higher over the plane

    def elevation(self, x: Any, y: Any) -> Any:
        """Height over the plane."""
        below = np.maximum(RADIUS**2 - (x - AT) ** 2 - y**2, 0.0)
        return np.maximum(0.0, HEIGHT - RADIUS + np.sqrt(below))

    def touch(self, x: float, y: float, z: float, radius: float) -> list[tuple[float, ...]]:
        """Normal and depth at every place where a foot, a ball, touches plane and hill."""
        dx, dz, near = x - AT, z - (HEIGHT - RADIUS), RADIUS + radius
        away = (dx * dx + y * y + dz * dz) ** 0.5
        on_plane, on_hill = (0, 0, 1, radius - z), (dx / away, y / away, dz / away, near - away)
        return [place for place in (on_plane, on_hill) if place[3] > 0.0]


@cache
def function_in_c() -> int:
    """Address of the touch function in C; the library it is in stays loaded."""
    library, source = Path(tempfile.mkdtemp()) / "hill.so", Path(__file__).with_suffix(".c")
    subprocess.run(["cc", "-shared", "-fPIC", source, "-o", library, "-lm"], check=True)
    return ctypes.cast(ctypes.CDLL(str(library)).hill, ctypes.c_void_p).value or 0


class HillInC(Hill):
    """The same, touched in C."""

    address = property(lambda self: function_in_c())

    def numbers(self, radius: float) -> Numbers:
        """What the function reads, and at how many places a foot can touch at a time."""
        return Numbers(np.array([AT, HEIGHT, RADIUS]), contacts=2)


for ground in (Hill(), HillInC()) if shutil.which("cc") else (Hill(),):
    record = apnc.simulate(apnc.Experiment(mi=0.15, duration=20, ground=ground, engine="compiled"))
    x, z = record.signals["position"][:, [0, 2]].T
    trunk = [float(z[np.abs(x - place) < 0.05].mean()) for place in (0.1, AT, 1.1)]
    print(record.end, f"in {record.wall_s:.2f} s; heights before, on, behind:", np.round(trunk, 4))

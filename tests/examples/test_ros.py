"""Controller and robot as ROS nodes under a real master, by wall clock."""

from __future__ import annotations

import itertools
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]
OBSERVER = ROOT / "tests" / "support" / "ros_observer.py"
DEBIAN = "/usr/lib/python3/dist-packages"
"""Where Debian's rospy lies, which a Python that is not Debian's does not look into."""

pytestmark = [
    pytest.mark.skipif(shutil.which("roslaunch") is None, reason="roslaunch is not installed"),
    pytest.mark.skipif(sys.version_info[:2] != (3, 11), reason="Debian's rospy is for Python 3.11"),
]


def free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port: int = probe.getsockname()[1]
    return port


@pytest.fixture
def ros(tmp_path: Path) -> Iterator[dict[str, str]]:
    """A roscore on the loopback interface, and the environment of its nodes."""
    port = free_port()
    customised = tmp_path / "customised"
    customised.mkdir()
    # Debian's packages come last, as in an environment with --system-site-packages: in PYTHONPATH
    # they would come first, and cffi refuse the library of another cffi that lies there
    (customised / "sitecustomize.py").write_text(f"import sys\nsys.path.append({DEBIAN!r})\n")
    environment = os.environ | {
        "ROS_MASTER_URI": f"http://127.0.0.1:{port}",
        "ROS_IP": "127.0.0.1",
        "ROS_HOME": str(tmp_path / "ros"),
        "ROS_PACKAGE_PATH": str(ROOT / "examples"),
        "PYTHONPATH": str(customised),
        "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}",
    }
    core = subprocess.Popen(
        ["/usr/bin/python3", shutil.which("roscore") or "roscore", "-p", str(port)],
        env=environment | {"PYTHONPATH": ""}, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
    )  # fmt: skip
    try:
        yield environment
    finally:
        core.send_signal(signal.SIGINT)
        core.wait(30)


def observe(ros: dict[str, str], seconds: float) -> dict[str, Any]:
    done = subprocess.run(
        [sys.executable, str(OBSERVER), str(seconds)],
        env=ros, capture_output=True, text=True, timeout=seconds + 60, check=True,
    )  # fmt: skip
    heard: dict[str, Any] = json.loads(done.stdout.splitlines()[-1])
    return heard


def phases(report: dict[str, str]) -> np.ndarray:
    return np.array([float(angle) for angle in report["phi"].split()])


@pytest.mark.thorough
def test_the_trot_forms_and_comes_back_when_the_node_dies(
    ros: dict[str, str], tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    gait = tmp_path / "gait.json"
    launch = subprocess.Popen(
        ["/usr/bin/python3", "/usr/bin/roslaunch", "--wait", "apnc_ros", "walk.launch",
         "mi:=0.12", f"gait:={gait}"],
        env=ros, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
    )  # fmt: skip
    try:
        heard = observe(ros, 20.0)
        last = heard["reports"][-1]
        assert last["kappa"] == "1"
        # the FMU's own phases lag and sway: the trot is (pi, pi, 0)
        assert np.abs(phases(last) - [np.pi, np.pi, 0.0]).max() < np.pi / 4
        assert heard["places"][-1] - heard["places"][0] > 0.3  # m
        ticks = np.diff(heard["commands"][60:])
        assert np.median(ticks) == pytest.approx(1 / 60, abs=1e-3)
        assert gait.is_file()

        node = ["pkill", "-KILL", "-P", str(launch.pid), "-f", "__name:=controller"]
        subprocess.run(node, check=True)
        again = observe(ros, 12.0)
        ticks_of = [int(report["tick"]) for report in again["reports"]]
        fresh = [n for n, (a, b) in enumerate(itertools.pairwise(ticks_of)) if b < a]
        first = again["reports"][fresh[0] + 1 if fresh else 0]
        assert int(first["tick"]) <= 120 and first["kappa"] == "1"
        assert np.abs(phases(again["reports"][-1]) - [np.pi, np.pi, 0.0]).max() < np.pi / 4
    finally:
        launch.send_signal(signal.SIGINT)
        try:
            output, _ = launch.communicate(timeout=30)
        except subprocess.TimeoutExpired:
            launch.kill()
            output, _ = launch.communicate()
        print(output[-2000:])
    with capsys.disabled():
        print(
            f"\n  jitter of a tick: {1e3 * np.std(ticks):.2f} ms standard deviation, "
            f"{1e3 * np.abs(ticks - 1 / 60).max():.1f} ms at most"
        )

"""The FMU that comes out of a tuned robot file, and a walk in it."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path
from typing import Any

import numpy as np

from apnc.loop.experiment import Experiment
from apnc.loop.simulate import plant_of, simulate
from apnc_plant.robot import load_robot
from research.gallery.measure import FIRST_SEED, duration_of, mi_values


def fmu_of(robot_file: Path, fmu: Path) -> dict[str, Any]:
    """Build the FMU of a robot by ``apnc build``, for this machine, and walk the robot under it.

    Args:
        robot_file: a tuned file.
        fmu: the FMU, which is written.

    Returns:
        ``kB`` of the file; start values ``rate`` [Hz] and ``weight`` [N]; ``mi`` of the walk;
        ``apart``, how far that walk gets from the one in the compiled engine [m].

    Raises:
        ValueError: the FMU was not built.
    """
    words = ["build", "--robot", str(robot_file), "--platform", "host", "--output", str(fmu)]
    done = subprocess.run([sys.executable, "-m", "apnc", *words], check=False)
    if done.returncode != 0:
        raise ValueError(f"apnc build of {robot_file} ended with {done.returncode}")
    robot = load_robot(robot_file)
    given: dict[str, Any] = {
        "robot": robot, "mi": robot.mi or mi_values(robot)[0], "seed": FIRST_SEED,
        "duration": duration_of(robot), "engine": "compiled",
    }  # fmt: skip
    inside = Experiment(fmu=str(fmu), **given)
    # a plant that is given is walked under the FMU itself
    record = simulate(inside, plant=plant_of(inside))
    compiled = simulate(Experiment(**given))
    apart = np.abs(record.signals["position"] - compiled.signals["position"]).max()
    return {
        "kB": round(fmu.stat().st_size / 1000.0),
        "rate": 1.0 / inside.Ts,
        "weight": inside.parameters()["robot_weight"],
        "mi": given["mi"],
        "apart": float(apart),
    }

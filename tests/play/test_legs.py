"""The page draws the legs of every robot where the plant has them."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from made_up_robots import every_chain
from odd_robot import odd_robot

from apnc_plant.kinematics import Kinematics
from apnc_plant.robot import RobotDescription
from play.numbers import chains_of

SPACE = Path(__file__).resolve().parents[2] / "play" / "page" / "space.js"
NODE = shutil.which("node")


@pytest.mark.skipif(NODE is None, reason="node is missing")
@pytest.mark.parametrize("robot", [odd_robot(), every_chain()], ids=lambda robot: robot.name)
def test_chains_are_those_of_the_plant(robot: RobotDescription, tmp_path: Path) -> None:
    angles = np.random.default_rng(2).uniform(-0.5, 0.5, (len(robot.legs), 3))
    shutil.copy(SPACE, tmp_path / "space.mjs")
    program = f"""
        import {{ chainOf }} from "./space.mjs";
        const angles = {json.dumps(angles.tolist())};
        const chains = {json.dumps(chains_of(robot))};
        console.log(JSON.stringify(chains.map((leg, k) => chainOf(leg, angles[k]))));
    """
    (tmp_path / "run.mjs").write_text(program)
    ran = subprocess.run(
        [str(NODE), "run.mjs"], cwd=tmp_path, capture_output=True, text=True, check=True, timeout=60
    )
    found = np.array(json.loads(ran.stdout))
    own = [Kinematics(robot).points(k, *each) for k, each in enumerate(angles)]
    np.testing.assert_allclose(found[:, 0], [leg.mount for leg in robot.legs])
    np.testing.assert_allclose(found[:, 1:], own, rtol=0.0, atol=1e-12)

"""Loading of Exudyn: its messages do not reach stdout."""

import contextlib
import io
import subprocess
import sys

import numpy as np
import pytest

from apnc_plant.robot import load_robot
from exudyn_models.plant import ExudynPlant


def test_the_warning_stays_off_stdout_and_what_exudyn_says_else_does_not() -> None:
    code = (
        "from exudyn_models.plant import ExudynPlant\n"
        "from exudyn_models.engine import exu\n"
        "from apnc_plant.robot import load_robot\n"
        "import numpy as np\n"
        "ExudynPlant(load_robot('lilibot')).advance(np.zeros(4), np.zeros(4), 0.1)\n"
        "exu().Print('heard')\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("heard\n", "")


def test_stdout_stays_quiet(capfd: pytest.CaptureFixture[str]) -> None:
    with contextlib.redirect_stdout(io.StringIO()) as printed:
        ExudynPlant(load_robot("lilibot")).advance(np.zeros(4), np.zeros(4), 0.1)
    assert printed.getvalue() == ""
    assert capfd.readouterr() == ("", "")

"""The peer: the same controller in Python, exported by PythonFMU.

The slave script runs the reference of ``apnc_core``; PythonFMU packages it with a library that
embeds the interpreter.
"""

from __future__ import annotations

import importlib.util
import subprocess
import sys
from pathlib import Path
from typing import Final

SCRIPT: Final = """\
import numpy as np
from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real

from apnc_core.controller import Controller
from apnc_core.interface import Inputs, Parameters


class ApncPeer(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        p = Parameters(stored=True, phi_stored=(3.0, 0.1, 3.0))
        self.controller = Controller(p)
        self.MI = 0.08
        self.register_variable(Real("MI", causality=Fmi2Causality.input))
        for leg in range(1, 5):
            setattr(self, f"grf{leg}", 24.525 / 4 * (0.8 + 0.01 * (leg - 1)))
            setattr(self, f"theta_hip{leg}", 0.0)
            setattr(self, f"theta_knee{leg}", 0.0)
            self.register_variable(Real(f"grf{leg}", causality=Fmi2Causality.input))
            self.register_variable(Real(f"theta_hip{leg}", causality=Fmi2Causality.output))
            self.register_variable(Real(f"theta_knee{leg}", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        grf = np.array([self.grf1, self.grf2, self.grf3, self.grf4])
        out = self.controller.tick(Inputs(grf, MI=self.MI))
        for leg in range(4):
            setattr(self, f"theta_hip{leg + 1}", float(out.theta_hip[leg]))
            setattr(self, f"theta_knee{leg + 1}", float(out.theta_knee[leg]))
        return True
"""


def available() -> bool:
    """Whether PythonFMU is installed (extra ``test``)."""
    return importlib.util.find_spec("pythonfmu") is not None


def export(folder: Path) -> Path:
    """Export the peer into ``folder`` and return the FMU.

    Raises:
        RuntimeError: PythonFMU failed.
    """
    script = folder / "apnc_peer.py"
    script.write_text(SCRIPT)
    command = [
        *(sys.executable, "-m", "pythonfmu", "build"),
        *("-f", str(script), "-d", str(folder)),
    ]
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    path = folder / "ApncPeer.fmu"
    if done.returncode != 0 or not path.is_file():
        raise RuntimeError(f"PythonFMU failed: {done.stderr.strip() or done.stdout.strip()}")
    return path

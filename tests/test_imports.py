"""No import has a side effect: it loads no engine, prints nothing and leaves ``sys`` as it is."""

from __future__ import annotations

import subprocess
import sys

IMPORT_ALL = """
import importlib, pkgutil, sys

def of_sys():
    return {name: value for name, value in vars(sys).items() if name != "modules"}

before = of_sys()
for root in ("apnc_plant", "exudyn_models", "mujoco_models", "apnc"):
    package = importlib.import_module(root)
    for module in pkgutil.walk_packages(package.__path__, root + "."):
        if not module.name.endswith("__main__"):  # that is a program
            importlib.import_module(module.name)
engines = {"exudyn", "mujoco"} & sys.modules.keys()
after = of_sys()
changed = [name for name in before | after if before.get(name) is not after.get(name)]
sys.exit(f"loaded {engines}, changed {changed}" if engines or changed else 0)
"""


def test_importing_every_module_has_no_side_effect() -> None:
    done = subprocess.run(
        [sys.executable, "-c", IMPORT_ALL], capture_output=True, text=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")


LOAD = """
import sys
from exudyn_models.engine import exu, items
assert "exudyn" not in sys.modules and not hasattr(sys, "exudynFast")
items(), exu()
assert sys.exudynFast
"""


def test_exudyn_comes_at_its_first_use_silent_and_fast() -> None:
    done = subprocess.run([sys.executable, "-c", LOAD], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stdout, done.stderr) == (0, "", "")

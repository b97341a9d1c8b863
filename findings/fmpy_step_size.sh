#!/usr/bin/env bash
# FMPy ignores the step that it is asked for, and steps a long co-simulation coarsely.
#
# Version: FMPy 0.3.32 and pythonfmu 0.7.0 (PyPI), run on 2026-12-01.
# Behaviour: simulate_fmu takes step_size for co-simulation, too, and does not use it there. The
# FMU is stepped by the interval of the output. If none is given, that is the step of the FMU's
# default experiment, doubled until at most 1000 steps are left, without a word. So a controller
# that asks for 1/60 s gets its inputs four times too seldom in a run of 45 s.
# Output seen: run, argument, longest step that the FMU was given in s
#   10 s no argument 0.0167
#   45 s no argument 0.0667
#   45 s step_size=1/60 0.0667
#   45 s output_interval=1/60 0.0167
# Way out: output_interval.
#
# Exit code 0 as long as it is so, 1 once it changes.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
python3 -m venv "$work/venv"
"$work/venv/bin/pip" install -q "fmpy==0.3.32" "pythonfmu==0.7.0"
cd "$work"
cat >longest.py <<'END'
from pythonfmu import DefaultExperiment, Fmi2Causality, Fmi2Slave, Real


class Longest(Fmi2Slave):
    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.default_experiment = DefaultExperiment(step_size=1 / 60)
        self.step = 0.0
        self.register_variable(Real("step", causality=Fmi2Causality.output))

    def do_step(self, current_time, step_size):
        self.step = max(self.step, step_size)
        return True
END
"$work/venv/bin/pythonfmu" build -f longest.py >/dev/null
cat >look.py <<'END'
import sys

from fmpy import simulate_fmu

STEP = 1 / 60
RUNS = {
    "10 s no argument": (10.0, {}),
    "45 s no argument": (45.0, {}),
    "45 s step_size=1/60": (45.0, {"step_size": STEP}),
    "45 s output_interval=1/60": (45.0, {"output_interval": STEP}),
}
seen = {}
for what, (stop_time, arguments) in RUNS.items():
    result = simulate_fmu("Longest.fmu", stop_time=stop_time, **arguments)
    seen[what] = round(float(result["step"].max()), 4)
    print(what, seen[what])
sys.exit(0 if list(seen.values()) == [0.0167, 0.0667, 0.0667, 0.0167] else 1)
END
"$work/venv/bin/python" look.py

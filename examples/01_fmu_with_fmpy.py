"""Drive the controller FMU with fmpy alone: four legs in the air, then on the ground.

apnc build --output Apnc.fmu
python examples/01_fmu_with_fmpy.py Apnc.fmu
"""

import sys

import numpy as np
from fmpy import extract, read_model_description
from fmpy.fmi2 import FMU2Slave

path = sys.argv[1] if len(sys.argv) > 1 else "Apnc.fmu"
description = read_model_description(path)
reference = {v.name: v.valueReference for v in description.modelVariables}
legs = range(1, 5)  # RF, RH, LF, LH
loads = [reference[f"leg[{i}].grf"] for i in legs]
hips = [reference[f"leg[{i}].theta_hip"] for i in legs]

fmu = FMU2Slave(
    guid=description.guid,
    unzipDirectory=extract(path),
    modelIdentifier=description.coSimulation.modelIdentifier,
    instanceName="controller",
)
fmu.instantiate()
fmu.setupExperiment(startTime=0.0)
fmu.enterInitializationMode()
fmu.setReal([reference["MI"]], [0.15])
fmu.exitInitializationMode()
step = float(description.defaultExperiment.stepSize)
for n in range(600):
    weight = 0.0 if n < 300 else 24.5
    fmu.setReal(loads, [weight / 4 * (1 + 0.1 * i * np.sin(0.2 * n)) for i in legs])
    fmu.doStep(n * step, step)
    if n % 60 == 0:
        print(f"t = {n * step:4.1f} s  theta_hip = {np.round(fmu.getReal(hips), 3)} rad")
fmu.terminate()
fmu.freeInstance()

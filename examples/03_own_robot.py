"""A robot of one's own: check its file, then walk it with the gains that it carries."""

from pathlib import Path

import numpy as np

import apnc

robot = apnc.load_robot(str(Path(__file__).with_suffix(".toml")))
print(f"{robot.name}: {robot.weight / 9.81:.2f} kg, legs in the FMU's order:")
for leg in robot.legs:
    print(f"  {leg.name}  mounted at {np.array(leg.mount)} m")

experiment = apnc.Experiment(robot=robot, mi=0.12, duration=20)
print(
    f"own gains: {dict(robot.controller)}; weight {experiment.parameters()['robot_weight']:.1f} N"
)

record = apnc.simulate(experiment)
summary = apnc.walk_features(record)
phases = ", ".join(f"{phi:.2f}" for phi in record.signals["phi"][-1])
print(f"{record.end} at {record.ended_at:.1f} s, {summary.path_speed_m_per_s:.3f} m/s")
print(f"phases against {record.legs[0]} at the end: {phases} rad")

standing = record.signals["foot_force"][-600:, :, 2].sum(axis=1).mean()  # the last 10 s
print(f"force on the ground {standing:.1f} N")

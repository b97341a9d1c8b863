"""A stored gait: what one controller learned, put into a fresh one on a robot that feels nothing.

In condition S3 every foot sensor is dead.
"""

import apnc

learning = apnc.simulate(apnc.Experiment(mi=0.15, duration=30))
apnc.write_report(learning, "learning")
gait = apnc.gait_of_run("learning")
apnc.write_gait(gait, "gait.json")

with_gait = apnc.read_gait("gait.json").settings(learning.legs)
for name, settings in (("no stored gait", {}), ("stored gait", with_gait)):
    record = apnc.simulate(
        apnc.Experiment(mi=0.15, duration=12, conditions="S3", settings=settings)
    )
    phases = ", ".join(f"{phi:5.2f}" for phi in record.signals["phi"][-1])
    speed = apnc.walk_features(record).path_speed_m_per_s
    print(f"{name}: phases {phases} rad, {speed:.3f} m/s along the path")

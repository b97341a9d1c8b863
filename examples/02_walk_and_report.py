"""Walk Lilibot over obstacles and write the report of the walk into walk/."""

import apnc

experiment = apnc.Experiment(
    mi=0.15,  # sets the stepping frequency
    duration=20,  # s
    seed=3,  # of the robot's asymmetry and the sensor noise
    ground=apnc.Obstacles(roughness=0.2, seed=3),
)
record = apnc.simulate(experiment)
summary = apnc.walk_features(record)

print(f"{record.end} at {record.ended_at:.1f} s: {experiment.command()}")
print(f"speed along the path {summary.path_speed_m_per_s:.3f} m/s")
print(f"stride frequency     {summary.stride_frequency_hz:.2f} Hz")
if summary.convergence_time_s is None:
    print("no trot held to the end")
else:
    print(f"trot after           {summary.convergence_time_s:.1f} s, held to the end")

height = record.signals["position"][:, 2]  # one array per signal, first axis time
print(f"height of the trunk  {1e3 * height.min():.0f} ... {1e3 * height.max():.0f} mm")

apnc.write_report(record, "walk")
print("report               walk/report.html")

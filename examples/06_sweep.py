"""A sweep: every pair of two lists is one experiment, all walked side by side, then a table."""

import csv
import math

import apnc

CELLS = [(mi, slope) for mi in (0.08, 0.15) for slope in (0.0, 5.0)]


def experiment(mi: float, slope_deg: float) -> apnc.Experiment:
    """One cell of the sweep."""
    return apnc.Experiment(mi=mi, duration=15, ground=apnc.Plane(slope=math.radians(slope_deg)))


summaries = apnc.simulate_many([experiment(*cell) for cell in CELLS], workers=2)
rows = [
    {
        "mi": mi,
        "slope_deg": slope,
        "end": summary.end,
        "speed_m_per_s": summary.path_speed_m_per_s,
        "stride_hz": summary.stride_frequency_hz,
        "cost_of_transport": summary.cost_of_transport,
    }
    for (mi, slope), summary in zip(CELLS, summaries, strict=True)
]
with open("sweep.csv", "w", newline="") as file:  # noqa: PTH123
    table = csv.DictWriter(file, rows[0])
    table.writeheader()
    table.writerows(rows)
print("  MI   slope   end        speed     stride")
for row in rows:
    print(
        f"{row['mi']:.2f}  {row['slope_deg']:4.1f} deg  {row['end']}  "
        f"{row['speed_m_per_s']:.3f} m/s  {row['stride_hz']:.2f} Hz"
    )

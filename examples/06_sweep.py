"""A sweep: every pair of two lists is one experiment, each on a core, the figures as a table."""

import csv
import math
from concurrent.futures import ProcessPoolExecutor

import apnc


def trial(mi: float, slope_deg: float) -> dict[str, object]:
    """Key figures of one walk."""
    ground = apnc.Plane(slope=math.radians(slope_deg))
    record = apnc.simulate(apnc.Experiment(mi=mi, duration=15, ground=ground))
    summary = apnc.summarise(record)
    return {
        "mi": mi,
        "slope_deg": slope_deg,
        "end": str(record.end),
        "speed_m_per_s": summary.path_speed_m_per_s,
        "stride_hz": summary.stride_frequency_hz,
        "cost_of_transport": summary.cost_of_transport,
    }


if __name__ == "__main__":  # the workers import this file
    cells = [(mi, slope) for mi in (0.08, 0.15) for slope in (0.0, 5.0)]
    with ProcessPoolExecutor(2) as workers:
        rows = list(workers.map(trial, *zip(*cells, strict=True)))
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

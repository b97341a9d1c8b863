"""Write docs/record.md, the page of the columns of record.csv, from the tables of signals.

python -m research.docs.record
"""

from __future__ import annotations

import numpy as np

from apnc.loop.columns import column_names
from apnc.loop.experiment import Experiment
from apnc.loop.record import Record, merged
from apnc_core.schema import Causality, Shape
from apnc_core.variables import TABLE
from apnc_plant.signals import PLANT_SIGNALS
from research.docs import DOCS

HEAD = """# record.csv

`record.csv` holds every signal of a run in SI units. Each line after the first is a sample, one
per tick of the controller. Read it with `pandas.read_csv("record.csv", index_col="time")` or
`numpy.genfromtxt("record.csv", delimiter=",", names=True)`. In Python, `record.to_pandas()` gives
the same table without a file. A name with a comma in it stands in quotation marks; pandas and the
module `csv` read that. The units stand in `summary.json` as well, under `columns`.

- `LEG.` stands for the name of each leg in the order of the robot, e.g. `RF.o1`, `RH.o1`. `1k`
  stands for the relation of leg 1 and leg k, counted in that order: `phi12`, `phi13`, `phi14`.
- A sample shows the inputs that the controller read at the start of its tick (loads, commands), its
  outputs, and the robot at that moment, before it has moved to them.
- A load has three names. The column here is named by the leg, `RF.grf`. The input of the controller
  FMU is named by the number of the leg: `leg[1].grf`, or `leg1_grf` in an FMU built with
  `--naming flat`. Leg 1 is the first leg of the robot, here RF. The other signals of a leg follow
  the same rule. In Python `record.signals["grf"][:, 0]` is the load of leg 1.
- Frames. World: x forward at the start, y to the left, z up, level on a slope, too. Reference pose:
  the pose of the robot file, where every joint angle is 0.
- Signs of the controller. `theta_hip` and `theta_knee` have those of `joint_angle`. `phi1k` and
  `phi_memory1k` are positive where leg k is ahead of leg 1. `turn` is positive to the left.
  Booleans are 0 or 1.

| column | unit | frame | meaning | positive |
|---|---|---|---|---|
"""


def page() -> str:
    """Text of the page."""
    lines: dict[str, str] = {}
    for column in column_names(_empty()):
        name = column.name.replace("RF.", "LEG.")
        if name.endswith("12"):
            name = name.removesuffix("2") + "k"
        elif name.startswith(("RH.", "LF.", "LH.")) or name.endswith(("13", "14")):
            continue
        cells = (f"`{name}`", column.unit, column.frame, column.description, column.sign)
        lines[name] = f"| {' | '.join(cell.replace('|', '&#124;') or '–' for cell in cells)} |"
    return HEAD + "\n".join(lines.values()) + "\n"


def _empty() -> Record:
    """A record of every signal without samples."""
    experiment = Experiment()
    robot = experiment.description
    n = len(robot.legs)
    widths = {Shape.scalar: (), Shape.leg: (n,), Shape.relation: (n - 1,)}
    shown = [v for v in TABLE if v.causality is not Causality.parameter]
    return Record(
        legs=tuple(leg.name for leg in robot.legs),
        time=np.empty(0),
        signals=merged(
            plant={signal.name: np.empty((0, *signal.shape(n))) for signal in PLANT_SIGNALS},
            controller={v.name: np.empty((0, *widths[v.shape])) for v in shown},
        ),
        mass=robot.mass,
        experiment=experiment,
        robot=robot,
    )


if __name__ == "__main__":
    (DOCS / "record.md").write_text(page(), encoding="utf-8")

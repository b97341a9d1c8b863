"""All benchmarks, one after the other."""

from benchmarks import (
    batch,
    closed_loop,
    controller,
    install,
    legs,
    memory,
    mujoco_rollout,
    plant,
    study,
    tune,
    walk_command,
)
from benchmarks.command import main

if __name__ == "__main__":
    modules = (
        controller, closed_loop, batch, plant, mujoco_rollout, legs, memory, walk_command, install,
        study, tune,
    )  # fmt: skip
    main({module.__name__.split(".")[-1]: module.measure for module in modules}, __doc__)

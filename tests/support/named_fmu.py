"""An FMU under control of a test, its variables by name."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import fmpy
from fmpy import fmi2


class FMU2Named(fmi2.FMU2Slave):
    """An FMU by names; fmpy wants the name of the class to begin with FMU2."""

    def __init__(self, path: Path) -> None:
        """Unpack an FMU into ``folder``."""
        description = fmpy.read_model_description(str(path))
        self.reference = {v.name: v.valueReference for v in description.modelVariables}
        self.folder = fmpy.extract(str(path))
        super().__init__(
            guid=description.guid,
            unzipDirectory=self.folder,
            modelIdentifier=description.coSimulation.modelIdentifier,
            instanceName="part",
        )

    def get(self, names: Sequence[str]) -> list[float]:
        """Values of Reals."""
        return list(self.getReal([self.reference[name] for name in names]))

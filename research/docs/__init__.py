"""What writes tables, pictures and films of the documentation."""

from __future__ import annotations

from pathlib import Path
from typing import Final

ROOT: Final = Path(__file__).resolve().parents[2]
"""The checkout."""

DOCS: Final = ROOT / "docs"

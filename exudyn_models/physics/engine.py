"""Exudyn, imported once for the whole package: the fast build, without its greeting."""

from __future__ import annotations

import contextlib
import io
import sys
from typing import Any

# Exudyn reads this flag at its first import only; the build without range checks is 1.4x faster.
vars(sys).setdefault("exudynFast", True)
# The import announces the build on stdout, which belongs to the program that uses this package.
with contextlib.redirect_stdout(io.StringIO()):
    import exudyn
    from exudyn import advancedUtilities, itemInterface

# Untyped: the stubs Exudyn ships contradict its signatures.
exu: Any = exudyn
items: Any = itemInterface
create_symbolic_user_function: Any = advancedUtilities.CreateSymbolicUserFunction

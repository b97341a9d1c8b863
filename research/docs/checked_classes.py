"""Extension of griffe for the site: classes with ``checked`` of apnc_plant.files are dataclasses.

Without it the reference shows neither their types nor their defaults. ``mkdocs.yml`` names it.
"""

from __future__ import annotations

from typing import Any, Final

import griffe

CHECKED: Final = "apnc_plant.files.checked"


class CheckedClasses(griffe.Extension):
    """Puts the decorator that griffe knows in place of ours, and types without their checks."""

    def on_class_instance(self, *, cls: griffe.Class, **_: Any) -> None:
        """Called for each class when its head has been read."""
        for decorator in cls.decorators:
            if isinstance(decorator.value, griffe.Expr) and decorator.callable_path == CHECKED:
                decorator.value = griffe.ExprName("dataclasses.dataclass")

    def on_attribute_instance(self, *, attr: griffe.Attribute, **_: Any) -> None:
        """Called for each field: ``Annotated[T, ...]`` is shown as ``T``."""
        annotated = attr.annotation
        if (
            isinstance(annotated, griffe.ExprSubscript)
            and str(annotated.left) == "Annotated"
            and isinstance(annotated.slice, griffe.ExprTuple)
        ):
            attr.annotation = annotated.slice.elements[0]

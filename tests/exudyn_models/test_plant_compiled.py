"""Compilation without a place to write."""

import numba
import pytest

from exudyn_models.physics.compiled import compiled


def test_functions_compile_where_nothing_can_be_cached(monkeypatch: pytest.MonkeyPatch) -> None:
    real = numba.njit

    def read_only(*arguments: object, cache: bool = False, **options: object) -> object:
        if cache:
            return lambda function: (_ for _ in ()).throw(RuntimeError("no locator available"))
        return real(*arguments, **options)

    monkeypatch.setattr(numba, "njit", read_only)

    @compiled
    def halve(x: float) -> float:
        return x / 2.0

    assert halve(3.0) == 1.5
    assert hasattr(halve, "py_func")

"""Touch functions of grounds, called by compiled code that does not know which ground it is."""

from __future__ import annotations

from functools import cache
from typing import Any, Final

import numba
from llvmlite import ir
from numba import types
from numba.extending import intrinsic

from apnc_plant.ground.surface import Surface
from exudyn_models.physics.compiled import cached

_REAL: Final = types.float64
_INTEGER: Final = types.int64
_POINTER: Final[Any] = types.CPointer
_REALS: Final = _POINTER(_REAL)
_INTEGERS: Final = _POINTER(_INTEGER)
_SIGNATURE: Final = _INTEGER(_REAL, _REAL, _REAL, _REAL, _REALS, _INTEGERS, _REALS)


@cache
def touch_of(kind: type[Surface]) -> Any:
    """Touch function of a kind of ground as a C function; its ``address`` is what code calls.

    One C signature for all: the forces are compiled once, not once per kind of ground.
    """
    return cached(numba.cfunc, kind.touch, _SIGNATURE)


def _call_touch(
    typing: Any,
    address: Any,
    x: Any,
    y: Any,
    z: Any,
    radius: Any,
    reals: Any,
    integers: Any,
    found: Any,
) -> Any:
    """Types and code of a call; the arguments but the first as ``Surface.touch`` takes them."""

    def generate(context: Any, builder: Any, signature: Any, arguments: Any) -> Any:
        real, integer = ir.DoubleType(), ir.IntType(64)
        pointers = [real.as_pointer(), integer.as_pointer(), real.as_pointer()]
        kind = ir.FunctionType(integer, [real] * 4 + pointers)
        function = builder.inttoptr(arguments[0], kind.as_pointer())
        data = [
            context.make_array(array)(context, builder, value).data
            for array, value in zip(signature.args[5:], arguments[5:], strict=True)
        ]
        return builder.call(function, [*arguments[1:5], *data])

    return _INTEGER(_INTEGER, _REAL, _REAL, _REAL, _REAL, reals, integers, found), generate


call_touch: Final[Any] = intrinsic(_call_touch)
"""Calls the touch function at an address, from compiled code."""

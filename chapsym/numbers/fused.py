"""The exact product by one fused multiply-add, for numba: what `pairs.two_product` becomes in compiled code."""

from functools import cache
from typing import Any

from numba.core import types
from numba.extending import intrinsic, overload

from . import pairs


def _fused(typing: Any, a: Any, b: Any, c: Any) -> Any:
    """a·b + c, rounded once."""

    def generate(context: Any, builder: Any, signature: Any, values: Any) -> Any:
        return builder.fma(*values)

    return types.float64(types.float64, types.float64, types.float64), generate


#: Numba calls it with a context in front, which types cannot tell.
fused: Any = intrinsic(_fused)


@cache
def register() -> None:
    """Makes compiled code take `pairs.two_product` by a fused multiply-add.

    The error of a product is a float64, barring underflow, so that both ways have the same bits.
    """

    @overload(pairs.two_product, inline="never", strict=False)
    def two_product(a: Any, b: Any) -> Any:
        def by_fused(a: Any, b: Any) -> Any:
            product = a * b
            return product, fused(a, b, -product)

        return by_fused

"""The language of the loops: Python on numbers, tuples and arrays that runs directly, and that codegen translates to C.

A function whose parameters are all annotated may be called from outside; the types of the others are inferred.  The
names below give the number of axes of an array, the last one contiguous; its elements are the numbers of the loops,
float64 or float32.  A vector is a tuple, several are a named tuple or a tuple of tuples; a conditional expression
between two vectors computes both.  Double-double is in `numbers.loose`.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias, TypeVar

if TYPE_CHECKING:  # the names are only read: the source also runs without NumPy
    import numpy as np

Vector: TypeAlias = "np.ndarray"
Matrix: TypeAlias = "np.ndarray"
Cube: TypeAlias = "np.ndarray"
Tensor: TypeAlias = "np.ndarray"
#: Arrays with one axis: of int64, and of float64 also in loops of float32.
Integers: TypeAlias = "np.ndarray"
Doubles: TypeAlias = "np.ndarray"
#: Types of the fields of named tuples: vectors, quaternions and matrices as tuples.
Three: TypeAlias = tuple[float, float, float]
Four: TypeAlias = tuple[float, float, float, float]
Nine: TypeAlias = tuple[float, ...]
#: A range whose iterations are independent, for vector code.
lanes = range

_F = TypeVar("_F", bound=Callable[..., object])


def out_of_line(function: _F) -> _F:
    """Marks a function that is called seldom: it is not inlined in C, as others are."""
    return function

"""The language of the loops: Python on numbers, tuples and arrays that runs as it is, and that codegen prints as C.

A function whose parameters are all annotated may be called from outside; the types of the others follow.  The names
below say how many axes an array has, the last one contiguous; its elements are the numbers of the loops, float64 or
float32.  A vector is a tuple, several are a named tuple or a tuple of tuples; where one of two vectors is chosen, both
are computed.  Double-double is in `numbers.loose`.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, TypeAlias, TypeVar

if TYPE_CHECKING:  # the names are read, not used: the text runs without NumPy, too
    import numpy as np

Vector: TypeAlias = "np.ndarray"
Matrix: TypeAlias = "np.ndarray"
Cube: TypeAlias = "np.ndarray"
Tensor: TypeAlias = "np.ndarray"
#: int64, and float64 in loops of float32, too; one axis.
Integers: TypeAlias = "np.ndarray"
Doubles: TypeAlias = "np.ndarray"
#: Vectors, quaternions and matrices as tuples: the fields of records.
Three: TypeAlias = tuple[float, float, float]
Four: TypeAlias = tuple[float, float, float, float]
Nine: TypeAlias = tuple[float, ...]
#: A range whose turns do not depend on each other: vector code.
lanes = range

_F = TypeVar("_F", bound=Callable[..., object])


def out_of_line(function: _F) -> _F:
    """Marks a function that is called seldom: in C it stays a call, where others are written in."""
    return function

"""Polynomials in Arb's balls that contain a function of τ in [0, 1]; products are cut, and what is cut is kept.

A model contains a function if at each τ its value is that of a polynomial in the balls: the terms beyond the degree are
at most a number on [0, 1], which widens the constant.  So `+`, `-` and `*` of models contain those of the functions,
and the kernels run on them as they are.
"""

from collections.abc import Iterable, Sequence
from typing import Any

from flint import arb, arb_poly

from ..levels.proved_root import upper

#: All τ that there are.
UNIT = arb(0.5, 0.5)


class Model:
    """A polynomial of at most a degree."""

    __slots__ = ("degree", "poly")

    def __init__(self, poly: Any, degree: int) -> None:
        self.poly, self.degree = poly, degree

    def __mul__(self, other: Any) -> Any:
        if isinstance(other, Model):
            return Model(cut(self.poly * other.poly, self.degree), self.degree)
        return Model(self.poly * other, self.degree) if isinstance(other, arb) or other else 0

    def __add__(self, other: Any) -> "Model":
        return Model(self.poly + (other.poly if isinstance(other, Model) else other), self.degree)

    def __sub__(self, other: Any) -> "Model":
        return Model(self.poly - (other.poly if isinstance(other, Model) else other), self.degree)

    def __neg__(self) -> "Model":
        return Model(-self.poly, self.degree)

    def __rsub__(self, other: Any) -> "Model":
        return -self + other

    __radd__, __rmul__ = __add__, __mul__

    def at(self, time: Any) -> Any:
        """The values at times in a ball."""
        return self.poly(time)


def cut(poly: Any, degree: int) -> Any:
    """The polynomial to a degree, its constant wide enough for all that is beyond."""
    if poly.length() <= degree + 1:
        return poly
    coefficients = poly.coeffs()  # by the list: python-flint 0.7 has no `truncate`
    beyond = arb_poly(coefficients[degree + 1 :])(UNIT).abs_upper()
    return arb_poly(coefficients[: degree + 1]) + arb(0, beyond)


def models(polynomials: Iterable[Any], degree: int) -> list[Model]:
    """Models of polynomials, cut to a degree."""
    return [Model(cut(poly, degree), degree) for poly in polynomials]


def bound(vector: Sequence[Any]) -> Any:
    """An upper bound of the length of a vector of models on [0, 1]."""
    return upper([x.at(UNIT) if isinstance(x, Model) else arb(x) for x in vector])


def exact(poly: Any) -> Any:
    """The middles."""
    return arb_poly([x.mid() for x in poly.coeffs()])

"""Analytic functions on a disc |s| ≤ R: their first coefficients in balls, and a bound of their size on the disc."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from flint import arb, arb_poly

from ..levels.proved_root import TooWide


class Disc(NamedTuple):
    """Its radius, and the number of coefficients that are kept."""

    radius: Any
    terms: int


class Analytic:
    """A function by its series, an arb_poly of `disc.terms` coefficients, and a bound of |f| on the disc."""

    __slots__ = ("bound", "disc", "series")

    def __init__(self, series: Any, bound: Any, disc: Disc) -> None:
        self.series, self.bound, self.disc = series, bound.abs_upper(), disc

    def __mul__(self, other: Any) -> "Analytic":
        if isinstance(other, Analytic):
            product = (self.series * other.series).truncate(self.disc.terms)
            return Analytic(product, self.bound * other.bound, self.disc)
        return Analytic(self.series * other, self.bound * abs(arb(other)), self.disc)

    def __add__(self, other: "Analytic") -> "Analytic":
        return Analytic(self.series + other.series, self.bound + other.bound, self.disc)

    def __sub__(self, other: "Analytic") -> "Analytic":
        return Analytic(self.series - other.series, self.bound + other.bound, self.disc)

    __rmul__ = __mul__

    def inverse(self, least: Any) -> "Analytic":
        """1/f, of an f with |f| ≥ least > 0 on the disc."""
        return Analytic(_inverse(self.series, self.disc.terms), 1 / least, self.disc)

    def at(self, s: Any) -> Any:
        """The value at a real s in the disc."""
        return self.series(s) + arb(0, self.beyond(s))

    def integral(self, s: Any) -> Any:
        """The integral from 0 to s."""
        return self.series.integral()(s) + arb(0, (abs(s) * self.beyond(s)).abs_upper())

    def on(self, disc: Disc) -> "Analytic":
        """The same on a smaller disc, where the coefficients tell a better bound."""
        return Analytic(self.series, size(self.series, disc.radius) + self.beyond(disc.radius), disc)

    def beyond(self, s: Any) -> Any:
        """A bound of the terms that are not kept (Cauchy)."""
        part = (abs(s) / self.disc.radius).abs_upper()
        if not part < 1:
            raise TooWide
        return (self.bound * part**self.disc.terms / (1 - part)).abs_upper()


def size(poly: Any, radius: Any) -> Any:
    """Σ|cₖ|Rᵏ."""
    return arb_poly([x.abs_upper() for x in poly.coeffs()])(radius).abs_upper()


def combined(factors: Sequence[Any], functions: Sequence[Analytic]) -> Analytic:
    """Σ of numbers times functions."""
    total = functions[0] * factors[0]
    for factor, function in zip(factors[1:], functions[1:], strict=True):
        total = total + function * factor
    return total


def _inverse(poly: Any, terms: int) -> Any:
    """The series of 1/f, by Newton's iteration."""
    if poly[0].contains(0):
        raise TooWide
    found, known = arb_poly([1 / poly[0]]), 1
    while known < terms:
        known = min(2 * known, terms)
        found = (found * (2 - (poly.truncate(known) * found).truncate(known))).truncate(known)
    return found

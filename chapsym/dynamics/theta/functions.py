"""Theta functions of a purely imaginary period matrix iY along a real straight line, as series in balls.

θ[a,b](x) = Σ exp(-π nᵀYn) cos(2π⟨n,x⟩ + π⟨n,b⟩) over n in Zᵍ + a/2.  Along x = x₀ + Us a term has the frequency
ν = 2π⟨n,U⟩.
"""

import itertools
import math
from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from typing import Any, NamedTuple

from flint import arb, arb_mat, arb_poly, ctx

from ..levels.proved_root import TooWide
from .analytic import Analytic, Disc, size

#: The most terms that may be looked at for one sum.
MOST_TERMS = 40_000
#: The discs go at most so far from the line, in periods.
FAR = 0.75


class Characteristic(NamedTuple):
    """The half period (τa + b)/2: two vectors of 0 and 1."""

    a: tuple[int, ...]
    b: tuple[int, ...]

    def plus(self, *others: "Characteristic") -> "Characteristic":
        """The sum, modulo periods."""
        every = (self, *others)
        a, b = (tuple(sum(x) % 2 for x in zip(*rows, strict=True)) for rows in zip(*every, strict=True))
        return Characteristic(a, b)

    @property
    def odd(self) -> bool:
        """Whether θ[a,b] is odd."""
        return sum(x * y for x, y in zip(self.a, self.b, strict=True)) % 2 == 1


class _Lattice(NamedTuple):
    """Half of the terms of one a, as n and -n are alike: 2n, ν and their factors; rows: of each term factor·νᵏ/k!.

    left: a bound of all other terms on a disc.
    """

    twice: list[tuple[int, ...]]
    rates: list[Any]
    factors: list[Any]
    rows: Any
    left: Any


class Thetas:
    """The functions of some characteristics on the line x₀ + Us, each by its name, with `terms` coefficients."""

    def __init__(
        self, Y: Any, start: Sequence[Any], direction: Sequence[Any], named: Mapping[Any, Characteristic], terms: int
    ) -> None:  # fmt: skip
        self.start, self.direction, self.named, self.terms = start, direction, named, terms
        self.speed = sum((u * u for u in direction), arb(0)).sqrt().abs_upper()
        #: The largest disc on which the bounds hold.
        self.radius = (FAR / self.speed).abs_lower()
        self.lattices = {a: self._lattice(Y, a) for a in {c.a for c in named.values()}}

    def _lattice(self, Y: Any, a: tuple[int, ...]) -> _Lattice:
        """Terms that may matter on the largest disc, of n in a cube that holds all of these.

        Of n with the largest component in [j, j + 1) there are at most 2g·(2j + 3)^(g-1), each at most
        exp(-πλj² + 2π|U|R√g(j + 1)), λ the least eigenvalue of Y; from one j to the next they fall by the ratio used.
        """
        g, bits = len(a), (ctx.prec + 16) * math.log(2)
        decay, grow = arb.pi() * _least_eigenvalue(Y), 2 * arb.pi() * self.speed * self.radius * arb(g).sqrt()
        if not decay > 0:
            raise TooWide
        reach = (grow + (grow * grow + 4 * decay * (bits + grow)).sqrt()) / (2 * decay)
        if not (2 * reach + 5) ** g < MOST_TERMS:
            raise TooWide
        most = math.ceil(float(reach)) + 1
        j = arb(most) + 0.5
        left = 2 * g * (2 * j + 3) ** (g - 1) * (-decay * j * j + grow * (j + 1)).exp()
        ratio = (-decay * (2 * j + 1) + grow).exp() * ((2 * j + 5) / (2 * j + 3)) ** (g - 1)
        if not ratio < 0.5:
            raise TooWide
        left *= 2
        small = arb(2) ** -(ctx.prec + 16)
        twice: list[tuple[int, ...]] = []
        rates: list[Any] = []
        factors: list[Any] = []
        for n in itertools.product(range(-most - 1, most + 1), repeat=g):
            m = tuple(2 * x + y for x, y in zip(n, a, strict=True))
            if m < tuple(-x for x in m):
                continue
            square = sum((m[i] * m[j] * Y[i, j] for i in range(g) for j in range(g)), arb(0)) / 4
            factor = (-arb.pi() * square).exp() * (2 if any(m) else 1)
            rate = arb.pi() * sum((x * u for x, u in zip(m, self.direction, strict=True)), arb(0))
            largest = (factor * (abs(rate) * self.radius).exp()).abs_upper()
            if largest < small:
                left += largest
            else:
                twice.append(m)
                rates.append(rate)
                factors.append(factor)
        row, rows = factors, []
        for k in range(self.terms):
            rows += row
            row = [x * rate / (k + 1) for x, rate in zip(row, rates, strict=True)]
        return _Lattice(twice, rates, factors, arb_mat(self.terms, len(twice), rows), left.abs_upper())

    def series(self, s: Any) -> dict[Any, Any]:
        """The Taylor polynomials at a real s of all functions, without what is left out."""
        x = [y + s * u for y, u in zip(self.start, self.direction, strict=True)]
        found: dict[Any, Any] = {}
        for a, lattice in self.lattices.items():
            turned = [sum((m * y for m, y in zip(twice, x, strict=True)), arb(0)) for twice in lattice.twice]
            waves = [(y.cos_pi(), y.sin_pi()) for y in turned]
            for name, c in self.named.items():
                if c.a == a:
                    found[name] = self._polynomial(lattice, waves, c)
        return found

    def _polynomial(self, lattice: _Lattice, waves: Sequence[tuple[Any, Any]], c: Characteristic) -> Any:
        values, rates = [], []
        for twice, (cosine, sine) in zip(lattice.twice, waves, strict=True):
            quarter = sum(x * y for x, y in zip(twice, c.b, strict=True)) % 4
            values.append((cosine, -sine, -cosine, sine)[quarter])
            rates.append((-sine, -cosine, sine, cosine)[quarter])
        both = lattice.rows * arb_mat([list(pair) for pair in zip(values, rates, strict=True)])
        return arb_poly([both[k, k % 2] * (-1 if k % 4 > 1 else 1) for k in range(self.terms)])

    def start_series(self) -> dict[Any, Any]:
        """The Taylor series at the start, with what the polynomials leave out."""
        found, _ = self.on(Disc(self.radius, self.terms), self.series(arb(0)))
        return {name: f.series for name, f in found.items()}

    def on(self, disc: Disc, polynomials: Mapping[Any, Any]) -> tuple[dict[Any, Analytic], Any]:
        """The functions of these polynomials on a disc no larger than `radius`, and a bound of what is left out there.

        The k-th coefficient of what is left out of the lattice is at most its size over Rᵏ (Cauchy); the terms of the
        lattice beyond the polynomial are those of exponential series.
        """
        left = _largest(lattice.left for lattice in self.lattices.values())
        off = arb_poly([arb(0, (left / disc.radius**k).abs_upper()) for k in range(self.terms)])
        beyond = _largest(self._beyond(lattice, disc.radius) for lattice in self.lattices.values()) + left
        return {
            name: Analytic(poly + off, size(poly, disc.radius) + beyond, disc) for name, poly in polynomials.items()
        }, beyond

    def _beyond(self, lattice: _Lattice, radius: Any) -> Any:
        """A bound of the terms of the lattice beyond their polynomials."""
        total = arb(0)
        for factor, rate in zip(lattice.factors, lattice.rates, strict=True):
            x = (abs(rate) * radius).abs_upper()
            total += factor * x**self.terms * x.exp()
        return (total / arb(self.terms).gamma() / self.terms).abs_upper()


def _largest(bounds: Iterable[Any]) -> Any:
    """As balls: floats would lose the smallest."""
    return reduce(lambda x, y: x.max(y), bounds)


def _least_eigenvalue(Y: Any) -> Any:
    """A lower bound, of one or two rows: det/tr for two."""
    if Y.nrows() == 1:
        return Y[0, 0].lower()
    return (Y.det() / (Y[0, 0] + Y[1, 1])).lower()

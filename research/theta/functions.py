"""Theta functions of genus two with a purely imaginary period matrix iY on a straight line, as sums in balls.

θ[a,b](x) = Σ exp(-π nᵀYn + 2πi⟨n,x⟩ + πi⟨n,b⟩) over n in Z² + a/2.

Not by `acb_mat.theta` of python-flint 0.9: it has all sixteen functions at any vector, while a line needs one sum for
each term.  With it 12 digits of a motion of two seconds took 2.3 s of the processor, not 0.16 s, 40 digits 4.9 s, not
0.26 s, and the tests, 15 s with these sums, had not ended after nine minutes.  Tests compare the two.
"""

import itertools
import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from flint import acb, acb_mat, arb, ctx

from chapsym.dynamics.levels.proved_root import TooWide

#: The most terms that may be looked at for one sum.
MOST_TERMS = 40_000
#: The bounds hold so far from the real line, in periods.
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


class Thetas:
    """The functions of some characteristics on the line x₀ + sU, s complex; `reach` bounds |Im s|.

    With n and -n together a term is 2exp(-πnᵀYn)cos(νs + φ), ν = 2π⟨n,U⟩, φ = 2π⟨n,x₀⟩ + π⟨n,b⟩.  `left` bounds all
    terms that are left out, of any one function, where |Im s| ≤ reach.
    """

    def __init__(
        self, Y: Any, start: Sequence[Any], direction: Sequence[Any], characteristics: Sequence[Characteristic]
    ) -> None:  # fmt: skip
        self.speed = sum((u * u for u in direction), arb(0)).sqrt().abs_upper()
        self.reach = (FAR / self.speed).abs_lower()
        most, self.left = self._bounded(Y)
        small, classes = arb(2) ** -(ctx.prec + 16), {c.a for c in characteristics}
        self.rates: list[Any] = []
        values, changes = [], []
        for m in itertools.product(range(-most, most + 1), repeat=2):  # 2n
            a = m[0] % 2, m[1] % 2
            if a not in classes or m < (-m[0], -m[1]):
                continue
            square = m[0] * m[0] * Y[0, 0] + m[1] * m[1] * Y[1, 1] + m[0] * m[1] * (Y[0, 1] + Y[1, 0])
            factor = (-arb.pi() * square / 4).exp() * (2 if any(m) else 1)
            rate, phase = (arb.pi() * (m[0] * x[0] + m[1] * x[1]) for x in (direction, start))
            largest = (factor * (abs(rate) * self.reach).exp()).abs_upper()
            if largest < small:
                self.left = (self.left + largest).abs_upper()
                continue
            sine, cosine = (factor * x for x in phase.sin_cos())
            turned = ((cosine, -sine), (-sine, -cosine), (-cosine, sine), (sine, cosine))  # by quarters
            rows = [turned[(m[0] * c.b[0] + m[1] * c.b[1]) % 4] if a == c.a else (0, 0) for c in characteristics]
            self.rates.append(rate)
            values += [[x for x, _ in rows], [y for _, y in rows]]
            changes += [[y * rate for _, y in rows], [-x * rate for x, _ in rows]]
        self.values, self.changes = (acb_mat(columns).transpose() for columns in (values, changes))

    def _bounded(self, Y: Any) -> tuple[int, Any]:
        """The largest component of 2n that may matter, and a bound of all terms beyond.

        Of n with the largest component in [j, j + 1) there are at most 4(2j + 3), each at most
        exp(-πλj² + 2π|U|R√2(j + 1)), λ the least eigenvalue of Y (at least det/tr), R the reach; from one j to the next
        they fall by the ratio used.
        """
        bits = (ctx.prec + 16) * math.log(2)
        decay = arb.pi() * (Y.det() / (Y[0, 0] + Y[1, 1])).lower()
        grow = 2 * arb.pi() * self.speed * self.reach * arb(2).sqrt()
        if not decay > 0:
            raise TooWide
        reach = (grow + (grow * grow + 4 * decay * (bits + grow)).sqrt()) / (2 * decay)
        if not (2 * reach + 5) ** 2 < MOST_TERMS:
            raise TooWide
        most = math.ceil(float(reach)) + 1
        j = arb(most) + 0.5
        left = 4 * (2 * j + 3) * (-decay * j * j + grow * (j + 1)).exp()
        ratio = (-decay * (2 * j + 1) + grow).exp() * (2 * j + 5) / (2 * j + 3)
        if not ratio < 0.5:
            raise TooWide
        return 2 * most + 1, (2 * left).abs_upper()

    def at(self, s: Any) -> list[Any]:
        """The values at s, a point or a ball; not finite beyond `reach`."""
        return self._sum(self.values, acb(s), self.left)

    def change(self, s: Any) -> list[Any]:
        """The derivatives by s at a real s: those of the terms left out are at most left/reach (Cauchy)."""
        return self._sum(self.changes, acb(s), self.left / self.reach)

    def _sum(self, matrix: Any, s: Any, left: Any) -> list[Any]:
        if not abs(s.imag) <= self.reach:
            return [acb("nan")] * matrix.nrows()
        waves = [x for rate in self.rates for x in reversed((s * rate).sin_cos())]
        off = arb(0, left.abs_upper())
        return [x + acb(off, off) for x in (matrix * acb_mat(len(waves), 1, waves)).entries()]

"""Chaplygin's variables, the curve of genus two on which they move, its periods, and where they are at the start.

Lemma `chaplygin-separation`: for the ball of `reduction`, μ₁ > μ₂ are the roots of Σ pᵢ²(Λᵢ - d)/(1 - μΛᵢ) = 0, and
in the time T, with φ(μ) = (μ - 1/c)(1 - dμ)Π(1 - μΛᵢ),
    dμ₁/w₁ + dμ₂/w₂ = -dT,     μ₁dμ₁/w₁ + μ₂dμ₂/w₂ = 0,     wᵢ² = φ(μᵢ).
The branch points e₁ < ... < e₄ are 1/Λᵢ and 1/c, e₅ = 1/d, and the sixth is infinite; e₁ ≤ μ₂ ≤ e₂, e₃ ≤ μ₁ ≤ e₄.
"""

import itertools
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from flint import acb, arb, arb_mat

from chapsym.dynamics.levels.proved_root import TooWide
from chapsym.dynamics.levels.start import fraction

from .functions import Characteristic
from .reduction import Reduced, Vector

#: The integrals from infinity to e₁, ..., e₅, half periods, for the cycles of `Curve`.
BRANCHES = (
    Characteristic((1, 0), (0, 0)), Characteristic((1, 0), (1, 0)), Characteristic((0, 1), (1, 0)),
    Characteristic((0, 1), (1, 1)), Characteristic((0, 0), (1, 1)),
)  # fmt: skip
#: The Δ with θ[Δ](∫ from infinity to P) = 0 for all P of the curve.  The zeros of θ are the curve, moved by a half
#: period, and six half periods are among them, the odd ones: only this makes Δ and Δ + each branch point odd.
RIEMANN = Characteristic((1, 1), (0, 1))
OTHERS = ((1, 2), (0, 2), (0, 1))


@dataclass(frozen=True)
class Curve:
    """Branch points and what each is of (0, 1, 2 of Λ, "c" and "d"), the factor of μ⁵ in φ, and the periods.

    The cycles: a₁ and a₂ round the cuts e₁e₂ and e₃e₄, b₁ and b₂ from these to the cut from e₅ to infinity.  They and
    BRANCHES are by hand; tests compare what comes out with other ways.
    inverse: of the matrix of the periods of dμ/w and μdμ/w on a₁ and a₂, in rows.  Y: the period matrix is iY.
    """

    points: Vector
    names: tuple[Any, ...]
    factor: Any
    inverse: Any
    Y: Any

    def characteristic(self, *names: Any) -> Characteristic:
        """Δ and the half periods of some branch points, and those of e₁ and e₃ from which μ₁ and μ₂ are counted."""
        branches = (BRANCHES[self.names.index(name)] for name in names)
        return RIEMANN.plus(BRANCHES[0], BRANCHES[2], *branches)

    def line(self, found: Reduced) -> tuple[Vector, Vector]:
        """Where the two variables are at the start, in periods from e₁ and e₃, and their rate in T."""
        ways = [self._way(*pair) for pair in zip(_roots(found), (2, 0), strict=True)]
        v = [x + y for x, y in zip(*ways, strict=True)]
        start = tuple(v[0] * self.inverse[0, k] + v[1] * self.inverse[1, k] for k in range(2))
        return start, tuple(-self.inverse[0, k] for k in range(2))

    def _way(self, root: tuple[Any, Any], cut: int) -> list[Any]:
        """∫dμ/w and ∫μdμ/w from the left end of a cut to (μ, w): μ = middle - half·cos f, w = half·sin f·√(rest)."""
        mu, w = root
        low, high = self.points[cut], self.points[cut + 1]
        middle, half = (low + high) / 2, (high - low) / 2
        rest = self.factor
        for i, e in enumerate(self.points):
            if i not in (cut, cut + 1):
                rest *= mu - e if i < cut else e - mu
        sine, cosine = w / (half * rest.sqrt()), (middle - mu) / half
        # At the right end the angle is near π, on either side of it: a period more or less is the same.
        angle = arb.atan2(sine, cosine) if cosine.mid() > 0 else arb.pi() + arb.atan2(-sine, -cosine)
        return [integral(self.points, self.factor, cut, power, angle) for power in (0, 1)]


def curve(found: Reduced) -> Curve:
    """The curve of a motion; raises TooWide where two branch points may be one."""
    named = [(1 / found.c, "c"), *((x, i) for i, x in enumerate(found.inverse))]
    named.sort(key=lambda pair: fraction(pair[0].mid()))
    points = (*(x for x, _ in named), 1 / found.d)
    if not all(x < y for x, y in itertools.pairwise(points)):
        raise TooWide
    L1, L2, L3 = found.inertia
    factor = found.d * L1 * L2 * L3
    gaps = [[2 * integral(points, factor, i, power, arb.pi()) for power in (0, 1)] for i in range(4)]
    # From one cut to the next √φ changes its sign, and so it does from one gap to the next.
    inverse = _inverse(arb_mat([gaps[0], [-x for x in gaps[2]]]))
    across = arb_mat([[x - y for x, y in zip(gaps[1], gaps[3], strict=True)], [-x for x in gaps[3]]])
    return Curve(points, (*(name for _, name in named), "d"), factor, inverse, across * inverse)


def integral(points: Sequence[Any], factor: Any, gap: int, power: int, angle: Any) -> Any:
    """∫μᵖdμ/√|φ| between two branch points, from the left to μ = middle - half·cos(angle)."""
    low, high = points[gap], points[gap + 1]

    def rate(f: Any, analytic: bool) -> Any:
        # By half the angle, whose squares are small at the ends in balls, too; one by one, the factors stay away
        # from the cut of the root.
        before, after = ((high - low) * x * x for x in ((f / 2).sin(), (f / 2).cos()))
        found = (low + before) ** power
        for i, e in enumerate(points):
            if i not in (gap, gap + 1):
                found *= (before + (low - e) if i < gap else after + (e - high)).rsqrt(analytic=analytic)
        return found

    found = acb.integral(rate, 0, acb(angle)).real / factor.sqrt()
    if not found.is_finite():
        raise TooWide
    return found


def _inverse(matrix: Any) -> Any:
    try:
        return matrix.inv()
    except ZeroDivisionError:
        raise TooWide from None


def _roots(found: Reduced) -> tuple[tuple[Any, Any], tuple[Any, Any]]:
    """(μ₁, w₁) and (μ₂, w₂) at the start: the roots of g₀ - g₁μ + g₂μ², and wᵢ from their rates in T."""
    L = found.inertia
    rates, _ = found.rates()
    lighter = [x - found.d for x in L]
    squares = [i * x * x for i, x in zip(lighter, found.p, strict=True)]
    moved = [2 * i * x * y for i, x, y in zip(lighter, found.p, rates, strict=True)]
    g0, g1, g2 = _coefficients(squares, L)
    root = (g1 * g1 - 4 * g0 * g2).sqrt()
    first, second = (g1 + root) / (2 * g2), 2 * g0 / (g1 + root)
    m0, m1, m2 = _coefficients(moved, L)

    def w(mu: Any, other: Any) -> Any:
        """(dμ/dT)(μ - other)/other, with the quadratic's derivative g₂(μ - other)."""
        return -(m0 - m1 * mu + m2 * mu * mu) / (g2 * other)

    return (first, w(first, second)), (second, w(second, first))


def _coefficients(weights: Sequence[Any], L: Sequence[Any]) -> Vector:
    """Of Σ weightᵢ(1 - μΛⱼ)(1 - μΛₖ)."""
    zero = weights[0] + weights[1] + weights[2]
    one = sum((x * (L[j] + L[k]) for x, (j, k) in zip(weights, OTHERS, strict=True)), arb(0))
    two = sum((x * L[j] * L[k] for x, (j, k) in zip(weights, OTHERS, strict=True)), arb(0))
    return zero, one, two

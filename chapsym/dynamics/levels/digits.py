"""One ball under way at N digits: fixed-point integers inside, mpmath's numbers outside.

All is scaled by a power of two, exactly, so that the largest moment of inertia is about 1, and the integers get as many
bits more as 𝒦 is small, the conditioning costs, and the roundings of the steps add up to.
"""

import math
from collections.abc import Sequence
from fractions import Fraction
from typing import Any

from flint import fmpz
from mpmath.libmp import MPZ, from_man_exp

from chapsym.generated import transport
from chapsym.generated.fixed import body_fixed, turns_fixed
from chapsym.numbers import Digits

from ..errors import Status, StepNotTaken
from ..loops.gibbs import BEYOND, certificate
from ..loops.path import joined
from .newton import refined
from .root import NotSettled, extrapolated, root, to_float
from .start import Exact, exponent_of, least, magnitude, start_near

Numbers = tuple[Any, ...]


def inner(x: Sequence[float], y: Sequence[float]) -> float:
    """The scalar product."""
    return x[0] * y[0] + x[1] * y[1] + x[2] * y[2]


#: Beyond so many bits flint's integers are faster than mpmath's.
FLINT_BITS = 600


class DigitsBall:
    """A ball that takes steps at N digits; `stages` are the exact coefficients of the composition."""

    def __init__(
        self, precision: Digits, K: Exact, g: Exact, J: Exact, D: Fraction, stages: Sequence[Fraction],
        attitude: Sequence[float] | None, radius: float, steps: int = 1,
    ) -> None:  # fmt: skip
        self.exponent, self.lost = magnitude(J, D)
        size = exponent_of(max(map(abs, K))) - self.exponent
        small = max(0, -size) if any(K) else 0
        # Roundings of the state add up to the square of the number of steps, as its frequencies drift.
        more = 2 * math.ceil(math.log2(steps * len(stages) + 1)) + 2 * self.lost
        self.home, self.precision = precision.context, precision.guarded(math.ceil(more * math.log10(2)))
        self.context = self.precision.context
        self.P = P = self.context.prec + small + 8
        self.scale = Fraction(2) ** -self.exponent

        self.number = number = fmpz if P > FLINT_BITS else MPZ

        def fixed(x: Fraction, scale: Fraction = self.scale) -> Any:
            exact = x * scale
            return number((exact.numerator << P) // exact.denominator)

        self.k = tuple(fixed(x, self.scale / 2) for x in K)
        self.g = self._unit(g)
        self.J, self.D = [fixed(x) for x in J], fixed(D)
        self.I = (self.J[1] + self.J[2], self.J[0] + self.J[2], self.J[0] + self.J[1])
        self.a: Numbers | None = None
        if attitude is not None:
            up = (Fraction(int(v), 1 << P) for v in self.g)
            self.a = self._unit(list(map(Fraction, attitude)) if attitude else least(*up))
        self.radius, self.x = radius, [number(0), number(0)]
        self.stages = [None if c == 1 else number((c.numerator << P) // c.denominator) for c in stages]
        floats = [[to_float(x, P) for x in v] for v in (self.k, self.I, (self.D,))]
        self.floats = tuple(floats[1]), floats[2][0]
        scales = [abs(float(c)) for c in stages]
        self.bounds = [certificate(*(c * x for x in floats[0]), *floats[1], *floats[2])[0] for c in scales]
        self.past: list[list[Any]] = [[] for _ in stages]

    def _unit(self, v: Sequence[Fraction]) -> Numbers:
        """An exact vector divided by its length."""
        squared = sum((x * x for x in v), Fraction(0))
        # Twice the bits under the root, so that its error is far below those that are kept.
        length = math.isqrt((squared.numerator << 4 * self.P) // squared.denominator)
        return tuple(self.number((x.numerator << 3 * self.P) // (x.denominator * length)) for x in v)

    def step(self) -> None:
        """Takes one step; raises StepNotTaken, the ball then being where the step began or at a stage of it."""
        for c, bound, past in zip(self.stages, self.bounds, self.past, strict=True):
            k = self.k if c is None else tuple((c * x) >> self.P for x in self.k)
            u = self._gibbs(k, bound, past)
            if u is None:
                self._turn_by(self._rotation(k))
                past.clear()
                continue
            if self.a is not None:
                self._follow(u)
            moved = turns_fixed(*(*u, *self.k, *self.g, self.P))
            self.k, self.g = moved[:3], moved[3:]

    def _gibbs(self, k: Numbers, bound: float, past: list) -> Any:
        """The Gibbs vector where `small-branch` or `straight-path` says that it is that of the branch; else None."""
        if not (bound >= 0.0 or bound == BEYOND):
            return None
        try:
            u, start = root(extrapolated(past), k, self.g, self.I, self.D, self.floats, self.P, self.number, self.lost)
        except (NotSettled, ZeroDivisionError, OverflowError):
            return None
        if not (self._on_path(u, k) if bound == BEYOND else inner(start, start) <= bound):
            return None
        past.insert(0, start)
        del past[8:]
        return u

    def _on_path(self, root: Numbers, k: Numbers) -> bool:
        """Whether the straight path joins a root to no rotation: an inequality with room, looked at in float64."""
        u, half, g = ([to_float(x, self.P) for x in v] for v in (root, k, self.g))
        I, D = self.floats
        numbers = *u, inner(u, u), *half, math.hypot(*half), *g, *I, D, 0.5 * (max(I) - min(I))
        proved, _ = joined(*numbers)
        return bool(proved)

    def _follow(self, u: Numbers) -> None:
        """Moves the contact point and the attitude."""
        P, one = self.P, self.number(1) << self.P
        squared = one + ((u[0] * u[0] + u[1] * u[1] + u[2] * u[2]) >> P)
        length = self.number(math.isqrt(squared << P))
        p0 = (one << P) // length
        p = (p0, *((x * p0) >> P for x in u))
        *a, x, y, _ = body_fixed(*(*(self.a or ()), *p, *self.g, P))
        self.a = tuple(a)
        self.x = [self.x[0] + x, self.x[1] + y]

    def _rotation(self, k: Numbers) -> Numbers:
        """The rotation of a step by the float64 continuation, refined: where neither lemma holds."""
        K, g, J, D = (tuple(self.out(x) for x in v) for v in ([2 * x for x in k], self.g, self.J, (self.D,)))
        near = tuple(map(self.precision.number, start_near(K, g, J, D[0])))
        q = refined(self.precision, near, K, g, J, D)
        if q is None:
            raise StepNotTaken(Status.NOT_CONVERGED, 1.0)
        return q

    def _turn_by(self, q: Numbers) -> None:
        fixed = self._into(q)
        if self.a is not None:
            *a, x, y, _ = body_fixed(*(*self.a, *fixed, *self.g, self.P))
            self.a = tuple(a)
            self.x = [self.x[0] + x, self.x[1] + y]
        k, g = (transport(*q, *(self.out(x) for x in v)) for v in (self.k, self.g))
        self.k, self.g = self._into(k), self._into(g)

    def _into(self, v: Numbers) -> Numbers:
        return tuple(self.number(int(self.context.floor(self.context.ldexp(x, self.P)))) for x in v)

    def frame(self, bits: int) -> tuple[Numbers, Numbers, Numbers, Numbers]:
        """𝒦, γ, the attitude and the contact point, rounded to so many bits, in the context of the precision."""

        def out(x: Any, shift: int = 0) -> Any:
            return self.home.make_mpf(from_man_exp(MPZ(x), shift - self.P, bits, "n"))

        momentum = tuple(out(x, self.exponent + 1) for x in self.k)
        trace = tuple(out(x) * self.radius for x in self.x)
        return momentum, tuple(map(out, self.g)), tuple(map(out, self.a or ())), trace

    def out(self, x: Any) -> Any:
        """A fixed-point integer as an mpf with all its bits."""
        return self.context.make_mpf(from_man_exp(MPZ(x), -self.P))

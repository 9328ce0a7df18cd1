"""One ball under way in Arb's balls: every step encloses the true one, of every state that there may be.

The rotation since the start is followed as a point and what it may be off by (`spread`): its error grows as that of the
motion does.  `proved_root` proves the root of each step for all states, where lemma `small-branch` holds, and |𝒦| is an
integral of the map so that it is looked at once, and beyond it where lemma `straight-path` does.  Elsewhere, as near a
fold, the branch is that which the float64 continuation selects, and the interval Newton test of `newton` encloses its
root: `selected` counts such steps.
"""

import math
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import Any

from flint import arb, arb_mat, ctx, fmpq, fmpz

from chapsym.generated import centre_step, compose, gibbs_residual, rotate, turn
from chapsym.numbers import Enclosure

from .newton import enclosed
from .proved_root import MATRIX_BITS, Numbers, TooWide, certified, inverse_slope, on_path, stretch, upper
from .root import NotSettled, extrapolated, root
from .spread import Spread, carried
from .start import Exact, exponent_of, least, magnitude, start_near

#: From so many bits on fmpz is faster than Python's integers.
FMPZ_BITS = 300
#: A rotation with a smaller q₀ is taken as a quaternion in balls: its Gibbs vector is too long.
LEAST_SCALAR = 0.125


def exact(x: float | Fraction) -> Any:
    """A float or a fraction as a ball; exact if the precision holds it."""
    x = Fraction(x)
    return arb(fmpq(x.numerator, x.denominator))


class ArbBall:
    """A ball that takes steps in balls of `precision` bits; `stages` are the exact coefficients of the composition.

    Every method is to be called with that precision set.
    """

    def __init__(
        self, precision: int, K: Exact, g: Exact, J: Exact, D: Fraction, stages: Sequence[Fraction],
        attitude: Sequence[float] | None, radius: float,
    ) -> None:  # fmt: skip
        self.precision = precision
        self.exponent, self.lost = magnitude(J, D)
        scale = Fraction(2) ** -self.exponent
        self.k: Numbers = tuple(exact(x * scale / 2) for x in K)
        self.g = unit(map(exact, g))
        self.J = tuple(exact(x * scale) for x in J)
        self.I = (self.J[1] + self.J[2], self.J[0] + self.J[2], self.J[0] + self.J[1])
        self.D = exact(D * scale)
        self.a: Numbers = () if attitude is None else unit(map(exact, attitude) if attitude else least(*self.g))
        # What is followed is the rotation since the start: 𝒦 and γ are those of the start, turned back by it.
        self.first_k, self.first_g, self.length = self.k, self.g, upper(self.k)
        self.p: Any = (arb(1), arb(0), arb(0), arb(0))
        self.spread, self.matrix_bits = Spread(), MATRIX_BITS + 3 * self.lost
        self.radius, self.x = exact(radius), (arb(0), arb(0))
        self.size = exponent_of(max(map(abs, K))) - self.exponent - 1
        self.number = int if precision < FMPZ_BITS else fmpz
        # Components of a small 𝒦 get as many bits as large ones have.
        self.P = precision - 8 + max(0, -self.size)
        self.one = arb(2) ** -self.P
        self.stages = [None if c == 1 else exact(c) for c in stages]
        self.bounds = [certified(2 * upper(self.k) * abs(exact(c)), self.I) for c in stages]
        self.fixed_I, self.fixed_D = self.fixed(self.I), self.fixed((self.D,))[0]
        self.floats = tuple(map(float, self.I)), float(self.D)
        self.past: list[list[Any]] = [[] for _ in stages]
        self.selected = 0

    def fixed(self, v: Sequence[Any]) -> Numbers:
        """The midpoints as integers, of which 2^P is one."""
        found = []
        for x in v:
            man, exp = x.mid().man_exp()
            shift = int(exp) + self.P
            man = self.number(man)
            found.append(man << shift if shift >= 0 else man >> -shift)
        return tuple(found)

    def step(self) -> None:
        """Takes one step; raises StepNotTaken, and TooWide where the balls are too large to prove one."""
        for c, bound, past in zip(self.stages, self.bounds, self.past, strict=True):
            k, (wide, g) = self.k, self._all()
            if c is not None:
                k, wide = tuple(c * x for x in k), tuple(c * x for x in wide)
            every = (*wide, *g, *self.I, self.D)
            found = self._proved(k, every, bound, past) or self._selected(every, bound, past)
            if found:
                self._turn_by(*(*found, k, every))
            self.k, self.g = (
                tuple(x + y for x, y in zip(v, turn(*self.p, *v), strict=True)) for v in (self.first_k, self.first_g)
            )

    def _all(self) -> tuple[Numbers, Numbers]:
        """k and γ of all states that there may be: a turn by ξ moves a vector by 2|ξ| of its length at most."""
        off = 2 * self.spread.size
        along, across = arb(0, (off * self.length).abs_upper()), arb(0, off.abs_upper())
        return tuple(x + along for x in self.k), tuple(x + across for x in self.g)

    def _proved(self, k: Numbers, every: Numbers, bound: tuple[Any, Any] | None, past: list) -> Any:
        """A point, and how far the branch's Gibbs vectors of all states are from it; None where that is not proved.

        k: that of the point that is followed; every: k, γ, I and D of all states.
        """
        try:
            near, start = root(
                extrapolated(past), self.fixed(k), self.fixed(self.g), self.fixed_I, self.fixed_D, self.floats, self.P,
                self.number, self.lost,
            )  # fmt: skip
        except (NotSettled, ZeroDivisionError, OverflowError):
            return None
        u = tuple(arb(x) * self.one for x in near)
        with ctx.workprec(self.matrix_bits):
            length = upper(gibbs_residual(*(*u, *every)))
            slope = on_path(u, length, *every) if bound is None else bound[1] if upper(u) <= bound[0] else None
            if slope is None:
                return None
            past.insert(0, start)
            del past[8:]
            return u, (length / slope).abs_upper()

    def _selected(self, every: Numbers, bound: Any, past: list) -> Any:
        """The same for the root that the continuation selects; None where its rotation is too long: it is taken here.

        A root that is proved to be the branch's after all serves the next steps as a guess.
        """
        q = self._rotation(every)
        squared = q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
        u = tuple(x / q[0] for x in q[1:])
        with ctx.workprec(self.matrix_bits):
            proved = squared < q[0] * q[0] if bound else stretch(u, *every) is not None
        past[:] = [tuple(map(float, u)), *past[:7]] if proved else []
        self.selected += not proved
        if q[0] > LEAST_SCALAR:
            return tuple(x.mid() for x in u), upper([x.rad() for x in u])
        if self.a:
            self._follow(q, every[3:6])
        self.p, far = point(compose(*self._turned(), *q))
        self.spread.restart(far)
        return None

    def _turn_by(self, u: Numbers, off: Any, k: Numbers, every: Numbers) -> None:
        """Turns by the rotation whose Gibbs vector is within `off` of u, by the mean-value form.

        As ∂G/∂u is affine in u, that of the point is u - A⁻¹G(u) with A = ∂G/∂u at the middle between the two.
        """
        r = gibbs_residual(*(*u, *k, *self.g, *self.I, self.D))
        with ctx.workprec(self.matrix_bits):
            inverse = inverse_slope(u, off, every)
            d = (inverse * arb_mat(3, 1, r)).entries()
        u = tuple(x - y for x, y in zip(u, d, strict=True))
        with ctx.workprec(self.matrix_bits):
            M, more = carried(u, inverse, every[:3], every[3:6], self.D, self.spread.size)
            scale = (1 / (1 + u[0] * u[0] + u[1] * u[1] + u[2] * u[2]).sqrt()).mid()
        if self.a:
            self._follow(unit((arb(1), *u)), every[3:6])
        self.p, far = point(scale * x for x in compose(*(*self.p, 1, *u)))
        with ctx.workprec(self.matrix_bits):
            # p∘(1, ε)∘(1, ξ) is p∘(1, ξ'), |ξ' - ξ| ≤ |ε|(1 + |ξ| + |ξ|²)/(1 - |ε||ξ|) ≤ 2|ε|.
            self.spread.moved(M, more + 2 * far)

    def _rotation(self, every: Numbers) -> Numbers:
        """The rotations of all states, where neither lemma holds."""
        K, g, J, D = tuple(2 * x for x in every[:3]), every[3:6], self.J, (self.D,)
        near = tuple(map(exact, start_near(K, g, J, self.D)))
        q = enclosed(Enclosure(self.precision, 0), near, K, g, J, D)
        if q is None:
            raise TooWide
        return q

    def _follow(self, q: Numbers, g: Numbers) -> None:
        """Moves the contact point by the rotation q; g: γ of all states."""
        x, y, _ = rotate(*self._attitude(), *centre_step(*q, *g))
        self.x = (self.x[0] + x, self.x[1] + y)

    def _turned(self) -> Any:
        """The rotation since the start, of any length, with all that there may be."""
        off = arb(0, self.spread.size)
        return compose(*(*self.p, 1, off, off, off))

    def _attitude(self) -> Numbers:
        return unit(compose(*(*self.a, *self._turned())))

    def bits(self) -> float:
        """The correct bits of 𝒦, γ and the attitude, each beside the length of its vector."""
        vectors = *self._all(), self._attitude() if self.a else ()
        widest = [max(map(log_radius, v), default=-math.inf) for v in vectors]
        return -max(widest[0] - self.size, *widest[1:])

    def frame(self, bits: int) -> tuple[Numbers, Numbers, Numbers, Numbers]:
        """𝒦, γ, the attitude and the contact point, rounded to so many bits."""
        scale = arb(2) ** (self.exponent + 1)
        k, g = self._all()
        a = self._attitude() if self.a else ()
        momentum, trace = tuple(x * scale for x in k), tuple(x * self.radius for x in self.x)
        ctx.prec = bits
        try:
            return tuple(tuple(+x for x in v) for v in (momentum, g, a, trace))  # type: ignore[return-value]
        finally:
            ctx.prec = self.precision


def point(p: Iterable[Any]) -> tuple[Numbers, Any]:
    """The middle of a quaternion in balls, and a bound of how far it is off, beside its length."""
    balls = list(p)
    middle = tuple(x.mid() for x in balls)
    with ctx.workprec(MATRIX_BITS):
        off = upper([x.rad() for x in balls]) / sum(x * x for x in middle).sqrt()
        return middle, (off / (1 - off)).abs_upper()


def log_radius(x: Any) -> float:
    """The logarithm to base 2 of the radius, rounded up."""
    man, exp = x.rad().man_exp()
    return int(exp) + int(man).bit_length() if man else -math.inf


def unit(v: Iterable[Any]) -> Numbers:
    """A vector divided by its length."""
    balls = list(v)
    length = sum(x * x for x in balls).sqrt()
    return tuple(x / length for x in balls)

"""One ball under way in Arb's balls: every step encloses the true one, of every state in the balls.

Where lemma `small-branch` holds, and |𝒦| is an integral of the map so that it is looked at once, G is monotone in a
ball of Gibbs vectors, ⟨x, G(v + x) - G(v)⟩ ≥ m|x|², and the step has one root there.  So the root is within |G(u)|/m
of any u: that is the proof of existence and uniqueness, for all 𝒦 and γ in their balls.  As ∂G/∂u is affine in u, the
root is u - A⁻¹G(u) with A = ∂G/∂u at the middle between the two, which Cramer's rule encloses.

Beyond that bound the check of lemma `straight-path` proves the same in a box round u, with its own m for every step.
Where it does not, as near a fold, the branch is that which the float64 continuation selects, and the interval Newton
test of `newton` encloses its root: `selected` counts such steps.
"""

import math
from collections.abc import Iterable, Sequence
from fractions import Fraction
from functools import cache, reduce
from typing import Any

from flint import arb, ctx, fmpq, fmpz

from chapsym.generated import centre_step, compose, gibbs_newton, gibbs_residual, rotate, transport, turn
from chapsym.numbers import Enclosure

from ..loops import path
from .newton import enclosed
from .retyped import Family
from .root import NotSettled, extrapolated, root
from .start import Exact, exponent_of, least, magnitude, start_near

Numbers = tuple[Any, ...]

#: From so many bits on fmpz is faster than Python's integers.
FMPZ_BITS = 300
#: The precision of the matrices beyond what a determinant can lose: what they multiply is as small as the radii.
MATRIX_BITS = 64
#: The box in which `straight-path` is looked at has so many times |G(u)|/I_min: enough if m is not much below I_min.
WIDER = 1024


class TooWide(ArithmeticError):
    """The balls have grown so much that a step cannot be proved: more bits are needed."""


def exact(x: float | Fraction) -> Any:
    """A float or a fraction as a ball; exact if the precision holds it."""
    x = Fraction(x)
    return arb(fmpq(x.numerator, x.denominator))


def upper(v: Sequence[Any]) -> Any:
    """An upper bound of the length of a vector, as an exact number."""
    bounds = [x.abs_upper() for x in v]
    return sum(x * x for x in bounds).sqrt().abs_upper()


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
            k = self.k if c is None else tuple(c * x for x in self.k)
            u = self._gibbs(k, bound, past)
            if u is None:
                q = self._rotation(k)
                self._judge(q, k, bound, past)
                self._turn_by(q)
            else:
                if self.a:
                    length = (1 + u[0] * u[0] + u[1] * u[1] + u[2] * u[2]).sqrt()
                    self._follow((1 / length, *(x / length for x in u)))
                moved = (tuple(a + b for a, b in zip(v, turn(1, *u, *v), strict=True)) for v in (self.k, self.g))
                self.k, self.g = moved

    def _gibbs(self, k: Numbers, bound: tuple[Any, Any] | None, past: list) -> Any:
        """The Gibbs vector of the branch, enclosed; None where no point was found near which it is proved to be."""
        try:
            near, start = root(
                extrapolated(past), self.fixed(k), self.fixed(self.g), self.fixed_I, self.fixed_D, self.floats, self.P,
                self.number, self.lost,
            )  # fmt: skip
        except (NotSettled, ZeroDivisionError, OverflowError):
            return None
        u = tuple(arb(x) * self.one for x in near)
        state, matrix_bits = (*k, *self.g, *self.I, self.D), MATRIX_BITS + 3 * self.lost
        r = gibbs_residual(*(*u, *state))
        with ctx.workprec(matrix_bits):
            slope = on_path(u, upper(r), *state) if bound is None else bound[1] if upper(u) <= bound[0] else None
        if slope is None:
            return None
        past.insert(0, start)
        del past[8:]
        return newton_enclosure(u, r, slope, state, matrix_bits)

    def _rotation(self, k: Numbers) -> Numbers:
        """The rotation where the lemma does not hold, enclosed."""
        K, g, J, D = tuple(2 * x for x in k), self.g, self.J, (self.D,)
        near = tuple(map(exact, start_near(K, g, J, self.D)))
        q = enclosed(Enclosure(self.precision, 0), near, K, g, J, D)
        if q is None:
            raise TooWide
        return q

    def _judge(self, q: Numbers, k: Numbers, bound: Any, past: list) -> None:
        """Counts a rotation that is not proved to be the branch's; one that is serves the next steps as a guess."""
        with ctx.workprec(MATRIX_BITS + 3 * self.lost):
            u = tuple(x / q[0] for x in q[1:])
            if (
                q[1] * q[1] + q[2] * q[2] + q[3] * q[3] < q[0] * q[0]
                if bound
                else stretch(u, *k, *self.g, *self.I, self.D)
            ):
                past.insert(0, tuple(map(float, u)))
                del past[8:]
            else:
                past.clear()
                self.selected += 1

    def _turn_by(self, q: Numbers) -> None:
        if self.a:
            self._follow(q)
        self.k, self.g = transport(*q, *self.k), transport(*q, *self.g)

    def _follow(self, q: Numbers) -> None:
        """Moves the contact point and the attitude by the rotation q."""
        x, y, _ = rotate(*self.a, *centre_step(*q, *self.g))
        self.x = (self.x[0] + x, self.x[1] + y)
        self.a = compose(*self.a, *q)

    def bits(self) -> float:
        """The correct bits of 𝒦, γ and the attitude, each beside the length of its vector."""
        widest = [max(map(log_radius, v), default=-math.inf) for v in (self.k, self.g, self.a)]
        return -max(widest[0] - self.size, *widest[1:])

    def frame(self, bits: int) -> tuple[Numbers, Numbers, Numbers, Numbers]:
        """𝒦, γ, the attitude and the contact point, rounded to so many bits."""
        scale = arb(2) ** (self.exponent + 1)
        momentum, trace = tuple(x * scale for x in self.k), tuple(x * self.radius for x in self.x)
        ctx.prec = bits
        try:
            return tuple(tuple(+x for x in v) for v in (momentum, self.g, self.a, trace))  # type: ignore[return-value]
        finally:
            ctx.prec = self.precision


def newton_enclosure(u: Numbers, r: Numbers, slope: Any, state: Numbers, matrix_bits: int) -> Numbers:
    """The root of G within |r|/m of a point u, r = G(u), where G is monotone with m = `slope`.

    state: k, γ, I and D, in balls.  The root is u - A⁻¹r with A = ∂G/∂u at the middle between the two.  Raises TooWide
    where det A may be 0.
    """
    with ctx.workprec(matrix_bits):
        off = (upper(r) / slope).abs_upper()
        box = tuple(x + arb(0, off) for x in u)
        det, _, _, _, c11, c12, c13, c21, c22, c23, c31, c32, c33 = gibbs_newton(*(*box, *state))
        if not det > 0:
            raise TooWide
        r1, r2, r3 = r
        d1 = (c11 * r1 + c21 * r2 + c31 * r3) / det
        d2 = (c12 * r1 + c22 * r2 + c32 * r3) / det
        d3 = (c13 * r1 + c23 * r2 + c33 * r3) / det
    return u[0] - d1, u[1] - d2, u[2] - d3


@cache
def joined() -> Any:
    """`path.joined` in balls: what its comparisons say is certain."""
    with ctx.workprec(MATRIX_BITS):
        text = Family("arb", lambda x: arb(repr(x))).loops(path, max=highest, min=lowest, sqrt=arb.sqrt)
    return text.joined


def on_path(u: Numbers, length: Any, *state: Any) -> Any:
    """m where G is monotone with it in a box round u that contains a root, and this is the branch's; else None.

    length: a bound of |G(u)|; state: k, γ, I and D.  With |G(u)| ≤ m · (half an edge) the root is in the box.
    """
    off = (WIDER * length / lowest(*state[6:9])).abs_upper()
    slope = stretch(tuple(x + arb(0, off) for x in u), *state)
    return slope if slope is not None and length <= (slope * off).abs_lower() else None


def stretch(box: Numbers, *state: Any) -> Any:
    """m by lemma `straight-path`, for every point of a box treated as if it were the root; None where it fails."""
    k, I = state[:3], state[6:9]
    least = lowest(*I)
    square, half = sum(x * x for x in box), sum(x * x for x in k).sqrt()
    proved, slope = joined()(*box, square, *k, half, *state[3:], (highest(*I) - least) / 2)
    return slope.abs_lower() if proved and least > 0 else None


def highest(*v: Any) -> Any:
    """The largest of balls, as a ball."""
    return reduce(arb.max, v)


def lowest(*v: Any) -> Any:
    """The smallest of balls, as a ball."""
    return reduce(arb.min, v)


def log_radius(x: Any) -> float:
    """The logarithm to base 2 of the radius, rounded up."""
    man, exp = x.rad().man_exp()
    return int(exp) + int(man).bit_length() if man else -math.inf


def unit(v: Iterable[Any]) -> Numbers:
    """A vector divided by its length."""
    balls = list(v)
    length = sum(x * x for x in balls).sqrt()
    return tuple(x / length for x in balls)


def certified(size: Any, inertia: Numbers) -> tuple[Any, Any] | None:
    """(radius, m) by lemma `small-branch` for |𝒦| ≤ size, both exact; None where |𝒦| is beyond its bound.

    There is one root with |u| < 1, it has |u| ≤ radius and is that of the small-rotation branch, and in this ball
    ⟨x, (∂G/∂u)x⟩ ≥ m|x|².
    """
    least = lowest(*inertia)
    size = size.abs_upper()
    if not size < least:
        return None
    slope = (highest(*inertia) - least) / 2 + size
    inner = size / (least + (least * least - size * size).sqrt())
    if not inner * slope < least:
        return None
    # The root is within `inner`; a point near it may be a little outside.
    radius = inner.abs_upper() + (least / slope - inner).abs_lower() / 8
    radius = (radius if radius < 1 else arb(1)).abs_upper()
    m = (least - radius * slope).abs_lower()
    return (radius, m) if least - radius * slope > 0 else None

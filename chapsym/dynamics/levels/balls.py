"""Runs and steps at any precision, in Arb's numbers: as enclosures for Enclosure(bits), as points for Digits(n).

`ArbBall`: every step encloses the true step of every state in the enclosure.  The rotation since the start is a point
and a bound of its error, which grows like the errors of the motion.  `proved_root` proves the root of each step for all
states, by lemma `small-branch` (checked once, as |𝒦| is an integral of the map), and beyond its bound by lemma
`straight-path`.  Elsewhere, as near a fold, the float64 continuation selects the branch, and the interval Newton test
encloses its root: `selected` counts such steps.

The error of the rotation is in a parallelepiped that turns and shears with the map, `Spread`.  𝒦 and γ of a step are
those of the start, turned back by the rotation since then.  The true rotation is p∘(1, ξ), with p an exact point and
ξ = Br, r in a box.  A step takes ξ to Mξ + w, with M a matrix in balls: the mean-value form, with M for all states in
the enclosure.  So B becomes the orthogonal factor of MB (Lohner), and the box grows by the motion itself and the
roundings of p: linearly for a regular motion, and not by a factor per step.

`DigitsBall`: the midpoints alone, with guard bits.

`root` finds the Gibbs vector of a step, to any number of bits: in float64, then by corrections.  Only midpoints count:
the result is a point, and nothing is proved of it.  If lemma `small-branch` holds, the root is in a convex region on
which G is monotone, so an iteration that converges there has found it.
"""

import math
from collections import deque
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from flint import arb, arb_mat, ctx, fmpq
from mpmath import MPContext, mpf
from mpmath.libmp import from_man_exp

from chapsym.generated import centre_step, compose, gibbs_newton, gibbs_residual, rotate, turn
from chapsym.numbers import Digits, Enclosure
from chapsym.numbers.precisions import flint_bits

from ..coefficients import COMPOSITIONS
from ..errors import BadInput, Status, StepNotTaken, TooWide
from ..loops.branch import moments
from ..loops.gibbs import BEYOND, certificate, newton_round
from ..loops.integrals import WEIGHTS
from ..loops.path import joined
from ..loops.vectors import adjoint, cross, dot, minus, scaled
from .frames import Balls, Frames, after
from .proved_root import MATRIX_BITS, Vector, certified, enclosed, inverse_slope, on_path, refined, stretch, unit, upper
from .start import Exact, exponent_of, fraction, least, magnitude, start

#: The start of a ball: exact 𝒦, γ, J and D; the exact coefficients of the composition; the attitude, empty for the
#: least rotation, or None; and the radius.
Given = tuple[Exact, Exact, Exact, Fraction, Exact, Sequence[float | Fraction] | None, float]
#: Steps of a ball between two calls of `progress`.
CHUNK = 200
#: Steps between two checks of the radii.
LOOK = 16
#: The number of attempts with more bits that may fail to help before the run stops.
MOST_STUCK = 4
#: The number of times that a root may lose the bits of the conditioning.
CONDITION = 3
#: The largest number of extra bits.
MOST_GUARD = 2**22


def run(
    precision: Digits | Enclosure, balls: Balls, steps: int, every: int, frames: Frames, order: int,
    progress: Callable[[int], None],
) -> list[int]:  # fmt: skip
    """Takes `steps` steps of every ball into `frames`, one ball after the other; frame 0 is written anew.

    Returns for each ball the number of rotations that are selected, not proved to be those of the branch
    (`ArbBall.selected`).

    Enclosure(bits): extra bits make up for the measured growth of the radii, so that `bits` are left at the end.
    """
    done, selected = 0, list[int]()
    for i in range(len(balls.D)):
        given = _given(balls, i, frames, order)
        way = _Way(frames, i, steps, every, after(done, progress))
        if isinstance(precision, Enclosure):
            selected.append(_enclosed(precision, given, way))
        else:
            ball = DigitsBall(precision, given, steps)
            with flint_bits(ball.precision):
                way.take(ball, precision.context.prec)
        done += int(frames.taken[i])
    return selected


def _given(balls: Balls, i: int, frames: Frames, order: int) -> Given:
    attitude = None
    if frames.with_body:
        attitude = () if frames.least else tuple(map(Fraction, frames.attitude[i, 0]))
    momentum, gamma, tensor = (list(map(Fraction, x[i])) for x in (balls.momentum, balls.gamma, balls.mass_tensor))
    return momentum, gamma, tensor, Fraction(balls.D[i]), COMPOSITIONS[order].exact, attitude, float(balls.radius[i])


@dataclass(frozen=True, eq=False)
class _Way:
    """The steps of one ball, and its frames."""

    frames: Frames
    i: int
    steps: int
    every: int
    progress: Callable[[int], None]

    def take(self, ball: "DigitsBall | ArbBall", bits: int, enough: Callable[[int], bool] = lambda step: True) -> None:
        """Takes the steps and writes the frames, with this many bits; stops early if `enough` is false."""
        f, i = self.frames, self.i
        kept = (f.momentum, f.gamma, *((f.attitude, f.contact) if f.with_body else ()))
        f.taken[i] = 0
        for array in kept:
            array[i, 1:] = math.nan
        for step in range(self.steps + 1):
            if step:
                try:
                    ball.step()
                except StepNotTaken as stop:
                    f.status[i], f.reach[i] = stop.status, stop.reach
                    return
                f.taken[i] = step
                if not enough(step):
                    return
            if step % self.every == 0:
                for array, values in zip(kept, ball.frame(bits), strict=False):
                    array[i, step // self.every] = values
            if step and (step % CHUNK == 0 or step == self.steps):
                self.progress(step)


def _enclosed(precision: Enclosure, given: Given, way: _Way) -> int:
    """The run with more bits until `precision.bits` are left, or BadInput; returns the number of selected rotations."""
    guard, before, stuck = precision.guard, (0, -math.inf), 0
    _, lost = magnitude(*given[2:4])
    while guard <= MOST_GUARD:
        bits = precision.bits + guard
        step, left, selected = _attempt(bits, precision.bits, given, way)
        if left >= precision.bits:
            return selected
        stuck = stuck + 1 if (step, left) <= before and guard > CONDITION * lost else 0
        if stuck == MOST_STUCK:
            break
        # The bits that a step has cost, and some more, for all steps.
        cost = (bits - left) / step if step and left > -math.inf else 0.0
        guard, before = max(2 * guard, 1, math.ceil(1.1 * cost * way.steps) + precision.guard), (step, left)
    raise BadInput(
        f"the balls grow too much: after step {step} of {way.steps}, {bits} bits leave less than {precision.bits};"
        " take fewer or shorter steps"
    )


def _attempt(bits: int, wanted: int, given: Given, way: _Way) -> tuple[int, float, int]:
    """Runs with this many bits while the wanted bits are left.

    Returns the step at which they were last counted, the bits left there, and the number of selected rotations.  No
    bits are left if a step could not be proved.
    """
    seen: tuple[int, float] = (0, math.inf)
    with flint_bits(bits):
        ball = ArbBall(bits, given)

        def enough(step: int) -> bool:
            nonlocal seen
            if step % LOOK and step % way.every and step != way.steps:
                return True
            seen = (step, ball.bits())
            return seen[1] >= wanted

        try:
            way.take(ball, wanted, enough)
        except TooWide:
            return seen[0] + 1, 0.0, ball.selected
        f, i = way.frames, way.i
        if f.status[i] != Status.TAKEN:
            seen = (int(f.taken[i]), ball.bits())
    if seen[1] < wanted:
        f.status[i], f.reach[i] = Status.TAKEN, 1.0  # of balls that were too wide for a proof
    return *seen, ball.selected


#: Up to this many bits the corrections use the float64 Jacobian; beyond, Newton's iteration doubles the bits.
CHORD_BITS = 300
#: The largest k for which float64 represents 2^-k with all bits.
FLOAT_BITS = 1000
#: The assumed factor of the error by the first correction with the float64 Jacobian.
GAIN = 2.0**-40
#: The bits by which a Newton iterate falls short of twice the bits of the last.
SHORT = 12
MOST_ROUNDS = 100
#: The largest number of rounds in float64, and the relative correction that is the last one: without a guess, and with
#: one.  The inverse is that of the last but one iterate, so that each correction with it gains the digits of the last
#: one.
COLD, WARM = (100, 1e-7), (3, 1e-12)

FloatVector = tuple[float, ...]
#: A point, and a bound of its distance from a root; None if none is proved.
Near = tuple[Vector, arb] | None


class NotSettled(ArithmeticError):
    """The corrections did not converge."""


def extrapolated(past: Sequence[FloatVector]) -> FloatVector:
    """The next Gibbs vector by the polynomial through the last eight, newest first; 0 where there are fewer."""
    if len(past) < len(WEIGHTS):
        return 0.0, 0.0, 0.0
    u1 = u2 = u3 = 0.0
    for weight, (v1, v2, v3) in zip(WEIGHTS, past, strict=True):
        u1, u2, u3 = u1 + weight * v1, u2 + weight * v2, u3 + weight * v3
    return u1, u2, u3


def root(guess: FloatVector, state: Vector, bits: int, lost: int, unit: arb) -> tuple[Vector, FloatVector]:
    """The Gibbs vector with this many bits, from a guess in float64, as exact numbers, and its float64 value.

    state: k, γ, I and D, the largest moment about 1; unit: a power of two about |k|.  lost: the bits that the
    conditioning costs.  Raises NotSettled, or another ArithmeticError, if it does not converge.
    """
    before, precisions = ctx.prec, [bits]
    while precisions[-1] > CHORD_BITS + 4 * lost:
        precisions.append(precisions[-1] // 2 + SHORT + lost)
    try:
        start, inverse = _in_float64(guess, tuple(map(float, state)))
        ctx.prec = precisions.pop()
        u = _chord(start, _rounded(state) if precisions else state, inverse, lost, unit)
        while precisions:
            u = _newton(u, state, precisions.pop())
    finally:
        ctx.prec = before
    if not all(x.is_finite() for x in u):
        raise NotSettled
    return u, start


def _rounded(state: Vector) -> Vector:
    """The state, rounded to the working precision."""
    return tuple(+x for x in state)


def _in_float64(guess: FloatVector, state: FloatVector) -> tuple[FloatVector, list[float]]:
    """A Gibbs vector by Newton's iteration in float64, and (∂G/∂u)⁻¹, column by column."""
    u, (k, g, inertia, D) = guess, (state[:3], state[3:6], state[6:9], state[9])
    rounds, enough = COLD if guess == (0.0, 0.0, 0.0) else WARM
    for _ in range(rounds):
        r = newton_round(u, k, g, inertia, D)
        u = r.w
        if max(map(abs, r.d)) <= enough * max(map(abs, u)):
            break
    scale = 1.0 / r.p[0]
    inverse = [c * scale for c in r.cofactors]
    if not all(map(math.isfinite, (*u, *inverse))):
        raise NotSettled
    return u, inverse


def _chord(start: FloatVector, state: Vector, inverse: Sequence[float], lost: int, unit: arb) -> Vector:
    """Corrections with one approximate inverse until the next one would be below a unit, or below `lost` bits.

    The corrections are floats, in that unit.  Raises NotSettled if they do not shrink.
    """
    if ctx.prec > FLOAT_BITS:
        raise NotSettled
    u1, u2, u3 = map(arb, start)
    large, least, before = 1 / unit, 2.0**-ctx.prec, 0.0
    for _ in range(MOST_ROUNDS):
        d1, d2, d3 = adjoint(inverse, [float(r * large) for r in gibbs_residual(u1, u2, u3, *state)])
        u1, u2, u3 = u1 - d1 * unit, u2 - d2 * unit, u3 - d3 * unit
        change = max(abs(d1), abs(d2), abs(d3))
        # The next correction is assumed to shrink by the same factor.
        gain = change / before if before else GAIN
        if change * gain <= least or change <= 4 * 2.0**lost * least:
            return u1.mid(), u2.mid(), u3.mid()
        if not gain < 1:
            break
        before = change
    raise NotSettled


def _newton(u: Vector, state: Vector, bits: int) -> Vector:
    """One correction of u to this many bits, with ∂G/∂u at the bits of the working precision, which becomes `bits`."""
    det, _, _, _, *cofactors = gibbs_newton(*u, *_rounded(state))
    half, ctx.prec = ctx.prec, bits
    residual = gibbs_residual(*u, *_rounded(state))
    ctx.prec = half
    d = adjoint(cofactors, [x.mid() / det for x in residual])
    ctx.prec = bits
    return tuple((x - y).mid() for x, y in zip(u, d, strict=True))


#: The guard bits of Digits for the roundings of one step.
GUARD = 8
#: A rotation with a smaller q₀ is a quaternion in balls, since its Gibbs vector is too long.
LEAST_SCALAR = 0.125
#: The largest |ξ| of the mean-value form.
LARGEST = 0.125


class Spread:
    """ξ = Br in balls; call every method at the precision of matrices."""

    def __init__(self) -> None:
        self.restart(arb(0))

    def restart(self, radius: arb) -> None:
        """All ξ with |ξ| ≤ radius."""
        self.axes, self.size = arb_mat(3, 3, [1, 0, 0, 0, 1, 0, 0, 0, 1]), small(radius)
        self.box = arb_mat(3, 1, [arb(0, radius)] * 3)

    def moved(self, M: arb_mat, more: arb) -> None:
        """All Mξ + w with |w| ≤ more."""
        edges = M * self.axes
        try:
            axes = orthogonal(edges, self.box)
            inverse = axes.inv()
        except ZeroDivisionError:
            raise TooWide from None
        box = inverse * edges * self.box
        rows = inverse.entries()
        radii = (x.abs_upper() + more * upper(rows[3 * i : 3 * i + 3]) for i, x in enumerate(box.entries()))
        self.axes, self.box = axes, arb_mat(3, 1, [arb(0, r.abs_upper()) for r in radii])
        self.size = small(upper((axes * self.box).entries()))


def small(size: arb) -> arb:
    """A bound of |ξ|; raises TooWide if it is too large for the mean-value form."""
    if not size < LARGEST:
        raise TooWide
    return size


def orthogonal(matrix: arb_mat, box: arb_mat) -> arb_mat:
    """The axes of a parallelepiped, by decreasing length of its edges: exact numbers, orthogonal to rounding."""
    e = [float(x) for x in matrix.entries()]
    radii = [x.rad() for x in box.entries()]
    largest = max(radii)
    columns = []
    for i in range(3):
        r = float(radii[i] / largest) if largest > 0 else 1.0
        x, y, z = e[i], e[i + 3], e[i + 6]
        columns.append((r * r * (x * x + y * y + z * z), x, y, z))
    (_, *a), (_, *b), _ = sorted(columns, reverse=True)
    a = scaled(1 / math.sqrt(dot(a, a)), a)
    b = minus(b, scaled(dot(a, b), a))
    b = scaled(1 / math.sqrt(dot(b, b)), b)
    return arb_mat(3, 3, [x for row in zip(a, b, cross(a, b), strict=True) for x in row])


def cross_matrix(v: Sequence[arb]) -> arb_mat:
    """[v]ₓ, so that [v]ₓ x = v × x."""
    x, y, z = v
    return arb_mat(3, 3, [0, -z, y, z, 0, -x, -y, x, 0])


def carried(u: Vector, inverse: arb_mat, k: Vector, g: Vector, D: arb, size: arb) -> tuple[arb_mat, arb]:
    """M and a bound of |w| for a step: ξ becomes Mξ + w, |ξ| ≤ size.

    u: the Gibbs vector of the point; inverse: A⁻¹ for every midpoint between u and the Gibbs vector of another state;
    k, γ: for all states.  By lemma `state-error` the Gibbs vector at ξ is ũ + δ with Aδ = -Sξ; S follows from the
    change of k and γ by ξ, v - ṽ = 2[ṽ + ṽ × ξ]ₓξ/(1 + |ξ|²); and (1, -ũ)(1, ξ)(1, ũ + δ) is a multiple of (1, ξ').
    The vector after the factor 2 is within 2|ξ||v| of ṽ, as is the v of every state.
    """
    (u1, u2, u3), (g1, g2, g3) = u, g
    square, inner = dot(u, u), dot(g, u)
    norm = 1 + square
    turned = arb_mat(
        3, 3, [inner + g1 * u1, g1 * u2, g1 * u3, g2 * u1, inner + g2 * u2, g2 * u3, g3 * u1, g3 * u2, inner + g3 * u3]
    )
    # Δ = -A⁻¹S; the factors 2 of [2γ]ₓ and [2k]ₓ come last.
    change = inverse * (turned * (cross_matrix(g) * D) + cross_matrix([norm * x for x in k])) * 2
    across = cross_matrix(u)
    s = 1 - square
    d11, d22, d33 = 2 * u1 * u1 + s, 2 * u2 * u2 + s, 2 * u3 * u3 + s
    o12, o13, o23 = 2 * u1 * u2, 2 * u1 * u3, 2 * u2 * u3
    own = arb_mat(3, 3, [d11, o12, o13, o12, d22, o23, o13, o23, d33])
    matrix = own - across * 2 + change - across * change
    far = size * upper(change.entries())
    root = norm.sqrt()
    scalar = norm + arb(0, ((root + root * size) * far).abs_upper())
    return matrix * (1 / scalar), (root * size * far / scalar).abs_upper()


def exact(x: float | Fraction) -> arb:
    """A float or a fraction as a ball; exact if the precision holds it."""
    x = Fraction(x)
    return arb(fmpq(x.numerator, x.denominator))


class _UnderWay:
    """A ball that takes steps with `precision` bits.

    An exact power of two scales all quantities, so that the largest moment of inertia is about 1.  Call every method
    with that precision set.
    """

    def __init__(self, precision: int, given: Given) -> None:
        K, g, J, D, stages, attitude, _ = given
        self.precision = self.root_bits = precision
        self.exponent, self.lost = magnitude(J, D)
        self.size = size_of(K, self.exponent)
        self.unit = arb(2) ** self.size
        scale = Fraction(2) ** -self.exponent
        self.k: Vector = tuple(exact(x * scale / 2) for x in K)
        self.g = unit(map(exact, g))
        self.J = tuple(exact(x * scale) for x in J)
        self.I = moments(self.J)
        self.D = exact(D * scale)
        self.a: Vector = () if attitude is None else unit(map(exact, attitude) if attitude else least(*self.g))
        self.x = (arb(0), arb(0))
        self.stages = [None if c == 1 else exact(c) for c in stages]
        self.past: list[deque[FloatVector]] = [deque(maxlen=len(WEIGHTS)) for _ in stages]

    def _root(self, k: Vector, past: deque[FloatVector]) -> tuple[Vector, FloatVector] | None:
        """A point near the Gibbs vector, and its float64 value; None if no iteration finds it."""
        state = *k, *self.g, *self.I, self.D
        try:
            return root(extrapolated(past), state, self.root_bits, self.lost, self.unit)
        except ArithmeticError:
            return None

    def _near(self, K: Vector, g: Vector) -> Vector:
        """The rotation of a step by the float64 continuation."""
        k, vertical, tensor = (list(map(fraction, v)) for v in (K, g, self.J))
        return tuple(map(exact, start(k, vertical, tensor, fraction(self.D))))

    def _follow(self, q: Vector, g: Vector) -> None:
        """Moves the contact point by the rotation q; g: γ of all states in the enclosure."""
        x, y, _ = rotate(*self._attitude(), *centre_step(*q, *g))
        self.x = (self.x[0] + x, self.x[1] + y)

    def _attitude(self) -> Vector:
        return self.a


class DigitsBall(_UnderWay):
    """A ball that takes steps at N digits with guard bits, on midpoints; its frames are mpmath's numbers."""

    def __init__(self, precision: Digits, given: Given, steps: int = 1) -> None:
        K, _, J, D, stages, _, self.radius = given
        self.context = precision.context
        exponent, lost = magnitude(J, D)
        # The effect of roundings grows with the square of the number of steps, as the frequencies drift.
        more = 2 * math.ceil(math.log2(steps * len(stages) + 1)) + 2 * lost
        bits = self.context.prec + more + GUARD
        small = max(0, -size_of(K, exponent))
        with flint_bits(bits + small):
            super().__init__(bits + small, given)
        self.root_bits = bits
        self.floats = *map(float, self.I), float(self.D)
        half = tuple(map(float, self.k))
        inertia, contact = self.floats[:3], self.floats[3]
        self.bounds = [certificate([abs(float(c)) * x for x in half], inertia, contact)[0] for c in stages]

    def step(self) -> None:
        """Takes one step; raises StepNotTaken, with the ball at the start of the step or at one of its stages."""
        for c, bound, past in zip(self.stages, self.bounds, self.past, strict=True):
            k = self.k if c is None else tuple(c * x for x in self.k)
            u = self._gibbs(k, bound, past)
            p = self._rotation(k) if u is None else (arb(1), *u)
            if self.a:
                q = unit(p)
                self._follow(q, self.g)
                self.a = tuple(x.mid() for x in compose(*self.a, *q))
            self.k, self.g = (
                tuple((x + y).mid() for x, y in zip(v, turn(*p, *v), strict=True)) for v in (self.k, self.g)
            )

    def _gibbs(self, k: Vector, bound: float, past: deque[FloatVector]) -> Vector | None:
        """The Gibbs vector, if `small-branch` or `straight-path` proves that it is that of the branch; else None."""
        if (found := self._root(k, past) if bound >= 0.0 or bound == BEYOND else None) is None:
            past.clear()
            return None
        u, start = found
        if not (self._on_path(u, k) if bound == BEYOND else dot(start, start) <= bound):
            past.clear()
            return None
        past.appendleft(start)
        return u

    def _on_path(self, root: Vector, k: Vector) -> bool:
        """Whether the straight path joins a root to the identity: an inequality with a margin, evaluated in float64."""
        u, half, g = (tuple(map(float, v)) for v in (root, k, self.g))
        spread = 0.5 * (max(self.floats[:3]) - min(self.floats[:3]))
        proved, _ = joined(u, dot(u, u), half, math.hypot(*half), g, self.floats[:3], self.floats[3], spread)
        return proved > 0

    def _rotation(self, k: Vector) -> Vector:
        """The refined rotation if neither lemma holds."""
        K = tuple(2 * x for x in k)
        if (q := refined(self._near(K, self.g), K, self.g, self.J, (self.D,))) is None:
            raise StepNotTaken(Status.NOT_CONVERGED, 1.0)
        return q

    def frame(self, bits: int) -> tuple[Vector, Vector, Vector, Vector]:
        """𝒦, γ, the attitude and the contact point, rounded to this many bits, in the context of the precision."""

        momentum = tuple(in_context(self.context, x, bits, self.exponent + 1) for x in self.k)
        g, a, x = (tuple(in_context(self.context, x, bits) for x in v) for v in (self.g, self.a, self.x))
        return momentum, g, a, tuple(y * self.radius for y in x)


class ArbBall(_UnderWay):
    """A ball that takes steps in Arb balls."""

    def __init__(self, precision: int, given: Given) -> None:
        super().__init__(precision, given)
        # The steps compose the rotation since the start; 𝒦 and γ are those of the start, turned back by this rotation.
        self.first_k, self.first_g, self.length = self.k, self.g, upper(self.k)
        self.p: Vector = (arb(1), arb(0), arb(0), arb(0))
        self.spread, self.matrix_bits = Spread(), MATRIX_BITS + 3 * self.lost
        *_, stages, _, radius = given
        self.radius = exact(radius)
        self.bounds = [certified(2 * upper(self.k) * abs(exact(c)), self.I) for c in stages]
        self.selected = 0

    def step(self) -> None:
        """Takes one step; raises StepNotTaken, and TooWide if the balls are too large to prove a step."""
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

    def _all(self) -> tuple[Vector, Vector]:
        """k and γ of all states in the enclosure: ξ moves a vector by at most 2|ξ| times its length."""
        off = 2 * self.spread.size
        along, across = arb(0, (off * self.length).abs_upper()), arb(0, off.abs_upper())
        return tuple(x + along for x in self.k), tuple(x + across for x in self.g)

    def _proved(self, k: Vector, every: Vector, bound: tuple[arb, arb] | None, past: deque[FloatVector]) -> Near:
        """A point, and a bound of its distance from the branch's Gibbs vectors of all states; None if none is proved.

        k: that of the followed point; every: k, γ, I and D of all states.
        """
        if (found := self._root(k, past)) is None:
            return None
        u, start = found
        with flint_bits(self.matrix_bits):
            length = upper(gibbs_residual(*(*u, *every)))
            slope = on_path(u, length, *every) if bound is None else bound[1] if upper(u) <= bound[0] else None
            if slope is None:
                return None
            past.appendleft(start)
            return u, (length / slope).abs_upper()

    def _selected(self, every: Vector, bound: tuple[arb, arb] | None, past: deque[FloatVector]) -> Near:
        """The same for the root that the continuation selects; None if its Gibbs vector is too long: the step is taken
        here.

        A root that is then proved to be that of the branch is a guess for the next steps.
        """
        q = self._rotation(every)
        squared = q[1] * q[1] + q[2] * q[2] + q[3] * q[3]
        u = tuple(x / q[0] for x in q[1:])
        with flint_bits(self.matrix_bits):
            proved = squared < q[0] * q[0] if bound else stretch(u, *every) is not None
        past.appendleft(tuple(map(float, u)))
        if not proved:
            past.clear()
        self.selected += not proved
        if q[0] > LEAST_SCALAR:
            return tuple(x.mid() for x in u), upper([x.rad() for x in u])
        if self.a:
            self._follow(q, every[3:6])
        self.p, far = point(compose(*self._turned(), *q))
        self.spread.restart(far)
        return None

    def _turn_by(self, u: Vector, off: arb, k: Vector, every: Vector) -> None:
        """Turns by the rotation whose Gibbs vector is within `off` of u, by the mean-value form.

        As ∂G/∂u is affine in u, the Gibbs vector of the point is u - A⁻¹G(u) with A = ∂G/∂u at the midpoint of the two.
        """
        r = gibbs_residual(*(*u, *k, *self.g, *self.I, self.D))
        with flint_bits(self.matrix_bits):
            inverse = inverse_slope(u, off, every)
            d = (inverse * arb_mat(3, 1, r)).entries()
        u = tuple(x - y for x, y in zip(u, d, strict=True))
        with flint_bits(self.matrix_bits):
            M, more = carried(u, inverse, every[:3], every[3:6], self.D, self.spread.size)
            scale = (1 / (1 + u[0] * u[0] + u[1] * u[1] + u[2] * u[2]).sqrt()).mid()
        if self.a:
            self._follow(unit((arb(1), *u)), every[3:6])
        self.p, far = point(scale * x for x in compose(*(*self.p, 1, *u)))
        with flint_bits(self.matrix_bits):
            # p∘(1, ε)∘(1, ξ) is p∘(1, ξ'), |ξ' - ξ| ≤ |ε|(1 + |ξ| + |ξ|²)/(1 - |ε||ξ|) ≤ 2|ε|.
            self.spread.moved(M, more + 2 * far)

    def _rotation(self, every: Vector) -> Vector:
        """The rotations of all states if neither lemma holds."""
        K, g = tuple(2 * x for x in every[:3]), every[3:6]
        finite = all(x.is_finite() for x in every)
        if not finite or (q := enclosed(self._near(K, g), K, g, self.J, (self.D,))) is None:
            raise TooWide
        return q

    def _turned(self) -> Vector:
        """A quaternion, of any length, that encloses the rotation since the start."""
        off = arb(0, self.spread.size)
        return compose(*(*self.p, 1, off, off, off))

    def _attitude(self) -> Vector:
        return unit(compose(*(*self.a, *self._turned())))

    def bits(self) -> float:
        """The correct bits of 𝒦, γ and the attitude, each relative to the length of its vector."""
        vectors = *self._all(), self._attitude() if self.a else ()
        widest = [max((log2_of(x.rad()) for x in v), default=-math.inf) for v in vectors]
        return -max(widest[0] - self.size, *widest[1:])

    def frame(self, bits: int) -> tuple[Vector, Vector, Vector, Vector]:
        """𝒦, γ, the attitude and the contact point, rounded to this many bits."""
        scale = arb(2) ** (self.exponent + 1)
        k, g = self._all()
        a = self._attitude() if self.a else ()
        momentum, trace = tuple(x * scale for x in k), tuple(x * self.radius for x in self.x)
        with flint_bits(bits):
            return tuple(tuple(+x for x in v) for v in (momentum, g, a, trace))  # type: ignore[return-value]


def point(p: Iterable[arb]) -> tuple[Vector, arb]:
    """The midpoint of a quaternion in balls, and a bound of its error, relative to its length."""
    balls = list(p)
    middle = tuple(x.mid() for x in balls)
    with flint_bits(MATRIX_BITS):
        off = upper([x.rad() for x in balls]) / sum((x * x for x in middle), arb(0)).sqrt()
        return middle, (off / (1 - off)).abs_upper()


def in_context(context: MPContext, x: arb, bits: int, shift: int = 0) -> mpf:
    """2^shift times the midpoint of a ball, rounded to this many bits, as a number of an mpmath context."""
    man, exp = x.mid().man_exp()
    return context.make_mpf(from_man_exp(int(man), int(exp) + shift, bits, "n"))


def size_of(K: Exact, exponent: int) -> int:
    """An exponent with |𝒦|/2^(exponent + 1) about 2^size."""
    return exponent_of(max(map(abs, K))) - exponent - 1


def log2_of(x: arb) -> float:
    """The logarithm to base 2 of the midpoint of a ball, rounded up; -inf if that is not positive."""
    if not x.is_finite():
        return math.inf
    man, exp = map(int, x.mid().man_exp())
    return exp + man.bit_length() if man > 0 else -math.inf

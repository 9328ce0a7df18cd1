"""A level of the reduced map at any precision: its circle, the step on the sphere, and in Jacobi's functions.

Numbers are Arb's midpoints: nothing here is a proof (that is `chapsym certify`), the working digits are the caller's
(flint's `ctx.workdps`).  Every level has its own sense: γ_b is reflected where that makes the motion positive, which
commutes with the map's symmetries.
"""

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import pi
from typing import Any, TypeVar

from flint import acb, arb, ctx, fmpq

from chapsym.dynamics import BadInput
from chapsym.dynamics.loops.branch import TAKEN, small_rotation
from chapsym.dynamics.loops.gibbs import bound, search
from chapsym.generated import gibbs_newton, turn

Vector = tuple[arb, ...]
#: A number as it is given: exact, or an Arb midpoint.
Given = str | int | Fraction | arb
Tensor = Sequence[Given]
Real = TypeVar("Real", arb, float)

#: Bits of a float64 Newton root that Arb's iteration may count on.
FIRST_BITS = 40
#: The most rounds of the secant method.
MOST_ROUNDS = 60


def number(x: Given | float) -> arb:
    """A fraction or decimal, as text or number, as an Arb midpoint."""
    if isinstance(x, arb):
        return middle(x)
    x = Fraction(x)
    return middle(arb(fmpq(x.numerator, x.denominator)))


def middle(x: arb) -> arb:
    """A ball without its radius."""
    return arb(x.mid())


def real(x: acb) -> arb:
    """The midpoint of the real part."""
    return middle(x.real)


def circle(moments: Sequence[Any], l: Any) -> tuple[tuple[Any, ...], Any]:
    """C_a², C_b², C_c² of (5.8) as corrected, and the parameter k², of levels l; numbers or arrays."""
    La, Lb, Lc = moments
    low, high = 1 - Lc * l, La * l - 1
    squares = -La * low / (Lc - La), -Lb * low / (Lc - Lb), -Lc * high / (Lc - La)
    return squares, (squares[1] - squares[0]) / squares[2]


def solved(function: Callable[[arb], arb], first: Given, second: Given) -> arb:
    """A root by the secant method, to the working digits."""
    a, b = number(first), number(second)
    fa = function(a)
    for _ in range(MOST_ROUNDS):
        fb = function(b)
        if fb == fa or abs(fb) < arb(2) ** (6 - ctx.prec):
            return b
        a, b, fa = b, middle(b - fb * (b - a) / (fb - fa)), fb
        if abs(b - a) < abs(b) * arb(2) ** (4 - ctx.prec):
            return b
    raise BadInput("the secant method found no root; next to the end of the branch take a smaller height")


def halved(below: Callable[[Real], bool], a: Real, b: Real, rounds: int) -> tuple[Real, Real]:
    """The part of an interval, halved so often, at whose first end something holds that does not at its second."""
    for _ in range(rounds):
        c = (a + b) / 2
        a, b = (c, b) if below(c) else (a, c)
    return a, b


class Level:
    """γ = (C_a cn u, C_b sn u, C_c dn u), the circle ⟨γ,Λ⁻¹γ⟩ = l around the axis c, and G_h on it.

    tensor: J; D; height: h > 0; level: l, strictly between two of 1/Λ; kick: τ, by which a top is perturbed (`step`).
    Phases φ are amplitudes, φ = am u, positive in the sense of the motion; half: 2K, a half turn in u.
    Raises BadInput where l is no circle's.
    """

    def __init__(self, tensor: Tensor, D: Given, height: Given, level: Given, kick: Given = 0) -> None:
        J = [number(x) for x in tensor]
        self.tensor, self.D, self.h, self.l, self.kick = J, number(D), number(height), number(level), number(kick)
        self.I = (J[1] + J[2], J[0] + J[2], J[0] + J[1])
        moments = [x + self.D for x in self.I]
        a, b, c = sorted(range(3), key=lambda i: -float(moments[i]))
        if not self.l > 1 / moments[b]:
            a, c = c, a
        La, _, Lc = self.moments = moments[a], moments[b], moments[c]
        squares, parameter = circle(self.moments, self.l)
        if not all(x > 0 for x in squares):
            raise BadInput(f"the level {float(self.l):.6g} is no circle around an axis")
        self.axes = a, b, c
        Ca, Cb, Cc = (middle(x.sqrt()) for x in squares)
        # V of (5.13-V) is positive with this sign of C_b.
        parity = 1 if (b - a) % 3 == 1 else -1
        sense = parity if float(La) < float(Lc) else -parity
        self.amplitudes = Ca, sense * Cb, Cc
        self.m = middle(parameter)
        if not 0 < self.m < 1:
            raise BadInput(f"the level {float(self.l):.6g} is the separatrix, or two moments are equal")
        self.K = real(acb(self.m).elliptic_k())
        self.half = 2 * self.K
        self.complement = real(acb(1 - self.m).elliptic_k())  # K'
        self._floats = [float(x) for x in (*self.I, self.D)]
        self._J = [float(x) for x in J]
        h = float(self.h)
        self._bound = bound((h / 2, 0.0, 0.0), self._floats[:3], self._floats[3])

    def point(self, phase: arb) -> Vector:
        """γ at a phase."""
        sine, gamma = phase.sin(), [arb(0)] * 3
        values = phase.cos(), sine, (1 - self.m * sine * sine).sqrt()
        for axis, size, value in zip(self.axes, self.amplitudes, values, strict=True):
            gamma[axis] = middle(size * value)
        return gamma[0], gamma[1], gamma[2]

    def direction(self, gamma: Vector) -> tuple[arb, arb]:
        """(cos φ, sin φ) of γ, up to a positive factor."""
        a, b, _ = self.axes
        return gamma[a] / self.amplitudes[0], gamma[b] / self.amplitudes[1]

    def step(self, gamma: Vector) -> Vector:
        """G_h(γ); for a perturbed top then φ is turned on to φ + τ sin 2φ on the same level."""
        k = tuple(self.h * x / 2 for x in gamma)
        u = self._root(k, gamma)
        moved = tuple(middle(x + d) for x, d in zip(gamma, turn(*(1, *u, *gamma)), strict=True))
        if self.kick == 0:
            return moved
        c, s = self.direction(moved)
        phase = arb.atan2(s, c)
        return self.point(middle(phase + self.kick * (2 * phase).sin()))

    def _root(self, k: Vector, gamma: Vector) -> Vector:
        """The Gibbs vector: Newton's iteration in Arb from the float64 root on the small-rotation branch."""
        u = tuple(map(arb, self._near([float(x) for x in k], [float(x) for x in gamma])))
        bits = FIRST_BITS
        while True:
            p0, p1, p2, p3, *_ = gibbs_newton(*(*u, *k, *gamma, *self.I, self.D))
            new = tuple(middle(p / p0) for p in (p1, p2, p3))
            off = max(abs(float(x - y)) for x, y in zip(new, u, strict=True))
            u, bits = new, 2 * bits
            if bits >= ctx.prec:
                break
        if not off <= 2.0 ** -min(FIRST_BITS, ctx.prec // 2 - 4):
            raise BadInput("Newton's iteration did not settle on the root of a step")
        return u

    def _near(self, k: list[float], gamma: list[float]) -> tuple[float, ...]:
        if self._bound[0] >= 0.0:
            settled, _, u = search((0.0, 0.0, 0.0), k, gamma, self._floats[:3], self._floats[3], *self._bound)
            if settled:
                return u
        status, _, q0, *q = small_rotation(*(*(2 * x for x in k), *gamma, *self._J, self._floats[3]))
        if status != TAKEN or q0 < 1e-6:
            raise BadInput(f"the small-rotation branch ends before the height {float(self.h):.6g}")
        return tuple(x / q0 for x in q)

    def turned(self, gamma: Vector, after: Vector) -> arb:
        """The angle φ~ - φ between successive γ, in (-π, π)."""
        (c, s), (x, y) = self.direction(gamma), self.direction(after)
        return middle(arb.atan2(c * y - s * x, c * x + s * y))

    def argument(self, phase: arb) -> arb:
        """u = F(φ, m), going on from turn to turn; next to π/2, where Arb's reduction is torn, by K - F."""
        turns = round(float(phase) / pi)
        rest = middle(phase - turns * arb.pi())
        c, s, k = rest.cos(), rest.sin(), (1 - self.m).sqrt()
        if s * s * k < c * c:
            part = self._first_kind(rest)
        else:
            part = self.K - self._first_kind(middle(arb.atan2(c, k * abs(s))))
            part = part if s > 0 else -part
        return middle(part + turns * self.half)

    def _first_kind(self, phase: arb) -> arb:
        return real(acb.elliptic_f(acb(phase), acb(self.m)))

    def amplitude(self, u: arb) -> arb:
        """φ = am u, by theta functions, going on from turn to turn."""
        turns = round(float(u / self.half))
        sn, cn, _ = self.jacobi(u - turns * self.half)
        return middle(arb.atan2(sn, cn) + turns * arb.pi())

    def jacobi(self, u: arb) -> tuple[arb, arb, arb]:
        """sn, cn, dn of u, by theta functions."""
        tau = acb(0, middle(self.complement / self.K))
        zero = acb.modular_theta(acb(0), tau)
        theta = acb.modular_theta(acb(u / self.half), tau)
        t2, t3, t4 = (real(x) for x in zero[1:])
        s1, s2, s3, s4 = (real(x) for x in theta)
        return middle(t3 * s1 / (t2 * s4)), middle(t4 * s2 / (t2 * s4)), middle(t4 * s3 / (t3 * s4))

    def lift(self, phase: arb, steps: int) -> arb:
        """The phase after this many steps, going on from turn to turn."""
        gamma, total = self.point(phase), float(phase)
        for _ in range(steps):
            after = self.step(gamma)
            total += float(self.turned(gamma, after))
            gamma = after
        c, s = self.direction(gamma)
        end = middle(arb.atan2(s, c))
        return end + 2 * arb.pi() * round((total - float(end)) / (2 * pi))

    def displacement(self, phase: Given, steps: int, half_turns: int) -> arb:
        """(G^q(u) - u)/2K - p, in half turns, of the orbit that starts at a phase."""
        start = number(phase)
        moved = self.argument(self.lift(start, steps)) - self.argument(start)
        return middle(moved / self.half - half_turns)


class Relation:
    """The same step by (5.15) as corrected, its chord form, and the law of the plateaus for small D.

    hG𝒟 = 2Vw(𝒟 - D(l - μ sn²δu)), 𝒟 = 1 - k² sn²ū sn²δu, w = sn cn dn of δu.
    """

    def __init__(self, level: Level) -> None:
        self.level = level
        La, Lb, Lc = level.moments
        Ca, Cb, Cc = level.amplitudes
        lower = Cc * Cc * (La - Lc) / Lc  # Λ_a l - 1
        self.mu = middle(Cb * Cb / Lb)
        self.V = middle((abs(Lb - Lc) * abs(lower) / (La * Lb * Lc)).sqrt())
        self.alpha = middle((2 * La * Lc * level.l - (La + Lc - Lb)) / ((Lb - Lc) * lower))
        self.beta = middle(Lc * Ca * Ca * (La - Lc) / ((Lb - Lc) ** 2 * lower))

    def height(self, half: arb, mean: arb) -> arb:
        """The h whose step leads from ū - δu to ū + δu."""
        w, y, shape, weight = self._parts(half)
        s = self.level.jacobi(mean)[0]
        scale = 1 - self.level.m * s * s * y
        return middle(2 * w * (1 - self.level.D * weight / scale) / (self.V * shape))

    def _parts(self, half: arb) -> tuple[arb, arb, arb, arb]:
        """w, y = sn², G/V² = 1 + αy - βy², λ = l - μy of the half increment."""
        sn, cn, dn = self.level.jacobi(half)
        y = sn * sn
        return sn * cn * dn, y, 1 + self.alpha * y - self.beta * y * y, self.level.l - self.mu * y

    def increment(self, u: arb) -> arb:
        """2δu of the step from u on the branch that starts at δu = 0, by the secant method."""
        slack = 1 - self.level.D * self.level.l
        b = middle(self.V * self.level.h / (2 * slack))
        return 2 * solved(lambda half: self.height(half, u + half) - self.level.h, b * arb("0.99"), b)

    def displacement(self, phase: Given, steps: int, half_turns: int) -> arb:
        """As `Level.displacement`, without the sphere."""
        start = self.level.argument(number(phase))
        u = start
        for _ in range(steps):
            u = middle(u + self.increment(u))
        return middle((u - start) / self.level.half - half_turns)

    def momentum(self, half: arb) -> arb:
        """M(a) = (2w/y)N(a), N = (1 - hG/(2Vw))/λ; 0 where the top, D = 0 with these Λ, has this increment."""
        w, y, shape, weight = self._parts(half)
        return middle(2 * (w - self.level.h * self.V * shape / 2) / (y * weight))

    def zeta(self, u: arb) -> arb:
        """Jacobi's Z(u) = E(am u) - (E/K)u."""
        level = self.level
        turns = round(float(u / level.half))
        rest = u - turns * level.half
        whole = real(acb(level.m).elliptic_e()) / level.K
        part = real(acb.elliptic_e_inc(acb(level.amplitude(rest)), acb(level.m)))
        return middle(part - whole * rest)

    def chord(self, u: arb, after: arb) -> arb:
        """M(a) - D(2w/y + 2Z(a) - (Z(u~) - Z(u))), a = (u~ - u)/2: (5.15) in chord form, 0 along an orbit."""
        half = middle((after - u) / 2)
        w, y, _, _ = self._parts(half)
        free = 2 * w / y + 2 * self.zeta(half)
        return middle(self.momentum(half) - self.level.D * (free - self.zeta(after) + self.zeta(u)))

    def law(self, steps: int, half_turns: int) -> arb:
        """The amplitude of the displacement at p/q to lowest order in D, in half turns: D²|A''|π²q²/(K³ sinh(qη)).

        A inverts M, at a = Kp/q; η = πK'/K.  To second order in D the map is u ↦ u + const + a coboundary + A''(ΔZ)²D²
        and the orbit's sum of (ΔZ)² has the q-th Fourier coefficient (2π²/K²) q²/sinh(qη).
        """
        level = self.level
        a = middle(level.K * half_turns / steps)
        e = arb(10) ** -(ctx.dps // 5)
        before, at, after = (self.momentum(a + x) for x in (-e, arb(0), e))
        slope, bend = (after - before) / (2 * e), (after - 2 * at + before) / (e * e)
        eta = arb.pi() * level.complement / level.K
        size = level.D**2 * abs(bend / slope**3) * (arb.pi() * steps) ** 2
        return middle(size / (level.K**3 * (steps * eta).sinh()))

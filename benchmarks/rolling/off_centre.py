"""A ball whose centre of mass is off its centre, and that rolls under its weight: its equations, and their enclosure.

In the axes of the body, with the vertical γ, the centre of mass at c from the centre, and r = ργ + c from the point of
contact to it:
    K = Iω + m r × (ω × r),   K' = K × ω + mg γ × c - mρ⟨ω, γ × c⟩ω,   v' = v × ω for what is fixed in space.
K is the momentum about the point of contact, which moves with the velocity ρω × γ; I is about the centre of mass.
`derived` makes these equations of the Lagrangian and the constraint, and what it makes is what runs; that it is the
principle's motion of `examples/off_centre_ball.py`, tests/studies/test_rolling_cases.py decides.

A step has exact polynomials of the time τ in [0, 1], of the step's length h: p₁, p₂, p₃ for the axes of space, p₃ for
γ, and k, w for K, ω.  Of their defects
    e = p' - h p × w,   κ = Iw + m r × (w × r) - k with r = ρp₃ + c,   f = k' - h(k × w + mg p₃ × c - ...)
there are bounds on [0, 1], and with them of the motion's distance.

Lemma (by hand).  Let a and b be the distances of the axes (the largest of three) and of K; a ≤ X and b ≤ Y; and the
letters of vectors bounds of their lengths.  Then d = ω - w has
    d ≤ β(b + κ + μa),   β = 1/I_min,   μ = mρw(2(ρ + c) + ρX),
and the vector (a, b) is at most exp(A)((a, b)(0) + rest), where A and rest ≥ 0 are, by rows,
    h(1 + X)β(μ, 1) and h(1 + X)βκ + e;   h(qβμ + s, qβ) and hqβκ + f;
    q = k + mρc(2w + Δ) with Δ ≥ d for a, b = X, Y,   s = mc(g + ρw²).
If that is below (X, Y), these were enough.
1. M(γ)ω = K and M(p₃)w = k + κ for M(γ)ω = Iω + m r × (ω × r) ≥ I_min in the sense of forms, as ⟨r × (ω × r), ω⟩ =
   |ω × r|².  So M(γ)d = (K - k) - κ - (M(γ) - M(p₃))w; and the last is m[ρδ × (w × r) + r̃ × (w × ρδ)], δ = γ - p₃,
   where r of γ has r ≤ ρ + c, and r̃ of p₃ at most ρX more.
2. An axis v has (v - p)' = h((v - p) × ω + p × d) - e, of which the first term is normal to v - p; p ≤ 1 + X.
3. (K - k)' = h((K - k) × ω + k × d + mgδ × c - mρ(ω⟨ω,γ × c⟩ - w⟨w,p₃ × c⟩)) - f, the first term likewise; in the
   last one ω⟨ω,u⟩ - w⟨w,v⟩ = d⟨ω,u⟩ + w⟨d,u⟩ + w⟨w,u - v⟩, u = γ × c ≤ c, u - v = δ × c.
4. So (a, b)' ≤ A(a, b) + rest, and A has no negative entry.
The contact point has the velocity ρω × e₃ = ρ(⟨p₂,ω⟩, -⟨p₁,ω⟩) of the true axes: off by hρ(d + wa) at most.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from typing import Any, NamedTuple

import numpy as np
from flint import arb, arb_mat, arb_poly, arb_series, ctx
from sympy import Expr, Matrix, Symbol, factor_terms, lambdify, symbols

from chapsym.dynamics.enclosed_motion import decimal, follow
from chapsym.dynamics.errors import TooWide
from chapsym.dynamics.flow.deviation import UNIT, bound, exact
from chapsym.dynamics.flow.start import ball, balls
from chapsym.dynamics.levels.balls import log2_of
from chapsym.dynamics.levels.proved_root import MATRIX_BITS, lowest, unit, upper
from chapsym.dynamics.loops.vectors import cross, dot
from chapsym.dynamics.principal_axes import quaternions
from chapsym.files import Data
from chapsym.numbers.precisions import flint_terms

Vector = Sequence[Any]
#: X of the lemma.
TUBE = 2.0**-20
#: A step is e^-POWER of the radius of convergence: rounds cost as the square of the terms.
POWER = 2
#: Bits and terms of the look at that radius.
LOOK_BITS, LOOK_TERMS = 64, 32
#: Pieces of a step on which |w| and |k| are bounded apart.
PIECES = 8


@cache
def derived() -> tuple[Callable[..., Vector], ...]:
    """K, and K' - K × ω, as functions of the parts of a `Body`, γ and ω.

    Of a Lagrangian L(v, ω, γ) and the constraint v = V = ρω × γ of the centre, γ' = γ × ω, with p = ∂L/∂v where v is V:
    d'Alembert's principle for the displacements η of the body, which move the centre by ρη × γ, is
    K' = K × ω + p × V + ∂L/∂γ × γ with K the derivative of L(V, ω, γ) by ω.
    """
    mass, radius, gravity = symbols("mass radius gravity")
    moments, offset, up, w, v = (symbols(f"{name}1:4") for name in ("I", "c", "g", "w", "v"))
    c, gamma, omega, velocity = map(Matrix, (offset, up, w, v))
    mean = velocity + omega.cross(c)
    squares = [*((mass, x) for x in mean), *zip(moments, w, strict=True)]
    lagrangian = sum(x * y**2 / 2 for x, y in squares) - mass * gravity * gamma.dot(c)
    rolls = dict(zip(v, radius * omega.cross(gamma), strict=True))

    def slope(of: Expr, by: Sequence[Symbol]) -> Matrix:
        return Matrix([of.diff(x) for x in by])

    K = slope(lagrangian.xreplace(rolls), w)
    rest = slope(lagrangian, v).xreplace(rolls).cross(velocity.xreplace(rolls)) + slope(lagrangian, up).cross(gamma)
    given = mass, radius, moments, offset, gravity, up, w
    return tuple(lambdify(given, list(one.applyfunc(factor_terms)), [], cse=True) for one in (K, rest))


class Body(NamedTuple):
    """SI units; inertia: the principal moments about the centre of mass; offset: c, from the centre to it."""

    mass: Any
    radius: Any
    inertia: Vector
    offset: Vector
    gravity: Any

    def arm(self, up: Vector) -> Vector:
        """The vector r from the point of contact to the centre of mass, for the vertical `up`."""
        return [self.radius * x + y for x, y in zip(up, self.offset, strict=True)]

    def momentum(self, up: Vector, w: Vector) -> Vector:
        """K of ω."""
        return derived()[0](*self, up, w)

    def omega(self, up: Vector, K: Vector) -> Vector:
        """ω of K: as (I + m|r|²)ω = K + m⟨r,ω⟩r."""
        r = self.arm(up)
        inverse = [1 / (i + self.mass * dot(r, r)) for i in self.inertia]
        x, y = ([i * z for i, z in zip(inverse, v, strict=True)] for v in (K, r))
        along = self.mass * dot(r, x) / (1 - self.mass * dot(r, y))
        return [i + along * j for i, j in zip(x, y, strict=True)]

    def torque(self, up: Vector, K: Vector, w: Vector) -> Vector:
        """K'."""
        return [x + y for x, y in zip(cross(K, w), derived()[1](*self, up, w), strict=True)]


class Step(NamedTuple):
    """Polynomials of τ: the axes of space, K, ω; a and b; the contact point; where it begins, and its length."""

    axes: Sequence[Vector]
    K: Vector
    w: Vector
    a: arb
    b: arb
    contact: Vector
    began: Fraction
    length: Fraction


class Path:
    """A motion in balls of `precision` bits, for `enclosed_motion.follow`; its methods need that precision set."""

    def __init__(self, precision: int, body: Body, axes: Sequence[Vector], w: Vector) -> None:
        self.precision, self.body, self.time, self.steps = precision, body, Fraction(0), 0
        self.tick: Callable[[], None] = lambda: None
        found = [*axes, body.momentum(axes[2], w)]
        a, b = max(map(_off, found[:3])), _off(found[3])
        points = [[arb_poly([x.mid()]) for x in v] for v in (*found, w)]
        self.last = Step(points[:3], points[3], points[4], a, b, [arb_poly([0])] * 2, self.time, Fraction(1))

    @property
    def width(self) -> float:
        """The logarithm to base 2 of how far the axes may be off."""
        return log2_of(arb(0, self.last.a).rad())

    def advance(self, end: Fraction) -> None:
        """Goes on to a later time, or a part of the way; raises TooWide where the balls allow no proof."""
        self.tick()
        state = [x(1) for v in (*self.last.axes, self.last.K) for x in v]
        start = [x.mid() for x in state]
        left = end - self.time
        with ctx.workprec(LOOK_BITS):
            rate = upper(self.body.omega(start[6:9], start[9:]))
            glance = 1 / max(Fraction(float(rate)), 1 / left)
            series = self._series(start, ball(glance), LOOK_TERMS)
        count = math.ceil(left / (Fraction(math.exp(-POWER) * _reach(series)) * glance))
        length = left / count
        with ctx.workprec(self.precision):
            terms = math.ceil(self.precision * math.log(2) / POWER) + 8
            *p, w = _vectors([exact(x) for x in self._series(start, ball(length), terms)])
        a, b = (x + y for x, y in zip((self.last.a, self.last.b), (_off(state[:9]), _off(state[9:])), strict=True))
        self.last = self._proved(Step(p[:3], p[3], w, a, b, self.last.contact, self.time, length))
        self.time, self.steps = self.time + length, self.steps + 1

    def _series(self, start: Vector, h: arb, terms: int) -> Vector:
        """Polynomials of axes, K and ω from there: each round gives another term."""
        found = [arb_series([x]) for x in start]
        for n in range(2, terms + 1):
            with flint_terms(n):
                *axes, K = _vectors(found)
                w = self.body.omega(axes[2], K)
                rates = [*(x for v in axes for x in cross(v, w)), *self.body.torque(axes[2], K, w)]
                found = [x + (h * y).integral() for x, y in zip(start, rates, strict=True)]
        with flint_terms(terms):
            return [arb_poly(x.coeffs()) for x in (*found, *self.body.omega(found[6:9], found[9:]))]

    def _proved(self, step: Step) -> Step:
        """The step with a and b on all of it, and the contact point; raises TooWide."""
        body, (*_, up), h, c = self.body, step.axes, ball(step.length), upper(self.body.offset)
        e = max(bound(_defect(p, h, cross(p, step.w))) for p in step.axes)
        f = bound(_defect(step.K, h, body.torque(up, step.K, step.w)))
        kappa = bound([x - y for x, y in zip(body.momentum(up, step.w), step.K, strict=True)])
        W, k = (max(upper([x((i + UNIT) / PIECES) for x in v]) for i in range(PIECES)) for v in (step.w, step.K))
        with ctx.workprec(MATRIX_BITS):
            X, beta = arb(TUBE), 1 / lowest(*body.inertia)
            Y = X / (beta * h)
            mu = body.mass * body.radius * W * (2 * (body.radius + c) + body.radius * X)
            apart = beta * (Y + kappa + mu * X)
            q = k + body.mass * body.radius * c * (2 * W + apart)
            s = body.mass * c * (body.gravity + body.radius * W * W)
            A = arb_mat([[(1 + X) * beta * mu, (1 + X) * beta], [q * beta * mu + s, q * beta]]) * h
            rest = [step.a + h * (1 + X) * beta * kappa + e, step.b + h * q * beta * kappa + f]
            a, b = (x.abs_upper() for x in (A.exp() * arb_mat([[x] for x in rest])).entries())
            if not (a < X and b < Y):
                raise TooWide
            off = arb(0, (h * body.radius * (beta * (b + kappa + mu * a) + W * a)).abs_upper())
        ways = dot(step.axes[1], step.w), -dot(step.axes[0], step.w)
        contact = [x(1) + off + (h * body.radius * y).integral() for x, y in zip(step.contact, ways, strict=True)]
        return step._replace(a=a, b=b, contact=contact)

    def frame(self, time: Fraction) -> dict[str, tuple[arb, ...]]:
        """The parts of a frame at a time of the last step."""
        last, tau = self.last, ball((time - self.last.began) / self.last.length)
        axes = [[x(tau) + arb(0, last.a) for x in v] for v in last.axes]
        K = [x(tau) + arb(0, last.b) for x in last.K]
        return {
            "gamma": tuple(axes[2]),
            "angular_momentum": tuple(K),
            "omega": tuple(self.body.omega(axes[2], K)),
            "attitude": unit(quaternions(np.array(axes, dtype=object))),
            "contact": tuple(x(tau) for x in last.contact),
        }


def _vectors(numbers: Vector) -> list[Vector]:
    return [numbers[i : i + 3] for i in range(0, len(numbers), 3)]


def _defect(v: Vector, h: arb, rate: Vector) -> Vector:
    return [x.derivative() - h * y for x, y in zip(v, rate, strict=True)]


def _off(v: Vector) -> arb:
    """A bound of the distance from the middles."""
    with ctx.workprec(MATRIX_BITS):
        return upper([x.rad() for x in v])


def _reach(series: Vector) -> float:
    """About the radius in which the series converge."""
    last = [max(abs(float(x[n])) for x in series) for n in range(LOOK_TERMS - 8, LOOK_TERMS)]
    return min((x ** (-1 / n) for n, x in enumerate(last, LOOK_TERMS - 8) if x), default=1.0)


@dataclass(frozen=True)
class Start:
    """A ball that starts with ω in its own axes, which are those of space; exact numbers."""

    title: str
    body: Body
    omega: Sequence[Fraction]
    time: Fraction = Fraction(10)
    frames: int = 40

    @property
    def radius(self) -> Fraction:
        """The radius of the ball."""
        return self.body.radius

    def path(self, precision: int) -> Path:
        """The motion at the start, with that precision set."""
        of = self.body
        body = Body(ball(of.mass), ball(of.radius), balls(of.inertia), balls(of.offset), ball(of.gravity))
        return Path(precision, body, [balls(x) for x in AXES], balls(self.omega))


AXES = [[Fraction(i == j) for j in range(3)] for i in range(3)]


def numbers(text: str) -> tuple[Fraction, ...]:
    return tuple(map(Fraction, text.split()))


START = Start(
    "A hollow ball with a weight inside: its centre of mass is 5.4 mm off the centre, which makes it faster and slower",
    Body(Fraction("1.2"), Fraction("0.11"), numbers("0.0081 0.0088 0.0094"), numbers("0.003 -0.002 0.004"),
         Fraction("9.81")),
    numbers("2 -1.5 2.5"),
)  # fmt: skip


def made(digits: int) -> Data:
    """The case as `make.made` has those of scenes, with the centre of mass and gravity."""
    body, count = START.body, START.frames
    found = follow(START, tuple(i * START.time / count for i in range(count + 1)), digits, limit=7200.0)
    if found.stopped:
        raise RuntimeError(found.stopped)
    one = {name: decimal(getattr(body, name)) for name in ("mass", "radius")}
    more = {name: [decimal(x) for x in v] for name, v in (("inertia", body.inertia), ("centre_of_mass", body.offset))}
    return {
        "case": "off-centre", "title": START.title, "ball": one | more, "gravity": decimal(body.gravity),
        **found.write(),
    }  # fmt: skip

"""Methods for systems with constraints on their velocities, as equations for the unknowns of a step.

A state has the coordinates and velocities, or momenta, at the start of a step.  The unknowns are velocities,
accelerations and multipliers, so that those of successive steps are near each other.  L is the Lagrangian, p = ∂L/∂v,
f = ∂L/∂q + F with the forces F, A v + b = 0 the constraints, and h the length of a step.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from typing import Any

import sympy as sp

from chapsym.dynamics.implicit import Vector
from chapsym.numbers import brief, plain_text

from .system import STEP, BadSystem, System, a_system, after


@dataclass(frozen=True, eq=False)
class Scheme:
    """A method for a system, in symbols.

    Attributes
    ----------
    state : tuple of sympy.Symbol
        The symbols of the state at the start of a step: first the coordinates.
    unknowns : tuple of sympy.Symbol
        The unknowns of the equations.
    residual : sequence of sympy.Expr
        Expressions that vanish at a step, as many as unknowns.
    after : sequence of sympy.Expr
        The next state, in state and unknowns; for an explicit method the rates of the state, at any state.
    place, velocity : sequence of sympy.Expr
        Coordinates and velocities at which the energy and the constraints of the step are evaluated.
    when : sympy.Rational
        The fraction of the step after which these are evaluated.
    start, guess : sequence of sympy.Expr
        The first state and the first guess of the unknowns, in coordinates and velocities.
    reflects : bool
        Whether the momenta of a state are those before a reflecting reaction, not those of its velocities.
    stages : sequence of sequence of sympy.Rational
        For an explicit Runge-Kutta method the rows of its tableau, then its weights; otherwise empty.
    integrals : mapping
        {name: quantity of only this method}, in the coordinates and velocities of the evaluation, and `STEP`.
    """

    state: Sequence[sp.Symbol]
    unknowns: Sequence[sp.Symbol]
    residual: Sequence[sp.Expr]
    after: Sequence[sp.Expr]
    place: Sequence[sp.Expr]
    velocity: Sequence[sp.Expr]
    start: Sequence[sp.Expr]
    guess: Sequence[sp.Expr]
    when: sp.Rational = sp.S.Zero
    reflects: bool = False
    stages: Sequence[Sequence[sp.Rational]] = ()
    integrals: Mapping[str, sp.Expr] = field(default_factory=dict)

    def step(self, state: Vector, first: Vector, length: Any, rates: Callable[[Any], Vector], number: Any) -> Any:
        """The next state in any numbers, by `after` at the state and, for an explicit method, at its stages."""
        known, at = [first], first
        for row in self.stages:
            weights = list(map(number, row))
            at = [x + length * sum(a * k[i] for a, k in zip(weights, known, strict=True)) for i, x in enumerate(state)]
            if row is not self.stages[-1]:
                known.append(rates(at))
        return at


@dataclass(frozen=True)
class Method:
    """A method for systems.

    Attributes
    ----------
    name : str
        Its name in tables.
    title : str
        Its full name.
    source : str
        Where it comes from.
    scheme : callable
        Its equations for a system: System to Scheme.

    Examples
    --------
    >>> from chapsym.mechanics import METHODS
    >>> METHODS["gni"].title
    'geometric nonholonomic integrator'
    """

    name: str
    title: str
    source: str
    scheme: Callable[[System], Scheme]


class _Parts:
    """The functions of a system at any position and velocity, and the symbols of a scheme."""

    def __init__(self, system: System) -> None:
        self.system, self.n, self.m = system, len(a_system(system).coordinates), system.rows.rows
        self.q, self.v = sp.Matrix(system.coordinates), sp.Matrix(system.velocities)
        self.p = self.symbols("p", self.n)

    def symbols(self, name: str, count: int) -> sp.Matrix:
        """Symbols of the unknowns or of the state."""
        return sp.Matrix([sp.Symbol(f"{name} {i}") for i in range(count)])  # a name that no symbol of a system has

    def at(self, of: sp.Matrix, q: sp.Matrix, v: sp.Matrix | None = None) -> sp.Matrix:
        """A function of coordinates, and of velocities, at others."""
        places: Mapping[sp.Symbol, sp.Expr] = dict(zip(self.q, q, strict=True))
        if v is not None:
            places = {**places, **dict(zip(self.v, v, strict=True))}
        return of.xreplace(places)

    def momenta(self, q: sp.Matrix, v: sp.Matrix) -> sp.Matrix:
        return self.at(self.system.momenta, q, v)

    def push(self, q: sp.Matrix, v: sp.Matrix) -> sp.Matrix:
        return self.at(self.system.push, q, v)

    def held(self, q: sp.Matrix, multipliers: sp.Matrix) -> sp.Matrix:
        """Aᵀλ."""
        return self.at(self.system.rows.T, q) * multipliers if self.m else sp.zeros(self.n, 1)

    def kept(self, q: sp.Matrix, v: sp.Matrix, end: sp.Matrix | None = None) -> sp.Matrix:
        """A v + b; for holonomic constraints their values at `end`, if given."""
        rates = self.at(self.system.rows, q) * v + self.at(self.system.offsets, q) if self.m else sp.Matrix([])
        if end is None or not self.system.holonomic:
            return sp.Matrix(rates)
        first = self.m - len(self.system.holonomic)
        return sp.Matrix([*rates[:first], *self.at(sp.Matrix(list(self.system.holonomic)), end)])


def discrete(alpha: sp.Rational, system: System) -> Scheme:
    """The discrete Lagrange-d'Alembert principle with h L(q + α h u, u), u = (q' - q)/h, the constraint at this
    position.

    p + h(1 - α) f - ∂L/∂v + A(q)ᵀλ = 0 and p' = ∂L/∂v + h α f, all at (q + α h u, u).
    """
    of = _Parts(system)
    u, multipliers = of.symbols("u", of.n), of.symbols("lam", of.m)
    place, end = of.q + alpha * STEP * u, of.q + STEP * u
    momenta, push = of.momenta(place, u), of.push(place, u)
    balance = of.p + STEP * (1 - alpha) * push - momenta + of.held(of.q, multipliers)
    return Scheme(
        (*of.q, *of.p), (*u, *multipliers), [*balance, *of.kept(place, u, end)],
        [*end, *(momenta + STEP * alpha * push)], list(place), list(u),
        [*of.q, *system.momenta], [*of.v, *([sp.S.Zero] * of.m)], alpha,
    )  # fmt: skip


def own(system: System) -> Scheme:
    """The discrete Lagrange-d'Alembert principle with a user's discrete Lagrangian and constraints.

    p + D₁L(q, q') + A(q)ᵀλ = 0, the discrete constraints, and p' = D₂L(q, q').
    """
    system = a_system(system)
    if system.discrete is None:
        raise BadSystem(f"{system.name} has no discretization of its own: give it discrete=Discrete(...)")
    of, action = _Parts(system), system.discrete.lagrangian
    u, multipliers = of.symbols("u", of.n), of.symbols("lam", of.m)
    end = of.q + STEP * u
    there = {after(x): e for x, e in zip(system.coordinates, end, strict=True)}
    both = system.coordinates, there
    first, last = (sp.Matrix([_divided(sp.diff(action, x).xreplace(there)) for x in ends]) for ends in both)
    kept = [_divided(c.xreplace(there)) for c in system.discrete.constraints]
    held = [of.at(sp.Matrix([c]), end)[0] for c in system.holonomic]
    half = STEP * of.v / 2
    ends = {**dict(zip(of.q, of.q - half, strict=True)), **dict(zip(there, of.q + half, strict=True))}
    return Scheme(
        (*of.q, *of.p), (*u, *multipliers), [*(of.p + first + of.held(of.q, multipliers)), *kept, *held],
        [*end, *last], list((of.q + end) / 2), list(u), [*of.q, *system.momenta], [*of.v, *([sp.S.Zero] * of.m)],
        sp.S.Half, integrals={name: e.xreplace(ends) for name, e in system.discrete.integrals.items()},
    )  # fmt: skip


def _divided(expr: sp.Expr) -> sp.Expr:
    """A polynomial over the length of a step, divided by it if possible."""
    try:
        whole = sp.Poly(sp.expand(expr * STEP), STEP)
    except sp.PolynomialError:
        return expr
    return sp.Poly(whole.all_coeffs()[:-1], STEP).as_expr() if whole.nth(0) == 0 and whole.degree() > 0 else expr


def geometric(system: System) -> Scheme:
    """The geometric nonholonomic integrator: with p⁻ before and p⁺ = p⁻ + Aᵀλ after the reaction at q, the velocity of
    (p⁻ + p⁺)/2 obeys the constraint at q; then a free step of h L(q + h u/2, u).
    """
    of = _Parts(system)
    u, w, multipliers = of.symbols("u", of.n), of.symbols("w", of.n), of.symbols("lam", of.m)
    place, end = of.q + STEP * u / 2, of.q + STEP * u
    momenta, push = of.momenta(place, u), of.push(place, u)
    held = of.held(of.q, multipliers)
    residual = [
        *(of.p + held + STEP * push / 2 - momenta), *(of.momenta(of.q, w) - of.p - held / 2), *of.kept(of.q, w, end)
    ]  # fmt: skip
    return Scheme(
        (*of.q, *of.p), (*u, *w, *multipliers), residual, [*end, *(momenta + STEP * push / 2)], list(of.q), list(w),
        [*of.q, *system.momenta], [*of.v, *of.v, *([sp.S.Zero] * of.m)], reflects=True,
    )  # fmt: skip


def leapfrog(system: System) -> Scheme:
    """The nonholonomic leapfrog: half a step of the position, the kick with the reaction there, half a step of the
    position.

    p = ∂L/∂v(m, u), p' = ∂L/∂v(m, w) = p + h (f(m, u) + f(m, w))/2 + A(m)ᵀλ, A(m)(u + w)/2 + b(m) = 0, m = q + h u/2,
    q' = m + h w/2.
    """
    of = _Parts(system)
    u, w, multipliers = of.symbols("u", of.n), of.symbols("w", of.n), of.symbols("lam", of.m)
    place = of.q + STEP * u / 2
    end, after = place + STEP * w / 2, of.momenta(place, w)
    kick = STEP * (of.push(place, u) + of.push(place, w)) / 2 + of.held(place, multipliers)
    residual = [*(of.momenta(place, u) - of.p), *(after - of.p - kick), *of.kept(place, (u + w) / 2, end)]
    return Scheme(
        (*of.q, *of.p), (*u, *w, *multipliers), residual, [*end, *after], list(place), list((u + w) / 2),
        [*of.q, *system.momenta], [*of.v, *of.v, *([sp.S.Zero] * of.m)], sp.S.Half,
    )  # fmt: skip


def lobatto(system: System) -> Scheme:
    """SPARK with the Lobatto pair of two stages: velocities V₁ at q and V₂ at q' = q + h(V₁ + V₂)/2, of one momentum P.

    P = p + h f(q, V₁)/2 + A(q)ᵀλ, p' = P + h f(q', V₂)/2 + A(q')ᵀμ, A V₁ + A V₂ = 0, and A v' = 0 at the end.
    """
    of = _Parts(system)
    first, last, end = (of.symbols(x, of.n) for x in ("u", "w", "z"))
    lam, mu = of.symbols("lam", of.m), of.symbols("mu", of.m)
    place = of.q + STEP * (first + last) / 2
    middle = of.momenta(of.q, of.v) + STEP * of.push(of.q, first) / 2 + of.held(of.q, lam)
    finish = middle + STEP * of.push(place, last) / 2 + of.held(place, mu)
    mean = (of.kept(of.q, first, place) + of.kept(place, last, place)) / 2
    residual = [
        *(of.momenta(of.q, first) - middle), *(of.momenta(place, last) - middle), *mean,
        *(of.momenta(place, end) - finish), *of.kept(place, end),
    ]  # fmt: skip
    return Scheme(
        (*of.q, *of.v), (*first, *last, *end, *lam, *mu), residual, [*place, *end], list(of.q), list(of.v),
        [*of.q, *of.v], [*of.v, *of.v, *of.v, *([sp.S.Zero] * (2 * of.m))],
    )  # fmt: skip


def midpoint(system: System) -> Scheme:
    """The implicit midpoint rule for the equations solved for the accelerations."""
    of = _Parts(system)
    a, multipliers = of.symbols("a", of.n), of.symbols("lam", of.m)
    velocity = of.v + STEP * a / 2
    place = of.q + STEP * velocity / 2
    return Scheme(
        (*of.q, *of.v), (*a, *multipliers), _accelerated(of, a, multipliers, place, velocity),
        [*(of.q + STEP * velocity), *(of.v + STEP * a)], list(of.q), list(of.v), [*of.q, *of.v],
        [sp.S.Zero] * (of.n + of.m),
    )  # fmt: skip


def explicit(stages: Sequence[Sequence[str]], system: System) -> Scheme:
    """An explicit Runge-Kutta method for the equations solved for the accelerations."""
    of = _Parts(system)
    a, multipliers = of.symbols("a", of.n), of.symbols("lam", of.m)
    return Scheme(
        (*of.q, *of.v), (*a, *multipliers), _accelerated(of, a, multipliers, of.q, of.v), [*of.v, *a], list(of.q),
        list(of.v), [*of.q, *of.v], [sp.S.Zero] * (of.n + of.m),
        stages=[[sp.Rational(x) for x in row] for row in stages],
    )  # fmt: skip


def _accelerated(of: _Parts, a: sp.Matrix, lam: sp.Matrix, place: sp.Matrix, velocity: sp.Matrix) -> list[sp.Expr]:
    matrix, right = of.system.equations
    return list(of.at(matrix, place) * sp.Matrix([*a, *lam]) - of.at(right, place, velocity))


METHODS: dict[str, Method] = {
    one.name: one
    for one in (
        Method("dla", "discrete Lagrange-d'Alembert, middle", "J. Cortés, S. Martínez, Nonlinearity 14 (2001) 1365",
               partial(discrete, sp.S.Half)),
        Method("own", "discrete Lagrange-d'Alembert, of one's own", "the same", own),
        Method("dla-left", "discrete Lagrange-d'Alembert, left end", "the same", partial(discrete, sp.S.Zero)),
        Method("gni", "geometric nonholonomic integrator",
               "S. Ferraro, D. Iglesias, D. Martín de Diego, Nonlinearity 21 (2008) 1911", geometric),
        Method("leapfrog", "nonholonomic leapfrog",
               "R. McLachlan, M. Perlmutter, J. Nonlinear Sci. 16 (2006) 283, (4.18)", leapfrog),
        Method("spark", "SPARK, Lobatto of two stages", "L. O. Jay, BIT 43 (2003) 93", lobatto),
        Method("midpoint", "implicit midpoint rule", "of the equations of motion", midpoint),
        Method("rk4", "Runge-Kutta of order 4", "of the equations of motion",
               partial(explicit, [["1/2"], ["0", "1/2"], ["0", "0", "1"], ["1/6", "1/3", "1/3", "1/6"]])),
    )
}  # fmt: skip


def scheme_of(system: System, method: object) -> Scheme:
    """The equations of a method, by its name, for a system; raises BadSystem for an unknown method."""
    name = plain_text(method)
    if name not in METHODS:
        raise BadSystem(f"{brief(method)} is no method; those are {', '.join(METHODS)}")
    return METHODS[name].scheme(a_system(system))
